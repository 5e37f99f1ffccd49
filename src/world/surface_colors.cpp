#include "world/surface_colors.h"

#include <algorithm>
#include <cmath>

#include "scene/surface_points.h"
#include "scene/texels.h"

namespace scumble::world {

namespace {

// Of an item that is of many colours, about. The same for all, whatever else there is: what stays is not
// looked at again.
constexpr size_t kPoints = 128;

}  // namespace

SurfaceColors::Part SurfaceColors::partOf(const GeometryItem& item, const scene::Material& material,
                                          const std::vector<Shared<scene::TextureImage>>& images) {
  Part part;
  // Paint has the colours of what it lies on.
  if (item.node == GeometryItem::kNoNode || !item.shown || material.paint) return part;
  part.primitive = item.primitive;
  part.linear = glm::mat3(item.model);
  const scene::TextureUse& use = material.baseColorTexture;
  if (use.image >= 0) part.image = images[size_t(use.image)].keep(), part.transform = use.transform;
  return part;
}

void SurfaceColors::sample(Part& part, const scene::Material& material) {
  const scene::Primitive& primitive = *part.primitive;
  const scene::TextureUse& use = material.baseColorTexture;
  const std::vector<glm::vec2>& uvs = scene::coordinatesOf(primitive, use);
  const auto stretched = [&](uint32_t v) { return part.linear * primitive.positions[v]; };
  scene::forEachSurfacePoint(primitive.indices, stretched, kPoints, [&](const scene::SurfacePoint& point) {
    ColorSample sample{glm::length(point.normal), glm::dvec3(1.0)};
    if (!part.image && primitive.colors.empty()) {
      if (part.samples.empty()) part.samples.push_back({0, glm::dvec3(1.0)});
      part.samples[0].area += sample.area;
      return;
    }
    if (!primitive.colors.empty())
      sample.root =
          glm::sqrt(point([&](uint32_t v) { return glm::dvec3(glm::vec3(primitive.colors[v])) / 255.0; }));
    if (part.image) {
      const glm::dvec4 color =
          scene::texelAt(*part.image, use, glm::vec2(point([&](uint32_t v) { return glm::dvec2(uvs[v]); })));
      sample.root *= glm::dvec3(color);
      if (material.alphaMode != scene::AlphaMode::opaque) sample.area *= color.a;
    }
    part.samples.push_back(sample);
  });
}

void SurfaceColors::look(const std::vector<GeometryItem>& items, const MaterialOf& materialOf,
                         const std::vector<Shared<scene::TextureImage>>& images) {
  parts_.resize(items.size());
  for (size_t i = 0; i < items.size(); ++i) {
    const scene::Material& material = materialOf(items[i].material);
    Part part = partOf(items[i], material, images);
    const Part& known = parts_[i];
    if (part.primitive == known.primitive && part.image == known.image && part.linear == known.linear &&
        part.transform == known.transform)
      continue;
    if (part.primitive) sample(part, material);
    parts_[i] = std::move(part);
  }
}

SceneColors SurfaceColors::colors(const std::vector<GeometryItem>& items, const MaterialOf& materialOf) {
  SceneColorSum all;
  for (size_t i = 0; i < items.size(); ++i) {
    Part& part = parts_[i];
    if (part.samples.empty()) continue;
    const glm::dvec3 factor =
        glm::sqrt(glm::clamp(glm::dvec3(materialOf(items[i].material).baseColor), 0.0, 1.0));
    if (part.factor != factor) {
      part.factor = factor;
      part.sum = {};
      for (const ColorSample& sample : part.samples) part.sum.add({sample.area, factor * sample.root});
    }
    all.add(part.sum);
  }
  return all.colors();
}

}  // namespace scumble::world
