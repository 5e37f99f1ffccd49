#include "scumble/renderer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <list>
#include <optional>
#include <thread>

#include "frame/framing.h"
#include "frame/light.h"
#include "frame/palette.h"
#include "frame/playing.h"
#include "frame/view_check.h"
#include "look/setting_path.h"
#include "passes/colorize/colorize.h"
#include "renderer/pass_list.h"
#include "renderer/readback.h"
#include "renderer/uniforms.h"
#include "scumble/nearest.h"

namespace scumble {

using namespace frame;
using namespace renderer;

namespace {

using Clock = std::chrono::steady_clock;
double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

constexpr uint32_t kMaxSize = 16384;
static_assert(Renderer::kMaxBegun <= int(gpu::kFramesInFlight), "each frame begun has copies of its own");
constexpr double kMaxTime = 1e6;  // seconds; a float still tells hundredths apart

Error usage(std::string problem, std::string advice) {
  return {ErrorKind::usage, "", 0, "", std::move(problem), std::move(advice)};
}

bool isFact(Slot slot) {
  return slot >= Slot::factDepth && slot <= Slot::id;
}

std::optional<Slot> slotOfAov(const std::string& name) {
  for (size_t i = 0; i < size_t(Slot::count); ++i)
    if (slotInfo(Slot(i)).isAov && name == slotInfo(Slot(i)).name) return Slot(i);
  return std::nullopt;
}

bool isPicture(const Image& image) {
  const size_t channels = image.channels.size();
  return image.width > 0 && image.height > 0 && (channels == 3 || channels == 4) &&
         image.pixels.size() == size_t(image.width) * image.height * channels;
}

// Sentences on what the device does not do as it should.
std::vector<std::string> workaroundsFor(gpu::Device& device) {
  std::vector<std::string> sentences;
  for (const uint32_t samples : {1u, 4u}) {
    const std::string at = " at " + std::to_string(samples) + (samples == 1 ? " sample" : " samples");
    if (samples == 4 && !device.supports4Samples()) {
      sentences.push_back("it has no 4 samples a pixel: use --samples 1");
      continue;
    }
    const std::optional<gpu::ViewDrawing> way = device.viewDrawing(samples);
    if (!way)
      sentences.push_back("it draws two views wrongly" + at + ", whichever way: stereo is refused there");
    else if (*way == gpu::ViewDrawing::separately)
      sentences.push_back("its multiview is wrong" + at + ": views are drawn one after the other");
    else if (*way == gpu::ViewDrawing::resolvedTogether)
      sentences.push_back("its multiview is wrong" + at +
                          ": views are drawn one after the other and resolved together");
  }
  return sentences;
}

GpuInfo toPublic(const gpu::DeviceInfo& info) {
  GpuInfo result;
  result.name = info.name;
  result.driver = info.driver;
  result.apiVersion = std::to_string(VK_API_VERSION_MAJOR(info.apiVersion)) + "." +
                      std::to_string(VK_API_VERSION_MINOR(info.apiVersion)) + "." +
                      std::to_string(VK_API_VERSION_PATCH(info.apiVersion));
  result.isCpu = info.isCpu;
  result.unusableBecause = info.unusableBecause;
  return result;
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

}  // namespace

namespace renderer {

// Everything that lives as long as scene and configuration stay the same.
struct Setup {
  Configuration configuration;
  gpu::PerFrameBuffer uniformBuffer;
  UniformSlice frameSlice, lightSlice;
  std::optional<FrameBuilder> builder;
  gpu::SetLayout frameLayout;
  gpu::DescriptorSets frameSet;
  std::optional<FrameResources> resources;
  std::vector<std::unique_ptr<Pass>> passes;
  std::vector<std::unique_ptr<Readback>> readbacks;  // in the order of configuration.readBack
  std::vector<std::vector<gpu::Barrier>> barriers;
  VkQueryPool queries[gpu::kFramesInFlight] = {};  // null where there are no timestamps
  VkDevice device = VK_NULL_HANDLE;
  ~Setup() {
    for (VkQueryPool pool : queries)
      if (pool) vkDestroyQueryPool(device, pool, nullptr);
  }
};

// A scene that is on the device, and what its frames are drawn with.
struct Resident {
  Resident(gpu::Device& device, gpu::Samplers& samplers, const Scene& kept, const GeometryOptions& options)
      : scene(kept), onGpu(device, samplers, scene.data(), options) {}
  Scene scene;  // keeps the data alive that onGpu refers to
  SceneOnGpu onGpu;
  std::unique_ptr<Setup> setup;
};

// A frame between begin() and finish().
struct Begun {
  Resident* of;
  uint32_t slot;  // of those in flight
  RenderOptions options;
  Frame frame;  // statistics so far; the pictures, where they had to be fetched early
  bool fetched = false;
};

}  // namespace renderer

struct Renderer::Impl {
  std::atomic<std::thread::id> user;  // the thread that is inside, if one is
  std::unique_ptr<gpu::Device> device;
  std::optional<gpu::Samplers> samplers;
  std::optional<ExampleTextures> examples;
  std::optional<LookTextures> lookTextures;
  ImagePassKind imagePasses = ImagePassKind::automatic;
  uint64_t sceneBudget = 0;
  std::list<Resident> residents;  // the one that was drawn last first
  std::optional<Backdrop> backdrop;
  ColorMaps colorMaps;
  std::optional<gpu::Submission> submissions[gpu::kFramesInFlight];
  std::deque<Begun> begun;  // the oldest first
  uint32_t nextSlot = 0;

