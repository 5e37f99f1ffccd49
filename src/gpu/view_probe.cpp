#include "gpu/view_probe.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "gpu/cache_file.h"
#include "gpu/graph_resources.h"
#include "gpu/pipeline.h"
#include "shaders/view_probe_frag.h"
#include "shaders/view_probe_vert.h"

namespace scumble::gpu {

namespace {

constexpr ViewDrawing kWays[] = {ViewDrawing::together, ViewDrawing::separately,
                                 ViewDrawing::resolvedTogether};
constexpr const char* kWayNames[] = {"together", "separately", "resolved-together"};

constexpr uint32_t kSize = ProbePicture::kSize, kProbeLayers = 2;
// What view_probe.vert and view_probe.frag draw, and what is there before.
constexpr uint8_t kDrawn[kProbeLayers] = {51, 204}, kClear = 102;
constexpr float kDrawnDepth[kProbeLayers] = {0.25f, 0.75f}, kClearDepth = 0.0625f;
// What lies there before: none of these. Memory may hold what an earlier probe has drawn right, and what is
// never written would pass for it.
constexpr uint8_t kSpoilt = 17;
constexpr float kSpoiltDepth = 0.5f;
constexpr int kLongSide = 160;  // pixels: x + y along the shape's long side

VkClearValue colorOf(uint8_t value) {
  const float v = float(value) / 255.0f;
  VkClearValue clear;
  clear.color = {{v, v, v, v}};
  return clear;
}

}  // namespace

bool isRight(const ProbePicture& picture) {
  for (uint32_t layer = 0; layer < kProbeLayers; ++layer) {
    const ProbePicture::Layer& l = picture.layers[layer];
    for (uint32_t y = 0; y < kSize; ++y)
      for (uint32_t x = 0; x < kSize; ++x) {
        // The centre is at (x + 1/2, y + 1/2); samples lie within half a pixel of it each way.
        const int beyond = int(x + y) + 1 - kLongSide;
        if (std::abs(beyond) <= 1) continue;
        const bool drawn = beyond < 0;
        const size_t at = size_t(y) * kSize + x;
        if (l.byVertexShader[at] != (drawn ? kDrawn[layer] : kClear)) return false;
        if (l.byFragmentShader[at] != (drawn ? kDrawn[1 - layer] : kClear)) return false;
        if (std::abs(l.depth[at] - (drawn ? kDrawnDepth[layer] : kClearDepth)) > 1e-5f) return false;
      }
  }
  return true;
}

ProbePicture drawProbe(Device& device, ViewDrawing drawing, uint32_t samples) {
  // A pipeline that draws a triangle over everything.
  const Views views{kProbeLayers, drawing};
  GraphicsPipelineDesc desc;
  desc.vertex = {shaders::view_probe_vert}, desc.fragment = {shaders::view_probe_frag};
  desc.colorFormats.assign(2, VK_FORMAT_R8G8B8A8_UNORM);
  desc.depthFormat = VK_FORMAT_D32_SFLOAT;
  desc.samples = samples;
  desc.viewMask = views.mask();
  desc.pushConstantBytes = 4;
  const Pipeline pipeline(device, desc);

  // Images, as frames have them: many samples are drawn and resolved, one is drawn straight away.
  FrameGraph graph;
  std::vector<Handle> drawn, resolved;
  const VkFormat formats[] = {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_D32_SFLOAT};
  for (const VkFormat format : formats) {
    drawn.push_back(graph.addImage("drawn", {.format = format, .samples = samples}));
    if (samples > 1) resolved.push_back(graph.addImage("resolved", {.format = format}));
  }
  for (const bool isSpoilt : {true, false}) {
    graph.addStep(isSpoilt ? "spoil" : "draw");
    for (size_t i = 0; i < std::size(formats); ++i) {
      const bool isDepth = isDepthFormat(formats[i]);
      const Use draw = isDepth ? Use::depthTarget : Use::colorTarget;
      const Use resolve = isDepth ? Use::depthResolveTarget : Use::resolveTarget;
      drawn[i] = graph.use(drawn[i], draw);
      if (samples > 1) resolved[i] = graph.use(resolved[i], isSpoilt ? draw : resolve);
    }
  }
  if (samples == 1) resolved = drawn;
  graph.addStep("read");
  for (const Handle image : resolved) graph.use(image, Use::copySource);
  graph.use(
      graph.importBuffer("read", Outside{}, Outside{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT}),
      Use::copyTarget);
  const FrameGraph::Needs needs = graph.needsOf({});
  const GraphResources images(device, graph, needs, {kSize, kSize, kProbeLayers});
  const auto recordBarriersOf = [&](VkCommandBuffer commands, size_t step) {
    recordBarriers(commands, images.barriers()[step],
                   [&](uint32_t resource) { return images.imageOf(resource); });
  };

  // Draw, and read back.
  constexpr size_t kLayerBytes = size_t(kSize) * kSize * 4;
  const Buffer readback(device, 3 * kProbeLayers * kLayerBytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                        MemoryKind::readback);
  device.runOnce([&](VkCommandBuffer commands) {
    Target targets[3];
    const auto setTargets = [&](const std::vector<Handle>& to, uint8_t color, float depth) {
      for (size_t i = 0; i < 3; ++i) targets[i] = {&images.image(to[i]), nullptr, colorOf(color)};
      targets[2].clear.depthStencil = {depth, 0};
    };
    recordBarriersOf(commands, 0);
    // Layer by layer and without a resolve, which no driver is known to get wrong.
    const auto spoil = [&](const std::vector<Handle>& to) {
      setTargets(to, kSpoilt, kSpoiltDepth);
      drawViews(commands, {kProbeLayers, ViewDrawing::separately}, {targets, 2}, &targets[2],
                [](uint32_t) {});
    };
    spoil(drawn);
    if (samples > 1) spoil(resolved);
    recordBarriersOf(commands, 1);
    setTargets(drawn, kClear, kClearDepth);
    if (samples > 1)
      for (size_t i = 0; i < 3; ++i) targets[i].resolve = &images.image(resolved[i]);
    drawViews(commands, views, {targets, 2}, &targets[2], [&](uint32_t firstView) {
      pipeline.bind(commands);
      pipeline.push(commands, firstView);
      vkCmdDraw(commands, 3, 1, 0, 0);
    });
    recordBarriersOf(commands, 2);
    for (size_t i = 0; i < 3; ++i) {
      VkBufferImageCopy copy{};
      copy.bufferOffset = i * kProbeLayers * kLayerBytes;
      const Image& image = images.image(resolved[i]);
      copy.imageSubresource = {aspectOf(image.desc().format), 0, 0, kProbeLayers};
      copy.imageExtent = {kSize, kSize, 1};
      vkCmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                             readback.handle(), 1, &copy);
    }
    recordBarriersOf(commands, 3);
  });

