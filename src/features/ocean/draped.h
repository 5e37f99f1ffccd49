// Wakes and splashes that an artist has made (paper 000, section 6.2): meshes of the scene, with whatever
// moves them, that lie on the water. The ocean writes their vertices, on its waves, and makes room below
// them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "features/ocean/ocean.shared.h"
#include "look/look_data.h"
#include "scene/scene_data.h"
#include "world/scene_motion.h"

namespace scumble::ocean {

#define PARAMS_STRUCT DrapeParams
#define PARAMS_FILE "features/ocean/drape.params"
#define PARAMS_PATH "drape"
#define PARAMS_TARGETS look::kMaterials
#include "look/define_params.h"

// Meshes of a scene that lie on the water: as the look says of a material, else what the scene says of a
// node, else what the material is called.
struct Draped {
  enum class Role : uint8_t { byNode, byName, on, off };
  std::vector<Role> materials;
  std::vector<std::optional<bool>> nodes;
  bool operator==(const Draped&) const = default;
  bool has(size_t node, size_t material) const;
};
Draped drapedOf(const scene::SceneData& scene, const look::LookData& look);

// The water below them, where its strokes are suppressed and its mesh is pushed down: a rectangle for each,
// on the water as if it were calm.
class DrapedZones {
 public:
  // Which of the items lie on the water: those that the feature writes the vertices of, of this kind.
  void find(const std::vector<world::GeometryItem>& items);
  bool isEmpty() const { return items_.empty(); }
  // Where they are in a pose; the largest shared::kMaxZones of them. `params`: by the scene's materials.
  // `grown`: what bounds have been grown by, since waves move what lies on them. `origin`: the middle of calm
  // water.
  std::vector<shared::WaterZone> at(const world::SceneMotion& motion, std::span<const DrapeParams> params,
                                    const glm::vec3& grown, const glm::vec3& origin) const;

 private:
  struct Item {
    size_t object;
    int material;                      // of the scene
    std::optional<scene::Bounds> box;  // in its own space; none: something bends it
  };
  std::vector<Item> items_;
};

}  // namespace scumble::ocean