  ~Impl() {
    for (auto& submission : submissions) submission.reset();
    residents.clear();
    backdrop.reset();
    lookTextures.reset();
    examples.reset();
    samplers.reset();
  }

  // The scene to draw, first of the residents.
  Resident& useScene(const Scene& wanted, const GeometryOptions& options) {
    const auto found = std::find_if(residents.begin(), residents.end(), [&](const Resident& resident) {
      return &resident.scene.data() == &wanted.data();
    });
    if (found != residents.end() && found->onGpu.options() == options) {
      residents.splice(residents.begin(), residents, found);
      return residents.front();
    }
    fetchAll();
    if (found != residents.end()) residents.erase(found);
    keepBudget(0);
    return residents.emplace_front(*device, *samplers, wanted, options);
  }
  // Takes off the device what was drawn longest ago, but for so many scenes, while there is too much.
  void keepBudget(size_t least) {
    while (residents.size() > least && device->memory().bytesInUse() > sceneBudget) {
      fetchAll();
      residents.pop_back();
    }
  }

  // Texels of pictures behind everything; none: there is no such picture.
  void useBackdrop(const glm::uvec2& texels) {
    if ((backdrop ? backdrop->size() : glm::uvec2(0)) == texels) return;
    fetchAll();
    for (Resident& resident : residents) resident.setup.reset();
    backdrop.reset();
    if (texels.x > 0) backdrop.emplace(*device, texels);
  }

