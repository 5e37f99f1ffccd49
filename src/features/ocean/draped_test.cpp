// Meshes of a scene that lie on the water: at the waves' height whatever moves them, with calm water below
// that nowhere comes through.
#include <algorithm>
#include <cmath>

#include "scene/scene_data.h"
#include "scumble/renderer.h"
#include "tests/support/animated_scene.h"
#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;

constexpr int kDrapedWidth = 96, kDrapedHeight = 72;
constexpr double kAboveWater = 0.02;  // metres that they lie above it by themselves
// From so far above that what lies higher or lower is seen in the same place.
const Stand kFarAbove{{0.1f, 300, 0.2f}, {0, 0, 0}, 2.2f};

Look windyLook(const Knobs& knobs = {}) {
  Knobs all{{"ocean.mode", "on"}, {"ocean.wind", "11"}, {"ocean.tiles", "3"}, {"ocean.speed", "1"}};
  all.insert(all.end(), knobs.begin(), knobs.end());
  return quietLook(all);
}

class Draped : public BothEyes {
 protected:
  static Frame drawAt(const Scene& scene, const Look& look, double time, const Stand& stand = kFarAbove,
                      double before = 0, uint32_t seed = 0) {
    RenderOptions options = sized(kDrapedWidth, kDrapedHeight, {"lit", "position", "id", "motion"});
    options.previousTime = before;
    options.seed = seed;
    Result<Frame> frame = renderer().render(
        scene, look, time, viewsFrom(scene, stand, kDrapedWidth, kDrapedHeight, GetParam()), options);
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  }
  static int idAt(const Frame& frame, int x, int y, size_t v) {
    return int(texel(aov(frame, "id", v), x, y).x);
  }
};
INSTANTIATE_BOTH_EYES(Draped);

Json named(const std::string& name) {
  return TestScene::colored(name, {0.9f, 0.2f, 0.2f, 1});
}

// A fine sheet of 5 m by 4 m, 0.4 m above calm water.
constexpr double kSheetHeight = 0.4;
TestMesh sheet(int cells = 40) {
  return gridMesh({-2.5f, float(kSheetHeight), 2}, {5, 0, 0}, {0, 0, -4}, cells);
}

Scene sheetScene(const std::string& material, const Json& extras = nullptr, int cells = 40) {
  TestScene s;
  s.add(sheet(cells), s.material(named(material)));
  if (!extras.is_null()) s.json()["nodes"].back()["extras"] = extras;
  return s.load();
}

// How high it lies above the sea that is there without it, where it is seen; `offset`: as calm water has it.
Difference above(const Frame& with, const Frame& bare, size_t v, int id, double offset, double tolerance) {
  Difference difference(tolerance);
  for (int y = 0; y < kDrapedHeight; ++y)
    for (int x = 0; x < kDrapedWidth; ++x) {
      if (int(texel(aov(with, "id", v), x, y).x) != id) continue;
      difference.add(texel(aov(with, "position", v), x, y).y - texel(aov(bare, "position", v), x, y).y,
                     offset + kAboveWater);
    }
  return difference;
}

// The sea alone: what else is there lies deep in it.
Scene seaAlone() {
  TestScene s;
  s.add(boxMesh({-0.1f, -40.1f, -0.1f}, {0.1f, -40, 0.1f}), s.material(named("Stone")));
  return s.load();
}

TEST_P(Draped, whatIsCalledSoOrSaysSoLiesOnTheWaves) {
  const Frame bare = drawAt(seaAlone(), windyLook(), 2.3);
  struct Case {
    const char* material;
    Json extras;
    Knobs knobs;
    bool lies;
  };
  const Json yes = {{"scumble_water", true}}, no = {{"scumble_water", 0}};
  for (const Case& c :
       {Case{"Wake", nullptr, {}, true}, Case{"splash.001", nullptr, {}, true},
        Case{"Ripples_Far", nullptr, {}, true}, Case{"Wakeful", nullptr, {}, false},
        Case{"Plank", nullptr, {}, false}, Case{"Plank", yes, {}, true}, Case{"Wake", no, {}, false},
        Case{"Plank", nullptr, {{"materials.Pl*.drape.mode", "on"}}, true},
        Case{"Wake", yes, {{"materials.Wake.drape.mode", "off"}}, false}}) {
    const Frame frame = drawAt(sheetScene(c.material, c.extras), windyLook(c.knobs), 2.3);
    for (size_t v = 0; v < viewCount(); ++v) {
      const Difference heights = above(frame, bare, v, 1, kSheetHeight, 0.02);
      EXPECT_GT(heights.count, c.lies ? 600u : 200u) << c.material;
      if (c.lies)
        EXPECT_EQ(heights.beyond, 0u) << c.material << ": " << heights.text();
      else
        EXPECT_GT(heights.beyond, heights.count / 3) << c.material << ": " << heights.text();
    }
  }
}

