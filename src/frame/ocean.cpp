#include "frame/ocean.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/animation.h"

namespace scumble::frame {

namespace {

// "Ocean", also with what Blender appends to a second one.
bool isOceanName(const std::string& name) {
  std::string start = name.substr(0, name.find('.'));
  std::transform(start.begin(), start.end(), start.begin(), [](char c) { return char(std::tolower(c)); });
  return start == "ocean";
}

glm::dvec2 directionOf(float degrees) {
  const double angle = glm::radians(double(degrees));
  return {std::cos(angle), std::sin(angle)};
}

// What depends on the mapping alone: water is flat, and (u, v) lie along x and z.
void finish(scene::Primitive& water) {
  const size_t count = water.vertexCount();
  water.normals.assign(count, {0, 1, 0});
  water.smoothNormals = water.normals;
  water.dPdu.assign(count, {kWaterPerPattern, 0, 0});
  water.dPdv.assign(count, {0, 0, kWaterPerPattern});
  for (const glm::vec3& p : water.positions) water.uv0.push_back(glm::vec2(p.x, p.z) / kWaterPerPattern);
}

}  // namespace

OceanShape oceanShape(const scene::SceneData& scene, const look::LookData& look) {
  const OceanParams params = look.get<OceanParams>();
  OceanShape shape;
  if (params.mode == 2) return shape;
  for (size_t n = 0; n < scene.nodes.size() && shape.node < 0; ++n)
    if (isOceanName(scene.nodes[n].name)) shape.node = int(n);
  if (params.mode == 0 && shape.node < 0) return shape;
  shape.isThere = true;
  if (shape.node >= 0) shape.origin = scene::worldMatrices(scene)[size_t(shape.node)][3];
  shape.origin.y += params.level;
  shape.grid = params.grid, shape.tiles = params.tiles, shape.tile = params.tile;
  // Waves end before their mesh does, which part of a cell moves. Of a cell or two they are nowhere whole.
  const float half = std::max(0.5f * float(shape.tiles) * shape.tile - shape.cell(), 0.01f * shape.cell());
  shape.falseHorizon = std::min(params.falseHorizon, half);
  shape.horizon = std::max(params.horizon, 1.5f * shape.falseHorizon);
  return shape;
}

scene::Primitive makeOceanTile(const OceanShape& shape) {
  scene::Primitive tile;
  const uint32_t n = uint32_t(shape.grid);
  for (uint32_t z = 0; z <= n; ++z)
    for (uint32_t x = 0; x <= n; ++x) tile.positions.push_back(glm::vec3(x, 0, z) * shape.cell());
  for (uint32_t z = 0; z < n; ++z)
    for (uint32_t x = 0; x < n; ++x) {
      const auto at = [&](uint32_t i, uint32_t j) { return (z + j) * (n + 1) + x + i; };
      tile.indices.insert(tile.indices.end(), {at(0, 0), at(0, 1), at(1, 1), at(0, 0), at(1, 1), at(1, 0)});
    }
  finish(tile);
  return tile;
}

scene::Primitive makeOceanRing(const OceanShape& shape) {
  constexpr uint32_t kSectors = 96, kRings = 8;
  const float inner = 0.8f * shape.falseHorizon;
  scene::Primitive ring;
  for (uint32_t r = 0; r <= kRings; ++r) {
    const float radius = inner * std::pow(shape.horizon / inner, float(r) / kRings);
    for (uint32_t s = 0; s < kSectors; ++s) {
      const float angle = 6.2831853f * float(s) / kSectors;
      ring.positions.push_back(shape.origin + radius * glm::vec3(std::cos(angle), 0, std::sin(angle)));
    }
  }
  for (uint32_t r = 0; r < kRings; ++r)
    for (uint32_t s = 0; s < kSectors; ++s) {
      const auto at = [&](uint32_t i, uint32_t j) { return (r + i) * kSectors + (s + j) % kSectors; };
      ring.indices.insert(ring.indices.end(), {at(0, 0), at(0, 1), at(1, 1), at(0, 0), at(1, 1), at(1, 0)});
    }
  finish(ring);
  return ring;
}

OceanWaves::OceanWaves(gpu::Device& device, const OceanShape& shape)
    : shape_(shape),
      buffer_(
          device,
          sizeof(shared::OceanField) + size_t(shape.grid) * size_t(shape.grid) * sizeof(shared::OceanPoint),
          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) {}

void OceanWaves::pose(const look::LookData& look, double time, const OceanWaves* now) {
  const OceanParams params = look.get<OceanParams>();
  ocean::Spectrum spectrum;
  spectrum.grid = shape_.grid, spectrum.tile = double(shape_.tile);
  spectrum.kind = params.spectrum == 0 ? ocean::Spectrum::phillips : ocean::Spectrum::jonswap;
  spectrum.wind = double(params.wind), spectrum.windDirection = double(params.windDirection);
  spectrum.fetch = double(params.fetch), spectrum.choppiness = double(params.choppiness);
  spectrum.depth = double(params.depth), spectrum.loop = double(params.loop);
  spectrum.height = double(params.height), spectrum.smallest = double(params.smallest);
  spectrum.seed = uint32_t(params.seed);
  if (!waves_ || waves_->spectrum() != spectrum) waves_.emplace(spectrum);
  waves_->at(time, field_);
  deviation_ = float(std::sqrt(waves_->variance()));

  travelled_ = directionOf(params.heading) * (double(params.speed) * time);
  const double cell = double(shape_.cell());
  cells_ = now ? now->cells_ : glm::floor(travelled_ / cell);
  within_ = travelled_ - cells_ * cell;
  slid_ = now ? now->travelled_ - travelled_ : glm::dvec2(0.0);

  auto* header = buffer_.as<shared::OceanField>();
  *header = {};
  const auto wrapped = [&](double index) {
    return int(index - std::floor(index / shape_.grid) * shape_.grid);
  };
  const double corner = shape_.firstPoint();
  header->first = {wrapped(cells_.x + corner), wrapped(cells_.y + corner)};
  header->travelled = {wrapped(cells_.x), wrapped(cells_.y)};
  header->grid = shape_.grid;
  header->cell = shape_.cell();
  header->origin = shape_.origin;
  header->fadeStart = 0.6f * shape_.falseHorizon, header->fadeEnd = shape_.falseHorizon;
  header->sink = 0.05f + 0.25f * deviation_;
  header->deviation = deviation_;
  header->wind = directionOf(params.windDirection);

  auto* points = reinterpret_cast<shared::OceanPoint*>(buffer_.contents() + sizeof(shared::OceanField));
  reach_ = glm::vec3(0.0f);
  for (size_t i = 0; i < field_.displacement.size(); ++i) {
    const glm::vec4& d = field_.displacement[i];
    points[i] = {glm::vec3(d), d.w, field_.normals[i]};
    reach_ = glm::max(reach_, glm::abs(glm::vec3(d)));
  }
  reach_.y += header->sink;
}

glm::mat4 OceanWaves::riding(const FloatParams& params, const glm::mat4& world) const {
  const glm::vec3 at = world[3], bow = world[params.bow == 0 ? 0 : 2];
  const glm::dvec2 place = onField(at);
  const ocean::Floating floating =
      ocean::floatingAt(field_, place.x, place.y, double(params.length), double(params.beam),
                        glm::degrees(std::atan2(double(bow.z), double(bow.x))));
  // Waves end at the false horizon.
  const float away = glm::length(glm::vec2(at.x - shape_.origin.x, at.z - shape_.origin.z));
  const float whole = 1.0f - glm::smoothstep(0.6f * shape_.falseHorizon, shape_.falseHorizon, away);
  const glm::quat tilt = glm::slerp(glm::quat(1, 0, 0, 0), floating.tilt, whole);
  return glm::translate(glm::mat4(1.0f), at + glm::vec3(0, whole * floating.height, 0)) *
         glm::mat4_cast(tilt) * glm::translate(glm::mat4(1.0f), -at);
}

}  // namespace scumble::frame