  void useConfiguration(Resident& resident, const Configuration& configuration);
  void record(VkCommandBuffer commands, Resident& resident, uint32_t slot, const RenderOptions& options);
  void readTimes(Begun& frame);
  // Waits for a frame and fetches its pictures, unless that has been done.
  void fetch(Begun& frame);
  // Before anything goes that frames under way use.
  void fetchAll() {
    for (Begun& frame : begun) fetch(frame);
  }
  // After an unexpected result of Vulkan: nothing that is under way can be trusted.
  void abandon() {
    for (auto& submission : submissions) submission.reset();
    begun.clear();
    for (Resident& resident : residents) {
      resident.setup.reset();
      resident.onGpu.forgetPoses();
    }
    if (backdrop) backdrop->forget();
  }
  Error failure(const gpu::VulkanError& error) {
    abandon();
    const bool internal = error.result == VK_ERROR_UNKNOWN || error.result == VK_ERROR_VALIDATION_FAILED_EXT;
    return {internal ? ErrorKind::internal : ErrorKind::noUsableGpu, "", 0, "", error.message(),
            "use a smaller picture or scene, or another --device"};
  }
  Error outOfMemory() {
    abandon();
    return {ErrorKind::noUsableGpu,          "", 0, "", "there is not enough memory",
            "use a smaller picture or scene"};
  }
};

// While one is taken, other threads are refused; the one that has it may enter again.
class Renderer::Turn {
 public:
  explicit Turn(Impl& impl) : impl_(impl) {
    std::thread::id user;
    isFirst_ = impl_.user.compare_exchange_strong(user, std::this_thread::get_id());
    isTaken_ = isFirst_ || user == std::this_thread::get_id();
  }
  ~Turn() {
    if (isFirst_) impl_.user = std::thread::id();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  explicit operator bool() const { return isTaken_; }
  Error refusal() const {
    return usage("this renderer is in use by another thread", "give each thread a renderer of its own");
  }

 private:
  Impl& impl_;
  bool isFirst_, isTaken_;
};

void Renderer::Impl::useConfiguration(Resident& resident, const Configuration& configuration) {
  if (resident.setup && resident.setup->configuration == configuration) return;
  fetchAll();
  resident.setup.reset();
  SceneOnGpu& scene = resident.onGpu;
  auto next = std::make_unique<Setup>();
  next->device = device->handle();
  next->configuration = configuration;

  // Uniform memory: what holds for the frame, then what each material has in each pass.
  const uint64_t lightBytes =
      std::max<size_t>(1, punctualLightCount(scene.data())) * sizeof(shared::PunctualLight);
  const uint64_t size = (64 << 10) + scene.materialCount() * 2048 + lightBytes +
                        (configuration.colorize ? passes::kColorizeUniformBytes : 0);
  next->uniformBuffer = gpu::PerFrameBuffer(
      *device, size, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  if (configuration.facts) scene.keepPrevious();
  next->builder.emplace(*device, *samplers, *examples, configuration, scene,
                        UniformSlice{next->uniformBuffer.handle(), 0, size, next->uniformBuffer.contents()});
  next->frameSlice = next->builder->uniform(sizeof(shared::FrameUniforms));
  next->lightSlice = next->builder->uniform(lightBytes);

  // Passes declare what they read and write; then images, and with them pipelines and descriptor sets, can be
  // made.
  next->passes = makePasses(configuration);
  for (const auto& pass : next->passes) pass->declare(*next->builder);
  for (const Slot slot : configuration.readBack)
    next->readbacks.emplace_back(std::make_unique<Readback>())->declare(*next->builder, slot);
  next->frameLayout = gpu::SetLayout(*device, {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_ALL},
                                               {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_ALL},
                                               {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_ALL}});
  next->frameSet = gpu::DescriptorSets(*device, next->frameLayout);
  next->frameSet.writeBuffer(0, 0, next->frameSlice.buffer, next->frameSlice.offset, next->frameSlice.size);
  next->frameSet.writeBuffer(0, 1, scene.motion().objects());
  next->frameSet.writeBuffer(0, 2, next->lightSlice.buffer, next->lightSlice.offset, next->lightSlice.size);
  next->resources.emplace(*device, *next->builder, next->frameLayout, next->frameSet[0]);
  for (const auto& pass : next->passes) pass->create(*next->builder, *next->resources);
  for (const auto& readback : next->readbacks) readback->create(*next->builder, *next->resources);
  next->barriers = next->builder->graph().planBarriers();

  if (device->hasTimestamps()) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = uint32_t(next->barriers.size() + 1);
    for (VkQueryPool& pool : next->queries)
      SCUMBLE_VK(vkCreateQueryPool(device->handle(), &info, nullptr, &pool));
  }
  resident.setup = std::move(next);
}

void Renderer::Impl::record(VkCommandBuffer commands, Resident& resident, uint32_t slot,
                            const RenderOptions& options) {
  Setup* const setup = resident.setup.get();
  const gpu::FrameGraph& graph = setup->builder->graph();
  const VkQueryPool queries = setup->queries[slot];
  const auto stamp = [&](uint32_t query) {
    if (queries) vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries, query);
  };
  for (const auto& readback : setup->readbacks) readback->setFrame(slot);
  if (queries) vkCmdResetQueryPool(commands, queries, 0, uint32_t(setup->barriers.size() + 1));
  std::vector<gpu::PerFrameBuffer*> uploads{&setup->uniformBuffer};
  resident.onGpu.addUploads(uploads);
  gpu::recordUploads(commands, uploads, slot);
  if (backdrop) backdrop->upload(commands, slot, options.background);
  stamp(0);
  for (size_t s = 0; s < graph.steps().size(); ++s) {
    gpu::recordBarriers(commands, setup->barriers[s], [&](gpu::ResourceId id) {
      return graph.resources()[id].isImage ? &setup->resources->image(id) : nullptr;
    });
    setup->builder->records()[s](commands);
    stamp(uint32_t(s + 1));
  }
}

void Renderer::Impl::readTimes(Begun& frame) {
  const Setup* const setup = frame.of->setup.get();
  const uint32_t slot = frame.slot;
  FrameStats& stats = frame.frame.stats;
  if (!setup->queries[slot]) return;
  const auto& steps = setup->builder->graph().steps();
  std::vector<uint64_t> stamps(steps.size() + 1);
  SCUMBLE_VK(vkGetQueryPoolResults(device->handle(), setup->queries[slot], 0, uint32_t(stamps.size()),
                                   stamps.size() * 8, stamps.data(), 8,
                                   VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
  const double unit = double(device->limits().timestampPeriod) * 1e-6;
  for (size_t s = 0; s < steps.size(); ++s) {
    const double time = double(stamps[s + 1] - stamps[s]) * unit;
    if (!stats.passes.empty() && stats.passes.back().name == steps[s].name)
      stats.passes.back().milliseconds += time;
    else
      stats.passes.push_back({steps[s].name, time});
  }
  stats.gpuMilliseconds = double(stamps.back() - stamps.front()) * unit;
}

void Renderer::Impl::fetch(Begun& frame) {
  if (frame.fetched) return;
  submissions[frame.slot]->wait();
  FrameStats& stats = frame.frame.stats;
  readTimes(frame);
  const Clock::time_point start = Clock::now();
  const Setup* const setup = frame.of->setup.get();
  const Configuration& configuration = setup->configuration;
  std::vector<Frame::Layer>& layers = frame.frame.layers;
  for (size_t i = 0; i < setup->readbacks.size(); ++i)
    layers.push_back({i == 0 ? "" : slotInfo(configuration.readBack[i]).name,
                      setup->readbacks[i]->images(frame.slot, frame.options.width, frame.options.height)});
  for (const std::string& aov : frame.options.aovs)
    if (slotOfAov(aov) == Slot::finalColor) layers.push_back({aov, layers.front().views});
  stats.readbackMilliseconds = millisecondsSince(start);
  frame.fetched = true;
}

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create(const RendererOptions& options) {
  gpu::DeviceOptions deviceOptions;
  deviceOptions.choice = options.device;
  deviceOptions.validation = options.validation;
  deviceOptions.cacheFolder = options.cacheFolder;
  Result<std::unique_ptr<gpu::Device>> device = gpu::Device::create(deviceOptions);
  if (!device) return device.error();
  std::unique_ptr<Renderer> created(new Renderer);
  created->impl_->device = std::move(device).value();
  created->impl_->samplers.emplace(*created->impl_->device);
  created->impl_->examples.emplace(*created->impl_->device);
  created->impl_->lookTextures.emplace(*created->impl_->device);
  created->impl_->imagePasses = options.imagePasses;
  created->impl_->sceneBudget = options.sceneBudget;
  return created;
}

Result<Frame> Renderer::render(const Scene& scene, const Look& look, double time,
                               const std::vector<View>& views, const RenderOptions& options) {
  const Turn turn(*impl_);
  if (!turn) return turn.refusal();
  if (!impl_->begun.empty())
    return usage("other frames have been begun", "call finish() until all are finished");
  if (const Status status = begin(scene, look, time, views, options); !status) return status.error();
  return finish();
}

Status Renderer::begin(const Scene& scene, const Look& look, double time, const std::vector<View>& views,
                       const RenderOptions& options) {
  const Turn turn(*impl_);
  if (!turn) return turn.refusal();
  // Check what the caller wants.
  if (scene.empty()) return usage("the scene is empty", "load one with Scene::load");
  const uint32_t largest = std::min(kMaxSize, impl_->device->limits().maxImageDimension2D);
  if (options.width < 1 || options.height < 1 || options.width > largest || options.height > largest)
    return usage("a picture of " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                     " is out of range",
                 "use 1x1 to " + std::to_string(largest) + "x" + std::to_string(largest));
  if (options.samples != 1 && options.samples != 4)
    return usage("the number of samples is neither 1 nor 4", "use 4");
  if (options.samples == 4 && !impl_->device->supports4Samples())
    return usage("this device has no 4 samples a pixel", "use --samples 1");
  if (views.empty() || views.size() > size_t(shared::kMaxViews))
    return usage("the number of views is neither one nor two", "give one, or a left and a right one");
  if (!options.previousViews.empty() && options.previousViews.size() != views.size())
    return usage("there are not as many previous views as views", "give one for each, or none at all");
  for (const std::vector<View>* seen : {&views, &options.previousViews})
    for (const View& view : *seen) {
      if (const std::string problem = problemWith(view); !problem.empty())
        return usage(problem, "see View in scumble/view.h, or make views with makeViews");
      if (view.node >= int(scene.data().nodes.size()))
        return usage("a view hangs on a node that the scene does not have", "make views of this scene");
    }
  const double previousTime = options.previousTime.value_or(time);
  if (!(std::abs(time) < kMaxTime && std::abs(previousTime) < kMaxTime))
    return usage("the time is out of range", "give it in seconds, up to a million");
  const Image* background = options.transparent || options.plain ? nullptr : options.background.get();
  if (background && !isPicture(*background))
    return usage("the background is no picture", "give it channels R, G, B, and as many pixels as it says");
  if (background && std::max(background->width, background->height) > largest)
    return usage("a background of " + std::to_string(background->width) + "x" +
                     std::to_string(background->height) + " is out of range",
                 "use up to " + std::to_string(largest) + " a side");
  if (impl_->begun.size() >= size_t(kMaxBegun))
    return usage("too many frames have been begun", "call finish() first");

  Configuration configuration;
  configuration.width = options.width;
  configuration.height = options.height;
  configuration.samples = options.samples;
  configuration.viewCount = uint32_t(views.size());
  configuration.plain = options.plain;
  const look::LookData now = look.data().at(time);
  configuration.layered = !options.plain && wantsLayers(now);
  configuration.glows = glows(scene.data(), now);
  configuration.limit = !options.plain && wantsLimit(now);
  const OceanShape ocean = oceanShape(scene.data(), now);
  configuration.ocean = !options.plain && ocean.isThere;
  configuration.colorize = !options.plain && wantsColorizers(now);
  const glm::uvec2 texels =
      background ? Backdrop::sizeFor(*background, options.width, options.height) : glm::uvec2(0);
  configuration.backdropWidth = texels.x, configuration.backdropHeight = texels.y;
  configuration.computeImagePasses =
      impl_->imagePasses == ImagePassKind::compute ||
      (impl_->imagePasses == ImagePassKind::automatic && impl_->device->prefersCompute());
  configuration.readBack.push_back(options.plain ? Slot::plain : Slot::finalColor);
  for (const std::string& aov : options.aovs) {
    const std::optional<Slot> slot = slotOfAov(aov);
    if (!slot || options.plain) {
      const std::string suggestion = nearest(aov, aovNames());
      return usage("there is no AOV '" + aov + "'", suggestion.empty()
                                                        ? "`scumble render --help` lists them"
                                                        : "did you mean '" + suggestion + "'?");
    }
    configuration.facts |= isFact(*slot);
    configuration.limit |= *slot == Slot::limit;
    configuration.matte |= *slot == Slot::matte;
    configuration.colorize |= *slot == Slot::colorize;
    if (*slot != Slot::finalColor) configuration.readBack.push_back(*slot);
  }

  try {
    if (views.size() > 1) {
      const std::optional<gpu::ViewDrawing> drawing = impl_->device->viewDrawing(options.samples);
      if (!drawing)
        return usage("this device draws several views wrongly, whichever way, at " +
                         std::to_string(options.samples) + " samples a pixel",
                     options.samples > 1 ? "use --samples 1" : "choose another device");
      configuration.viewDrawing = *drawing;
    }
    Begun next{nullptr, impl_->nextSlot, options, {}};
    FrameStats& stats = next.frame.stats;
    auto start = Clock::now();
    const auto lap = [&] {
      const double elapsed = millisecondsSince(start);
      start = Clock::now();
      return elapsed;
    };
    GeometryOptions geometry;
    geometry.ground = hasGround(scene.data(), now, background != nullptr) && !options.transparent;
    geometry.shadowWarp = now.get<LightParams>().shadowWarp;
    geometry.casts = shadowCasters(scene.data(), now);
    geometry.clips = everPlayed(scene.data(), look.data());
    geometry.nodes = nodeSettings(scene.data(), now);
    geometry.ocean = ocean;
    geometry.ground &= !ocean.isThere || now.get<GroundParams>().mode == 1;
    if (configuration.matte || configuration.facts) next.frame.objects = objectNames(scene.data(), geometry);
    Resident& resident = impl_->useScene(scene, geometry);
    next.of = &resident;
    impl_->useBackdrop(texels);
    stats.uploadMilliseconds = lap();
    impl_->useConfiguration(resident, configuration);
    impl_->keepBudget(1);
    stats.setupMilliseconds = lap();

    // Everything to its place, then the uniforms.
    Setup& setup = *resident.setup;
    SceneOnGpu& sceneOnGpu = resident.onGpu;
    sceneOnGpu.pose(look.data(), now, time);
    if (configuration.facts) sceneOnGpu.posePrevious(look.data(), look.data().at(previousTime), previousTime);
    const std::vector<View> seenFrom = ridden(views, sceneOnGpu.motion());
    std::vector<View> seenBefore;
    if (configuration.facts)
      seenBefore =
          ridden(options.previousViews.empty() ? views : options.previousViews, *sceneOnGpu.previousMotion());
    shared::FrameUniforms uniforms =
        frameUniforms(sceneOnGpu, now, seenFrom, seenBefore, time, configuration);
    const std::vector<shared::PunctualLight> lights = punctualLights(
        scene.data(), now.get<LightParams>(), sceneOnGpu.motion().world(), uniforms.sceneRadius);
    uniforms.lightCount = uint32_t(lights.size());
    std::copy(lights.begin(), lights.end(),
              reinterpret_cast<shared::PunctualLight*>(setup.lightSlice.mapped));
    setup.frameSlice.write(uniforms);
    sceneOnGpu.look(uniforms, configuration.viewCount,
                    largestInflation(now, sceneOnGpu, uniforms.imageSize.y) + 1);
    for (size_t m = 0; m < sceneOnGpu.materialCount(); ++m) {
      const ChosenSets sets = chosenSets(sceneOnGpu, m, now, *impl_->lookTextures);
      sceneOnGpu.setColorSets(m, sets.lit ? &*sets.lit : nullptr, sets.shadowed ? &*sets.shadowed : nullptr);
      sceneOnGpu.setMaterial(m, materialData(sceneOnGpu, m, now, background != nullptr, impl_->colorMaps));
    }
    std::optional<BackdropInput> backdrop;
    if (background)
      backdrop = {&impl_->backdrop->image(),
                  backdropUniforms(sceneOnGpu, now, uniforms, texels, impl_->colorMaps)};
    const FrameInput input{now,
                           time,
                           uniforms,
                           sceneOnGpu,
                           options.transparent || background,
                           options.seed,
                           backdrop ? &*backdrop : nullptr};
    for (const auto& pass : setup.passes) pass->update(input);

    std::optional<gpu::Submission>& submission = impl_->submissions[next.slot];
    if (!submission) submission.emplace(*impl_->device);
    submission->submit(
        [&](VkCommandBuffer commands) { impl_->record(commands, resident, next.slot, options); });
    stats.cpuMilliseconds = lap();
    impl_->device->savePipelineCache();
    stats.triangles = sceneOnGpu.triangleCount();
    stats.drawCalls = sceneOnGpu.draws().size();
    stats.deviceBytes = impl_->device->memory().bytesInUse();
    stats.uploadedBytes = sceneOnGpu.uploadedBytes();
    impl_->begun.push_back(std::move(next));
    impl_->nextSlot = (impl_->nextSlot + 1) % gpu::kFramesInFlight;
    return Done{};
  } catch (const gpu::VulkanError& error) {
    return impl_->failure(error);
  } catch (const std::bad_alloc&) {
    return impl_->outOfMemory();
  }
}

Result<Frame> Renderer::finish() {
  const Turn turn(*impl_);
  if (!turn) return turn.refusal();
  if (impl_->begun.empty()) return usage("no frame has been begun", "call begin() first");
  try {
    impl_->fetch(impl_->begun.front());
    Frame frame = std::move(impl_->begun.front().frame);
    impl_->begun.pop_front();
    return frame;
  } catch (const gpu::VulkanError& error) {
    return impl_->failure(error);
  } catch (const std::bad_alloc&) {
    return impl_->outOfMemory();
  }
}

std::vector<std::string> Renderer::aovNames() {
  std::vector<std::string> names;
  for (size_t i = 0; i < size_t(Slot::count); ++i)
    if (slotInfo(Slot(i)).isAov) names.emplace_back(slotInfo(Slot(i)).name);
  return names;
}

bool Renderer::needsFloat(const std::string& aov) {
  const std::optional<Slot> slot = slotOfAov(aov);
  if (!slot) return false;
  const VkFormat format = slotInfo(*slot).format;
  return format == VK_FORMAT_R32G32B32A32_SFLOAT || gpu::isDepthFormat(format);
}

bool Renderer::hasSizeOfItsOwn(const std::string& aov) {
  const std::optional<Slot> slot = slotOfAov(aov);
  return slot && slotInfo(*slot).rate == Rate::once;
}

double playedSeconds(const Scene& scene, const Look& look) {
  if (scene.empty()) return 0;
  double seconds = 0;
  for (const scene::PlayedClip& played : playedClips(scene.data(), look.data().at(0)))
    if (played.speed != 0)
      seconds = std::max(seconds, scene.data().clips[size_t(played.clip)].duration / std::abs(played.speed));
  return seconds;
}

GpuInfo Renderer::gpu() const {
  GpuInfo info = toPublic(impl_->device->info());
  info.wouldBeUsed = true;
  return info;
}

int Renderer::validationMessages() const {
  return impl_->device->validationMessages();
}

Result<std::vector<GpuInfo>> listGpus(const std::string& choice, const std::string& cacheFolder) {
  const Result<std::vector<gpu::DeviceInfo>> devices = gpu::listDevices();
  if (!devices) return devices.error();
  std::vector<GpuInfo> gpus;
  for (const gpu::DeviceInfo& device : *devices) gpus.push_back(toPublic(device));
  const Result<size_t> chosen = gpu::chooseDevice(*devices, choice);
  if (chosen) gpus[*chosen].wouldBeUsed = true;
  if (!chosen && !choice.empty()) return chosen.error();
  for (size_t i = 0; i < gpus.size(); ++i) {
    if (!gpus[i].unusableBecause.empty()) continue;
    gpu::DeviceOptions options;
    options.choice = std::to_string(i);
    options.cacheFolder = cacheFolder;
    const Result<std::unique_ptr<gpu::Device>> device = gpu::Device::create(options);
    if (!device) {
      gpus[i].unusableBecause = device.error().problem;
      continue;
    }
    try {
      gpus[i].workarounds = workaroundsFor(**device);
    } catch (const gpu::VulkanError& error) {
      gpus[i].unusableBecause = error.message();
    }
  }
  return gpus;
}

}  // namespace scumble
