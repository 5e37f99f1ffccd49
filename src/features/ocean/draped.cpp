#include "features/ocean/draped.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "features/ocean/extras.h"
#include "world/geometry.h"

namespace scumble::ocean {

namespace {

// Also in the plural, and with what modelling programs append to a second one.
bool isCalledSo(const std::string& name) {
  std::string word;
  for (const char c : name) {
    if (!std::isalpha(static_cast<unsigned char>(c))) break;
    word += char(std::tolower(static_cast<unsigned char>(c)));
  }
  constexpr std::array<std::string_view, 6> kWords{"wake",     "wakes",  "splash",
                                                   "splashes", "ripple", "ripples"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

// On the water as if it were calm: along the longer of the two sides that lie flattest.
shared::WaterZone zoneOf(const scene::Bounds& box, const glm::mat4& model, const glm::vec3& origin) {
  shared::WaterZone zone{};
  const glm::vec3 middle = model * glm::vec4(box.center(), 1.0f), half = 0.5f * (box.max - box.min);
  zone.center = glm::vec2(middle.x, middle.z) - glm::vec2(origin.x, origin.z);
  float longest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const glm::vec2 side = half[axis] * glm::vec2(model[axis].x, model[axis].z);
    if (glm::length(side) > longest) longest = glm::length(side), zone.along = side / longest;
  }
  if (longest == 0) return zone;
  for (int axis = 0; axis < 3; ++axis) {
    const glm::vec2 side = half[axis] * glm::vec2(model[axis].x, model[axis].z);
    zone.halves += glm::abs(
        glm::vec2(glm::dot(side, zone.along), glm::dot(side, glm::vec2(-zone.along.y, zone.along.x))));
  }
  return zone;
}

}  // namespace

bool Draped::has(size_t node, size_t material) const {
  const Role role = material < materials.size() ? materials[material] : Role::off;
  if (role == Role::on || role == Role::off) return role == Role::on;
  return nodes[node].value_or(role == Role::byName);
}

Draped drapedOf(const scene::SceneData& scene, const look::LookData& look) {
  Draped draped;
  for (const scene::Material& material : scene.materials) {
    const int mode = look.getFor<DrapeParams>(look::kMaterials, material.name).mode;
    draped.materials.push_back(mode == 1                   ? Draped::Role::on
                               : mode == 2                 ? Draped::Role::off
                               : isCalledSo(material.name) ? Draped::Role::byName
                                                           : Draped::Role::byNode);
  }
  for (const scene::Node& node : scene.nodes) draped.nodes.push_back(saysWater(node));
  return draped;
}

void DrapedZones::find(const std::vector<world::GeometryItem>& items) {
  items_.clear();
  for (size_t i = 0; i < items.size(); ++i) {
    const world::GeometryItem& item = items[i];
    if (!item.isWrittenByFeature || item.kind != shared::kDraped || !item.shown) continue;
    const bool bends = item.skin >= 0 || !item.primitive->morphTargets.empty();
    items_.push_back({i, item.primitive->material, bends ? std::nullopt : std::optional(item.extent->box)});
  }
}

std::vector<shared::WaterZone> DrapedZones::at(const world::SceneMotion& motion,
                                               std::span<const DrapeParams> params, const glm::vec3& grown,
                                               const glm::vec3& origin) const {
  std::vector<shared::WaterZone> zones;
  for (const Item& item : items_) {
    scene::Bounds bounds = motion.bounds()[item.object];
    if (bounds.empty) continue;
    bounds.min += grown, bounds.max -= grown;
    shared::WaterZone zone = item.box ? zoneOf(*item.box, motion.model(item.object), origin)
                                      : zoneOf(bounds, glm::mat4(1.0f), origin);
    zone.calm = params[size_t(item.material)].calm, zone.room = params[size_t(item.material)].room;
    if (zone.halves.x > 0 && zone.halves.y > 0) zones.push_back(zone);
  }
  const auto area = [](const shared::WaterZone& zone) { return zone.halves.x * zone.halves.y; };
  std::stable_sort(zones.begin(), zones.end(),
                   [&](const auto& a, const auto& b) { return area(a) > area(b); });
  if (zones.size() > size_t(shared::kMaxZones)) zones.resize(size_t(shared::kMaxZones));
  return zones;
}

}  // namespace scumble::ocean
