#include "features/ocean/hulls/hulls.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <optional>
#include <span>

#include "features/ocean/extras.h"
#include "scene/parallel.h"
#include "scene/posed_bounds.h"
#include "scene/surroundings.h"

namespace scumble::ocean {

using namespace world;

namespace {

// What the scene says, and over that what the look does.
int roleOf(const scene::Node& node, const look::LookData& look, bool maySet) {
  if (!maySet && node.extras.empty()) return kHullAuto;
  FloatParams params;
  if (const std::optional<int> says = hullOf(node)) params.hull = *says;
  look.fillFor(FloatParams::block(), look::kNodes, node.name, &params);
  return params.hull;
}

// The joint that moves most of a mesh.
int mainJoint(const scene::Primitive& primitive) {
  std::map<uint16_t, float> weights;
  for (size_t i = 0; i < primitive.joints.size(); ++i) weights[primitive.joints[i]] += primitive.weights[i];
  const auto most = std::max_element(weights.begin(), weights.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == weights.end() ? -1 : int(most->first);
}

// From the world to around a mesh's origin, with that of its axes upright that is the most so: as it was
// built, however it heels where it is placed.
glm::mat4 uprightOf(const glm::mat4& rest) {
  glm::vec3 up(0, 1, 0);
  float most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const glm::vec3 along = glm::normalize(glm::vec3(rest[axis]));
    if (std::abs(along.y) > most) most = std::abs(along.y), up = along.y > 0 ? along : -along;
  }
  glm::mat4 turn(1.0f);
  const glm::vec3 axis(-up.z, 0, up.x);
  if (glm::length(axis) > 1e-6f) turn = glm::rotate(turn, std::acos(std::min(up.y, 1.0f)), axis);
  return turn * glm::translate(glm::mat4(1.0f), -glm::vec3(rest[3]));
}

// None where no wave is as high as its rim. `most`: how far it may take water down, metres.
std::optional<shared::WaterBasin> basinAround(std::span<const glm::vec3> rim, float most,
                                              const Hulls::Waves& waves) {
  if (rim.empty() || !(most > 0)) return std::nullopt;
  shared::WaterBasin basin{};
  basin.count = int(std::min(rim.size(), size_t(shared::kBasinPoints)));
  basin.most = most;
  const auto flat = [](const glm::vec3& at) { return glm::vec2(at.x, at.z); };
  float lowest = rim[0].y, apart = 0;
  glm::vec2 least(flat(rim[0])), greatest(least);
  for (const glm::vec3& point : rim) {
    float nearest = std::numeric_limits<float>::infinity();
    for (int i = 0; i < basin.count; ++i)
      nearest = std::min(nearest, glm::distance(flat(point), flat(rim[size_t(i)])));
    apart = std::max(apart, nearest);
    lowest = std::min(lowest, point.y);
    least = glm::min(least, flat(point)), greatest = glm::max(greatest, flat(point));
  }
  if (!(waves.highest > lowest)) return std::nullopt;
  for (int i = 0; i < basin.count; ++i) {
    basin.rim[i] = rim[size_t(i)];
    basin.rim[i].y = std::max(basin.rim[i].y, waves.lowest);
  }
  basin.margin = waves.triangle + apart;
  basin.center = 0.5f * (least + greatest);
  basin.reach = 0.5f * glm::distance(least, greatest) + basin.margin +
                (waves.highest - std::max(lowest, waves.lowest)) / shared::kBasinSlope;
  return basin;
}

bool canInvert(const glm::mat4& matrix) {
  const float volume = std::abs(glm::determinant(glm::mat3(matrix)));
  return std::isfinite(volume) && volume > 1e-12f;
}

}  // namespace

HullNodes hullNodes(const scene::SceneData& scene, const look::LookData& look,
                    std::span<const FloatingNode> floating, int ocean) {
  const size_t count = scene.nodes.size();
  HullNodes nodes{std::vector<int>(count, HullNodes::kNone), std::vector<bool>(count, false),
                  std::vector<bool>(count, false)};
  const bool maySet = look.setsAny(FloatParams::block(), "hull", look::kNodes);
  std::vector<bool> rides(count, false), isOff(count, false), hasInside(count, false);
  for (const FloatingNode& one : floating) rides[one.node] = true;
  for (size_t n = 0; n < count; ++n) {
    const scene::Node& node = scene.nodes[n];
    const int role = roleOf(node, look, maySet);
    const size_t parent = node.parent >= 0 ? size_t(node.parent) : n;
    isOff[n] = int(n) == ocean || role == kHullOff || (parent != n && isOff[parent] && role == kHullAuto);
    if (isOff[n]) continue;
    nodes.root[n] = int(n);
    nodes.isInside[n] = role == kHullInside;
    if (parent != n && nodes.isWhole[parent] && !nodes.isInside[n]) nodes.root[n] = nodes.root[parent];
    nodes.isWhole[n] =
        !nodes.isInside[n] && (role == kHullWhole || rides[n] || (parent != n && nodes.isWhole[parent]));
    for (int above = node.parent; nodes.isInside[n] && above >= 0; above = scene.nodes[size_t(above)].parent)
      if (nodes.root[size_t(above)] >= 0) hasInside[size_t(nodes.root[size_t(above)])] = true;
  }
  for (size_t n = 0; n < count; ++n)
    if (nodes.root[n] >= 0 && !nodes.isInside[n] && hasInside[size_t(nodes.root[n])])
      nodes.root[n] = HullNodes::kNone;
  return nodes;
}

std::vector<Triangle> Hulls::trianglesOf(const Part& part) {
  const scene::Primitive& primitive = *part.primitive;
  std::vector<glm::vec3> places;
  places.reserve(primitive.positions.size());
  const size_t influences = size_t(primitive.influences);
  for (size_t v = 0; v < primitive.positions.size(); ++v) {
    const glm::vec4 at(primitive.positions[v], 1.0f);
    glm::vec3 place(0.0f);
    if (part.matrices.size() == 1)
      place = part.matrices[0] * at;
    else
      for (size_t i = v * influences; i < (v + 1) * influences; ++i)
        if (primitive.joints[i] < part.matrices.size())
          place += primitive.weights[i] * glm::vec3(part.matrices[primitive.joints[i]] * at);
    places.push_back(place);
  }
  std::vector<Triangle> triangles;
  for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
    triangles.push_back(
        {places[primitive.indices[i]], places[primitive.indices[i + 1]], places[primitive.indices[i + 2]]});
  return triangles;
}

void Hulls::findFields(const std::vector<std::vector<Part>>& wanted) {
  std::vector<Known> fields;
  std::vector<size_t> missing;
  for (const std::vector<Part>& parts : wanted) {
    const auto isSame = [&](const Known& known) { return known.parts == parts; };
    if (std::any_of(fields.begin(), fields.end(), isSame)) continue;
    const auto known = std::find_if(known_.begin(), known_.end(), isSame);
    if (known == known_.end()) missing.push_back(fields.size());
    fields.push_back(known == known_.end() ? Known{parts, nullptr} : *known);
  }
  scene::parallelFor(missing.size(), scene::threadCount(0), [&](size_t i) {
    Known& one = fields[missing[i]];
    std::vector<Triangle> triangles;
    for (const Part& part : one.parts)
      for (const Triangle& triangle : trianglesOf(part)) triangles.push_back(triangle);
    std::optional<HullField> found = one.parts[0].isInside ? fillHull(triangles) : findHull(triangles);
    if (found) one.field = std::make_shared<const HullField>(std::move(*found));
  });
  known_ = std::move(fields);
}

void Hulls::find(const scene::SceneData& scene, const HullNodes& nodes, const Sea& sea,
                 const std::vector<GeometryItem>& items) {
  hulls_.clear();
  // What belongs together: of a hull with all that hangs on it all, else each instance by itself.
  std::map<std::pair<int, size_t>, std::vector<size_t>> groups;
  for (size_t i = 0; i < items.size(); ++i) {
    const GeometryItem& item = items[i];
    if (item.node == GeometryItem::kNoNode || nodes.root[item.node] < 0 || item.primitive->isPaint) continue;
    if (!item.shown && !nodes.isInside[item.node]) continue;
    if (item.isWrittenByFeature) continue;  // lies on the water
    const int root = nodes.root[item.node];
    groups[{root, nodes.isWhole[size_t(root)] ? 0 : item.instanceOfNode}].push_back(i);
  }
  const std::vector<bool> around = scene::surroundings(scene);
  const std::vector<glm::dmat4> world = scene::worldMatrices(scene);
  std::vector<Hull> hulls;
  std::vector<std::vector<Part>> wanted;
  for (const auto& [key, group] : groups) {
    const auto sizeOf = [&](size_t item) {
      const glm::vec3 size = items[item].reach.max - items[item].reach.min;
      return size.x * size.y * size.z;
    };
    const size_t main = *std::max_element(group.begin(), group.end(),
                                          [&](size_t a, size_t b) { return sizeOf(a) < sizeOf(b); });
    scene::Bounds reach;
    for (const size_t i : group) reach.add(items[i].reach);
    const glm::vec3 extent = reach.max - reach.min;
    const bool isSaid = nodes.isWhole[size_t(key.first)] || nodes.isInside[size_t(key.first)];
    if (!isSaid) {
      if (reach.empty || reach.min.y > sea.level + sea.reach || reach.max.y < sea.level - sea.reach) continue;
      if (std::max(extent.x, extent.z) > sea.longest || (!around.empty() && around[size_t(key.first)]))
        continue;
    }
    Hull hull;
    hull.item = main;
    std::map<int, std::vector<glm::mat4>> jointsOf;
    const auto matricesOf = [&](const GeometryItem& item) {
      if (item.skin < 0) return std::vector<glm::mat4>{item.model};
      std::vector<glm::mat4>& joints = jointsOf[item.skin];
      if (joints.empty()) joints = scene::jointMatrices(scene.skins[size_t(item.skin)], world);
      return joints;
    };
    hull.joint = items[main].skin >= 0 ? mainJoint(*items[main].primitive) : -1;
    hull.rest = matricesOf(items[main])[size_t(std::max(hull.joint, 0))];
    if (!canInvert(hull.rest)) continue;
    const glm::mat4 upright = uprightOf(hull.rest);
    std::vector<Part>& parts = wanted.emplace_back();
    for (const size_t i : group) {
      Part& part =
          parts.emplace_back(Part{items[i].primitive, matricesOf(items[i]), nodes.isInside[items[i].node]});
      for (glm::mat4& matrix : part.matrices) matrix = upright * matrix;
    }
    hull.rest = upright * hull.rest;
    hulls.push_back(hull);
  }
  findFields(wanted);
  for (size_t i = 0; i < hulls.size(); ++i) {
    const auto known =
        std::find_if(known_.begin(), known_.end(), [&](const Known& one) { return one.parts == wanted[i]; });
    hulls[i].field = known->field;
    if (known->field) hulls_.push_back(hulls[i]);
  }
  // The largest ones, where there are too many.
  const auto sizeOf = [](const Hull& hull) {
    return float(hull.field->within.size()) / std::abs(glm::determinant(glm::mat3(hull.field->toPoints)));
  };
  std::stable_sort(hulls_.begin(), hulls_.end(),
                   [&](const Hull& a, const Hull& b) { return sizeOf(a) > sizeOf(b); });
  if (hulls_.size() > size_t(shared::kMaxCutouts)) hulls_.resize(size_t(shared::kMaxCutouts));
}

bool Hulls::place(gpu::Uploader& uploader, const std::function<void()>& settle) {
  std::vector<std::shared_ptr<const HullField>> fields;
  for (Hull& hull : hulls_) {
    int first = 0;
    const auto same = std::find(fields.begin(), fields.end(), hull.field);
    for (auto before = fields.begin(); before != same; ++before) first += int((*before)->within.size());
    hull.first = first;
    if (same == fields.end()) fields.push_back(hull.field);
  }
  if (fields == placed_) return false;
  std::vector<uint32_t> words;
  for (const auto& field : fields) {
    const auto byteAt = [&](const glm::ivec3& at) {
      return uint32_t(uint8_t(field->at(glm::min(at, field->size - 1))));
    };
    for (int y = 0; y < field->size.y; ++y)
      for (int z = 0; z < field->size.z; ++z)
        for (int x = 0; x < field->size.x; ++x)
          words.push_back(byteAt({x, y, z}) | byteAt({x + 1, y, z}) << 8 | byteAt({x, y, z + 1}) << 16 |
                          byteAt({x + 1, y, z + 1}) << 24);
  }
  settle();
  placed_ = std::move(fields);
  points_ = {};  // what was there goes first
  if (!words.empty()) points_ = uploader.storage<uint32_t>(words);
  return true;
}

void Hulls::pose(const SceneMotion& motion, const Waves& waves, shared::Cutouts& cutouts,
                 std::vector<shared::WaterBasin>& basins) const {
  cutouts.count = 0;
  basins.clear();
  for (const Hull& hull : hulls_) {
    const glm::mat4 now = hull.joint >= 0 ? motion.joints(hull.item)[hull.joint] : motion.model(hull.item);
    if (!canInvert(now)) continue;
    const HullField& field = *hull.field;
    const glm::dmat4 toRest = glm::dmat4(hull.rest) * glm::inverse(glm::dmat4(now));
    const glm::dmat4 toPoints = glm::dmat4(field.toPoints) * toRest, toWorld = glm::inverse(toPoints);

    // How far its rim stands out of the sea at most. Below it is sunk, and the sea closes over it.
    float standsOut = field.rim.empty() ? 1.0f : -1e30f;
    std::vector<glm::vec3> rim;
    for (const glm::vec3& point : field.rim) {
      const glm::vec3 at = toWorld * glm::dvec4(point, 1.0);
      standsOut = std::max(standsOut, at.y - waves.heightAt(at));
      rim.push_back(at - waves.origin);
    }
    if (!(standsOut > 0)) continue;
    // Waves that are higher than the rim elsewhere are taken down to it, and end above it where that is not
    // enough: not where it lies on its side.
    constexpr float kWall = 8;
    const glm::vec3 up = toWorld[1];
    const float cell = glm::length(up);
    const float upright = glm::smoothstep(0.5f, 0.85f, up.y / cell);

    shared::Cutout& cutout = cutouts.all[cutouts.count++];
    cutout.toPoints = toPoints;
    cutout.size = field.size;
    cutout.ceiling = field.top + 1.0f + kWall * upright * standsOut / cell;
    cutout.first = hull.first;
    if (const auto basin = basinAround(rim, kWall * upright * standsOut, waves)) basins.push_back(*basin);
  }
}

}  // namespace scumble::ocean