// Carried, stretched, mirrored, instanced, bent by joints and by morph targets; on what rides the waves
// itself.
TEST_P(Draped, theyLieOnTheWavesWhateverMovesThem) {
  const auto onNode = [&](Json node, Json above = nullptr) {
    AnimatedScene s;
    const int mesh = s.mesh({sheet(), 0, {}, {}, {}, {}}, s.material(named("Wake")));
    node["mesh"] = mesh;
    if (above.is_null()) {
      s.node(node);
    } else {
      const int parent = s.node(above);
      s.node(node, parent);
    }
    return s.load();
  };
  const auto skinned = [&](Json above) {
    AnimatedScene s;
    AnimatedMesh mesh{sheet(), 4, {}, {}, {}, {}};
    for (size_t i = 0; i < mesh.shape.positions.size(); ++i) {
      mesh.joints.insert(mesh.joints.end(), {0, 1, 0, 0});
      mesh.weights.insert(mesh.weights.end(), {0.5f, 0.5f, 0, 0});
    }
    const int shape = s.mesh(mesh, s.material(named("Wake")));
    above["name"] = "Boat";
    const int boat = s.node(above);
    const int a = s.node({{"translation", {0, 0.1, 0}}}, boat),
              b = s.node({{"translation", {0, 0.3, 0}}}, boat);
    const int skin = s.skin({a, b}, {glm::mat4(1.0f), glm::mat4(1.0f)});
    s.node({{"mesh", shape}, {"skin", skin}});
    return s.load();
  };
  const auto morphed = [&] {
    AnimatedScene s;
    AnimatedMesh mesh{sheet(), 0, {}, {}, {}, {0.5f}};
    AnimatedMesh::Target target;
    target.positions.assign(mesh.shape.positions.size(), {0, 0.6f, 0});
    target.normals.assign(mesh.shape.positions.size(), {0, 0, 0});
    mesh.targets = {target};
    s.node({{"mesh", s.mesh(mesh, s.material(named("Wake")))}});
    return s.load();
  };
  const Scene nothing = seaAlone();
  const Knobs rides{{"nodes.Boat.float.rides", "on"}};
  struct Case {
    const char* what;
    Scene scene;
    double height;
  };
  const std::vector<Case> cases{
      {"carried", onNode({{"translation", {0.5, 0.2, 0.1}}, {"rotation", {0, 0.3826834, 0, 0.9238795}}}),
       0.6},
      {"mirrored", onNode({{"scale", {-0.7, 2, 1}}}), 0.8},
      {"on what rides", onNode({{"translation", {0, 0.1, 0}}}, {{"name", "Boat"}}), 0.5},
      {"joints", skinned(Json::object()), 0.6},
      {"morph targets", morphed(), 0.7}};
  for (const double time : {2.3, 7.9}) {
    const Frame bare = drawAt(nothing, windyLook(), time);
    for (const Case& c : cases) {
      const bool hasBoat = std::string(c.what) == "on what rides" || std::string(c.what) == "joints";
      const Frame frame = drawAt(c.scene, windyLook(hasBoat ? rides : Knobs()), time);
      for (size_t v = 0; v < viewCount(); ++v) {
        int id = 0;
        for (size_t n = 0; n < c.scene.data().nodes.size(); ++n)
          if (c.scene.data().nodes[n].mesh >= 0) id = int(n) + 1;
        const Difference heights = above(frame, bare, v, id, c.height, 0.025);
        EXPECT_GT(heights.count, 400u) << c.what;
        EXPECT_EQ(heights.beyond, 0u) << c.what << " at " << time << ": " << heights.text();
      }
    }
  }
}

// Of a coarse sheet at the water's height, whose triangles cut waves' crests off.
TEST_P(Draped, theSeaMakesRoom) {
  TestScene s;
  s.add(gridMesh({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 4), s.material(named("Wake")));
  const Scene scene = s.load();
  const auto through = [&](const char* room, size_t v) {
    const Frame frame = drawAt(scene, windyLook({{"materials.Wake.drape.room", room}}), 2.3);
    size_t count = 0;
    for (int y = 0; y < kDrapedHeight; ++y)
      for (int x = 0; x < kDrapedWidth; ++x) {
        const glm::dvec4 place = texel(aov(frame, "position", v), x, y);
        count += std::max(std::abs(place.x), std::abs(place.z)) < 2 && idAt(frame, x, y, v) != 1;
      }
    return count;
  };
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_EQ(through("1", v), 0u);
    EXPECT_GT(through("0", v), 20u);
  }
}

