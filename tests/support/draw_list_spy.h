// The draw list as the device leaves it, copied to where the CPU can read it.
#pragma once

#include <cstring>
#include <functional>

#include "renderer/pass_list.h"
#include "scumble/renderer.h"
#include "tests/support/test_device.h"

namespace scumble::test {

// What a frame's list was, and what it was made of.
struct SeenList {
  std::vector<shared::DrawCommand> commands, torn, casters;
  std::vector<frame::DrawBucket> buckets;
  std::vector<frame::Draw> draws;
  std::vector<scene::Bounds> bounds;  // by object
  std::vector<uint8_t> mirrored;      // by object
  std::vector<float> scales;          // by object
  shared::FrameUniforms uniforms;
  float inflation = 0, longestCasterEdge = 0;
};

class DrawListSpy : public frame::Pass {
 public:
  explicit DrawListSpy(SeenList& into) : into_(into) {}
  const char* name() const override { return "spy"; }
  void declare(frame::FrameBuilder& frame, uint32_t) override {
    const gpu::Handle copy = frame.graph().importBuffer(
        "copy", {}, gpu::Outside{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    frame.step("spy", [this](VkCommandBuffer commands) {
      const frame::DrawList& list = frame_->scene().draws();
      const VkDeviceSize size = into_.draws.size() * sizeof(shared::DrawCommand);
      if (size == 0) return;
      const VkBufferCopy seen{0, 0, size}, casters{0, size, size}, torn{0, 2 * size, size};
      vkCmdCopyBuffer(commands, list.torn(), copy_.handle(), 1, &torn);
      vkCmdCopyBuffer(commands, list.seen(), copy_.handle(), 1, &seen);
      vkCmdCopyBuffer(commands, list.casters(), copy_.handle(), 1, &casters);
    });
    frame.use(frame.get(frame::kDrawList), gpu::Use::copySource);
    frame.use(copy, gpu::Use::copyTarget);
  }
  void create(frame::FrameBuilder& frame) override { frame_ = &frame; }
  void bind(const gpu::GraphResources&) override {
    copy_ = gpu::Buffer(frame_->device(), 3 * frame_->scene().draws().room() * sizeof(shared::DrawCommand),
                        VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryKind::readback);
  }
  void update(const frame::FrameInput& input) override {
    const frame::SceneOnGpu& scene = input.scene;
    into_ = {{},
             {},
             {},
             scene.draws().buckets(),
             scene.draws().draws(),
             scene.motion().bounds(),
             scene.motion().mirrored(),
             scene.motion().scales(),
             input.uniforms,
             input.inflation,
             scene.longestCasterEdge()};
  }
  void collect() {
    const size_t count = into_.draws.size();
    into_.commands.resize(count), into_.torn.resize(count), into_.casters.resize(count);
    if (!copy_.handle()) return;
    const auto* read = reinterpret_cast<const shared::DrawCommand*>(copy_.mapped());
    std::copy(read, read + count, into_.commands.begin());
    std::copy(read + count, read + 2 * count, into_.casters.begin());
    std::copy(read + 2 * count, read + 3 * count, into_.torn.begin());
  }

 private:
  SeenList& into_;
  frame::FrameBuilder* frame_ = nullptr;
  gpu::Buffer copy_;
};

// A renderer of its own whose frames' lists can be read.
class RendererWithSpy {
 public:
  RendererWithSpy() {
    RendererOptions options;
    options.device = testDevice();
    options.validation = true;
    options.arrangePasses = [this](renderer::PassList& list) {
      list.insertAfter("cull", [this] {
        auto spy = std::make_unique<DrawListSpy>(list_);
        spy_ = spy.get();
        return spy;
      });
    };
    auto made = Renderer::create(options);
    if (!made) throw std::runtime_error(made.error().message());
    renderer_ = std::move(*made);
  }
  Frame draw(const Scene& scene, const Look& look, const std::vector<View>& views,
             const RenderOptions& options) {
    auto frame = renderer_->render(scene, look, 0, views, options);
    if (!frame) throw std::runtime_error(frame.error().message());
    spy_->collect();
    return std::move(*frame);
  }
  const SeenList& list() const { return list_; }  // of the last frame
  int validationMessages() const { return renderer_->validationMessages(); }

 private:
  SeenList list_;
  DrawListSpy* spy_ = nullptr;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace scumble::test
