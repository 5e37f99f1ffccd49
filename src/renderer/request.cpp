// What is to be drawn: whether it can be, and which setups it takes.
#include <algorithm>
#include <cmath>

#include "base/pixels.h"
#include "renderer/feature_list.h"
#include "renderer/impl.h"
#include "scene/prepare_mesh.h"
#include "scumble/nearest.h"
#include "stage/light.h"
#include "stage/view_check.h"

namespace scumble {

using namespace frame;
using namespace renderer;

namespace {

constexpr double kFarthest = scene::kMaxCoordinate;  // metres

bool isPicture(const Image& image) {
  const size_t channels = image.channels.size();
  return image.width > 0 && image.height > 0 && (channels == 3 || channels == 4) &&
         image.pixels.size() == size_t(image.width) * image.height * channels;
}

}  // namespace

Status Renderer::Impl::check(const Request& request) const {
  const Scene& scene = request.scene;
  const double time = request.time;
  const std::vector<View>& views = request.views;
  const RenderOptions& options = request.options;
  const Delivery* const delivery = request.delivery;
  if (scene.empty()) return usage("the scene is empty", "load one with Scene::load");
  // Sizes and samples.
  const uint32_t largest = std::min(kMaxImageSide, device->limits().maxImageDimension2D);
  const auto isSize = [&](glm::uvec2 size) {
    return size.x >= 1 && size.y >= 1 && size.x <= largest && size.y <= largest;
  };
  const auto badSize = [&](glm::uvec2 size) {
    return usage("a picture of " + std::to_string(size.x) + "x" + std::to_string(size.y) + " is out of range",
                 "use 1x1 to " + std::to_string(largest) + "x" + std::to_string(largest));
  };
  if (const glm::uvec2 size(options.width, options.height); !isSize(size)) return badSize(size);
  if (options.samples != 1 && options.samples != 4)
    return usage("the number of samples is neither 1 nor 4", "use 4");
  if (options.samples == 4 && !device->supports4Samples())
    return usage("this device has no 4 samples a pixel", "use --samples 1");
  // Views, now and a frame before.
  if (views.empty() || views.size() > size_t(kMaxViews))
    return usage("there are " + std::to_string(views.size()) + " views",
                 "give one, a left and a right one, or up to " + std::to_string(kMaxViews));
  if (!options.previousViews.empty() && options.previousViews.size() != views.size())
    return usage("there are not as many previous views as views", "give one for each, or none at all");
  for (const std::vector<View>* seen : {&views, &options.previousViews})
    for (const View& view : *seen) {
      if (const std::string problem = problemWith(view); !problem.empty())
        return usage(problem, "see View in scumble/view.h, or make views with makeViews");
      if (view.node >= int(scene.data().nodes.size()))
        return usage("a view hangs on a node that the scene does not have", "make views of this scene");
      if (view.size != glm::uvec2(0) && !isSize(view.size)) return badSize(view.size);
    }
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(options.positionsFrom[axis]) <= kFarthest))
      return usage("positions count from a place that is out of range", "give metres, up to 1e15");
  if (const std::optional<SpherePart>& sphere = options.sphere) {
    const glm::mat3 none = glm::transpose(sphere->eyeToSphere) * sphere->eyeToSphere - glm::mat3(1.0f);
    const bool isTurn = glm::length(none[0]) + glm::length(none[1]) + glm::length(none[2]) < 1e-3f &&
                        glm::determinant(sphere->eyeToSphere) > 0;
    if (!isTurn) return usage("eyeToSphere is no turn", "see SpherePart in scumble/renderer.h");
    if (!(sphere->knobHeight > 0.001f && sphere->knobHeight < 100))
      return usage("a sphere's knobHeight is out of range", "give radians, like 1.57");
    if (std::any_of(views.begin(), views.end(), isParallel))
      return usage("a view without perspective is no part of a sphere", "use a perspective one");
  }
  if (!options.previousScene.empty()) {
    const scene::SceneData &now = scene.data(), &then = options.previousScene.data();
    if (&now != &then &&
        (now.family == 0 || now.family != then.family || now.nodes.size() != then.nodes.size()))
      return usage("the previous scene is another one",
                   "give an earlier one of the same SceneEditor, with as many nodes");
  }
  // Time, and the picture behind everything.
  const double previousTime = options.previousTime.value_or(time);
  if (!(std::abs(time) < kMaxTime && std::abs(previousTime) < kMaxTime))
    return usage("the time is out of range", "give it in seconds, up to a million");
  const Image* const background = backgroundOf(request);
  if (background && !isPicture(*background))
    return usage("the background is no picture", "give it channels R, G, B, and as many pixels as it says");
  if (background && std::max(background->width, background->height) > largest)
    return usage("a background of " + std::to_string(background->width) + "x" +
                     std::to_string(background->height) + " is out of range",
                 "use up to " + std::to_string(largest) + " a side");
  if (begun.size() >= size_t(kMaxBegun))
    return usage("too many frames have been begun", "call finish() first");

  if (options.drawing && (delivery || request.isYardstick))
    return usage("only frames that come back have drawings", "render the picture by itself");
  if (options.drawing && aovsOfDrawings(request.scene.data(), request.look.at(time)).empty())
    return usage("a drawing is made of lines", adviceForDrawings());
  // Only what a pass offers can be saved.
  const std::vector<const Aov*> offered = request.isYardstick ? std::vector<const Aov*>() : aovs;
  std::vector<std::string> names = options.aovs;
  const std::vector<std::string> readBack = readBackOf(request);
  names.insert(names.end(), readBack.begin(), readBack.end());
  if (delivery)
    for (const Delivery::Target& target : delivery->targets)
      if (!target.key.aov.empty()) names.push_back(target.key.aov);
  for (const std::string& name : names)
    if (std::none_of(offered.begin(), offered.end(), [&](const Aov* aov) { return name == aov->name; })) {
      const std::string suggestion = nearest(name, aovNames());
      return usage("there is no AOV '" + name + "'", suggestion.empty()
                                                         ? "`scumble render --help` lists them"
                                                         : "did you mean '" + suggestion + "'?");
    }
  // And only as it can be.
  for (const std::pair<const std::string, PixelFormat>& wanted : options.formats) {
    const std::string& name = wanted.first;
    if (name.empty()) continue;
    if (std::find(options.aovs.begin(), options.aovs.end(), name) == options.aovs.end() &&
        std::find(readBack.begin(), readBack.end(), name) == readBack.end())
      return usage("there is a format for '" + name + "', which is not asked for", "name it in aovs as well");
    const bool isColor = std::any_of(offered.begin(), offered.end(),
                                     [&](const Aov* aov) { return name == aov->name && aov->isColor; });
    if (wanted.second == PixelFormat::srgb8 && !isColor)
      return usage("the AOV '" + name + "' is no colour", "8-bit codes are for colours only");
  }
  return Done{};
}