  // Both colours and the depth, layer by layer.
  ProbePicture picture;
  const std::byte* at = readback.mapped();
  const auto reds = [&](std::vector<uint8_t>& out) {
    for (size_t p = 0; p < size_t(kSize) * kSize; ++p) out.push_back(uint8_t(at[4 * p]));
    at += kLayerBytes;
  };
  for (auto& layer : picture.layers) reds(layer.byVertexShader);
  for (auto& layer : picture.layers) reds(layer.byFragmentShader);
  for (auto& layer : picture.layers) {
    layer.depth.resize(size_t(kSize) * kSize);
    std::memcpy(layer.depth.data(), at, kLayerBytes);
    at += kLayerBytes;
  }
  return picture;
}

std::optional<ViewDrawing> findViewDrawing(Device& device, uint32_t samples) {
  for (const ViewDrawing way : kWays)
    if (isRight(drawProbe(device, way, 1)) && (samples == 1 || isRight(drawProbe(device, way, samples))))
      return way;
  return std::nullopt;
}

namespace {

std::string textOf(const std::string& driver, const ViewDrawings& drawings) {
  std::string text = driver + "\n";
  for (const std::optional<ViewDrawing>& way : {drawings.of1Sample, drawings.of4Samples})
    text += std::string(way ? kWayNames[size_t(*way)] : "none") + "\n";
  return text;
}

}  // namespace

std::optional<ViewDrawings> readViewDrawings(const std::string& file, const std::string& driver) {
  const std::vector<char> data = readCache(file);
  const std::string text(data.begin(), data.end());
  // There are few possible texts: the one that this is tells what was found.
  std::vector<std::optional<ViewDrawing>> answers(std::begin(kWays), std::end(kWays));
  answers.push_back(std::nullopt);
  for (const std::optional<ViewDrawing>& one : answers)
    for (const std::optional<ViewDrawing>& four : answers)
      if (const ViewDrawings drawings{one, four}; text == textOf(driver, drawings)) return drawings;
  return std::nullopt;
}

void writeViewDrawings(const std::string& file, const std::string& driver, const ViewDrawings& drawings) {
  const std::string text = textOf(driver, drawings);
  writeCache(file, std::vector<char>(text.begin(), text.end()));
}

}  // namespace scumble::gpu
