#include "scene/nearest_place.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace scumble::scene {

namespace {

// The place on a triangle that is nearest to a point, as parts of the second and the third corner (after
// Ericson 2005, section 5.1.5).
glm::vec2 nearestOn(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 ab = b - a, ac = c - a, ap = p - a;
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {0, 0};
  const glm::vec3 bp = p - b;
  const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {1, 0};
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {d1 / (d1 - d3), 0};
  const glm::vec3 cp = p - c;
  const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 1};
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {0, d2 / (d2 - d6)};
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const float w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {1 - w, w};
  }
  const float sum = va + vb + vc;
  return sum > 0 ? glm::vec2(vb, vc) / sum : glm::vec2(0);
}

}  // namespace

struct NearestPlaces::Tree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  explicit Tree(const NearestPlaces& places) {
    device = rtcNewDevice("threads=1");
    if (!device) throw std::bad_alloc();
    scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(places.triangles_.size()));
    rtcSetGeometryUserData(geometry, const_cast<NearestPlaces*>(&places));
    rtcSetGeometryBoundsFunction(geometry, boundsOf, nullptr);
    rtcSetGeometryPointQueryFunction(geometry, askAbout);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  ~Tree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  struct Nearest {
    const NearestPlaces* places;
    glm::vec3 point;
    float distance2;
    size_t triangle;
    glm::vec2 at;
  };

  static void boundsOf(const RTCBoundsFunctionArguments* arguments) {
    const auto& places = *static_cast<const NearestPlaces*>(arguments->geometryUserPtr);
    const Triangle& t = places.triangles_[arguments->primID];
    Bounds box;
    for (int i = 0; i < 3; ++i) box.add(places.corner(t, i));
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = box.min.x, out.lower_y = box.min.y, out.lower_z = box.min.z;
    out.upper_x = box.max.x, out.upper_y = box.max.y, out.upper_z = box.max.z;
  }

  // Of equally near ones the first counts, so that the tree's order decides nothing.
  static bool askAbout(RTCPointQueryFunctionArguments* arguments) {
    auto& nearest = *static_cast<Nearest*>(arguments->userPtr);
    const NearestPlaces& places = *nearest.places;
    const size_t index = arguments->primID;
    const Triangle& t = places.triangles_[index];
    const glm::vec3 &a = places.corner(t, 0), &b = places.corner(t, 1), &c = places.corner(t, 2);
    const glm::vec2 at = nearestOn(nearest.point, a, b, c);
    const glm::vec3 away = a + at.x * (b - a) + at.y * (c - a) - nearest.point;
    const float distance2 = glm::dot(away, away);
    if (distance2 > nearest.distance2 || (distance2 == nearest.distance2 && index >= nearest.triangle))
      return false;
    nearest.distance2 = distance2, nearest.triangle = index, nearest.at = at;
    // A little more than that, for those that are as near.
    arguments->query->radius = std::nextafter(std::sqrt(distance2) * 1.0001f, INFINITY);
    return true;
  }
};

NearestPlaces::NearestPlaces(std::span<const Primitive* const> primitives)
    : primitives_(primitives.begin(), primitives.end()) {
  // Slivers, whose areas are roundings, only where there is nothing else.
  constexpr float kSliver = 1e-4f;
  for (const float least : {kSliver, 0.0f}) {
    for (uint32_t p = 0; p < primitives_.size(); ++p) {
      const Primitive& primitive = *primitives_[p];
      if (primitive.positions.empty()) continue;
      for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const Triangle t{
            p, uint32_t(i / 3), {primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]}};
        const glm::vec3 ab = corner(t, 1) - corner(t, 0), ac = corner(t, 2) - corner(t, 0), bc = ac - ab;
        const float longest2 = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
        if (glm::length(glm::cross(ab, ac)) > least * longest2) triangles_.push_back(t);
      }
    }
    if (!triangles_.empty()) break;
  }
  if (!triangles_.empty()) tree_ = std::make_unique<Tree>(*this);
}

NearestPlaces::~NearestPlaces() = default;

NearestPlaces::Place NearestPlaces::to(const glm::vec3& point) const {
  Tree::Nearest nearest{this, point, INFINITY, 0, glm::vec2(0)};
  RTCPointQuery query{point.x, point.y, point.z, 0, INFINITY};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(tree_->scene, &query, &context, nullptr, &nearest);
  const Triangle& triangle = triangles_[nearest.triangle];
  return {triangle.primitive, triangle.number, triangle.vertices, nearest.at};
}

}  // namespace scumble::scene
