#include "renderer/setup.h"

#include <algorithm>
#include <cassert>

#include "stage/light.h"

namespace scumble::renderer {

namespace {

constexpr Aov kPictureAov{.name = "", .isColor = true, .premultiplied = 3};

}  // namespace

Setup::Setup(gpu::Device& device, gpu::Samplers& samplers, ExampleTextures& examples, SceneOnGpu& scene,
             const PassList& passes, const SetupKey& key, glm::uvec2 size,
             const std::function<void(double)>& progress)
    : device_(device), scene_(scene), key_(key), size_(size), uniforms_(device) {
  // What all passes share: set 0.
  frameSlice_ = uniforms_.slice(sizeof(shared::FrameUniforms));
  lightSlice_ = uniforms_.slice(key.lights * sizeof(shared::PunctualLight));
  frameLayout_ = gpu::SetLayout(device, {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_ALL},
                                         {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_ALL},
                                         {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_ALL},
                                         {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_ALL},
                                         {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_ALL}});
  frameSet_ = gpu::DescriptorSets(device, frameLayout_);
  frameSet_.writeBuffer(0, 0, frameSlice_.buffer, frameSlice_.offset, frameSlice_.size);
  frameSet_.writeBuffer(0, 2, lightSlice_.buffer, lightSlice_.offset, lightSlice_.size);

  // Passes declare what they read and write.
  std::vector<std::string> asked = key.aovs;
  for (const TargetKey& target : key.targets)
    if (!target.isDepthBuffer()) asked.push_back(target.aov);
  builder_.emplace(device, samplers, examples, key.configuration, scene, frameLayout_, frameSet_[0],
                   uniforms_, std::move(asked));
  passes_ = passes.makeAll();
  assert(passes_.size() == key.variants.size());
  for (size_t i = 0; i < passes_.size(); ++i) builder_->declare(*passes_[i], key.variants[i]);
  const gpu::Handle picture = builder_->get(kPicture);
  if (key.readsBack) {
    reads_.push_back({"", false, std::make_unique<Readback>()});
    reads_.back().readback->declare(*builder_, kPictureAov, {picture});
  }
  for (const std::string& name : key.aovs) {
    const FrameBuilder::Offer& offer = *builder_->offered(name);
    reads_.push_back({name, offer.aov->isOnce, nullptr});
    if (key.readsBack && offer.images.front() == picture) continue;
    reads_.back().readback = std::make_unique<Readback>();
    reads_.back().readback->declare(*builder_, *offer.aov, offer.images);
  }
  for (const TargetKey& target : key.targets) declareTarget(target, picture);

  // What is needed for that is made.
  needs_ = builder_->graph().needsOf({});
  for (size_t s = 0; s < needs_.steps.size(); ++s)
    if (needs_.steps[s]) steps_.push_back(s);
  needsPrevious_ = needs_.lives[builder_->get(kPreviousVertices).resource].isUsed;
  if (needsPrevious_) scene.keepPrevious();
  for (const auto& pass : passes_)
    if (builder_->needs(*pass, needs_)) needed_.push_back(pass.get());
  for (size_t i = 0; i < needed_.size(); ++i) {
    progress(double(i) / double(needed_.size()));
    needed_[i]->create(*builder_);
  }
  for (const auto& deliver : delivers_) deliver->create(*builder_);
  resources_.emplace(device, builder_->graph(), needs_, frameSize());
  bindScene();

  if (device.hasTimestamps()) {
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = uint32_t(steps_.size() + 1);
    for (VkQueryPool& pool : queries_) SCUMBLE_VK(vkCreateQueryPool(device.handle(), &info, nullptr, &pool));
  }
}

void Setup::declareTarget(const TargetKey& target, gpu::Handle picture) {
  // Whatever was done to it before on this queue, or behind the semaphores that are waited for, is over; and
  // whatever comes after may use it.
  constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  const bool isFirst = target.image >= targets_.size();
  if (isFirst) {
    targets_.resize(target.image + 1);
    targets_[target.image] = builder_->graph().importImage(
        "target " + std::to_string(target.image + 1),
        {.format = target.format, .width = target.width, .height = target.height, .perView = false},
        gpu::Outside{kAll, VK_ACCESS_2_MEMORY_WRITE_BIT, target.before},
        gpu::Outside{kAll, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT, target.after});
  }
  const FrameBuilder::Offer* const offer =
      target.aov.empty() || target.isDepthBuffer() ? nullptr : builder_->offered(target.aov);
  // Beside motion, the depth that comes with it: no surface is drawn twice.
  const bool hasFacts = std::any_of(key_.targets.begin(), key_.targets.end(),
                                    [](const TargetKey& key) { return key.isDeviceMotion(); });
  const gpu::Handle source = target.isDepthBuffer() ? builder_->get(hasFacts ? kDepthOfFacts : kDepth)
                             : offer                ? offer->images.front()
                                                    : picture;
  delivers_.push_back(std::make_unique<Deliver>());
  delivers_.back()->declare(*builder_, target, source, offer && offer->aov->isSquareRoot,
                            targets_[target.image], !isFirst || target.before != VK_IMAGE_LAYOUT_UNDEFINED);
}

