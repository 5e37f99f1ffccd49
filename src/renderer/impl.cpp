#include "renderer/impl.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "frame/framing.h"
#include "frame/light.h"
#include "frame/palette.h"
#include "frame/playing.h"
#include "frame/view_check.h"
#include "scumble/nearest.h"

namespace scumble {

using namespace frame;
using namespace renderer;

namespace {

using Clock = std::chrono::steady_clock;
double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

static_assert(Renderer::kMaxBegun <= int(gpu::kFramesInFlight), "each frame begun has copies of its own");

bool isPicture(const Image& image) {
  const size_t channels = image.channels.size();
  return image.width > 0 && image.height > 0 && (channels == 3 || channels == 4) &&
         image.pixels.size() == size_t(image.width) * image.height * channels;
}

// Frame::objects.
std::vector<std::string> objectNames(const scene::SceneData& scene, const GeometryOptions& options) {
  std::vector<std::string> names;
  for (const scene::Node& node : scene.nodes)
    names.push_back(node.mesh < 0       ? ""
                    : node.name.empty() ? "node " + std::to_string(names.size() + 1)
                                        : node.name);
  names.push_back(options.ground ? "Ground" : "");
  names.push_back(options.ocean.isThere ? "Ocean" : "");
  return names;
}

// Views that hang on nodes, where waves move those.
std::vector<View> ridden(std::vector<View> views, const SceneMotion& motion) {
  for (View& view : views)
    if (view.node >= 0) view.worldToEye *= glm::inverse(motion.riding(size_t(view.node)));
  return views;
}

// The picture behind everything has texels for the largest of all views.
glm::uvec2 largestOf(const std::vector<ViewGroup>& groups) {
  glm::uvec2 largest(0);
  for (const ViewGroup& group : groups) largest = glm::max(largest, group.size);
  return largest;
}

const Image* backgroundOf(const Request& request) {
  const RenderOptions& options = request.options;
  return options.transparent || request.isYardstick ? nullptr : options.background.get();
}

}  // namespace

namespace renderer {

Error usage(std::string problem, std::string advice) {
  return {ErrorKind::usage, "", 0, "", std::move(problem), std::move(advice)};
}

}  // namespace renderer

Renderer::Impl::Impl(std::unique_ptr<gpu::Device> made, const RendererOptions& options)
    : device(std::move(made)), imagePasses(options.imagePasses), sceneBudget(options.sceneBudget) {
  samplers.emplace(*device);
  examples.emplace(*device);
  lookTextures.emplace(*device);
  passes = standardPasses();
  if (options.arrangePasses) options.arrangePasses(passes);
  asked = passes.makeAll();
  aovs = aovsOf(asked);
}

Renderer::Impl::~Impl() {
  for (auto& submission : submissions) submission.reset();
  residents.clear();
  backdrop.reset();
  lookTextures.reset();
  examples.reset();
  samplers.reset();
}

// -- What is on the device

Resident& Renderer::Impl::useScene(const Scene& wanted, const GeometryOptions& options, FrameStats& stats) {
  const auto found = std::find_if(residents.begin(), residents.end(), [&](const Resident& resident) {
    const scene::SceneData &is = resident.scene.data(), &becomes = wanted.data();
    return &is == &becomes || (is.family != 0 && is.family == becomes.family);
  });
  if (found != residents.end()) {
    residents.splice(residents.begin(), residents, found);
  } else {
    fetchAll();
    keepBudget(0);
    residents.emplace_front(*device, *samplers, wanted);
  }
  Resident& resident = residents.front();
  if (resident.onGpu.isOf(wanted.data(), options)) return resident;
  try {
    const SceneOnGpu::Written before = resident.onGpu.written();
    const SceneOnGpu::Changes changes = resident.onGpu.update(wanted.data(), options, [&] { fetchAll(); });
    resident.scene = wanted;
    const SceneOnGpu::Written now = resident.onGpu.written();
    stats.writtenPrimitives = now.primitives - before.primitives;
    stats.writtenTextures = now.textures - before.textures;
    stats.writtenMaterials = now.materials - before.materials;
    if (changes.materials)
      resident.setups.clear();
    else if (changes.buffers)
      for (const std::unique_ptr<Setup>& setup : resident.setups) setup->bindScene();
  } catch (...) {
    // What is half of one and half of the other goes, when nobody draws from it any more.
    for (auto& submission : submissions) submission.reset();
    residents.pop_front();
    throw;
  }
  return resident;
}

void Renderer::Impl::keepBudget(size_t least) {
  while (residents.size() > least && device->memory().bytesInUse() > sceneBudget) {
    fetchAll();
    residents.pop_back();
  }
}

void Renderer::Impl::useBackdrop(const glm::uvec2& texels) {
  if ((backdrop ? backdrop->size() : glm::uvec2(0)) == texels) return;
  fetchAll();
  for (Resident& resident : residents) resident.setups.clear();
  backdrop.reset();
  if (texels.x > 0) backdrop.emplace(*device, texels);
}

void Renderer::Impl::useSetups(Resident& resident, const std::vector<SetupKey>& keys, Begun& frame,
                               const std::function<void(double)>& progress) {
  std::vector<std::unique_ptr<Setup>>& had = resident.setups;
  std::vector<std::unique_ptr<Setup>> now(keys.size());
  // Those that fit as they are; then those that fit but for their size.
  for (const bool sizeToo : {true, false})
    for (size_t i = 0; i < keys.size(); ++i)
      for (std::unique_ptr<Setup>& setup : had)
        if (!now[i] && setup && setup->key() == keys[i] &&
            (!sizeToo || setup->size() == frame.parts[i].group.size))
          now[i] = std::move(setup);
  bool fits = std::none_of(had.begin(), had.end(), [](const auto& setup) { return bool(setup); });
  for (size_t i = 0; i < keys.size(); ++i) fits &= now[i] && now[i]->size() == frame.parts[i].group.size;
  if (!fits) {
    // Frames under way may use what changes or goes.
    for (std::unique_ptr<Setup>& setup : had)
      if (setup) now.push_back(std::move(setup));
    fetchAll();
    now.resize(keys.size());
    for (size_t i = 0; i < keys.size(); ++i)
      if (now[i]) now[i]->resize(frame.parts[i].group.size);
    const VkBuffer positions = resident.onGpu.previousPositions().handle();
    for (size_t i = 0; i < keys.size(); ++i)
      if (!now[i])
        now[i] =
            std::make_unique<Setup>(*device, *samplers, *examples, resident.onGpu,
                                    keys[i].plain ? plain : passes, keys[i], frame.parts[i].group.size,
                                    [&](double part) { progress((double(i) + part) / double(keys.size())); });
    // One that needs to know where everything was has made room for it: others name what was there before.
    if (resident.onGpu.previousPositions().handle() != positions)
      for (const std::unique_ptr<Setup>& setup : now) setup->bindScene();
  }
  had = std::move(now);
  for (size_t i = 0; i < keys.size(); ++i) frame.parts[i].setup = had[i].get();
}

// -- What is to be drawn

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

