// Passes that live outside of the library: put between two of its own, they take the picture so far and give
// the next one. Nothing under src/ knows them.
#include <gtest/gtest.h>

#include <cmath>

#include "frame/image_step.h"
#include "renderer/pass_list.h"
#include "shaders/inserted_brighten_image_comp.h"
#include "shaders/inserted_brighten_image_frag.h"
#include "shaders/inserted_count_comp.h"
#include "shaders/inserted_flip_comp.h"
#include "shaders/inserted_gamma_image_comp.h"
#include "shaders/inserted_gamma_image_frag.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;
using namespace frame;

#define PARAMS_STRUCT BrightenParams
#define PARAMS_FILE "tests/render/inserted_brighten.params"
#define PARAMS_PATH "brighten"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// An image pass with an AOV of its own.
class Gamma : public Pass {
 public:
  explicit Gamma(float power) : power_(power) {}
  const char* name() const override { return "gamma"; }
  std::span<const Aov> aovs() const override { return kAovs; }

  void declare(FrameBuilder& frame, uint32_t) override {
    const gpu::Handle picture = step_.declare(
        frame, {.name = name(),
                .shader = {{shaders::inserted_gamma_image_frag}, {shaders::inserted_gamma_image_comp}},
                .inputs = {{1, frame.get(kPicture)}},
                .outputs = {frame.image(name(), {.format = kHalves})},
                .uniformBytes = sizeof(float)})[0];
    frame.give(kPicture, picture);
    frame.offer(kAovs[0], {picture});
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }
  void update(const FrameInput&) override { step_.update(power_); }

 private:
  static constexpr Aov kAovs[] = {{.name = "gamma", .isColor = true, .premultiplied = 3}};
  float power_;
  ImageStep step_;
};

// An image pass with a knob: one row of a .params file, and its one use in the shader.
class Brighten : public Pass {
 public:
  const char* name() const override { return "brighten"; }

  void declare(FrameBuilder& frame, uint32_t) override {
    frame.give(kPicture, step_.declare(frame, {.name = name(),
                                               .shader = {{shaders::inserted_brighten_image_frag},
                                                          {shaders::inserted_brighten_image_comp}},
                                               .inputs = {{1, frame.get(kPicture)}},
                                               .outputs = {frame.image(name(), {.format = kHalves})},
                                               .uniformBytes = sizeof(BrightenParams)})[0]);
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }
  void update(const FrameInput& input) override { step_.update(input.knobs.scene<BrightenParams>()); }

 private:
  ImageStep step_;
};

// Two compute steps: one writes arguments, into a buffer of its own, by which the other is dispatched; that
// one goes on from a copy of the picture.
class HalfFlip : public Pass {
 public:
  const char* name() const override { return "half-flip"; }

  void declare(FrameBuilder& frame, uint32_t) override {
    picture_ = frame.get(kPicture);
    arguments_ = frame.buffer("groups", 3 * sizeof(uint32_t));
    frame.step("half-flip", [this](VkCommandBuffer commands) {
      count_.bind(commands);
      count_.bindSet(commands, 0, countSet_[0]);
      vkCmdDispatch(commands, 1, 1, 1);
    });
    frame.use(picture_, gpu::Use::sampledByCompute);
    arguments_ = frame.use(arguments_, gpu::Use::storageBufferWrite);

    frame.step("half-flip", [this](VkCommandBuffer commands) {
      VkImageCopy copy{};
      const gpu::ImageDesc& desc = resources_->image(picture_).desc();
      copy.srcSubresource = copy.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, desc.layers};
      copy.extent = {desc.width, desc.height, 1};
      vkCmdCopyImage(commands, resources_->image(picture_).handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                     resources_->image(flipped_).handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    });
    frame.use(picture_, gpu::Use::copySource);
    flipped_ = frame.use(frame.image("half-flipped", {.format = kHalves}), gpu::Use::copyTarget);

    frame.step("half-flip", [this](VkCommandBuffer commands) {
      flip_.bind(commands);
      flip_.bindSet(commands, 0, flipSet_[0]);
      vkCmdDispatchIndirect(commands, resources_->buffer(arguments_), 0);
    });
    frame.use(picture_, gpu::Use::sampledByCompute);
    frame.use(arguments_, gpu::Use::indirectBuffer);
    flipped_ = frame.use(flipped_, gpu::Use::storageImageWrite);
    frame.give(kPicture, flipped_);
  }

