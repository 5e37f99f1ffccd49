// Draws the scene, with one pipeline for each kind of material.
#pragma once

#include <compare>
#include <map>

#include "frame/pass.h"
#include "frame/vertex_input.h"

namespace scumble::frame {

struct GeometryStepDesc {
  // Which draws: those that are visible, with the detail of surfaces or of what tears them; or those that
  // cast shadows.
  enum class What : uint8_t { visible, torn, casters };
  What what = What::visible;
  std::optional<uint32_t> onlyMaterial;  // nothing but what has this one
  gpu::Shader vertex, fragment;
  uint32_t inputs = 0;  // VertexInput bits that `vertex` reads
  // Instead of both, with more inputs, for materials that the look paints textures on; may be empty.
  gpu::Shader paintedVertex, paintedFragment;
  uint32_t paintedInputs = 0;
  // Instead of `fragment`, for materials whose colours a pass has painted already; may be empty.
  gpu::Shader prepaintedFragment;
  gpu::Shader depthOnlyVertex;  // instead of both for opaque surfaces: position in, depth out; may be empty
  std::vector<VkFormat> colorFormats;
  VkCompareOp depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
  uint32_t samples = 1, viewMask = 0;  // mask 0: the shaders know no views
  uint32_t viewCount = 1;
  uint32_t constant = 0;  // the pass's own, to begin with
  // Blended surfaces are left to somebody else; else they are drawn like masked ones.
  bool leavesBlended = false;
  // Nothing but blended surfaces that are no layers of paint.
  bool onlyBlended = false;
  gpu::Blend blend = gpu::Blend::none;
  bool depthWrite = true;
  // Set 2, or null for none. Its first bindings are dynamic uniforms, one for each of `materialStrides`: the
  // step from one material's knobs to the next one's, in bytes.
  const gpu::SetLayout* passLayout = nullptr;
  std::vector<uint32_t> materialStrides;
};

// What of the look goes into a material's pipelines besides its vertex colours and the scene's textures.
struct MaterialVariant {
  bool isPrepainted = false;
  uint8_t sets = 0;        // ColorSets
  bool isPainted = false;  // the look paints a texture on it
  uint32_t features = 0;   // MetaTexture::features() of what is laid on it
  uint32_t tangents = 0;   // tangentOptions() of that
  uint32_t options = 0;    // the pass's own
  auto operator<=>(const MaterialVariant&) const = default;
};

class GeometryStep {
 public:
  // What the step that draws them uses, while a pass declares.
  static void use(FrameBuilder& frame) {
    frame.use(frame.get(kVertices), gpu::Use::vertexBuffer);
    frame.use(frame.get(kDrawList), gpu::Use::indirectBuffer);
  }
  void create(FrameBuilder& frame, const GeometryStepDesc& desc);
  // What of the look goes into the pipelines: the pass's own constant, and what each material has. Makes the
  // pipelines that are still missing, also for what the scene has become.
  void specialise(uint32_t constant, std::vector<MaterialVariant> materials = {});
  // The same as it is, for what the scene has become.
  void refresh() {
    if (statesVersion_ != scene_->draws().statesVersion()) makePipelines();
  }
  // Draws opaque, then masked, then blended surfaces: by pipeline and material, of each the nearest first
  // (casters as they lie). `passSets`: set 2, one for all or one for each material; null for none.
  void draw(VkCommandBuffer commands, const gpu::DescriptorSets* passSets, uint32_t firstView) const;

 private:
  // What a pipeline is made for, in the order in which they draw.
  struct Variant {
    uint32_t constant;
    AlphaMode alpha;
    MaterialVariant material;
    bool varied, textured;
    auto operator<=>(const Variant&) const = default;
  };
  Variant variant(const DrawState& state) const {
    return {constant_, state.alpha,
            state.material < materials_.size() ? materials_[state.material] : MaterialVariant(), state.varied,
            state.textured};
  }
  bool includes(const DrawState& state) const;
  const gpu::Pipeline& pipelineFor(const Variant& variant);
  void makePipelines();

  gpu::Device* device_ = nullptr;
  const SceneOnGpu* scene_ = nullptr;
  VkDescriptorSet frameSet_ = VK_NULL_HANDLE;
  GeometryStepDesc desc_;
  std::vector<VkDescriptorSetLayout> setLayouts_;
  uint32_t constant_ = 0;
  std::vector<MaterialVariant> materials_;
  std::map<Variant, gpu::Pipeline> pipelines_;
  // The step's buckets of the scene's draws, in the order in which they are drawn.
  struct Chosen {
    const gpu::Pipeline* pipeline;
    uint32_t bucket;
  };
  std::vector<Chosen> chosen_;
  uint32_t statesVersion_ = 0;  // of the draw list, that they were chosen for
};

}  // namespace scumble::frame
