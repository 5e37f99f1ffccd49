// What the geometry passes share: the vertex streams, and one pipeline for each kind of material.
#pragma once

#include <array>
#include <functional>

#include "frame/pass.h"

namespace scumble::frame {

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
};

struct GeometryStepDesc {
  gpu::Shader vertex, fragment;
  uint32_t inputs = 0;          // VertexInput bits that `vertex` reads
  gpu::Shader depthOnlyVertex;  // instead of both for opaque surfaces: position in, depth out; may be empty
  std::vector<VkFormat> colorFormats;
  VkCompareOp depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
  uint32_t samples = 1, viewMask = 0;  // mask 0: the shaders know no views
  uint32_t viewCount = 1;
  bool blends = false;  // blended surfaces are composited; else they are drawn like masked ones
  // Set 2, or null for none. Its first bindings are dynamic uniforms, one for each of `materialStrides`: the
  // step from one material's knobs to the next one's, in bytes.
  const gpu::SetLayout* passLayout = nullptr;
  std::vector<uint32_t> materialStrides;
};

class GeometryStep {
 public:
  void create(gpu::Device& device, const FrameResources& resources, const SceneOnGpu& scene,
              const GeometryStepDesc& desc);
  // Draws what `includes` lets through: opaque, then masked, then blended surfaces from far to near as `eye`
  // sees them.
  void draw(VkCommandBuffer commands, const FrameResources& resources, const SceneOnGpu& scene,
            VkDescriptorSet passSet, uint32_t firstView, const glm::vec3& eye,
            const std::function<bool(const Draw&)>& includes = {}) const;

 private:
  // Specialised by alpha mode (constant 0), by whether colours vary (1) and by whether textures are read (2).
  static size_t variant(const Draw& draw) { return size_t(draw.alpha) * 4 + draw.varied * 2 + draw.textured; }
  std::array<gpu::Pipeline, 12> pipelines_;
  bool hasPassSet_ = false, hasViews_ = false;
  std::vector<uint32_t> materialStrides_;
};

}  // namespace scumble::frame
