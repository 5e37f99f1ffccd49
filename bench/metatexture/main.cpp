// Milliseconds per full screen of MetaTexture, with 4 and with 8 samples, beside an ordinary trilinear sample
// in the same run.
//
//   metatexture_bench [--size 1280x720] [--runs 31] [--device NAME] [--json FILE]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "frame/metatexture.h"
#include "scumble/image.h"
#include "shaders/fullscreen_vert.h"
#include "shaders/metatexture_bench_frag.h"

using namespace scumble;
using namespace scumble::frame;

namespace {

struct Block {
  glm::vec2 imageSize;
  float askew;
  MetaTexture meta;
};

struct Case {
  const char* name;
  uint32_t method, skew;
  float skip, askew;
  std::vector<double> milliseconds;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
  std::string size = "1280x720", deviceName, jsonFile;
  int runs = 31;
  CLI::App app("Milliseconds per full screen of MetaTexture, beside an ordinary trilinear sample");
  app.add_option("--size", size, "WxH")->capture_default_str();
  app.add_option("--runs", runs, "how often each case is drawn")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--device", deviceName, "part of a name, a number, or cpu");
  app.add_option("--json", jsonFile, "also write the numbers here");
  CLI11_PARSE(app, argc, argv);
  uint32_t width = 0, height = 0;
  if (std::sscanf(size.c_str(), "%ux%u", &width, &height) != 2 || width == 0 || height == 0) {
    std::fprintf(stderr, "metatexture_bench: error: '%s' is no size\n", size.c_str());
    return 2;
  }
  gpu::DeviceOptions options;
  options.choice = deviceName;
  Result<std::unique_ptr<gpu::Device>> created = gpu::Device::create(options);
  if (!created || !(*created)->hasTimestamps()) {
    std::fprintf(stderr, "metatexture_bench: error: %s\n",
                 created ? "this device has no timestamps" : created.error().message().c_str());
    return 4;
  }
  gpu::Device& device = **created;
  gpu::Samplers samplers(device);
  ExampleTextures examples(device);
  const ExampleTexture& example = examples.get({}, 0);

  std::vector<Case> cases{{"write only", 0, 0, 0, 0, {}},
                          {"trilinear sample", 1, 0, 0, 0.5f, {}},
                          {"MetaTexture, 4 samples", 2, 0, 0, 0.5f, {}},
                          {"MetaTexture, 4 samples, skip 0.02", 2, 0, 0.02f, 0.5f, {}},
                          {"MetaTexture, 4 samples, skip 0.1", 2, 0, 0.1f, 0.5f, {}},
                          {"MetaTexture, 8 samples", 2, 2, 0, 0.5f, {}},
                          {"MetaTexture, 8 samples, skip 0.02", 2, 2, 0.02f, 0.5f, {}},
                          {"MetaTexture, 8 samples, skip 0.1", 2, 2, 0.1f, 0.5f, {}}};

  gpu::Image target(device, {VK_FORMAT_R16G16B16A16_SFLOAT, width, height, 1},
                    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
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
    const Block block{
        {float(width), float(height)},
        cases[i].askew,
        metaTextureUse(params, 0b0111, {}, examples, float(height) / 1080.0f, glm::vec2(0.0f)).meta};
    std::memcpy(uniforms.mapped() + i * kStride, &block, sizeof(block));
    sets.writeBuffer(i, 0, uniforms.handle(), i * kStride, sizeof(block));
    sets.writeTexture(i, 1, example.image.view(),
                      samplers.get(cases[i].method == 2 ? MetaTextureUse{block.meta, &example}.sampler()
                                                        : ExampleTextures::kSampler));
    gpu::GraphicsPipelineDesc desc;
    desc.vertex = {shaders::fullscreen_vert};
    desc.fragment = {shaders::metatexture_bench_frag};
    desc.constants = {cases[i].method, cases[i].skew, cases[i].skip > 0};
    desc.colorFormats = {VK_FORMAT_R16G16B16A16_SFLOAT};
    desc.viewMask = 1;
    desc.sets = {layout.handle()};
    pipelines.emplace_back(device, desc);
  }
  VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = 2;
  VkQueryPool queries;
  SCUMBLE_VK(vkCreateQueryPool(device.handle(), &info, nullptr, &queries));

  // All cases take turns, so that what else the machine does falls on all of them. The first turn compiles.
  Configuration configuration;
  configuration.width = width, configuration.height = height;
  for (int run = -1; run < runs; ++run)
    for (size_t i = 0; i < cases.size(); ++i) {
      device.runOnce([&](VkCommandBuffer commands) {
        VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
        barrier.newLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        barrier.image = target.handle();
        barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        dependency.imageMemoryBarrierCount = 1;
        dependency.pImageMemoryBarriers = &barrier;
        vkCmdPipelineBarrier2(commands, &dependency);
        vkCmdResetQueryPool(commands, queries, 0, 2);
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries, 0);
        const Target color{&target, nullptr, {}, Target::Before::undefined};
        drawViews(commands, configuration, {&color, 1}, nullptr, [&](uint32_t) {
          pipelines[i].bind(commands);
          pipelines[i].bindSet(commands, 0, sets[i]);
          vkCmdDraw(commands, 3, 1, 0, 0);
        });
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries, 1);
      });
      uint64_t stamps[2];
      SCUMBLE_VK(vkGetQueryPoolResults(device.handle(), queries, 0, 2, sizeof(stamps), stamps, 8,
                                       VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
      if (run >= 0)
        cases[i].milliseconds.push_back(double(stamps[1] - stamps[0]) *
                                        double(device.limits().timestampPeriod) * 1e-6);
    }
  vkDestroyQueryPool(device.handle(), queries, nullptr);

  std::printf("%s, %ux%u\n%-36s %10s %8s\n", device.info().name.c_str(), width, height, "", "ms", "ratio");
  nlohmann::ordered_json json{{"device", device.info().name},
                              {"driver", device.info().driver},
                              {"width", width},
                              {"height", height},
                              {"runs", runs}};
  for (const Case& c : cases) {
    std::vector<double> ratios;
    for (size_t r = 0; r < c.milliseconds.size(); ++r)
      ratios.push_back(c.milliseconds[r] / cases[1].milliseconds[r]);
    std::printf("%-36s %10.3f %8.2f\n", c.name, median(c.milliseconds), median(ratios));
    json["cases"].push_back(
        {{"name", c.name}, {"milliseconds", median(c.milliseconds)}, {"ratio", median(ratios)}});
  }
  if (!jsonFile.empty())
    if (const Status written = writeText(jsonFile, json.dump(2) + "\n"); !written) {
      std::fprintf(stderr, "metatexture_bench: error: %s\n", written.error().message().c_str());
      return 5;
    }
  return 0;
}
