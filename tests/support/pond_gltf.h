// Tests only: a scene with something still and something that moves.
#pragma once

#include "tests/support/loaded_test_gltf.h"

namespace scumble {

// A flat box whose centre is (1, 1, -2), a camera above it, and a node "Bird" that goes from (0, 3, 0) to
// (4, 3, 0) in a second and faces along +x.
inline scene::TestGltf pond() {
  scene::TestGltf g;
  std::vector<float> corners;
  for (int i = 0; i < 8; ++i)
    corners.insert(corners.end(), {i & 1 ? 5.0f : -3.0f, i & 2 ? 2.0f : 0.0f, i & 4 ? -1.0f : -3.0f});
  g.addMesh({{"POSITION", g.addFloats(corners, 3)}},
            g.addIndices({0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                          2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6}));
  const int bird = int(g.json["nodes"].size());
  g.json["nodes"].push_back({{"name", "Bird"}, {"rotation", {0, 0.70710678, 0, 0.70710678}}});
  g.json["scenes"][0]["nodes"].push_back(bird);
  const int times = g.addFloats({0, 1}, 1), places = g.addFloats({0, 3, 0, 4, 3, 0}, 3);
  g.json["accessors"][size_t(times)]["min"] = {0};
  g.json["accessors"][size_t(times)]["max"] = {1};
  g.json["animations"] = {
      {{"name", "Fly"},
       {"samplers", {{{"input", times}, {"output", places}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", bird}, {"path", "translation"}}}}}}}};
  return g;
}

}  // namespace scumble
