#include "world/indirect_light.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "scene/parallel.h"
#include "scene/texels.h"

namespace scumble::world {

namespace {

// Rays from a vertex, at most; fewer where all would be more than so many.
constexpr size_t kRays = 64, kLeastRays = 16, kAllRays = size_t(1) << 25;
constexpr size_t kVerticesAtOnce = 1024;

bool takesPart(const GeometryItem& item) {
  return item.node != GeometryItem::kNoNode && item.shown && item.feature < 0 &&
         !item.primitive->indices.empty() && !item.primitive->isPaint;
}

// Directions of the upper half sphere around Z, as dense as the cosine (Roberts' R2 sequence on a disc).
std::vector<glm::vec3> cosineDirections(size_t count) {
  std::vector<glm::vec3> directions;
  for (size_t i = 0; i < count; ++i) {
    const glm::dvec2 at = glm::fract(0.5 + double(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532));
    const double radius = std::sqrt(at.x), angle = 6.283185307179586 * at.y;
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - at.x));
  }
  return directions;
}

// Axes square to a unit vector (Duff et al. 2017).
glm::mat3 axesAround(const glm::vec3& n) {
  const float sign = std::copysign(1.0f, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

// Items that see each other, as triangles in the world.
class Surroundings {
 public:
  explicit Surroundings(std::vector<const GeometryItem*> items) : items_(std::move(items)) {
    device_ = rtcNewDevice("threads=1");
    if (!device_) throw std::bad_alloc();
    scene_ = rtcNewScene(device_);
    for (const GeometryItem* item : items_) add(*item);
    rtcCommitScene(scene_);
  }
  ~Surroundings() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;

  struct Seen {
    const GeometryItem* item;
    uint32_t triangle;
    glm::vec2 at;  // shares of its second and third corners
    float distance;
  };
  // What a ray meets; no item where that is nothing.
  Seen seen(const glm::vec3& from, const glm::vec3& way, float nearest, float farthest) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit hit{};
    hit.ray = {from.x, from.y, from.z, nearest, way.x, way.y, way.z, 0, farthest, ~0u, 0, 0};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {nullptr, 0, {}, 0};
    return {items_[hit.hit.geomID], hit.hit.primID, {hit.hit.u, hit.hit.v}, hit.ray.tfar};
  }

  static glm::mat4 placeOf(const GeometryItem& item) { return item.skin >= 0 ? glm::mat4(1.0f) : item.model; }

 private:
  void add(const GeometryItem& item) {
    const scene::Primitive& primitive = *item.primitive;
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                primitive.positions.size()));
    auto* const indices =
        static_cast<uint32_t*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                       3 * sizeof(uint32_t), primitive.indices.size() / 3));
    if (!vertices || !indices) throw std::bad_alloc();
    const glm::mat4 place = placeOf(item);
    for (size_t v = 0; v < primitive.positions.size(); ++v)
      vertices[v] = glm::vec3(place * glm::vec4(primitive.positions[v], 1));
    std::copy(primitive.indices.begin(), primitive.indices.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  std::vector<const GeometryItem*> items_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

class Baking {
 public:
  Baking(const std::function<const scene::Material&(size_t)>& materialOf,
         const std::vector<Shared<scene::TextureImage>>& images, float reach, size_t rays)
      : materialOf_(materialOf), images_(images), reach_(reach), directions_(cosineDirections(rays)) {}

  void bake(const Surroundings& around, const GeometryItem& item, std::vector<glm::u8vec4>& to) const {
    const scene::Primitive& primitive = *item.primitive;
    const size_t count = primitive.positions.size();
    to.resize(count);
    const glm::mat4 place = Surroundings::placeOf(item);
    const glm::mat3 ofNormals = glm::transpose(glm::inverse(glm::mat3(place)));
    scene::parallelFor((count + kVerticesAtOnce - 1) / kVerticesAtOnce, scene::threadCount(0),
                       [&](size_t part) {
                         const size_t end = std::min(count, (part + 1) * kVerticesAtOnce);
                         for (size_t v = part * kVerticesAtOnce; v < end; ++v)
                           to[v] = at(around, glm::vec3(place * glm::vec4(primitive.positions[v], 1)),
                                      ofNormals * primitive.normals[v]);
                       });
  }

 private:
  glm::u8vec4 at(const Surroundings& around, const glm::vec3& point, const glm::vec3& normal) const {
    const float length = glm::length(normal);
    if (!(length > 0)) return {};
    const glm::mat3 axes = axesAround(normal / length);
    // A little way off, since it lies on triangles itself.
    const float off = 1e-3f * reach_;
    glm::dvec3 color(0.0);
    double share = 0;
    for (const glm::vec3& direction : directions_) {
      const Surroundings::Seen seen = around.seen(point + off * axes[2], axes * direction, 0, reach_);
      if (!seen.item) continue;
      const double near = 1 - double(seen.distance) / reach_;
      color += near * colorOf(seen);
      share += near;
    }
    const glm::dvec3 root = share > 0 ? glm::sqrt(color / share) : glm::dvec3(0.0);
    return glm::u8vec4(255.0 * glm::clamp(glm::dvec4(root, share / double(directions_.size())), 0.0, 1.0) +
                       0.5);
  }

  // Linear.
  glm::dvec3 colorOf(const Surroundings::Seen& seen) const {
    const scene::Primitive& primitive = *seen.item->primitive;
    const scene::Material& material = materialOf_(seen.item->material);
    const auto between = [&](const auto& of) {
      const auto corner = [&](size_t k) { return of(primitive.indices[3 * size_t(seen.triangle) + k]); };
      const double u = double(seen.at.x), v = double(seen.at.y);
      return (1 - u - v) * corner(0) + u * corner(1) + v * corner(2);
    };
    glm::dvec3 color(material.baseColor);
    if (!primitive.colors.empty())
      color *= between([&](uint32_t v) { return glm::dvec3(primitive.colors[v]) / 255.0; });
    const scene::TextureUse& use = material.baseColorTexture;
    if (use.image >= 0) {
      const std::vector<glm::vec2>& uvs = scene::coordinatesOf(primitive, use);
      const glm::vec2 uv(between([&](uint32_t v) { return glm::dvec2(uvs[v]); }));
      const glm::dvec3 root(scene::texelAt(*images_[size_t(use.image)], use, uv));
      color *= root * root;
    }
    return glm::clamp(color, 0.0, 1.0);
  }

  const std::function<const scene::Material&(size_t)>& materialOf_;
  const std::vector<Shared<scene::TextureImage>>& images_;
  float reach_;
  std::vector<glm::vec3> directions_;
};

}  // namespace

std::vector<std::vector<glm::u8vec4>> indirectLight(
    const std::vector<GeometryItem>& items, const std::function<const scene::Material&(size_t)>& materialOf,
    const std::vector<Shared<scene::TextureImage>>& images, float reach) {
  std::vector<std::vector<glm::u8vec4>> all(items.size());
  if (!(reach > 0)) return all;
  std::vector<const GeometryItem*> standing;
  size_t vertices = 1;
  for (const GeometryItem& item : items) {
    if (!takesPart(item)) continue;
    vertices += item.primitive->positions.size();
    if (item.skin < 0) standing.push_back(&item);
  }
  const Baking baking(materialOf, images, reach, std::clamp(kAllRays / vertices, kLeastRays, kRays));
  const Surroundings world(standing);
  for (size_t i = 0; i < items.size(); ++i) {
    if (!takesPart(items[i])) continue;
    if (items[i].skin < 0)
      baking.bake(world, items[i], all[i]);
    else
      baking.bake(Surroundings({&items[i]}), items[i], all[i]);
  }
  return all;
}

}  // namespace scumble::world
