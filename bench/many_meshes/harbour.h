// The parts of the benchmark's harbour: many different meshes, each with about as many triangles as asked
// for.
#pragma once

#include <functional>

#include "mesh_kit/document.h"
#include "mesh_kit/mesh_builder.h"
#include "mesh_kit/random.h"

namespace harbour {

// Indices into palette().
enum Paint : int {
  kGranite,
  kSandstone,
  kBasalt,
  kMoss,
  kHullRed,
  kHullBlue,
  kHullGreen,
  kHullCream,
  kPlanks,
  kSpar,
  kOak,
  kHoop,
  kWallWhite,
  kWallOchre,
  kWallRose,
  kRoofSlate,
  kRoofTile,
  kWindow,
  kLeaf,
  kLeafDark,
  kWater,
  kQuay
};
std::vector<meshkit::Material> palette();

// All stand on y = 0, are about one metre in half width, and differ with every call's random numbers.
using Shape =
    std::function<meshkit::Mesh(const std::string& name, size_t triangles, meshkit::Random& random)>;
meshkit::Mesh makeRock(const std::string& name, size_t triangles, meshkit::Random& random);
meshkit::Mesh makeHull(const std::string& name, size_t triangles, meshkit::Random& random);
meshkit::Mesh makeBarrel(const std::string& name, size_t triangles, meshkit::Random& random);
meshkit::Mesh makeHouse(const std::string& name, size_t triangles, meshkit::Random& random);
meshkit::Mesh makeTree(const std::string& name, size_t triangles, meshkit::Random& random);

// A terraced bowl that everything stands on, seen whole from the camera "Bench".
meshkit::Document makeHarbour(size_t triangles, size_t meshes);

}  // namespace harbour
