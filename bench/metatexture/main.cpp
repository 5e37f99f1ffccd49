// Milliseconds per full screen of MetaTexture, with 4 and with 8 samples, beside an ordinary trilinear sample
// in the same run.
//
//   metatexture_bench [--size 1280x720] [--runs 31] [--device NAME] [--json FILE]
#include "frame/metatexture.h"
#include "full_screen/full_screen.h"
#include "shaders/metatexture_bench_frag.h"

using namespace scumble;
using namespace scumble::frame;

namespace {

struct Block {
  glm::vec2 imageSize;
  float askew;
  MetaTextureUniforms meta;
};

struct Case {
  const char* name;
  uint32_t method, skew;
  float skip, askew;
};

}  // namespace

int main(int argc, char** argv) {
  bench::FullScreen screen("metatexture_bench",
                           "Milliseconds per full screen of MetaTexture, beside an ordinary trilinear sample",
                           argc, argv);
  gpu::Device& device = screen.device();
  gpu::Samplers samplers(device);
  ExampleTextures examples(device);
  const ExampleTexture& example = examples.get({}, 0);

  const std::vector<Case> cases{{"write only", 0, 0, 0, 0},
                                {"trilinear sample", 1, 0, 0, 0.5f},
                                {"MetaTexture, 4 samples", 2, 0, 0, 0.5f},
                                {"MetaTexture, 4 samples, skip 0.02", 2, 0, 0.02f, 0.5f},
                                {"MetaTexture, 4 samples, skip 0.1", 2, 0, 0.1f, 0.5f},
                                {"MetaTexture, 8 samples", 2, 2, 0, 0.5f},
                                {"MetaTexture, 8 samples, skip 0.02", 2, 2, 0.02f, 0.5f},
                                {"MetaTexture, 8 samples, skip 0.1", 2, 2, 0.1f, 0.5f}};

  constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_FRAGMENT_BIT;
  gpu::SetLayout layout(device, {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, kStage},
                                 {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kStage}});
  gpu::DescriptorSets sets(device, layout, uint32_t(cases.size()));
  constexpr uint64_t kStride = 256;
  gpu::Buffer uniforms(device, kStride * cases.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                       gpu::MemoryKind::upload);
  std::vector<gpu::Pipeline> pipelines;
  for (size_t i = 0; i < cases.size(); ++i) {
    WarpMetaTextureParams params;
    params.skip = cases[i].skip;
    MetaTextureUse use =
        metaTextureUse(params, 0b0111, {}, examples, float(screen.height()) / 1080.0f, glm::vec2(0.0f));
    use.meta.skew = int(cases[i].skew), use.meta.wrapping = 0;
    const Block block{{float(screen.width()), float(screen.height())}, cases[i].askew, use.meta.uniforms()};
    std::memcpy(uniforms.mapped() + i * kStride, &block, sizeof(block));
    sets.writeBuffer(i, 0, uniforms.handle(), i * kStride, sizeof(block));
    sets.writeTexture(i, 1, example.image.view(),
                      samplers.get(cases[i].method == 2 ? use.sampler() : ExampleTextures::kSampler));
    pipelines.push_back(screen.pipeline({shaders::metatexture_bench_frag},
                                        {cases[i].method, use.meta.features()}, {layout.handle()}));
  }
  std::vector<bench::FullScreenCase> drawn;
  for (size_t i = 0; i < cases.size(); ++i)
    drawn.push_back({cases[i].name, [&, i](VkCommandBuffer commands) {
                       pipelines[i].bind(commands);
                       pipelines[i].bindSet(commands, 0, sets[i]);
                       vkCmdDraw(commands, 3, 1, 0, 0);
                     }});
  return screen.run(std::move(drawn), 1);
}