  void create(FrameBuilder& frame) override {
    frame_ = &frame;
    constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_COMPUTE_BIT;
    countLayout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kStage},
                                                   {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kStage}});
    flipLayout_ = gpu::SetLayout(frame.device(), {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kStage},
                                                  {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kStage}});
    countSet_ = gpu::DescriptorSets(frame.device(), countLayout_);
    flipSet_ = gpu::DescriptorSets(frame.device(), flipLayout_);
    count_ = gpu::Pipeline(frame.device(), gpu::ComputePipelineDesc{
                                               {shaders::inserted_count_comp}, {}, {countLayout_.handle()}});
    flip_ = gpu::Pipeline(
        frame.device(), gpu::ComputePipelineDesc{{shaders::inserted_flip_comp}, {}, {flipLayout_.handle()}});
  }

  void bind(const gpu::GraphResources& resources) override {
    resources_ = &resources;
    const VkSampler exact = frame_->samplers().get({VK_FILTER_NEAREST});
    for (gpu::DescriptorSets* const sets : {&countSet_, &flipSet_})
      sets->rewriteTexture(0, 0, resources.image(picture_).view(), exact);
    countSet_.writeBuffer(0, 1, resources.buffer(arguments_));
    flipSet_.writeStorageImage(0, 1, resources.image(flipped_).view());
  }

 private:
  gpu::Handle picture_, arguments_, flipped_;
  FrameBuilder* frame_ = nullptr;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout countLayout_, flipLayout_;
  gpu::DescriptorSets countSet_, flipSet_;
  gpu::Pipeline count_, flip_;
};

class InsertedPass : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 83, kHeight = 48;

  // One in which final-color is the last pass that does something.
  static Look lastOneLook() {
    Look look;
    if (const Status set = look.set("final.lostEdges", "0"); !set)
      throw std::runtime_error(set.error().message());
    return look;
  }

  // Layers of a frame by a renderer whose passes were arranged.
  static Frame drawWith(const std::function<void(renderer::PassList&)>& arrange,
                        const std::vector<std::string>& aovs = {}, std::string* graph = nullptr,
                        const Look& look = lastOneLook(), double time = 0) {
    RendererOptions options;
    options.device = testDevice();
    options.validation = true;
    options.arrangePasses = arrange;
    const auto made = Renderer::create(options);
    if (!made) throw std::runtime_error(made.error().message());
    const Scene scene = stillLife().load();
    const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
    // Twice, with another size between, so that everything was bound to other images as well.
    Result<Frame> frame = (*made)->render(scene, look, time, views, sized(kWidth, kHeight, aovs));
    if (frame) frame = (*made)->render(scene, look, time, views, sized(2 * kWidth, 16, aovs));
    if (frame) frame = (*made)->render(scene, look, time, views, sized(kWidth, kHeight, aovs));
    if (!frame) throw std::runtime_error(frame.error().message());
    EXPECT_EQ((*made)->validationMessages(), 0);
    if (graph) *graph = (*made)->graph();
    return std::move(frame).value();
  }
};
INSTANTIATE_BOTH_EYES(InsertedPass);

void expectGamma(const Image& before, const Image& after, float power) {
  ASSERT_EQ(before.pixels.size(), after.pixels.size());
  double changed = 0;
  for (size_t i = 0; i < before.pixels.size(); ++i) {
    const float expected = i % 4 == 3 ? before.pixels[i] : std::pow(std::max(before.pixels[i], 0.0f), power);
    ASSERT_NEAR(after.pixels[i], expected, 2e-3f * std::max(expected, 0.05f)) << i;
    changed += std::abs(after.pixels[i] - before.pixels[i]);
  }
  EXPECT_GT(changed / double(before.pixels.size()), 0.02) << "nothing has happened";
}

TEST_P(InsertedPass, anImagePassAfterTheLastOne) {
  const Frame plain = drawWith({});
  const Frame with = drawWith(
      [](renderer::PassList& list) {
        list.insertAfter("final-color", [] { return std::make_unique<Gamma>(0.5f); });
      },
      {"final-color", "gamma"});
  ASSERT_EQ(with.layers.size(), 3u);
  for (size_t v = 0; v < viewCount(); ++v) {
    expectGamma(plain.layers[0].views[v], with.layers[0].views[v], 0.5f);
    EXPECT_EQ(with.layers[1].views[v].pixels, plain.layers[0].views[v].pixels) << "what came before";
    EXPECT_EQ(with.layers[2].views[v].pixels, with.layers[0].views[v].pixels) << "its own AOV";
  }
}

