#include "scene/edited_parts.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/import_failure.h"
#include "scene/parallel.h"
#include "scene/prepare_mesh.h"

namespace scumble::scene {

namespace {

// Ends in a failure where something is wrong; `what` names it.
class Check {
 public:
  explicit Check(std::string what) : what_(std::move(what)) {}
  void require(bool isRight, const std::string& problem, const std::string& advice) const {
    if (!isRight) fail(what_, problem, advice);
  }
  template <class Vector>
  void finite(std::span<const Vector> values, const std::string& name) const {
    for (size_t i = 0; i < values.size(); ++i)
      for (int c = 0; c < Vector::length(); ++c)
        require(std::isfinite(values[i][c]), name + "[" + std::to_string(i) + "] is not finite",
                "give finite numbers");
  }
  template <class T>
  void perVertex(std::span<const T> values, size_t count, const std::string& name) const {
    require(values.empty() || values.size() == count,
            "there are " + std::to_string(values.size()) + " " + name + " for " + std::to_string(count) +
                " vertices",
            "give one a vertex, or none");
  }

 private:
  std::string what_;
};

TextureUse useOf(const TextureSlot& slot, const SceneData& scene, const Check& check) {
  TextureUse use;
  if (slot.texture == TextureId::none) return use;
  check.require(isIndex(slot.texture, scene.images.size()),
                "there is no texture " + std::to_string(int(slot.texture)), "add it first");
  check.require(slot.uvSet == 0 || slot.uvSet == 1, "uvSet is neither 0 nor 1", "use 0 or 1");
  for (int i = 0; i < 9; ++i)
    check.require(std::isfinite(slot.transform[i / 3][i % 3]), "a texture's transform is not finite",
                  "give finite numbers");
  use.image = int(slot.texture);
  use.sampler = {Wrap(slot.wrapU), Wrap(slot.wrapV), slot.nearest, slot.mipmaps};
  use.uvSet = slot.uvSet;
  use.transform = slot.transform;
  return use;
}

TextureSlot slotOf(const TextureUse& use) {
  return {TextureId(use.image),
          TextureSlot::Wrap(use.sampler.wrapU),
          TextureSlot::Wrap(use.sampler.wrapV),
          use.sampler.nearest,
          use.sampler.mipmaps,
          use.uvSet,
          use.transform};
}

Primitive primitiveOf(const MeshPart& part, const SceneData& scene, const Check& check,
                      ImportWarnings& warnings) {
  const size_t count = part.positions.size();
  check.require(count > 0, "it has no positions", "give some");
  check.require(count <= ~uint32_t(0), "it has too many vertices", "split it");
  check.finite(part.positions, "positions");
  for (size_t i = 0; i < count; ++i)
    check.require(isDrawable(part.positions[i]), "positions[" + std::to_string(i) + "] is out of range",
                  "use metres within +-1e15");
  check.perVertex(part.normals, count, "normals"), check.finite(part.normals, "normals");
  check.perVertex(part.uv0, count, "uv0"), check.finite(part.uv0, "uv0");
  check.perVertex(part.uv1, count, "uv1"), check.finite(part.uv1, "uv1");
  check.perVertex(part.colors, count, "colors");
  check.perVertex(part.warpScales, count, "warpScales");
  for (const float scale : part.warpScales)
    check.require(scale >= 0 && scale <= 64, "a warp scale is out of range", "use 0 to 64");
  check.perVertex(part.roundness, count, "roundness");
  for (const float roundness : part.roundness)
    check.require(roundness >= 0 && roundness <= 1, "a roundness is out of range", "use 0 to 1");
  check.require(isIndex(part.material, scene.materials.size()),
                "there is no material " + std::to_string(int(part.material)), "add it first");
  const size_t corners = part.indices.empty() ? count : part.indices.size();
  check.require(corners % 3 == 0, std::to_string(corners) + " corners make no triangles",
                "give three a triangle");
  for (size_t i = 0; i < part.indices.size(); ++i)
    check.require(part.indices[i] < count, "indices[" + std::to_string(i) + "] is no vertex",
                  "use 0 to " + std::to_string(count - 1));

  Primitive primitive;
  const auto copy = [](auto& to, const auto& from) { to.assign(from.begin(), from.end()); };
  copy(primitive.positions, part.positions);
  copy(primitive.normals, part.normals);
  copy(primitive.uv0, part.uv0);
  copy(primitive.uv1, part.uv1);
  copy(primitive.colors, part.colors);
  copy(primitive.warpScales, part.warpScales);
  copy(primitive.roundness, part.roundness);
  copy(primitive.indices, part.indices);
  for (uint32_t i = 0; part.indices.empty() && i < count; ++i) primitive.indices.push_back(i);
  primitive.material = int(part.material);
  cleanPrimitive(primitive, "", warnings);
  return primitive;
}

}  // namespace

bool isAffine(const glm::dmat4& m) {
  return isDrawable(m) && m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
}

TextureImage imageOf(const TextureDesc& texture) {
  const Check check("texture");
  check.require(texture.width >= 1 && texture.height >= 1 && texture.width <= kMaxImageSide &&
                    texture.height <= kMaxImageSide,
                "a size of " + std::to_string(texture.width) + "x" + std::to_string(texture.height) +
                    " is out of range",
                "use 1 to 16384 a side");
  check.require(texture.rgba.size() == size_t(4) * texture.width * texture.height,
                "there are " + std::to_string(texture.rgba.size()) + " bytes for " +
                    std::to_string(texture.width) + "x" + std::to_string(texture.height) + " pixels",
                "give four a pixel");
  TextureImage image;
  image.name = texture.name;
  image.width = texture.width, image.height = texture.height;
  image.rgba.assign(texture.rgba.begin(), texture.rgba.end());
  return image;
}

Material materialOf(const MaterialDesc& given, const SceneData& scene) {
  const Check check("material");
  const auto inUnit = [](float x) { return x >= 0 && x <= 1; };
  for (int c = 0; c < 4; ++c)
    check.require(inUnit(given.baseColor[c]), "its base colour is out of range", "use 0 to 1");
  for (int c = 0; c < 3; ++c)
    check.require(given.emissive[c] >= 0 && std::isfinite(given.emissive[c]), "what it emits is out of range",
                  "use numbers from 0 on");
  check.require(std::isfinite(given.alphaCutoff) && given.alphaCutoff >= 0,
                "its alpha cutoff is out of range", "use 0 to 1");
  if (given.shadowedColor)
    for (int c = 0; c < 3; ++c)
      check.require(inUnit((*given.shadowedColor)[c]), "its colour in shadow is out of range", "use 0 to 1");
  if (given.outline) {
    check.require(given.outline->width >= 0 && given.outline->width <= 1000,
                  "the width of its outline is out of range", "use 0 to 1000");
    for (int c = 0; c < 3; ++c)
      check.require(inUnit(given.outline->color[c]), "its outline's colour is out of range", "use 0 to 1");
    check.require(inUnit(given.outline->lightingMix), "its outline's lightingMix is out of range",
                  "use 0 to 1");
  }
  Material material;
  material.name = given.name;
  material.baseColor = given.baseColor;
  material.baseColorTexture = useOf(given.baseColorTexture, scene, check);
  material.emissive = given.emissive;
  material.emissiveTexture = useOf(given.emissiveTexture, scene, check);
  material.alphaMode = AlphaMode(given.alpha);
  material.alphaCutoff = given.alphaCutoff;
  material.doubleSided = given.doubleSided;
  material.unlit = given.unlit;
  material.shadowedColor = given.shadowedColor;
  material.litTexture = useOf(given.litTexture, scene, check);
  material.shadowedTexture = useOf(given.shadowedTexture, scene, check);
  if (given.outline)
    material.outline = Outline{Outline::Unit(given.outline->unit), given.outline->width, given.outline->color,
                               given.outline->lightingMix};
  return material;
}

MaterialDesc descOf(const Material& material) {
  MaterialDesc desc;
  desc.name = material.name;
  desc.baseColor = material.baseColor;
  desc.baseColorTexture = slotOf(material.baseColorTexture);
  desc.emissive = material.emissive;
  desc.emissiveTexture = slotOf(material.emissiveTexture);
  desc.alpha = MaterialDesc::Alpha(material.alphaMode);
  desc.alphaCutoff = material.alphaCutoff;
  desc.doubleSided = material.doubleSided;
  desc.unlit = material.unlit;
  desc.shadowedColor = material.shadowedColor;
  desc.litTexture = slotOf(material.litTexture);
  desc.shadowedTexture = slotOf(material.shadowedTexture);
  if (material.outline)
    desc.outline = OutlineDesc{OutlineDesc::Unit(material.outline->unit), material.outline->width,
                               material.outline->color, material.outline->lightingMix};
  return desc;
}

Mesh meshOf(const std::vector<MeshPart>& parts, const SceneData& scene, const Mesh* before) {
  if (parts.empty()) fail("mesh", "it has no parts", "give one at least");
  Mesh mesh;
  if (before) mesh.painting = before->painting;  // its strokes stay
  ImportWarnings warnings;
  for (size_t i = 0; i < parts.size(); ++i) {
    const Check check("part " + std::to_string(i) + " of the mesh");
    mesh.primitives.push_back(primitiveOf(parts[i], scene, check, warnings));
  }
  // What has no area takes up no space.
  std::erase_if(mesh.primitives, [](const Primitive& p) { return p.indices.empty(); });
  weldSmoothNormals(mesh);
  const float radius = boundingRadius(mesh);
  parallelFor(mesh.primitives.size(), mesh.primitives.size() > 1 ? threadCount(0) : 1, [&](size_t p) {
    const bool hasBefore = before && p < before->primitives.size();
    finishPrimitive(mesh.primitives[p], radius, PatternCoordinates::automatic,
                    hasBefore ? &before->primitives[p] : nullptr);
  });
  return mesh;
}

Light lightOf(const LightDesc& given) {
  const Check check("light");
  for (const float number : {given.color.r, given.color.g, given.color.b, given.intensity, given.range})
    check.require(number >= 0 && std::isfinite(number), "its colour, intensity or range is out of range",
                  "use numbers from 0 on");
  check.require(given.innerCone >= 0 && given.innerCone < given.outerCone &&
                    given.outerCone <= glm::half_pi<float>() + 1e-6f,
                "its cones are out of range", "use 0 <= inner < outer <= pi / 2");
  Light light;
  light.kind = LightKind(given.kind);
  light.color = given.color;
  light.intensity = given.intensity;
  light.range = given.range;
  light.innerCone = given.innerCone, light.outerCone = given.outerCone;
  return light;
}

}  // namespace scumble::scene
