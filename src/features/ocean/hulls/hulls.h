// Which meshes of a scene keep the sea out, and where they are in a frame (paper 000, section 6.2).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "features/ocean/floating.h"
#include "features/ocean/hulls/hull_field.h"
#include "features/ocean/ocean.shared.h"
#include "gpu/frames_in_flight.h"
#include "shading/cutouts.shared.h"
#include "world/geometry.h"
#include "world/scene_motion.h"

namespace scumble::ocean {

// By node: whose hull its mesh is part of.
struct HullNodes {
  static constexpr int kNone = -1;
  std::vector<int> root;       // a node, also its own; kNone: of no hull's
  std::vector<bool> isWhole;   // by node: all that hangs on it is one hull
  std::vector<bool> isInside;  // by node: its mesh is the inside of one, and not drawn
  bool operator==(const HullNodes&) const = default;
};

// What rides, and what the look or the scene says, is a hull with all that hangs on it; every other mesh may
// be one by itself. Where an artist says what is inside, that alone counts.
HullNodes hullNodes(const scene::SceneData& scene, const look::LookData& look,
                    std::span<const FloatingNode> floating, int ocean);

class Hulls {
 public:
  // Where the sea is: metres of its level, how far waves may take it from there, and the longest mesh that
  // can be a hull unless somebody says that it is.
  struct Sea {
    float level, reach, longest;
  };
  // What holds water at rest, of all that is drawn; vertices are asked for where that was not known before.
  void find(const scene::SceneData& scene, const HullNodes& nodes, const Sea& sea,
            const std::vector<world::GeometryItem>& items);
  // None does.
  void clear() {
    hulls_.clear();
    known_.clear();
  }
  // Its points on the device. True where those are another buffer.
  bool place(gpu::Uploader& uploader, const std::function<void()>& settle);
  bool isEmpty() const { return hulls_.empty(); }
  const gpu::Buffer& points() const { return points_; }

  // The waves around them: the middle of calm water, the highest and the lowest that water may be above that,
  // and metres from a point of the ocean's mesh to the farthest one of the same triangle. `heightAt`: the
  // sea's, at a place of the world.
  struct Waves {
    glm::vec3 origin;
    float highest, lowest, triangle;
    std::function<float(const glm::vec3&)> heightAt;
  };
  // Finds, for where they are now, what they cut out of the sea, and how the sea lies around them, for those
  // that a wave may reach over.
  void pose(const world::SceneMotion& motion, const Waves& waves, shared::Cutouts& cutouts,
            std::vector<shared::WaterBasin>& basins) const;

 private:
  // A mesh of a hull, at rest; where it is drawn, from the place of the first one.
  struct Part {
    const scene::Primitive* primitive;
    std::vector<glm::mat4> matrices;  // its own, or its joints'
    bool isInside;
    bool operator==(const Part&) const = default;
  };
  struct Hull {
    std::shared_ptr<const HullField> field;
    size_t item;     // which moves it
    int joint;       // of its skin; -1: none
    glm::mat4 rest;  // upright, around its origin
    int first = 0;   // of its points
  };
  struct Known {
    std::vector<Part> parts;
    std::shared_ptr<const HullField> field;  // null: they hold no water
  };
  // Of all of these, which are looked through at once where they are not known.
  void findFields(const std::vector<std::vector<Part>>& wanted);
  static std::vector<Triangle> trianglesOf(const Part& part);

  std::vector<Hull> hulls_;
  std::vector<Known> known_;
  std::vector<std::shared_ptr<const HullField>> placed_;  // in points_
  gpu::Buffer points_;
};

}  // namespace scumble::ocean
