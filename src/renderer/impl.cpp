#include "renderer/impl.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "passes/shadow_map/shadow_map_knobs.h"
#include "passes/surface/surface_knobs.h"
#include "renderer/feature_list.h"
#include "scene/seen.h"
#include "scumble/nearest.h"
#include "stage/framing.h"
#include "stage/light.h"
#include "stage/palette.h"
#include "stage/playing.h"
#include "stage/view_check.h"

namespace scumble {

using namespace frame;
using namespace renderer;

namespace {

using Clock = std::chrono::steady_clock;
double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

static_assert(Renderer::kMaxBegun <= int(gpu::kFramesInFlight), "each frame begun has copies of its own");

// Frame::objects: of what is seen at some time.
std::vector<std::string> objectNames(const scene::SceneData& scene, const GeometryOptions& options) {
  std::vector<std::string> names;
  const std::vector<bool> seen = scene::seenNodes(scene, options.clips);
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const scene::Node& node = scene.nodes[n];
    names.push_back(!seen[n] ? "" : node.name.empty() ? "node " + std::to_string(n + 1) : node.name);
  }
  names.push_back(options.ground ? "Ground" : "");
  for (const PlannedFeature& planned : options.features)
    if (!planned.feature->material().empty())
      names.emplace_back(planned.plan ? planned.feature->material() : "");
  return names;
}

// Views that hang on nodes, where features move those.
// Views in the scene's coordinates, carried by what features move.
std::vector<View> carried(const std::vector<View>& views, const Scene& scene, const SceneMotion& motion) {
  return carriedBy([&](int node) { return motion.movedBy(size_t(node)); },
                   countedFrom(scene.origin(), views));
}

// What follows waits for all that was recorded.
void waitForAll(VkCommandBuffer commands) {
  constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  gpu::memoryBarrier(commands, kAll, VK_ACCESS_2_MEMORY_WRITE_BIT, kAll,
                     VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT);
}

// The picture behind everything has texels for the largest of all views.
glm::uvec2 largestOf(const std::vector<ViewGroup>& groups) {
  glm::uvec2 largest(0);
  for (const ViewGroup& group : groups) largest = glm::max(largest, group.size);
  return largest;
}

}  // namespace

