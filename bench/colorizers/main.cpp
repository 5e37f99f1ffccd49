// Milliseconds per picture of colorizers, beside a plain full-screen pass with the same reads in the same
// run.
//
//   colorizers_bench [--size 1280x720] [--runs 31] [--device NAME] [--json FILE]
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "full_screen/full_screen.h"
#include "passes/colorize/strips.h"
#include "scumble/look.h"
#include "scumble/view.h"
#include "shaders/colorize_image_frag.h"
#include "shaders/plain_reads_frag.h"

using namespace scumble;
using namespace scumble::frame;
using namespace scumble::passes;

namespace {

struct Case {
  std::string name;
  Look look;
  gpu::Pipeline pipeline{};
};

void add(Look& look, const std::string& name, std::vector<std::pair<std::string, std::string>> settings) {
  settings.emplace_back("grade.tint", "#E0C0A0");
  for (const auto& [path, value] : settings)
    if (const Status set = look.set("colorizers." + name + "." + path, value); !set)
      std::fprintf(stderr, "colorizers_bench: %s\n", set.error().message().c_str()), std::exit(1);
}

// So many that fill the screen; the eye looks down -z from the origin.
Look fullScreen(int count, const std::vector<std::pair<std::string, std::string>>& settings) {
  Look look;
  for (int i = 0; i < count; ++i) {
    auto all = settings;
    all.insert(all.begin(), {{"volume.center", std::to_string(0.1 * i) + ",0,-6"},
                             {"volume.radius", "12"},
                             {"volume.size", "12,11,10"}});
    add(look, "c" + std::to_string(i), all);
  }
  return look;
}

// Spheres of which some stand in the picture's middle and the others behind the eye.
Look partly(int seen, int others) {
  Look look = fullScreen(seen, {{"volume.kind", "atmospheric"}});
  for (int i = 0; i < others; ++i)
    add(look, "b" + std::to_string(i), {{"volume.kind", "atmospheric"}, {"volume.center", "0,0,20"}});
  return look;
}

// Small ones, spread over the picture.
Look spread(int count) {
  Look look;
  for (int i = 0; i < count; ++i) {
    const int column = i % 8, row = i / 8;
    add(look, "s" + std::to_string(i),
        {{"volume.kind", "atmospheric"},
         {"volume.center", std::to_string(-3.5 + column) + "," + std::to_string(-1.75 + 0.5 * row) + ",-6"},
         {"volume.radius", "0.4"}});
  }
  return look;
}

}  // namespace

