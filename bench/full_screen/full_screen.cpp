#include "full_screen/full_screen.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "report/report.h"
#include "shaders/fullscreen_vert.h"

namespace scumble::bench {

using namespace frame;

FullScreen::FullScreen(const std::string& program, const std::string& description, int argc, char** argv)
    : program_(program) {
  std::string size = "1280x720";
  gpu::DeviceOptions options;
  CLI::App app(description);
  app.add_option("--size", size, "WxH")->capture_default_str();
  app.add_option("--runs", runs_, "how often each case is drawn")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--device", options.choice, "part of a name, a number, or cpu");
  app.add_option("--json", json_, "also write the numbers here");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  if (std::sscanf(size.c_str(), "%ux%u", &width_, &height_) != 2 || width_ == 0 || height_ == 0) {
    std::fprintf(stderr, "%s: error: '%s' is no size\n", program.c_str(), size.c_str());
    std::exit(2);
  }
  Result<std::unique_ptr<gpu::Device>> created = gpu::Device::create(options);
  if (!created || !(*created)->hasTimestamps()) {
    std::fprintf(stderr, "%s: error: %s\n", program.c_str(),
                 created ? "this device has no timestamps" : created.error().message().c_str());
    std::exit(4);
  }
  device_ = std::move(created).value();
}

gpu::Pipeline FullScreen::pipeline(gpu::Shader fragment, std::vector<uint32_t> constants,
                                   std::vector<VkDescriptorSetLayout> sets) {
  gpu::GraphicsPipelineDesc desc;
  desc.vertex = {shaders::fullscreen_vert};
  desc.fragment = fragment;
  desc.constants = std::move(constants);
  desc.colorFormats = {kFormat};
  desc.viewMask = 1;
  desc.pushConstantBytes = 4;
  desc.sets = std::move(sets);
  return gpu::Pipeline(*device_, desc);
}

double FullScreen::milliseconds(const FullScreenCase& one, const gpu::Image& target, VkQueryPool queries) {
  device_->runOnce([&](VkCommandBuffer commands) {
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
    const gpu::Target to{&target, nullptr, {}, gpu::Target::Before::undefined};
    gpu::drawViews(commands, gpu::Views{}, {&to, 1}, nullptr, [&](uint32_t) { one.draw(commands); });
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries, 1);
  });
  uint64_t stamps[2];
  SCUMBLE_VK(vkGetQueryPoolResults(device_->handle(), queries, 0, 2, sizeof(stamps), stamps, 8,
                                   VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
  return double(stamps[1] - stamps[0]) * double(device_->limits().timestampPeriod) * 1e-6;
}

int FullScreen::run(std::vector<FullScreenCase> cases, size_t yardstick) {
  const gpu::Image target(*device_, {kFormat, width_, height_, 1}, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = 2;
  VkQueryPool queries;
  SCUMBLE_VK(vkCreateQueryPool(device_->handle(), &info, nullptr, &queries));
  for (FullScreenCase& one : cases) one.first = milliseconds(one, target, queries);
  for (int run = 0; run < runs_; ++run)
    for (FullScreenCase& one : cases) one.milliseconds.push_back(milliseconds(one, target, queries));
  vkDestroyQueryPool(device_->handle(), queries, nullptr);

  std::printf("%s, %ux%u\n%-36s %10s %8s %12s\n", device_->info().name.c_str(), width_, height_, "", "ms",
              "ratio", "first, ms");
  nlohmann::ordered_json json{{"device", device_->info().name},
                              {"driver", device_->info().driver},
                              {"width", width_},
                              {"height", height_},
                              {"runs", runs_}};
  for (const FullScreenCase& one : cases) {
    std::vector<double> ratios;
    for (size_t r = 0; r < one.milliseconds.size(); ++r)
      ratios.push_back(one.milliseconds[r] / cases[yardstick].milliseconds[r]);
    std::printf("%-36s %10.3f %8.2f %12.1f\n", one.name.c_str(), median(one.milliseconds), median(ratios),
                one.first);
    json["cases"].push_back({{"name", one.name},
                             {"milliseconds", median(one.milliseconds)},
                             {"ratio", median(ratios)},
                             {"first", one.first}});
  }
  return give(program_.c_str(), json_, json);
}

}  // namespace scumble::bench
