#include "world/surface_colors.h"

#include <algorithm>
#include <cmath>

#include "scene/surface_points.h"

namespace scumble::world {

namespace {

// Of an item that is of many colours, about. The same for all, whatever else there is: what stays is not
// looked at again.
constexpr size_t kPoints = 128;

// A texture's coordinate in [0, 1).
double wrapped(double x, scene::Wrap wrap) {
  if (!std::isfinite(x)) return 0;
  switch (wrap) {
    case scene::Wrap::clampToEdge:
      return std::clamp(x, 0.0, 1.0 - 1e-9);
    case scene::Wrap::mirroredRepeat: {
      const double t = x - 2 * std::floor(0.5 * x);
      return std::min(t > 1 ? 2 - t : t, 1.0 - 1e-9);
    }
    default:
      return x - std::floor(x);
  }
}

// The texel at a place: sRGB, which is close to a square root, and alpha.
glm::dvec4 texel(const scene::Image& image, const scene::TextureUse& use, const glm::vec2& uv) {
  const glm::vec3 at = use.transform * glm::vec3(uv, 1.0f);
  const auto index = [](double t, uint32_t size) { return std::min(size_t(t * size), size_t(size) - 1); };
  const size_t x = index(wrapped(at.x, use.sampler.wrapU), image.width),
               y = index(wrapped(at.y, use.sampler.wrapV), image.height);
  const uint8_t* p = &image.rgba[4 * (y * image.width + x)];
  return glm::dvec4(p[0], p[1], p[2], p[3]) / 255.0;
}

}  // namespace

SurfaceColors::Part SurfaceColors::partOf(const GeometryItem& item, const scene::Material& material,
                                          const std::vector<Shared<scene::Image>>& images) {
  Part part;
  if (item.node == GeometryItem::kNoNode || !item.shown) return part;
  part.primitive = item.primitive;
  part.linear = glm::mat3(item.model);
  const scene::TextureUse& use = material.baseColorTexture;
  if (use.image >= 0) part.image = images[size_t(use.image)].keep(), part.transform = use.transform;
  return part;
}

void SurfaceColors::sample(Part& part, const scene::Material& material) {
  const scene::Primitive& primitive = *part.primitive;
  const scene::TextureUse& use = material.baseColorTexture;
  const std::vector<glm::vec2>& uvs =
      use.uvSet == 1 && !primitive.uv1.empty() ? primitive.uv1 : primitive.uv0;
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
          texel(*part.image, use, glm::vec2(point([&](uint32_t v) { return glm::dvec2(uvs[v]); })));
      sample.root *= glm::dvec3(color);
      if (material.alphaMode != scene::AlphaMode::opaque) sample.area *= color.a;
    }
    part.samples.push_back(sample);
  });
}

void SurfaceColors::look(const std::vector<GeometryItem>& items, const MaterialOf& materialOf,
                         const std::vector<Shared<scene::Image>>& images) {
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

SceneColors SurfaceColors::colors(const std::vector<GeometryItem>& items,
                                  const MaterialOf& materialOf) const {
  SceneColorSum sum;
  for (size_t i = 0; i < items.size(); ++i) {
    if (parts_[i].samples.empty()) continue;
    const glm::dvec3 base =
        glm::sqrt(glm::clamp(glm::dvec3(materialOf(items[i].material).baseColor), 0.0, 1.0));
    for (const ColorSample& sample : parts_[i].samples) sum.add({sample.area, base * sample.root});
  }
  return sum.colors();
}

}  // namespace scumble::world
