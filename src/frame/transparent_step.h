// Draws the blended surfaces of all objects and materials at once, in one order, the farthest first
// (kTransparentOrder). Materials are looked up by the shaders (shading/transparent.glsl), so that triangles
// of two objects may follow each other in any order.
//
// Materials on which the look paints otherwise (another texture, or in another way), and more textures than a
// shader may have, make groups, which are drawn one after the other, the one that reaches farthest first: the
// order holds within each.
#pragma once

#include "frame/geometry_step.h"

namespace scumble::frame {

class TransparentStep {
 public:
  // Which blended surfaces: those that are no layers of paint (scene::PaintLayer), premultiplied; such
  // layers, premultiplied and tested against depth of one sample a pixel; or both, with colours as they are.
  enum class What : uint8_t { surfaces, paint, all };
  // Of the description count shaders and their inputs, formats, samples, views, and the layout of set 2, of
  // which nothing is dynamic.
  void create(FrameBuilder& frame, const GeometryStepDesc& desc, What what);
  // The scene's buffers have other names.
  void bind();
  // Before each frame, after the scene has its materials. `constant`, `variants`: as in
  // GeometryStep::specialise. `paintings`: by material, which of the pass's own textures are painted on it;
  // empty: none is.
  void update(uint32_t constant, std::span<const MaterialVariant> variants = {},
              std::span<const uint32_t> paintings = {});
  // `passSets`: set 2, one for all or one for each material, of which a group takes that of its first one;
  // null for none.
  void draw(VkCommandBuffer commands, const gpu::DescriptorSets* passSets, uint32_t firstView) const;

 private:
  struct Group {
    MaterialVariant painted;  // what the look paints on it
    uint32_t painting = 0;    // and which textures
    bool isVaried = false, fades = false;
    uint32_t leader = 0;  // its first material, painted ones first
    std::vector<SetTexture> textures;
    float farthest = 0;  // metres to what is the farthest of it
    const gpu::Pipeline* pipeline = nullptr;
  };
  Group& groupFor(const MaterialVariant& variant, uint32_t painting,
                  const std::array<SetTexture, 4>& textures);
  const gpu::Pipeline& pipelineFor(const Group& group, uint32_t index);

  bool includes(const scene::Material& material) const {
    return what_ == What::all || (what_ == What::paint) == material.paint.has_value();
  }

  FrameBuilder* frame_ = nullptr;
  What what_ = What::all;
  GeometryStepDesc desc_;
  gpu::SetLayout layout_;
  gpu::DescriptorSets sets_;  // by group: there are no more than materials
  UniformSlice rows_;         // shared::TransparentMaterial, by material
  uint32_t constant_ = 0;
  std::vector<Group> groups_;
  std::vector<uint32_t> order_;  // in which they are drawn
  uint32_t texturesVersion_ = 0;
  std::map<std::vector<uint32_t>, gpu::Pipeline> pipelines_;
};

}  // namespace scumble::frame