SetupKey Renderer::Impl::keyOf(const Request& request, const look::LookData& now) const {
  SetupKey key;
  key.configuration.samples = request.options.samples;
  key.configuration.computeImagePasses =
      imagePasses == ImagePassKind::compute ||
      (imagePasses == ImagePassKind::automatic && device->prefersCompute());
  key.configuration.hasBackdrop = backgroundOf(request) != nullptr;
  key.configuration.onSphere = request.options.sphere.has_value();
  key.plain = request.isYardstick;
  key.readsBack = !request.delivery;
  key.aovs = request.options.aovs;
  if (request.options.drawing)
    for (const std::string& name : aovsOfDrawings(request.scene.data(), now))
      if (std::find(key.aovs.begin(), key.aovs.end(), name) == key.aovs.end()) key.aovs.push_back(name);
  for (const auto& pass : key.plain ? askedPlain : asked)
    key.variants.push_back(pass->variant(request.scene.data(), now));
  key.lights = std::max<size_t>(1, punctualLightCount(request.scene.data()));
  return key;
}

std::vector<SetupKey> Renderer::Impl::keysOf(const Request& request, const look::LookData& now,
                                             std::vector<Begun::Part>& parts) const {
  std::vector<SetupKey> keys;
  std::vector<VkImage> delivered;  // by an earlier part
  const SetupKey common = keyOf(request, now);
  for (Begun::Part& part : parts) {
    const std::vector<size_t>& members = part.group.members;
    SetupKey& key = keys.emplace_back(common);
    key.configuration.viewCount = uint32_t(members.size());
    if (members.size() > 1)
      key.configuration.viewDrawing =
          device->viewDrawing(request.options.samples).value_or(gpu::ViewDrawing::together);
    if (!request.delivery) continue;
    for (const VulkanReadback& readback : request.delivery->readbacks) {
      if (std::find(members.begin(), members.end(), readback.view) == members.end()) continue;
      if (readback.aov.empty())
        key.readsBack = true;
      else if (std::find(key.aovs.begin(), key.aovs.end(), readback.aov) == key.aovs.end())
        key.aovs.push_back(readback.aov);
    }
    for (const Delivery::Target& target : request.delivery->targets) {
      const auto member = std::find(members.begin(), members.end(), target.view);
      if (member == members.end()) continue;
      const auto image = std::find(part.images.begin(), part.images.end(), target.image);
      TargetKey& own = key.targets.emplace_back(target.key);
      own.image = uint32_t(image - part.images.begin());
      own.view = uint32_t(member - members.begin());
      if (image == part.images.end()) part.images.push_back(target.image);
      // What a part before has drawn into it stays.
      if (std::find(delivered.begin(), delivered.end(), target.image) != delivered.end())
        own.before = own.after;
    }
    delivered.insert(delivered.end(), part.images.begin(), part.images.end());
  }
  return keys;
}

}  // namespace scumble