namespace renderer {

const Image* backgroundOf(const Request& request) {
  const RenderOptions& options = request.options;
  return options.transparent || request.isYardstick ? nullptr : options.background.get();
}

std::vector<std::string> readBackOf(const Request& request) {
  std::vector<std::string> names;
  if (request.delivery)
    for (const VulkanReadback& readback : request.delivery->readbacks)
      if (!readback.aov.empty()) names.push_back(readback.aov);
  return names;
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
  askedPlain = plain.makeAll();
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
    if (options.drawing) {
      next.drawnLook = now;
      for (const std::string& name : aovsOfDrawings(scene.data(), now)) {
        next.formats.erase(name);  // of floats
        if (std::find(options.aovs.begin(), options.aovs.end(), name) == options.aovs.end())
          next.drawnFrom.push_back(name);
      }
    }
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
    knobs.evaluate(now);
    GeometryOptions geometry;
    geometry.features = plannedFeatures(scene.data(), now);
    geometry.ground = hasGround(scene.data(), now, background != nullptr) && !options.transparent;
    for (const PlannedFeature& planned : geometry.features)
      if (planned.plan && planned.plan->replacesGround)
        geometry.ground &= knobs.scene<GroundParams>().mode == 1;
    // Over a picture only shadows are seen of it.
    geometry.groundStrokes = geometry.ground && !background && knobs.scene<GroundParams>().strokes > 0;
    geometry.shadowWarp = knobs.scene<LightParams>().shadowWarp;
    std::vector<KnobTable::Material> materials;
    for (const scene::Material& material : scene.data().materials) materials.push_back({material.name, {}});
    knobs.evaluate(materials);
    for (size_t m = 0; m < materials.size(); ++m)
      geometry.casts.push_back(knobs.of<passes::ShadowMapParams>(m).cast);
    const passes::IndirectParams indirect = knobs.scene<passes::IndirectParams>();
    if (indirect.source == 0 && passes::mayTakeIndirect(now)) geometry.indirectReach = indirect.reach;
    geometry.clips = everPlayed(scene.data(), look);
    geometry.nodes = nodeSettings(scene.data(), now);
    std::vector<std::string> readBack = readBackOf(request);
    readBack.insert(readBack.end(), options.aovs.begin(), options.aovs.end());
    const bool namesObjects = std::any_of(aovs.begin(), aovs.end(), [&](const Aov* aov) {
      return aov->namesObjects && std::find(readBack.begin(), readBack.end(), aov->name) != readBack.end();
    });
    if (namesObjects) next.frame.objects = objectNames(scene.data(), geometry);
    const bool drops = !scene.data().keepsVertices && !look.isAnimated() && !request.isRehearsal;
    Resident* const used = useScene(scene, geometry, drops, stats);
    if (!used)
      return usage("the scene's vertices have been dropped, and this frame needs them",
                   "load the scene again, where need be with SceneOptions::keepsVertices");
    Resident& resident = *used;
    const SpherePart* const sphere = options.sphere ? &*options.sphere : nullptr;
    const glm::uvec2 frameSize =
        sphere ? glm::uvec2(wholeSphere(views.front(), groups.front().size)) : largestOf(groups);
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
    if (namesObjects) next.frame.materials = sceneOnGpu.materialNames();
    const std::vector<KnobTable::Material> subjects = sceneOnGpu.knobSubjects();
    knobs.evaluate(subjects);
    sceneOnGpu.pose(look, knobs, time);
    const bool needsPrevious = std::any_of(next.parts.begin(), next.parts.end(), [](const Begun::Part& part) {
      return part.setup->needsPrevious();
    });
    const double previousTime = options.previousTime.value_or(time);
    if (needsPrevious) {
      const look::LookData then = look.at(previousTime);
      previousKnobs.evaluate(then);
      previousKnobs.evaluate(subjects);
      sceneOnGpu.posePrevious(options.previousScene.empty() ? scene.data() : options.previousScene.data(),
                              look, previousKnobs, previousTime);
    }
    const std::vector<View> seenFrom = carried(views, scene, sceneOnGpu.motion());
    std::vector<View> seenBefore;
    if (needsPrevious)
      seenBefore = carried(options.previousViews.empty() ? views : options.previousViews, scene,
                           *sceneOnGpu.previousMotion());

    // What all views see alike.
    std::vector<float> inflations, margins;
    for (const ViewGroup& group : groups) {
      inflations.push_back(largestInflation(sceneOnGpu, knobs,
                                            knobHeight(seenFrom[group.members.front()], group.size, sphere)));
      margins.push_back(inflations.back() + 1);
    }
    sceneOnGpu.look(viewersOf(seenFrom, groups, margins));
    for (size_t m = 0; m < sceneOnGpu.materialCount(); ++m) {
      const ChosenSets sets = chosenSets(sceneOnGpu, m, knobs, *lookTextures);
      sceneOnGpu.setColorSets(m, sets.lit ? &*sets.lit : nullptr, sets.shadowed ? &*sets.shadowed : nullptr);
      sceneOnGpu.setMaterial(m, materialData(sceneOnGpu, m, knobs, background != nullptr, colorMaps));
    }

    // What each group of them sees.
    for (size_t p = 0; p < next.parts.size(); ++p) {
      Begun::Part& part = next.parts[p];
      shared::FrameUniforms uniforms =
          frameUniforms(sceneOnGpu, knobs, viewsOf(part.group, seenFrom), viewsOf(part.group, seenBefore),
                        rigOf(part.group.rig, seenFrom), time, part.group.size, sphere);
      const std::vector<shared::PunctualLight> lights =
          punctualLights(scene.data(), knobs.scene<LightParams>(), sceneOnGpu.motion().world(),
                         sceneOnGpu.motion().shown(), uniforms.sceneRadius);
      uniforms.lightCount = uint32_t(lights.size());
      uniforms.positionShift = scene.origin() - options.positionsFrom;
      std::optional<BackdropInput> behind;
      if (background)
        behind = {&backdrop->image(),
                  backdropUniforms(sceneOnGpu, knobs, uniforms, texels,
                                   sphere ? glm::vec2(frameSize) : glm::vec2(0), colorMaps)};
      part.setup->update({now, knobs, time, uniforms, sceneOnGpu, inflations[p],
                          options.transparent || background, options.seed, behind ? &*behind : nullptr},
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
    stats.drawCalls = sceneOnGpu.draws().count();
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
    views[i].node = request.views[i].node, views[i].isLevel = request.views[i].isLevel;
    problem = problemWith(views[i]);
  }
  if (!problem.empty()) {
    device->log(LogLevel::warning, "the newest views are not used: " + problem);
    return;
  }
  const std::vector<View> now = carried(views, request.scene, motion);
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
  for (const Begun::Part& part : frame.parts) {
    part.setup->record(commands, frame.slot);
    // Each takes the scene's buffers as its own last frame has left them; others may do more, or less.
    if (frame.parts.size() > 1) waitForAll(commands);
  }
}

void Renderer::Impl::fetch(Begun& frame) {
  if (frame.fetched) return;
  submissions[frame.slot]->wait();
  for (const Begun::Part& part : frame.parts) part.setup->readTimes(frame.slot, frame.frame.stats);
  const Clock::time_point start = Clock::now();
  for (const Begun::Part& part : frame.parts)
    for (Setup::Layer& layer : part.setup->readLayers(frame.slot, frame.formats)) {
      // Not all parts need have the same ones.
      std::vector<Frame::Layer>& all = frame.frame.layers;
      auto into = std::find_if(all.begin(), all.end(),
                               [&](const Frame::Layer& other) { return other.name == layer.name; });
      if (into == all.end())
        into = all.insert(all.end(), {layer.name, std::vector<Image>(layer.isOnce ? 1 : frame.viewCount)});
      else if (layer.isOnce)
        continue;
      for (size_t v = 0; v < layer.views.size(); ++v)
        into->views[layer.isOnce ? 0 : part.group.members[v]] = std::move(layer.views[v]);
    }
  if (frame.drawnLook) draw(frame);
  frame.frame.stats.readbackMilliseconds = millisecondsSince(start);
  frame.fetched = true;
}

void Renderer::Impl::draw(Begun& frame) {
  std::vector<Frame::Layer>& layers = frame.frame.layers;
  for (size_t view = 0; view < frame.viewCount; ++view) {
    const Image& picture = layers.front().views[view];
    Drawing& drawing = frame.frame.drawings.emplace_back(Drawing{picture.width, picture.height, {}});
    const auto aov = [&](const char* name) -> const Image* {
      const auto found = std::find_if(layers.begin(), layers.end(),
                                      [&](const Frame::Layer& layer) { return layer.name == name; });
      return found == layers.end() ? nullptr : &found->views[view];
    };
    for (const FeatureParts& parts : features())
      if (parts.drawing.add) parts.drawing.add(aov, *frame.drawnLook, drawing);
  }
  std::erase_if(layers, [&](const Frame::Layer& layer) {
    return std::find(frame.drawnFrom.begin(), frame.drawnFrom.end(), layer.name) != frame.drawnFrom.end();
  });
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