// As under the program's own decorations: a tenth of the contrast at most, in a hole that they leave.
TEST_P(Draped, strokesAreGoneInTheirHoles) {
  TestScene s;
  const int wake = s.material(named("Wake"));
  TestMesh ring;
  for (const auto& [corner, size] : {std::pair(glm::vec2(-5, -5), glm::vec2(10, 1.2f)),
                                     {glm::vec2(-5, 3.8f), glm::vec2(10, 1.2f)},
                                     {glm::vec2(-5, -3.8f), glm::vec2(1.2f, 7.6f)},
                                     {glm::vec2(3.8f, -3.8f), glm::vec2(1.2f, 7.6f)}}) {
    const TestMesh part = gridMesh({corner.x, 0.1f, corner.y + size.y}, {size.x, 0, 0}, {0, 0, -size.y});
    for (const uint32_t index : part.indices) ring.indices.push_back(index + uint32_t(ring.positions.size()));
    ring.positions.insert(ring.positions.end(), part.positions.begin(), part.positions.end());
    ring.normals.insert(ring.normals.end(), part.normals.begin(), part.normals.end());
    ring.uvs.insert(ring.uvs.end(), part.uvs.begin(), part.uvs.end());
  }
  s.add(ring, wake);
  const Scene scene = s.load();
  const auto strokes = [&](const char* calm, size_t v) {
    const Look look = windyLook({{"ocean.wind", "0"},
                                 {"ocean.speed", "0"},
                                 {"ocean.paint.foam", "0"},
                                 {"materials.Wake.drape.calm", calm}});
    // What strokes there are is what another seed changes.
    const Stand near{{0.1f, 20, 0.2f}};
    const Frame frames[] = {drawAt(scene, look, 4, near), drawAt(scene, look, 4, near, 0, 1)};
    double sum = 0;
    size_t count = 0;
    for (int y = 0; y < kDrapedHeight; ++y)
      for (int x = 0; x < kDrapedWidth; ++x) {
        const glm::dvec4 place = texel(aov(frames[0], "position", v), x, y);
        if (std::max(std::abs(place.x), std::abs(place.z)) > 3.5 || idAt(frames[0], x, y, v) == 1) continue;
        sum += std::pow(
            glm::distance(texel(aov(frames[0], "lit", v), x, y), texel(aov(frames[1], "lit", v), x, y)), 2);
        ++count;
      }
    EXPECT_GT(count, 1000u);
    return std::sqrt(sum / double(count));
  };
  for (size_t v = 0; v < viewCount(); ++v) {
    const double without = strokes("0", v), with = strokes("1", v);
    EXPECT_GT(without, 0.005);
    EXPECT_LE(with, 0.1 * without);
  }
}

TEST_P(Draped, motionIsTheirsAndTheWaves) {
  const Scene scene = sheetScene("Wake");
  const Stand aside{{0, 6, 14}};
  const Frame still = drawAt(scene, windyLook(), 2.3, aside, 2.3),
              moves = drawAt(scene, windyLook(), 2.3, aside, 2.1),
              before = drawAt(scene, windyLook(), 2.1, aside, 2.1);
  for (size_t v = 0; v < viewCount(); ++v) {
    size_t seen = 0, moved = 0;
    Difference heights(0.06);
    const View view = viewsFrom(scene, aside, kDrapedWidth, kDrapedHeight, GetParam())[v];
    for (int y = 0; y < kDrapedHeight; ++y)
      for (int x = 0; x < kDrapedWidth; ++x) {
        if (idAt(moves, x, y, v) != 1) continue;
        ++seen;
        EXPECT_LT(glm::length(glm::dvec2(texel(aov(still, "motion", v), x, y))), 1e-3);
        const glm::dvec2 motion(texel(aov(moves, "motion", v), x, y));
        moved += glm::length(motion) > 0.05;
        // Where it was then, that lay on the waves of then.
        const int u = int(std::floor(x + 0.5 - motion.x)), w = int(std::floor(y + 0.5 - motion.y));
        if (u < 0 || w < 0 || u >= kDrapedWidth || w >= kDrapedHeight || idAt(before, u, w, v) != 1) continue;
        const glm::dvec3 at(texel(aov(before, "position", v), u, w));
        heights.add(glm::distance(pixelOf(view, at, kDrapedWidth, kDrapedHeight),
                                  glm::dvec2(x + 0.5, y + 0.5) - motion),
                    0);
      }
    EXPECT_GT(seen, 300u);
    EXPECT_GT(moved, seen / 4);
    EXPECT_GT(heights.count, seen / 2);
    EXPECT_LT(heights.mean(), 0.75) << heights.text();
  }
}

}  // namespace
}  // namespace scumble
