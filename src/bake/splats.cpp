#include "bake/splats.h"

#include <algorithm>
#include <cmath>

#include "scene/nearest_place.h"
#include "scene/parallel.h"
#include "scene/splat_places.h"

namespace scumble::bake {

namespace {

// As much as a colour varies from stroke to stroke.
float strokeShade(uint32_t chance, float variation) {
  return 1 + variation * (float(chance & 255) / 255 - 0.5f);
}

template <class Work>
void forChunks(size_t count, int threads, const Work& work) {
  constexpr size_t kChunk = 4096;
  scene::parallelFor((count + kChunk - 1) / kChunk, scene::threadCount(threads), [&](size_t chunk) {
    for (size_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, count); ++i) work(i);
  });
}

}  // namespace

std::vector<Splat> splatsOf(const scene::Painting& painting, const BakeOptions& options, float least) {
  std::vector<float> along;
  while (scene::splatCount(painting, least) > scene::kMostSplats) least *= 2;
  const std::vector<scene::SplatPlace> places = scene::splatPlaces(painting, along, least);
  std::vector<uint32_t> strokeOf;
  for (uint32_t s = 0; s < painting.strokes.size(); ++s)
    strokeOf.resize(strokeOf.size() + painting.strokes[s].pointCount, s);
  std::vector<Splat> splats(places.size());
  forChunks(places.size(), options.threads, [&](size_t i) {
    const scene::SplatPlace& place = places[i];
    const scene::Stroke& stroke = painting.strokes[strokeOf[place.point]];
    const uint32_t last = stroke.firstPoint + stroke.pointCount - 1;
    const auto tangentAt = [&](uint32_t p) {
      const glm::vec3 t = painting.points[std::min(p + 1, last)].position -
                          painting.points[p > stroke.firstPoint ? p - 1 : p].position;
      const float length = glm::length(t);
      return length > 1e-15f ? t / length : glm::vec3(1, 0, 0);
    };
    const uint32_t next = place.point + (place.toNext > 0 ? 1 : 0);
    const scene::StrokePoint &a = painting.points[place.point], &b = painting.points[next];
    const uint32_t chance = scene::strokeChance(strokeOf[place.point]);
    Splat& splat = splats[i];
    splat.position = glm::mix(a.position, b.position, place.toNext);
    const glm::vec3 direction = glm::mix(tangentAt(place.point), tangentAt(next), place.toNext);
    splat.along = glm::length(direction) > 1e-6f ? glm::normalize(direction) : tangentAt(place.point);
    splat.facing = glm::normalize(a.orientation * glm::vec3(0, 0, 1));
    splat.radius = glm::mix(a.radius, b.radius, place.toNext);
    const glm::vec4 color = glm::mix(glm::vec4(glm::sqrt(glm::vec3(a.color)), a.color.a),
                                     glm::vec4(glm::sqrt(glm::vec3(b.color)), b.color.a), place.toNext);
    splat.root = glm::min(glm::vec3(color) * strokeShade(chance, options.variation), glm::vec3(1));
    splat.opacity = color.a;
    splat.spacing = place.spacing;
    splat.from = glm::mix(along[place.point], along[next], place.toNext);
    splat.to = along[last] - splat.from;
    splat.chance = float(chance) / 65536;
    splat.brush = int(stroke.brush);
    splat.order =
        options.order * splat.radius * (float(strokeOf[place.point] + 1) / float(painting.strokes.size()));
  });
  return splats;
}

std::vector<Splat> hungSplats(const scene::Painting& painting, const Proxy& proxy, const BakeOptions& options,
                              float reach, size_t& left) {
  static const scene::Primitive kNothing;
  std::vector<const scene::Primitive*> surfaces;  // but for paint
  for (const scene::Primitive* p : proxy.primitives) surfaces.push_back(p->isPaint ? &kNothing : p);
  const scene::NearestPlaces nearest(surfaces);
  std::vector<Splat> splats = splatsOf(painting, options, scene::kSplatSpacing);
  left = splats.size();
  if (nearest.isEmpty()) return {};
  forChunks(splats.size(), options.threads, [&](size_t i) {
    Splat& splat = splats[i];
    const scene::NearestPlaces::Place foot = nearest.to(splat.position);
    splat.triangle = proxy.triangleOf[foot.primitive][foot.triangle];
    if (splat.triangle < 0) return;
    const ProxyTriangle& t = proxy.triangles[size_t(splat.triangle)];
    splat.parts = {1 - foot.at.x - foot.at.y, foot.at.x, foot.at.y};
    const glm::vec3 on = foot.mixed(proxy.primitives[foot.primitive]->positions);
    const glm::vec3 away = splat.position - on;
    // Above the surface is where its own normals say, which at edges is on neither side of a plane.
    glm::vec3 normal(0);
    for (int c = 0; c < 3; ++c) normal += splat.parts[c] * proxy.normals[t.places[c]];
    splat.height = glm::dot(away, normal) < 0 ? -glm::length(away) : glm::length(away);
    splat.order = splat.height + splat.order;
    if (splat.height < -splat.radius || splat.height > reach) splat.triangle = -1;
  });
  const size_t before = splats.size();
  std::erase_if(splats, [](const Splat& s) { return s.triangle < 0; });
  left = before - splats.size();
  std::stable_sort(splats.begin(), splats.end(),
                   [](const Splat& a, const Splat& b) { return a.order < b.order; });
  return splats;
}

}  // namespace scumble::bake
