#include "scumble/renderer.h"

#include <cmath>
#include <map>

#include "renderer/gpu_list.h"
#include "renderer/impl.h"
#include "renderer/shader_table.h"
#include "scumble/vulkan.h"
#include "stage/playing.h"

namespace scumble {

using namespace frame;
using namespace renderer;

Renderer::Renderer() = default;
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> RendererAccess::create(Result<std::unique_ptr<gpu::Device>> made,
                                                         const RendererOptions& options) {
  if (!made) return made.error();
  std::unique_ptr<gpu::Device> device = std::move(made).value();
  std::map<const uint32_t*, std::string> names;
  for (const renderer::NamedShader& shader : renderer::shaderTable())
    names[shader.words.data()] = shader.name;
  device->nameShaders(std::move(names));
  if (!options.shaderFolder.empty()) {
    Result<gpu::ShaderReplacements> shaders = renderer::readShaders(options.shaderFolder);
    if (!shaders) return shaders.error();
    device->replaceShaders(std::move(shaders).value());
  }
  device->log(LogLevel::information, "drawing on " + device->info().name + ", " + device->info().driver);
  std::unique_ptr<Renderer> created(new Renderer);
  created->impl_ = std::make_unique<Renderer::Impl>(std::move(device), options);
  return created;
}

Result<std::unique_ptr<Renderer>> Renderer::create(const RendererOptions& options) {
  return createRenderer(VulkanWishes(), options);
}

Result<Frame> Renderer::render(const Scene& scene, const Look& look, double time,
                               const std::vector<View>& views, const RenderOptions& options) {
  return RendererAccess::render(*this, {scene, look.data(), time, views, options});
}

Result<Frame> RendererAccess::render(Renderer& renderer, const Request& request) {
  const Renderer::Turn turn(*renderer.impl_);
  if (!turn) return turn.refusal();
  if (!renderer.impl_->begun.empty())
    return usage("other frames have been begun", "call finish() until all are finished");
  if (const Status status = renderer.impl_->begin(request); !status) return status.error();
  return renderer.finish();
}

Status RendererAccess::begin(Renderer& renderer, const Request& request) {
  const Renderer::Turn turn(*renderer.impl_);
  if (!turn) return turn.refusal();
  return renderer.impl_->begin(request);
}

Status Renderer::begin(const Scene& scene, const Look& look, double time, const std::vector<View>& views,
                       const RenderOptions& options) {
  return RendererAccess::begin(*this, {scene, look.data(), time, views, options});
}

Status Renderer::prepare(const Scene& scene, const Look& look, const std::vector<View>& views,
                         const RenderOptions& options, Rehearsal extent) {
  const Turn turn(*impl_);
  if (!turn) return turn.refusal();
  if (!impl_->begun.empty())
    return usage("other frames have been begun", "call finish() until all are finished");
  return impl_->prepare({scene, look.data(), 0, views, options}, extent);
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

namespace {

// Of the passes that the library has.
const std::vector<const Aov*>& standardAovs() {
  static const std::vector<std::unique_ptr<Pass>> passes = standardPasses().makeAll();
  static const std::vector<const Aov*> aovs = aovsOf(passes);
  return aovs;
}

const Aov* standardAov(const std::string& name) {
  for (const Aov* const aov : standardAovs())
    if (name == aov->name) return aov;
  return nullptr;
}

}  // namespace

std::vector<std::string> Renderer::aovNames() {
  std::vector<std::string> names;
  for (const Aov* const aov : standardAovs()) names.emplace_back(aov->name);
  return names;
}

bool Renderer::needsFloat(const std::string& name) {
  const Aov* const aov = standardAov(name);
  return aov && aov->needsFloat;
}

bool Renderer::hasSizeOfItsOwn(const std::string& name) {
  const Aov* const aov = standardAov(name);
  return aov && aov->hasOwnSize;
}

std::string Renderer::graph() const {
  std::string text;
  if (!impl_->residents.empty())
    for (const auto& setup : impl_->residents.front().setups) text += setup->dot();
  return text;
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

size_t Renderer::framesBegun() const {
  return impl_->begun.size();
}

int Renderer::validationMessages() const {
  return impl_->device->validationMessages();
}

}  // namespace scumble
