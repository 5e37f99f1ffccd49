// A scene's ocean: where it is, its mesh, and its waves at a moment, on the CPU and on the device
// (paper 000, section 6.1; the waves themselves: features/ocean/waves).
#pragma once

#include <array>
#include <compare>
#include <optional>

#include "features/ocean/decorations.h"
#include "features/ocean/draped.h"
#include "features/ocean/hulls/hulls.h"
#include "features/ocean/ocean.shared.h"
#include "features/ocean/waves/surface.h"
#include "world/geometry.h"

namespace scumble::ocean {

using namespace world;

// The feature's, as SceneOnGpu::feature() knows it.
inline constexpr const char* kName = "ocean";

#define PARAMS_STRUCT OceanParams
#define PARAMS_FILE "features/ocean/ocean.params"
#define PARAMS_PATH "ocean"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// What of the ocean goes into the scene's geometry.
struct OceanShape {
  bool isThere = false;
  int node = -1;                                        // whose mesh it stands for; -1: none
  glm::vec3 origin{0.0f};                               // middle of calm water, world
  int grid = 80, tiles = 5;                             // vertices along a tile; tiles along a side
  float tile = 60, falseHorizon = 120, horizon = 1000;  // metres
  std::vector<int> decorations;                         // their kinds
  HullNodes hulls;                                      // empty: none keeps the sea out
  Draped draped;                                        // meshes of the scene
  bool operator==(const OceanShape&) const = default;
  // Metres from the middle to which waves are whole.
  float fadeStart() const { return 0.6f * falseHorizon; }
  float cell() const { return tile / float(grid); }
  // Place of the mesh's first point, in cells from the middle, along x and z.
  int firstPoint() const { return -(tiles * grid / 2); }
};
OceanShape oceanShape(const scene::SceneData& scene, const look::LookData& look);

using shared::kWaterPerPattern;

// A tile with its corner at the origin. The middle one has all points, and is split as waves/surface.h
// says; each ring of tiles around it every second point of the one before, since small triangles far away
// cost much and show nothing.
struct OceanTile {
  int stride = 1;               // points between corners of its cells
  std::array<int, 4> beside{};  // along its sides -x, +x, -z, +z, where a finer tile may lie beside it
  auto operator<=>(const OceanTile&) const = default;
};
OceanTile oceanTileAt(const OceanShape& shape, int x, int z);
scene::Primitive makeOceanTile(const OceanShape& shape, const OceanTile& tile);
// The flat water between the waves and the horizon.
scene::Primitive makeOceanRing(const OceanShape& shape);
// What of a decoration is finer than the ocean's own mesh: it rides at the same height, and the ocean's is
// pushed down below it.
scene::Primitive makeOceanDecoration(int kind);

// The shape as what is planned.
class OceanPlan : public FeaturePlan {
 public:
  explicit OceanPlan(OceanShape shape);
  const OceanShape& shape() const { return shape_; }
  bool equals(const FeaturePlan& other) const override {
    return shape_ == static_cast<const OceanPlan&>(other).shape_;
  }
  std::optional<uint32_t> kindOf(size_t node, size_t material) const override {
    return shape_.draped.has(node, material) ? std::optional<uint32_t>(shared::kDraped) : std::nullopt;
  }
  void addItems(const GeometryItem& item, MadePrimitives& made, Geometry& geometry) const override;
  std::unique_ptr<FeatureMoment> makeMoment(gpu::Device& device,
                                            const scene::SceneData& scene) const override;

 private:
  OceanShape shape_;
};

// The waves of a moment. The mesh stays where it is but for part of a cell, and waves and pattern slide
// through it: nothing wraps and nothing pops.
class OceanWaves : public FeatureMoment {
 public:
  // `scene` stays until another one is followed.
  OceanWaves(gpu::Device& device, const scene::SceneData& scene, const OceanShape& shape);
  bool follow(const scene::SceneData& scene, const FeaturePlan& plan) override;
  void pose(const look::LookData& look, const KnobTable& now, double time,
            const FeatureMoment* present) override {
    pose(now.look(), time, travelledBy(look), static_cast<const OceanWaves*>(present));
  }
  void moveNodes(const scene::SceneData& scene, std::span<const glm::dmat4> world,
                 std::vector<std::optional<glm::mat4>>& moved) const override;
  Place placeOf(uint32_t kind) const override;
  scene::Bounds boundsOf(uint32_t kind, uint32_t detail, const scene::Bounds& posed) const override;
  void addUploads(std::vector<gpu::PerFrameBuffer*>& uploads) override {
    uploads.push_back(&buffer_);
    if (cutouts_.handle()) uploads.push_back(&cutouts_);
  }
  void find(const std::vector<GeometryItem>& items) override;
  bool place(gpu::Uploader& uploader, const std::vector<GeometryItem>& items,
             const std::vector<GeometryPlace>& places, const std::function<void()>& settle) override;
  void posed(const SceneMotion& motion) override;
  std::optional<CutoutBuffers> cutouts() const override;

  // The waves at a time, in seconds; the look is one at that time. `travelled`: how far over the water the
  // scene is at any time.
  // `now`: waves of another time whose points of the mesh are to be followed, for where they were at this
  // one; null: the mesh stays. Decorations are then those of `now`, carried along by the water.
  void pose(const look::LookData& look, double time, const Travelled& travelled,
            const OceanWaves* now = nullptr);

  // From where something is on calm water to where it rides the waves. `world`: its matrix.
  glm::mat4 riding(const FloatParams& params, const glm::mat4& world) const;
  const ocean::WaveField& field() const { return field_; }
  // Height of the sea as it is drawn, but for decorations, at a place of the world.
  float seaAt(const glm::vec3& at) const;
  // Where on the field a place of the world is: metres, x and z.
  glm::dvec2 onField(const glm::vec3& at) const {
    return glm::dvec2(at.x - shape_.origin.x, at.z - shape_.origin.z) + travelled_;
  }

  const gpu::PerFrameBuffer& buffer() const { return buffer_; }

 private:
  // Gives shaders the zones and basins, of which they know otherwise none.
  void putAround();
  // Where a decoration's mesh is; empty where it draws nothing.
  scene::Bounds decorationBounds(size_t decoration) const;
  // Begins anew after a power of two, at which all scales of a pattern repeat: numbers stay fine.
  static glm::vec2 patternAt(const glm::dvec2& metres) {
    return glm::mod(metres / double(kWaterPerPattern), glm::dvec2(8192.0));
  }

  gpu::Device& device_;
  const scene::SceneData* scene_;
  OceanShape shape_;
  std::optional<ocean::Waves> waves_;
  ocean::WaveField field_;
  glm::dvec2 travelled_{0.0};  // over the water, metres
  glm::dvec2 cells_{0.0};      // whole cells of it
  glm::vec2 within_{0.0f};     // the rest
  glm::vec2 slid_{0.0f};       // metres that the water has slid since, to the time whose points are followed
  glm::vec3 reach_{0.0f};      // how far vertices may be from their place at rest, metres
  std::vector<FloatingNode> floating_;
  std::vector<shared::WaterDecoration> decorations_;
  DrapedZones draped_;
  std::vector<shared::WaterZone> zones_;
  std::vector<shared::WaterBasin> basins_;
  float highest_ = 0;                // wave above calm water, metres
  std::vector<DrapeParams> drapes_;  // by the scene's materials, in the pose
  Hulls hulls_;
  gpu::PerFrameBuffer cutouts_;  // shared::Cutouts; only with hulls
  gpu::PerFrameBuffer buffer_;   // shared::OceanField, then grid * grid shared::OceanPoint
};

}  // namespace scumble::ocean
