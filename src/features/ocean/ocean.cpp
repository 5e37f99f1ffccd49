#include "features/ocean/ocean.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "features/ocean/extras.h"
#include "scene/animation.h"
#include "scene/seen.h"
#include "stage/playing.h"

namespace scumble::ocean {

namespace {

// What its extras say, else whether it is called "Ocean", also with what Blender appends to a second one.
bool standsForOcean(const scene::Node& node) {
  if (const std::optional<bool> says = saysOcean(node)) return *says;
  std::string start = node.name.substr(0, node.name.find('.'));
  std::transform(start.begin(), start.end(), start.begin(), [](char c) { return char(std::tolower(c)); });
  return start == "ocean";
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
  const std::vector<bool> visible = scene::shownNodes(scene);
  for (size_t n = 0; n < scene.nodes.size() && shape.node < 0; ++n)
    if (visible[n] && standsForOcean(scene.nodes[n])) shape.node = int(n);
  if (params.mode == 0 && shape.node < 0) return shape;
  shape.isThere = true;
  // The sea level is the world's, and waves lie about the scene's origin: world coordinates are too coarse
  // far out.
  shape.origin = shape.node >= 0 ? glm::vec3(scene::worldMatrices(scene)[size_t(shape.node)][3])
                                 : glm::vec3(0.0, -scene.origin.y, 0.0);
  shape.origin.y += params.level;
  shape.grid = params.grid, shape.tiles = params.tiles, shape.tile = params.tile;
  // Waves end before their mesh does, which part of a cell moves. Of a cell or two they are nowhere whole.
  const float half = std::max(0.5f * float(shape.tiles) * shape.tile - shape.cell(), 0.01f * shape.cell());
  shape.falseHorizon = std::min(params.falseHorizon, half);
  shape.horizon = std::max(params.horizon, 1.5f * shape.falseHorizon);
  const std::vector<FloatingNode> floating = floatingNodes(scene, look, shape.node);
  for (const Decoration& one : decorationsOf(scene, look, floating))
    shape.decorations.push_back(one.params.kind);
  shape.draped = drapedOf(scene, look);
  if (params.hulls) shape.hulls = hullNodes(scene, look, floating, shape.node);
  return shape;
}

OceanTile oceanTileAt(const OceanShape& shape, int x, int z) {
  constexpr int kMostHalvings = 3;
  const auto strideAt = [&](int i, int j) {
    const int middle = shape.tiles / 2;
    int halvings = std::min(std::max(std::abs(i - middle), std::abs(j - middle)), kMostHalvings);
    while (shape.grid % (1 << halvings) != 0) --halvings;
    return 1 << halvings;
  };
  // Beside coarser tiles it is split as beside its like, so that most tiles share a mesh.
  const int stride = strideAt(x, z);
  const auto beside = [&](int i, int j) { return std::min(stride, strideAt(i, j)); };
  return {stride, {beside(x - 1, z), beside(x + 1, z), beside(x, z - 1), beside(x, z + 1)}};
}

scene::Primitive makeOceanTile(const OceanShape& shape, const OceanTile& tile) {
  scene::Primitive mesh;
  const int n = shape.grid, s = tile.stride;
  std::vector<uint32_t> known(size_t(n + 1) * size_t(n + 1), ~0u);
  const auto at = [&](int x, int z) {
    uint32_t& index = known[size_t(z) * size_t(n + 1) + size_t(x)];
    if (index == ~0u) {
      index = uint32_t(mesh.positions.size());
      mesh.positions.push_back(glm::vec3(x, 0, z) * shape.cell());
    }
    return index;
  };
  for (int z = 0; z < n; z += s)
    for (int x = 0; x < n; x += s) {
      // The cell's outline, seen from above against the clock, with the points of finer tiles beside it.
      const auto step = [&](bool isBorder, int side) { return isBorder ? tile.beside[size_t(side)] : s; };
      std::vector<uint32_t> outline;
      for (int i = 0, d = step(x == 0, 0); i < s; i += d) outline.push_back(at(x, z + i));
      for (int i = 0, d = step(z + s == n, 3); i < s; i += d) outline.push_back(at(x + i, z + s));
      for (int i = 0, d = step(x + s == n, 1); i < s; i += d) outline.push_back(at(x + s, z + s - i));
      for (int i = 0, d = step(z == 0, 2); i < s; i += d) outline.push_back(at(x + s - i, z));
      if (outline.size() == 4) {
        for (const size_t corner : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(outline[corner]);
        continue;
      }
      const uint32_t middle = at(x + s / 2, z + s / 2);
      for (size_t i = 0; i < outline.size(); ++i)
        mesh.indices.insert(mesh.indices.end(), {middle, outline[i], outline[(i + 1) % outline.size()]});
    }
  finish(mesh);
  return mesh;
}

scene::Primitive makeOceanRing(const OceanShape& shape) {
  constexpr uint32_t kSectors = 96, kRings = 8;
  const float inner = 0.8f * shape.falseHorizon;
  scene::Primitive ring;
  for (uint32_t r = 0; r <= kRings; ++r) {
    const float radius = inner * std::pow(shape.horizon / inner, float(r) / kRings);
    for (uint32_t s = 0; s < kSectors; ++s) {
      const float angle = 6.2831853f * float(s) / kSectors;
      ring.positions.push_back(radius * glm::vec3(std::cos(angle), 0, std::sin(angle)));
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

scene::Primitive makeOceanDecoration(int kind) {
  scene::Primitive water = makeDecorationMesh(kind);
  finish(water);
  return water;
}

OceanPlan::OceanPlan(OceanShape shape) : shape_(std::move(shape)) {
  replacedNode = shape_.node;
  for (size_t n = 0; n < shape_.hulls.isInside.size(); ++n)
    if (shape_.hulls.isInside[n]) hiddenNodes.push_back(int(n));
  replacesGround = true;
  isPrepainted = true;
  // The sea's horizon is a quiet line.
  quietDistance = shape_.falseHorizon;
}

std::unique_ptr<FeatureMoment> OceanPlan::makeMoment(gpu::Device& device,
                                                     const scene::SceneData& scene) const {
  return std::make_unique<OceanWaves>(device, scene, shape_);
}

void OceanPlan::addItems(const GeometryItem& common, MadePrimitives& made, Geometry& geometry) const {
  GeometryItem item = common;
  const auto use = [&](const scene::Primitive& primitive) {
    item.primitive = &primitive, item.extent = &primitive.extent;
  };
  // Tiles.
  item.kind = shared::kWaves;
  item.isWrittenByFeature = true;
  for (int z = 0; z < shape_.tiles; ++z)
    for (int x = 0; x < shape_.tiles; ++x) {
      const OceanTile tile = oceanTileAt(shape_, x, z);
      const auto& [negativeX, positiveX, negativeZ, positiveZ] = tile.beside;
      use(made.get("ocean tile",
                   {double(shape_.grid), double(shape_.tile), double(tile.stride), double(negativeX),
                    double(positiveX), double(negativeZ), double(positiveZ)},
                   [&] { return makeOceanTile(shape_, tile); }));
      const glm::vec2 corner =
          glm::vec2(shape_.firstPoint() + glm::ivec2(x, z) * shape_.grid) * shape_.cell();
      item.instance = glm::translate(glm::mat4(1.0f), shape_.origin + glm::vec3(corner.x, 0, corner.y));
      item.model = item.instance;
      item.patternShift = corner / kWaterPerPattern;
      item.reach = scene::posedBounds(*item.extent, item.model, {}, {});
      geometry.items.push_back(item);
    }
  // The flat water around them.
  use(made.get("ocean ring", {double(shape_.falseHorizon), double(shape_.horizon)},
               [&] { return makeOceanRing(shape_); }));
  item.kind = shared::kFlat;
  item.isWrittenByFeature = false;
  item.instance = item.model = glm::translate(glm::mat4(1.0f), shape_.origin);
  item.patternShift = glm::vec2(0.0f);
  item.reach = scene::posedBounds(*item.extent, item.model, {}, {});
  geometry.items.push_back(item);
  // Decorations.
  item.kind = shared::kDecoration;
  item.isWrittenByFeature = true;
  item.instance = item.model = glm::mat4(1.0f);
  item.patternShift = -glm::vec2(shape_.origin.x, shape_.origin.z) / kWaterPerPattern;
  for (const int kind : shape_.decorations) {
    use(made.get("ocean decoration", {double(kind)}, [&] { return makeOceanDecoration(kind); }));
    geometry.items.push_back(item);
    ++item.detail;
  }
}

OceanWaves::OceanWaves(gpu::Device& device, const scene::SceneData& scene, const OceanShape& shape)
    : device_(device),
      scene_(&scene),
      shape_(shape),
      buffer_(
          device,
          sizeof(shared::OceanField) + size_t(shape.grid) * size_t(shape.grid) * sizeof(shared::OceanPoint),
          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) {}

bool OceanWaves::follow(const scene::SceneData& scene, const FeaturePlan& plan) {
  const OceanShape& shape = static_cast<const OceanPlan&>(plan).shape();
  if (shape.grid != shape_.grid) return false;
  scene_ = &scene;
  shape_ = shape;
  return true;
}

void OceanWaves::pose(const look::LookData& look, double time, const Travelled& travelled,
                      const OceanWaves* now) {
  // The waves.
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
  waves_->at(stage::heldTime(time, params.hold), field_);
  const float deviation = float(std::sqrt(waves_->variance()));

  // Where the mesh lies on the water, which slides through it.
  floating_ = floatingNodes(*scene_, look, shape_.node);
  travelled_ = travelled(time);
  const double cell = double(shape_.cell());
  cells_ = now ? now->cells_ : glm::floor(travelled_ / cell);
  within_ = travelled_ - cells_ * cell;
  slid_ = now ? now->travelled_ - travelled_ : glm::dvec2(0.0);

  // What shaders know of that.
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
  header->fadeStart = shape_.fadeStart(), header->fadeEnd = shape_.falseHorizon;
  header->sink = 0.05f + 0.25f * deviation;
  header->relief = std::hypot(deviation, 0.1f);  // calm water has few colours
  header->within = within_;
  header->push = 0.2f + 0.5f * deviation;
  // Decorations.
  if (now) {
    decorations_ = now->decorations_;
    for (shared::WaterDecoration& one : decorations_) {
      one.center += slid_;
      for (glm::vec4& point : one.points) point += glm::vec4(slid_, 0.0f, 0.0f);
    }
    zones_ = now->zones_;
    for (shared::WaterZone& zone : zones_) zone.center += slid_;
    basins_ = now->basins_;
    putAround();
  } else {
    decorations_ = placeDecorations(decorationsOf(*scene_, look, floating_), *scene_,
                                    playedClips(*scene_, look), time, shape_.origin, travelled);
  }
  header->decorationCount = int(decorations_.size());
  std::copy(decorations_.begin(), decorations_.end(), header->decorations);

  drapes_.clear();
  if (!draped_.isEmpty())
    for (const scene::Material& material : scene_->materials)
      drapes_.push_back(look.getFor<DrapeParams>(look::kMaterials, material.name));

  // The points.
  auto* points = reinterpret_cast<shared::OceanPoint*>(buffer_.contents() + sizeof(shared::OceanField));
  reach_ = glm::vec3(0.0f);
  highest_ = 0;
  for (size_t i = 0; i < field_.displacement.size(); ++i) {
    const glm::vec4& d = field_.displacement[i];
    highest_ = std::max(highest_, d.y);
    points[i] = {glm::vec3(d), d.w, field_.normals[i]};
    reach_ = glm::max(reach_, glm::abs(glm::vec3(d)));
  }
  reach_.y += header->sink + header->push;
}

void OceanWaves::find(const std::vector<GeometryItem>& items) {
  // Waves of more than a tenth of a tile are of another sea than the tile's.
  const Hulls::Sea sea{shape_.origin.y, 0.1f * shape_.tile, shape_.tile};
  shape_.hulls.root.empty() ? hulls_.clear() : hulls_.find(*scene_, shape_.hulls, sea, items);
  draped_.find(items);
}

bool OceanWaves::place(gpu::Uploader& uploader, const std::vector<GeometryItem>&,
                       const std::vector<GeometryPlace>&, const std::function<void()>& settle) {
  if (!hulls_.place(uploader, settle)) return false;
  if (!hulls_.isEmpty() && !cutouts_.handle())
    cutouts_ = gpu::PerFrameBuffer(device_, sizeof(shared::Cutouts), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  return true;
}

void OceanWaves::posed(const SceneMotion& motion) {
  zones_ = draped_.at(motion, drapes_, reach_, shape_.origin);
  basins_.clear();
  if (!hulls_.isEmpty()) {
    // A cell's diagonal, as far as waves draw it out.
    const float triangle = 1.5f * shape_.cell() + std::min(std::hypot(reach_.x, reach_.z), shape_.cell());
    const Hulls::Waves waves{shape_.origin, highest_, -reach_.y, triangle,
                             [this](const glm::vec3& at) { return seaAt(at); }};
    hulls_.pose(motion, waves, *cutouts_.as<shared::Cutouts>(), basins_);
  }
  putAround();
}

void OceanWaves::putAround() {
  auto* const header = buffer_.as<shared::OceanField>();
  header->zoneCount = int(zones_.size());
  std::copy(zones_.begin(), zones_.end(), header->zones);
  header->basinCount = int(basins_.size());
  std::copy(basins_.begin(), basins_.end(), header->basins);
}

std::optional<FeatureMoment::CutoutBuffers> OceanWaves::cutouts() const {
  if (hulls_.isEmpty()) return std::nullopt;
  return CutoutBuffers{cutouts_.handle(), hulls_.points().handle()};
}

float OceanWaves::seaAt(const glm::vec3& at) const {
  const glm::dvec2 place = onField(at);
  const float away = glm::length(glm::vec2(at.x - shape_.origin.x, at.z - shape_.origin.z));
  const float whole = 1.0f - glm::smoothstep(shape_.fadeStart(), shape_.falseHorizon, away);
  return shape_.origin.y + whole * ocean::heightAt(field_, place.x, place.y);
}

void OceanWaves::moveNodes(const scene::SceneData&, std::span<const glm::dmat4> world,
                           std::vector<std::optional<glm::mat4>>& moved) const {
  for (const FloatingNode& one : floating_)
    if (!moved[one.node]) moved[one.node] = riding(one.params, glm::mat4(world[one.node]));
}

FeatureMoment::Place OceanWaves::placeOf(uint32_t kind) const {
  // Tiles are moved by less than a cell, where no other time's points are followed.
  if (kind == shared::kWaves)
    return {{-within_.x, 0.0f, -within_.y}, patternAt(travelled_ - glm::dvec2(within_))};
  if (kind == shared::kFlat) return {{slid_.x, 0.0f, slid_.y}, patternAt(travelled_)};
  if (kind == shared::kDraped) return {};
  return {glm::vec3(0.0f), patternAt(travelled_)};
}

scene::Bounds OceanWaves::boundsOf(uint32_t kind, uint32_t detail, const scene::Bounds& posed) const {
  if (kind == shared::kDecoration) return decorationBounds(detail);
  scene::Bounds bounds = posed;
  if (kind == shared::kWaves || kind == shared::kDraped) bounds.min -= reach_, bounds.max += reach_;
  return bounds;
}

scene::Bounds OceanWaves::decorationBounds(size_t decoration) const {
  const shared::WaterDecoration& one = decorations_[decoration];
  scene::Bounds bounds;
  if (one.count == 0) return bounds;
  const float around = one.reach + 4 * shape_.cell();
  const glm::vec3 middle = shape_.origin + glm::vec3(one.center.x, 0, one.center.y);
  const glm::vec3 extent =
      glm::vec3(around, 0, around) + reach_ + glm::vec3(0.0f, decorationHeight(one), 0.0f);
  bounds.add(middle - extent);
  bounds.add(middle + extent);
  return bounds;
}

glm::mat4 OceanWaves::riding(const FloatParams& params, const glm::mat4& world) const {
  const glm::vec3 at = world[3], bow = world[params.bow == 0 ? 0 : 2];
  const glm::dvec2 place = onField(at);
  const ocean::Floating floating =
      ocean::floatingAt(field_, place.x, place.y, double(params.length), double(params.beam),
                        glm::degrees(std::atan2(double(bow.z), double(bow.x))));
  // Waves end at the false horizon.
  const float away = glm::length(glm::vec2(at.x - shape_.origin.x, at.z - shape_.origin.z));
  const float whole = 1.0f - glm::smoothstep(shape_.fadeStart(), shape_.falseHorizon, away);
  const glm::quat tilt = glm::slerp(glm::quat(1, 0, 0, 0), floating.tilt, whole);
  return glm::translate(glm::mat4(1.0f), at + glm::vec3(0, whole * floating.height, 0)) *
         glm::mat4_cast(tilt) * glm::translate(glm::mat4(1.0f), -at);
}

}  // namespace scumble::ocean