TEST_P(InsertedPass, anImagePassBetweenTwoOthers) {
  const Frame plain = drawWith({}, {"color"});
  const Frame with = drawWith(
      [](renderer::PassList& list) {
        list.insertBefore("colorize", [] { return std::make_unique<Gamma>(0.5f); });
      },
      {"color", "gamma", "colorize"});
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_EQ(with.layers[1].views[v].pixels, plain.layers[1].views[v].pixels);
    expectGamma(plain.layers[1].views[v], with.layers[2].views[v], 0.5f);
    EXPECT_EQ(with.layers[3].views[v].pixels, with.layers[2].views[v].pixels) << "no colorizers: as it is";
    EXPECT_NE(with.layers[0].views[v].pixels, plain.layers[0].views[v].pixels);
  }
}

// A knob from outside of the library: a row gives the struct on both sides, the reader, the checks, tracks
// and
// --set; the shader uses it.
TEST_P(InsertedPass, aKnobIsOneRowAndOneUse) {
  const look::AddedBlock added(BrightenParams::block());
  const auto arrange = [](renderer::PassList& list) {
    list.insertAfter("lost-edges", [] { return std::make_unique<Brighten>(); });
  };
  const Frame plain = drawWith({}, {}, nullptr, Look());
  const auto expectTimes = [&](const Look& look, double time, float factor) {
    const Frame with = drawWith(arrange, {}, nullptr, look, time);
    for (size_t v = 0; v < viewCount(); ++v) {
      const Image &before = plain.layers[0].views[v], &after = with.layers[0].views[v];
      for (size_t i = 0; i < before.pixels.size(); ++i) {
        const float expected = before.pixels[i] * (i % 4 == 3 ? 1 : factor);
        ASSERT_NEAR(after.pixels[i], expected, 2e-3f * std::max(expected, 0.05f)) << i;
      }
    }
  };
  expectTimes(Look(), 0, 1);
  Look look;
  ASSERT_TRUE(look.set("brighten.by", "1.75"));
  expectTimes(look, 0, 1.75f);
  const Result<Look> tracked =
      Look::fromJson(R"({"brighten": {"by": {"keys": [[0, 0.5], [2, 1.5]]}}})", "test");
  ASSERT_TRUE(tracked.ok()) << tracked.error().message();
  expectTimes(*tracked, 1, 1.0f);
  expectTimes(*tracked, 2, 1.5f);
  EXPECT_FALSE(look.set("brighten.by", "9")) << "beyond the row's range";
  const Status slip = look.set("brighten.bi", "1");
  ASSERT_FALSE(slip.ok());
  EXPECT_NE(slip.error().message().find("brighten.by"), std::string::npos) << slip.error().message();
}

TEST_P(InsertedPass, computeWithAnIndirectBufferOfItsOwn) {
  const Frame plain = drawWith({});
  std::string graph;
  const Frame with = drawWith(
      [](renderer::PassList& list) {
        list.insertAfter("final-color", [] { return std::make_unique<HalfFlip>(); });
      },
      {}, &graph);
  size_t differs = 0;
  for (size_t v = 0; v < viewCount(); ++v) {
    const Image &before = plain.layers[0].views[v], &after = with.layers[0].views[v];
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x)
        for (uint32_t c = 0; c < 4; ++c) {
          const bool isFlipped = y < kHeight / 2 && c < 3;
          ASSERT_EQ(after.at(x, y, c), before.at(x, y, isFlipped ? 2 - c : c)) << x << ", " << y;
          differs += after.at(x, y, c) != before.at(x, y, c);
        }
  }
  EXPECT_GT(differs, size_t(kWidth * kHeight / 2)) << "nothing has happened";
  EXPECT_NE(graph.find("half-flipped, version 2"), std::string::npos) << graph;
  EXPECT_NE(graph.find("groups\\n12 bytes"), std::string::npos) << graph;
}

}  // namespace
}  // namespace scumble
