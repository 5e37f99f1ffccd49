// The vertex streams that geometry passes read.
#pragma once

#include "gpu/pipeline.h"
#include "world/scene_on_gpu.h"

namespace scumble::frame {

using namespace world;

// Vertex attributes by shader location.
enum VertexInput : uint32_t {
  kPosition = 1 << 0,
  kNormal = 1 << 1,
  kUv0 = 1 << 2,
  kUv1 = 1 << 3,
  kColor = 1 << 4,
  kDPdu = 1 << 5,
  kSmoothNormal = 1 << 6,
  kDPdv = 1 << 7,
  kPatternUv = 1 << 8,
  kWarpScale = 1 << 9,
  kPreviousPosition = 1 << 10,  // a frame ago; only where the configuration has facts
  kIndirect = 1 << 12,          // light that surfaces give each other: world/indirect_light.h
  kPart = 1 << 11,              // of blended surfaces: world/transparent_triangles.h
};

// Adds attributes for these bits, and the bindings that they need.
void addVertexInput(gpu::GraphicsPipelineDesc& pipeline, uint32_t inputs);

// Binds all streams of the scene's final vertices.
void bindVertices(VkCommandBuffer commands, const SceneOnGpu& scene);

}  // namespace scumble::frame