  // Only what a pass offers can be saved.
  const std::vector<const Aov*> offered = request.isYardstick ? std::vector<const Aov*>() : aovs;
  std::vector<std::string> names = options.aovs;
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
    if (std::find(options.aovs.begin(), options.aovs.end(), name) == options.aovs.end())
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
  key.plain = request.isYardstick;
  key.readsBack = !request.delivery;
  key.aovs = request.options.aovs;
  if (key.plain)
    key.variants.assign(2, 0);
  else
    for (const auto& pass : asked) key.variants.push_back(pass->variant(request.scene.data(), now));
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

uint32_t Renderer::Impl::freeSlot() const {
  uint32_t slot = 0;
  const auto isTaken = [&](const Begun& frame) { return frame.slot == slot; };
  while (std::any_of(begun.begin(), begun.end(), isTaken)) ++slot;
  return slot;
}

// -- A frame

Status Renderer::Impl::begin(const Request& request) {
  if (Status status = check(request); !status) return status;
  const Scene& scene = request.scene;
  const look::LookData& look = request.look;
  const double time = request.time;
  const std::vector<View>& views = request.views;
  const RenderOptions& options = request.options;
  const Delivery* const delivery = request.delivery;
  const look::LookData now = look.at(time);
  const std::vector<ViewGroup> groups = groupViews(views, {options.width, options.height});
  const Image* const background = backgroundOf(request);

  // Scene, pipelines, and all of the frame that is left.
  const auto progress = [&](double part) {
    const double whole = request.progressFrom + part * (request.progressTo - request.progressFrom);
    if (options.progress && !options.progress(whole)) throw Cancelled();
  };
  try {
    progress(0);
    const bool isTogether = std::any_of(groups.begin(), groups.end(),
                                        [](const ViewGroup& group) { return group.members.size() > 1; });
    if (isTogether && !device->viewDrawing(options.samples))
      return usage("this device draws several views wrongly, whichever way, at " +
                       std::to_string(options.samples) + " samples a pixel",
                   options.samples > 1 ? "use --samples 1" : "choose another device");
    Begun next;
    next.slot = freeSlot();
    next.viewCount = views.size();
    next.formats = options.formats;
    for (const ViewGroup& group : groups) next.parts.push_back({group});
    FrameStats& stats = next.frame.stats;
    const uint32_t pipelinesBefore = device->pipelines().made();
    auto start = Clock::now();
    const auto lap = [&] {
      const double elapsed = millisecondsSince(start);
      start = Clock::now();
      return elapsed;
    };

    // The scene, as the look has it, and what its views are drawn with.
    GeometryOptions geometry;
    geometry.ocean = oceanShape(scene.data(), now);
    geometry.ground = hasGround(scene.data(), now, background != nullptr) && !options.transparent;
    geometry.ground &= !geometry.ocean.isThere || now.get<GroundParams>().mode == 1;
    geometry.shadowWarp = now.get<LightParams>().shadowWarp;
    geometry.casts = shadowCasters(scene.data(), now);
    geometry.clips = everPlayed(scene.data(), look);
    geometry.nodes = nodeSettings(scene.data(), now);
    for (const Aov* const aov : aovs)
      if (aov->namesObjects &&
          std::find(options.aovs.begin(), options.aovs.end(), aov->name) != options.aovs.end())
        next.frame.objects = objectNames(scene.data(), geometry);
    Resident& resident = useScene(scene, geometry, stats);
    const glm::uvec2 frameSize = largestOf(groups);
    const glm::uvec2 texels =
        background ? Backdrop::sizeFor(*background, frameSize.x, frameSize.y) : glm::uvec2(0);
    useBackdrop(texels);
    stats.uploadMilliseconds = lap();
    progress(0.3);
    useSetups(resident, keysOf(request, now, next.parts), next,
              [&](double part) { progress(0.3 + 0.6 * part); });
    keepBudget(1);
    stats.setupMilliseconds = lap();

    // Everything to its place.
    SceneOnGpu& sceneOnGpu = resident.onGpu;
    sceneOnGpu.pose(look, now, time);
    const bool needsPrevious = std::any_of(next.parts.begin(), next.parts.end(), [](const Begun::Part& part) {
      return part.setup->needsPrevious();
    });
    const double previousTime = options.previousTime.value_or(time);
    if (needsPrevious)
      sceneOnGpu.posePrevious(options.previousScene.empty() ? scene.data() : options.previousScene.data(),
                              look, look.at(previousTime), previousTime);
    const std::vector<View> seenFrom = ridden(views, sceneOnGpu.motion());
    std::vector<View> seenBefore;
    if (needsPrevious)
      seenBefore =
          ridden(options.previousViews.empty() ? views : options.previousViews, *sceneOnGpu.previousMotion());

    // What all views see alike.
    std::vector<float> margins;
    for (const ViewGroup& group : groups)
      margins.push_back(largestInflation(now, sceneOnGpu, float(group.size.y)) + 1);
    sceneOnGpu.look(viewersOf(seenFrom, groups, margins));
    for (size_t m = 0; m < sceneOnGpu.materialCount(); ++m) {
      const ChosenSets sets = chosenSets(sceneOnGpu, m, now, *lookTextures);
      sceneOnGpu.setColorSets(m, sets.lit ? &*sets.lit : nullptr, sets.shadowed ? &*sets.shadowed : nullptr);
      sceneOnGpu.setMaterial(m, materialData(sceneOnGpu, m, now, background != nullptr, colorMaps));
    }

    // What each group of them sees.
    for (Begun::Part& part : next.parts) {
      shared::FrameUniforms uniforms =
          frameUniforms(sceneOnGpu, now, viewsOf(part.group, seenFrom), viewsOf(part.group, seenBefore),
                        rigOf(part.group.rig, seenFrom), time, part.group.size);
      const std::vector<shared::PunctualLight> lights = punctualLights(
          scene.data(), now.get<LightParams>(), sceneOnGpu.motion().world(), uniforms.sceneRadius);
      uniforms.lightCount = uint32_t(lights.size());
      std::optional<BackdropInput> behind;
      if (background)
        behind = {&backdrop->image(), backdropUniforms(sceneOnGpu, now, uniforms, texels, colorMaps)};
      part.setup->update({now, time, uniforms, sceneOnGpu, options.transparent || background, options.seed,
                          behind ? &*behind : nullptr},
                         lights);
      part.setup->setTargets(next.slot, part.images);
    }

    progress(1);
    if (request.isRehearsal) {
      // What has been posed was not drawn.
      sceneOnGpu.forgetPoses();
      return Done{};
    }

    // Off it goes.
    std::optional<gpu::Submission>& submission = submissions[next.slot];
    if (!submission) submission.emplace(*device);
    gpu::Device::Around around;
    if (delivery) around.waits = delivery->waits, around.signals = delivery->signals;
    if (options.latch) around.last = [&] { latch(request, sceneOnGpu.motion(), next); };
    submission->submit([&](VkCommandBuffer commands) { record(commands, resident, next, request.options); },
                       around);
    stats.cpuMilliseconds = lap();
    device->savePipelineCache();
    stats.pipelines = device->pipelines().made() - pipelinesBefore;
    stats.triangles = sceneOnGpu.triangleCount();
    stats.drawCalls = sceneOnGpu.draws().size();
    stats.deviceBytes = device->memory().bytesInUse();
    stats.uploadedBytes = sceneOnGpu.uploadedBytes();
    for (const Begun::Part& part : next.parts) {
      stats.imageBytes += part.setup->resources().bytes();
      stats.imageBytesUnshared += part.setup->resources().bytesUnshared();
    }
    begun.push_back(std::move(next));
    return Done{};
  } catch (const Cancelled&) {
    return cancelled();
  } catch (const gpu::VulkanError& error) {
    return failure(error);
  } catch (const std::bad_alloc&) {
    return outOfMemory();
  } catch (...) {
    // The caller's own, out of a callback.
    (void)cancelled();
    throw;
  }
}

void Renderer::Impl::latch(const Request& request, const SceneMotion& motion, const Begun& frame) {
  std::vector<View> views = request.views;
  request.options.latch(views);
  // What cannot be drawn from changes nothing.
  std::string problem;
  if (views.size() != request.views.size()) problem = "there are more or fewer views than before";
  for (size_t i = 0; i < views.size() && problem.empty(); ++i) {
    views[i].node = request.views[i].node;
    problem = problemWith(views[i]);
  }
  if (!problem.empty()) {
    device->log(LogLevel::warning, "the newest views are not used: " + problem);
    return;
  }
  const std::vector<View> now = ridden(views, motion);
  for (const Begun::Part& part : frame.parts) {
    std::vector<shared::ViewUniforms> uniforms;
    const bool hasPrevious = !request.options.previousViews.empty();
    for (const size_t member : part.group.members) uniforms.push_back(viewUniforms(now[member], now[member]));
    part.setup->latch(frame.slot, uniforms, hasPrevious);
  }
}

void Renderer::Impl::record(VkCommandBuffer commands, Resident& resident, const Begun& frame,
                            const RenderOptions& options) {
  std::vector<gpu::PerFrameBuffer*> uploads;
  resident.onGpu.addUploads(uploads);
  for (const Begun::Part& part : frame.parts) {
    part.setup->beginTimes(commands, frame.slot);
    part.setup->addUploads(uploads);
  }
  gpu::recordUploads(commands, uploads, frame.slot);
  if (backdrop) backdrop->upload(commands, frame.slot, options.background);
  for (const Begun::Part& part : frame.parts) part.setup->record(commands, frame.slot);
}

void Renderer::Impl::fetch(Begun& frame) {
  if (frame.fetched) return;
  submissions[frame.slot]->wait();
  for (const Begun::Part& part : frame.parts) part.setup->readTimes(frame.slot, frame.frame.stats);
  const Clock::time_point start = Clock::now();
  for (const Begun::Part& part : frame.parts) {
    const bool isFirst = &part == &frame.parts.front();
    std::vector<Setup::Layer> layers = part.setup->readLayers(frame.slot, frame.formats);
    for (size_t i = 0; i < layers.size(); ++i) {
      if (isFirst)
        frame.frame.layers.push_back(
            {layers[i].name, std::vector<Image>(layers[i].isOnce ? 1 : frame.viewCount)});
      std::vector<Image>& into = frame.frame.layers[i].views;
      for (size_t v = 0; v < layers[i].views.size(); ++v)
        if (!layers[i].isOnce || isFirst)
          into[layers[i].isOnce ? 0 : part.group.members[v]] = std::move(layers[i].views[v]);
    }
  }
  frame.frame.stats.readbackMilliseconds = millisecondsSince(start);
  frame.fetched = true;
}

void Renderer::Impl::fetchAll() {
  for (Begun& frame : begun) fetch(frame);
}

// -- When something goes wrong

Error Renderer::Impl::cancelled() {
  try {
    fetchAll();
  } catch (const gpu::VulkanError& error) {
    return failure(error);
  } catch (const std::bad_alloc&) {
    return outOfMemory();
  }
  // What was half made goes, and what has been posed was not drawn.
  for (Resident& resident : residents) {
    resident.setups.clear();
    resident.onGpu.forgetPoses();
  }
  return {ErrorKind::cancelled, "", 0, "", "rendering was cancelled", ""};
}

void Renderer::Impl::abandon() {
  for (auto& submission : submissions) submission.reset();
  begun.clear();
  for (Resident& resident : residents) {
    resident.setups.clear();
    resident.onGpu.forgetPoses();
  }
  if (backdrop) backdrop->forget();
}

Error Renderer::Impl::failure(const gpu::VulkanError& error) {
  abandon();
  const bool internal = error.result == VK_ERROR_UNKNOWN || error.result == VK_ERROR_VALIDATION_FAILED_EXT;
  return {internal ? ErrorKind::internal : ErrorKind::noUsableGpu, "", 0, "", error.message(),
          "use a smaller picture or scene, or another --device"};
}

Error Renderer::Impl::outOfMemory() {
  abandon();
  return {ErrorKind::noUsableGpu, "", 0, "", "there is not enough memory", "use a smaller picture or scene"};
}

}  // namespace scumble