void Setup::setTargets(uint32_t slot, const std::vector<VkImage>& images) {
  foreign_[slot].clear();
  foreign_[slot].reserve(images.size());
  for (uint32_t i = 0; i < targets_.size(); ++i) {
    gpu::ImageDesc desc{VK_FORMAT_UNDEFINED};
    for (const TargetKey& target : key_.targets)
      if (target.image == i) {
        desc.format = target.format, desc.width = target.width, desc.height = target.height;
        desc.layers = std::max(desc.layers, target.layer + 1);
      }
    foreign_[slot].push_back(gpu::Image::foreign(device_, images[i], desc));
    resources_->import(targets_[i], &foreign_[slot].back());
  }
}

void Setup::latch(uint32_t slot, std::vector<shared::ViewUniforms> views, bool keepsPrevious) {
  auto& uniforms = *reinterpret_cast<shared::FrameUniforms*>(frameSlice_.mapped);
  for (size_t v = 0; v < views.size(); ++v) {
    views[v].aside = uniforms.views[v].aside;
    if (keepsPrevious) views[v].previousWorldToClip = uniforms.views[v].previousWorldToClip;
  }
  std::copy(views.begin(), views.end(), uniforms.views);
  uniforms_.amend(frameSlice_, slot);
}

Setup::~Setup() {
  for (VkQueryPool pool : queries_)
    if (pool) vkDestroyQueryPool(device_.handle(), pool, nullptr);
}

void Setup::resize(glm::uvec2 size) {
  if (size == size_) return;
  size_ = size;
  resources_->resize(frameSize());
  bind();
}

void Setup::bindScene() {
  frameSet_.writeBuffer(0, 1, scene_.motion().objects());
  const auto [cutouts, points] = scene_.cutouts();
  frameSet_.writeBuffer(0, 3, cutouts);
  frameSet_.writeBuffer(0, 4, points);
  bind();
}

void Setup::bind() {
  for (Pass* const pass : needed_) pass->bind(*resources_);
  for (const Read& read : reads_)
    if (read.readback) read.readback->bind(*resources_);
  for (const auto& deliver : delivers_) deliver->bind(*resources_);
}

void Setup::update(const FrameInput& input, const std::vector<shared::PunctualLight>& lights) {
  auto* const held = reinterpret_cast<shared::PunctualLight*>(lightSlice_.mapped);
  // Shaders go through all that the buffer holds: those that are hidden now have no strength.
  std::fill(std::copy(lights.begin(), lights.end(), held), held + key_.lights, shared::PunctualLight{});
  frameSlice_.write(input.uniforms);
  for (Pass* const pass : needed_) pass->update(input);
}

void Setup::stamp(VkCommandBuffer commands, uint32_t slot, uint32_t query) const {
  if (queries_[slot])
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_[slot], query);
}

void Setup::beginTimes(VkCommandBuffer commands, uint32_t slot) const {
  if (queries_[slot]) vkCmdResetQueryPool(commands, queries_[slot], 0, uint32_t(steps_.size() + 1));
}

void Setup::record(VkCommandBuffer commands, uint32_t slot) {
  for (const Read& read : reads_)
    if (read.readback) read.readback->setFrame(device_, slot);
  const auto barriers = [&](size_t step) {
    gpu::recordBarriers(commands, resources_->barriers()[step],
                        [&](uint32_t resource) { return resources_->imageOf(resource); });
  };
  stamp(commands, slot, 0);
  for (size_t i = 0; i < steps_.size(); ++i) {
    const gpu::DebugLabel label(device_.debugUtils(), commands, builder_->graph().steps()[steps_[i]].name);
    barriers(steps_[i]);
    builder_->records()[steps_[i]](commands);
    stamp(commands, slot, uint32_t(i + 1));
  }
  barriers(builder_->records().size());
}

void Setup::readTimes(uint32_t slot, FrameStats& stats) const {
  if (!queries_[slot]) return;
  std::vector<uint64_t> stamps(steps_.size() + 1);
  SCUMBLE_VK(vkGetQueryPoolResults(device_.handle(), queries_[slot], 0, uint32_t(stamps.size()),
                                   stamps.size() * 8, stamps.data(), 8,
                                   VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
  const double unit = double(device_.limits().timestampPeriod) * 1e-6;
  for (size_t i = 0; i < steps_.size(); ++i) {
    const std::string& name = builder_->graph().steps()[steps_[i]].name;
    const double time = double(stamps[i + 1] - stamps[i]) * unit;
    if (stats.passes.empty() || stats.passes.back().name != name) stats.passes.push_back({name});
    const gpu::FrameGraph::Traffic traffic = builder_->graph().trafficOf(steps_[i], frameSize());
    PassTime& pass = stats.passes.back();
    pass.milliseconds += time, pass.bytesRead += traffic.read, pass.bytesWritten += traffic.written;
    pass.fetches += builder_->fetchesOf(steps_[i], frameSize());
  }
  stats.gpuMilliseconds += double(stamps.back() - stamps.front()) * unit;
}

std::vector<Setup::Layer> Setup::readLayers(uint32_t slot,
                                            const std::map<std::string, PixelFormat>& formats) const {
  std::vector<Layer> layers;
  for (const Read& read : reads_) {
    const auto format = formats.find(read.name);
    const Readback& from = read.readback ? *read.readback : *reads_.front().readback;
    layers.push_back({read.name, read.isOnce,
                      from.images(slot, size_.x, size_.y,
                                  format == formats.end() ? PixelFormat::float32 : format->second)});
  }
  return layers;
}

std::string Setup::dot() const {
  return builder_->graph().toDot(needs_, frameSize());
}

}  // namespace scumble::renderer