int main(int argc, char** argv) {
  bench::FullScreen screen("colorizers_bench",
                           "Milliseconds per picture of colorizers, beside a plain pass with the same reads",
                           argc, argv);
  gpu::Device& device = screen.device();
  const uint32_t width = screen.width(), height = screen.height();
  gpu::Samplers samplers(device);

  // What is compared.
  const std::pair<std::string, std::string> fog{"volume.kind", "atmospheric"};
  std::vector<Case> cases;
  const auto addCase = [&](std::string name, Look look) {
    cases.push_back({std::move(name), std::move(look)});
  };
  addCase("plain pass with the same reads", Look());
  addCase("1 sphere of fog", fullScreen(1, {fog}));
  addCase("4 spheres of fog", fullScreen(4, {fog}));
  addCase("4 seen of 64 listed", partly(4, 60));
  addCase("16 spheres of fog", fullScreen(16, {fog}));
  addCase("16 spheres, surfaces", fullScreen(16, {}));
  addCase("16 spheres of fog, gamma", fullScreen(16, {fog, {"grade.gamma", "0.8,1,1.2"}}));
  addCase("16 spheres of fog, falloff", fullScreen(16, {fog, {"volume.falloff", "0.7"}}));
  addCase("16 ellipsoids of fog", fullScreen(16, {fog, {"volume.shape", "ellipsoid"}}));
  addCase("16 boxes of fog", fullScreen(16, {fog, {"volume.shape", "box"}}));
  addCase("16 capsules of fog", fullScreen(16, {fog, {"volume.shape", "capsule"}}));
  addCase("16 half-spaces of fog", fullScreen(16, {fog, {"volume.shape", "half-space"}}));
  addCase("64 small spheres side by side", spread(64));
  addCase("64 spheres of fog", fullScreen(64, {fog}));

  // A wall ten metres away.
  View view{glm::mat4(1.0f), glm::mat4(0.0f)};
  const float aspect = float(width) / float(height), near = 0.01f;
  view.eyeToClip[0][0] = 1.6f / aspect, view.eyeToClip[1][1] = -1.6f;
  view.eyeToClip[2][3] = -1, view.eyeToClip[3][2] = near;
  shared::FrameUniforms uniforms{};
  shared::ViewUniforms& seen = uniforms.views[0];
  seen.worldToClip = view.eyeToClip, seen.worldToEye = view.worldToEye;
  seen.ndcToEyeRay = {1 / view.eyeToClip[0][0], 1 / view.eyeToClip[1][1], 0, 0};
  seen.depthToEye = {near, 0, 0, 1};
  uniforms.views[1] = seen;
  uniforms.imageSize = {float(width), float(height)};

  // The colours and the depth that all of them read.
  const auto image = [&](VkFormat format, VkImageUsageFlags usage) {
    return gpu::Image(device, {format, width, height, 1}, usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  };
  const gpu::Image color = image(VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT),
                   depth = image(VK_FORMAT_D32_SFLOAT,
                                 VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  const auto toLayout = [&](VkCommandBuffer commands, const gpu::Image& of, VkImageLayout from,
                            VkImageLayout to) {
    VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = barrier.dstAccessMask =
        VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = from, barrier.newLayout = to;
    barrier.image = of.handle();
    const bool isDepth = gpu::isDepthFormat(of.desc().format);
    barrier.subresourceRange = {
        VkImageAspectFlags(isDepth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT), 0, 1, 0, 1};
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
  };
  device.runOnce([&](VkCommandBuffer commands) {
    constexpr VkImageLayout kClear = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    for (const gpu::Image* of : {&color, &depth}) toLayout(commands, *of, VK_IMAGE_LAYOUT_UNDEFINED, kClear);
    const VkClearColorValue gray{{0.4f, 0.5f, 0.6f, 1}};
    const VkClearDepthStencilValue far{near / 10, 0};
    const VkImageSubresourceRange colors{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
        depths{VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, color.handle(), kClear, &gray, 1, &colors);
    vkCmdClearDepthStencilImage(commands, depth.handle(), kClear, &far, 1, &depths);
    for (const gpu::Image* of : {&color, &depth})
      toLayout(commands, *of, kClear, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });

  // Lists of colorizers and pipelines, as the pass makes them.
  const VkShaderStageFlags all = VK_SHADER_STAGE_FRAGMENT_BIT;
  const gpu::SetLayout frameLayout(
      device, {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, all}, {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, all}});
  const gpu::SetLayout layout(device, {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, all},
                                       {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, all},
                                       {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, all}});
  constexpr uint64_t kStride = gpu::uniformStride(sizeof(shared::ColorizeUniforms));
  gpu::Buffer frameBuffer(device, sizeof(uniforms),
                          VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                          gpu::MemoryKind::upload);
  gpu::Buffer lists(device, kStride * cases.size(), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                    gpu::MemoryKind::upload);
  std::memcpy(frameBuffer.mapped(), &uniforms, sizeof(uniforms));
  gpu::DescriptorSets frameSet(device, frameLayout), sets(device, layout, uint32_t(cases.size()));
  frameSet.writeBuffer(0, 0, frameBuffer.handle());
  frameSet.writeBuffer(0, 1, frameBuffer.handle());
  for (size_t i = 0; i < cases.size(); ++i) {
    Case& c = cases[i];
    const std::vector<PlacedColorizer> colorizers = placeColorizers(c.look.data(), {}, {}, uniforms);
    auto* block = new (lists.mapped() + i * kStride) shared::ColorizeUniforms{};
    const uint32_t features = fillUniforms(colorizers, uniforms, 1, width, height, *block);
    sets.writeBuffer(i, 0, lists.handle(), i * kStride, sizeof(*block));
    sets.writeTexture(i, 1, color.view(), samplers.get({}));
    gpu::SamplerDesc nearest;
    nearest.filter = VK_FILTER_NEAREST;
    sets.writeTexture(i, 2, depth.view(), samplers.get(nearest));
    c.pipeline = screen.pipeline(
        i == 0 ? gpu::Shader{shaders::plain_reads_frag} : gpu::Shader{shaders::colorize_image_frag},
        {features, 0, 0, 1}, {frameLayout.handle(), layout.handle()});
  }
  // A full screen of each.
  std::vector<bench::FullScreenCase> drawn;
  for (size_t i = 0; i < cases.size(); ++i)
    drawn.push_back({cases[i].name, [&, i](VkCommandBuffer commands) {
                       cases[i].pipeline.bind(commands);
                       cases[i].pipeline.push(commands, 0);
                       cases[i].pipeline.bindSet(commands, 0, frameSet[0]);
                       cases[i].pipeline.bindSet(commands, 1, sets[i]);
                       vkCmdDraw(commands, 3, 1, 0, 0);
                     }});
  return screen.run(std::move(drawn), 0);
}
