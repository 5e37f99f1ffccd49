// What a look makes of clips: how long poses stand, which clips play, and what names which hold.
#include "stage/playing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scumble/look.h"
#include "scumble/scene.h"
#include "tests/support/test_gltf.h"

namespace scumble::stage {
namespace {

using scene::SceneData;
using scene::TestGltf;
using Json = TestGltf::Json;

TEST(Playing, aHeldPoseBeginsOnItsGrid) {
  for (int hold = 1; hold <= 24; ++hold)
    for (int frame = -200; frame <= 2000; ++frame) {
      const int first = int(std::floor(double(frame) / hold)) * hold;
      // However the time was come by.
      for (const double time : {frame / 24.0, frame * (1 / 24.0), double(float(frame) / 24.0f)})
        ASSERT_DOUBLE_EQ(heldTime(time, hold), first / 24.0) << "frame " << frame << " held for " << hold;
      ASSERT_DOUBLE_EQ(heldTime((frame + 0.5) / 24, hold), first / 24.0);
      ASSERT_DOUBLE_EQ(heldTime((frame + 0.99) / 24, hold), first / 24.0);
    }
  // Far from the beginning, in whole frames.
  for (int64_t frame = 23'000'000; frame < 23'000'100; ++frame) {
    const int64_t held = frame / 2 * 2;
    EXPECT_DOUBLE_EQ(heldTime(double(frame) / 24, 2), double(held) / 24);
  }
}

TEST(Playing, noHoldIsTheTimeItself) {
  for (const double time : {-3.7, 0.0, 1 / 60.0, 12.3456789}) EXPECT_EQ(heldTime(time, 0), time);
}

// At other rates: the same drawing as long as the grid's, never one from the future.
TEST(Playing, otherRatesShareTheGrid) {
  for (const int rate : {25, 30, 60, 90, 120})
    for (int hold = 1; hold <= 24; ++hold)
      for (int frame = -3 * rate; frame <= 20 * rate; ++frame) {
        const double time = double(frame) / rate, held = heldTime(time, hold);
        // In whole numbers: floor(24 frame / rate / hold) hold.
        const double drawing = std::floor(double(24 * frame) / (rate * hold) + 1e-9);
        ASSERT_DOUBLE_EQ(held, drawing * hold / 24) << frame << " at " << rate << ", held for " << hold;
        ASSERT_LE(held, time + 1e-5);
        ASSERT_GT(held, time - hold / 24.0 - 1e-5);
        ASSERT_DOUBLE_EQ(heldTime(held, hold), held) << "a held time is held";
      }
}

// A quad on a node; below it two more; a clip for each name, which moves the first.
SceneData sceneWith(const std::vector<std::string>& clips) {
  TestGltf g;
  g.addQuad()["material"] = 0;
  g.json["materials"] = {{{"name", "Cloth"}}, {{"name", "Skin"}}};
  Json other = g.json["meshes"][0];
  other["primitives"][0]["material"] = 1;
  g.json["meshes"].push_back(other);
  g.json["nodes"] = {{{"name", "Boat"}, {"mesh", 0}, {"children", {1, 3}}},
                     {{"name", "Mast"}, {"children", {2}}},
                     {{"name", "Flag.tip"}, {"mesh", 1}},
                     {{"name", "Gull"}, {"mesh", 1}}};
  g.json["scenes"] = {{{"nodes", {0}}}};
  const int times = g.addFloats({0, 1}, 1), values = g.addFloats({0, 0, 0, 1, 0, 0}, 3);
  for (const std::string& name : clips)
    g.json["animations"].push_back(
        {{"name", name},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", times}, {"output", values}}}}});
  const std::string text = g.glb();
  const Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "test.glb", "");
  EXPECT_TRUE(scene.ok()) << scene.error().message();
  return scene.ok() ? scene->data() : SceneData();
}

Look lookWith(const std::string& json, const std::vector<std::pair<std::string, std::string>>& byHand = {}) {
  Result<Look> look = Look::fromJson(json, "test.json");
  EXPECT_TRUE(look.ok()) << look.error().message();
  Look result = look.ok() ? look.value() : Look();
  for (const auto& [path, value] : byHand) {
    const Status set = result.set(path, value);
    EXPECT_TRUE(set.ok()) << set.error().message();
  }
  return result;
}

std::vector<std::pair<int, float>> played(const SceneData& scene, const Look& look, double time = 0) {
  std::vector<std::pair<int, float>> result;
  for (const scene::PlayedClip& clip : playedClips(scene, look.data().at(time)))
    result.emplace_back(clip.clip, clip.weight);
  return result;
}
using Played = std::vector<std::pair<int, float>>;

TEST(Playing, theFirstClipOfEachFilePlaysWhereNoneIsNamed) {
  SceneData scene = sceneWith({"Walk", "Run", "Sleep", "Walk"});
  EXPECT_EQ(played(scene, Look()), (Played{{0, 1}}));
  EXPECT_EQ(everPlayed(scene, Look().data()), std::vector<int>{0});
  scene.clips[1].file = 1, scene.clips[2].file = 1, scene.clips[3].file = 3;
  EXPECT_EQ(played(scene, Look()), (Played{{0, 1}, {1, 1}, {3, 1}}));
  EXPECT_EQ(everPlayed(scene, Look().data()), (std::vector<int>{0, 1, 3}));
  // A setting for clips that are not there, or of another knob, names none.
  EXPECT_EQ(played(scene, lookWith(R"({"clips": {"Fly": {"play": {"weight": 1}}}})")),
            (Played{{0, 1}, {1, 1}, {3, 1}}));
  EXPECT_EQ(played(scene, lookWith(R"({"clips": {"Run": {"play": {"speed": 2}}}})")).size(), 3u);
  EXPECT_TRUE(played(sceneWith({}), Look()).empty());
}

TEST(Playing, combinedScenesKeepTheirFiles) {
  TestGltf g;
  g.addQuad();
  const int times = g.addFloats({0, 1}, 1), values = g.addFloats({0, 0, 0, 1, 0, 0}, 3);
  for (const char* name : {"a", "b"})
    g.json["animations"].push_back(
        {{"name", name},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", times}, {"output", values}}}}});
  TestGltf still;
  still.addQuad();
  const auto load = [](const TestGltf& gltf) {
    const std::string text = gltf.glb();
    return Scene::loadFromMemory(text.data(), text.size(), "test.glb", "").value();
  };
  const Scene moves = load(g), stands = load(still);
  EXPECT_EQ(played(Scene::combine({stands, moves, stands, moves}).data(), Look()), (Played{{0, 1}, {2, 1}}));
  const Scene pair = Scene::combine({moves, moves});
  EXPECT_EQ(played(Scene::combine({pair, moves}).data(), Look()), (Played{{0, 1}, {2, 1}, {4, 1}}));
}

TEST(Playing, namedClipsPlayAlone) {
  SceneData scene = sceneWith({"Walk", "Run", "Walk slow"});
  scene.clips[2].file = 1;
  EXPECT_EQ(played(scene, lookWith(R"({"clips": {"Run": {"play": {"weight": 0.5}}}})")), (Played{{1, 0.5f}}));
  EXPECT_EQ(played(scene, lookWith(R"({"clips": {"Walk*": {"play": {"weight": 0.5}}}})")),
            (Played{{0, 0.5f}, {2, 0.5f}}));
  // Named to stand still: none plays.
  EXPECT_TRUE(played(scene, lookWith(R"({"clips": {"Walk": {"play": {"weight": 0}}}})")).empty());
  const Look set = lookWith(R"({"clips": {"*": {"play": {"weight": 1, "speed": -2, "start": 0.5}},
                                          "Run": {"play": {"weight": 0.25, "repeat": "ping-pong"}}}})",
                            {{"clips.Walk.play.weight", "0"}, {"clips.Run.play.start", "3"}});
  const auto clips = playedClips(scene, set.data().at(0));
  ASSERT_EQ(clips.size(), 2u);
  EXPECT_EQ(clips[0].clip, 1);
  EXPECT_EQ(clips[0].weight, 0.25f);
  EXPECT_EQ(clips[0].speed, -2);
  EXPECT_EQ(clips[0].start, 3);
  EXPECT_EQ(clips[0].repeat, scene::Repeat::pingPong);
  EXPECT_EQ(clips[1].clip, 2);
  EXPECT_EQ(clips[1].start, 0.5);
  EXPECT_EQ(clips[1].repeat, scene::Repeat::loop);
  EXPECT_EQ(
      playedClips(scene,
                  lookWith(R"({"clips": {"Walk": {"play": {"weight": 1, "repeat": "once"}}}})").data())[0]
          .repeat,
      scene::Repeat::once);
}

TEST(Playing, weightsThatChangeWithTime) {
  const SceneData scene = sceneWith({"Walk", "Run", "Sleep"});
  const Look look = lookWith(
      R"({"clips": {"Walk": {"play": {"weight": {"keys": [[2, 1], [3, 0]]}}},
                    "Run": {"play": {"weight": {"keys": [[2, 0], [3, 1], [4, 0]]}}}}})");
  EXPECT_EQ(played(scene, look, 0), (Played{{0, 1}}));
  EXPECT_EQ(played(scene, look, 2.25), (Played{{0, 0.75f}, {1, 0.25f}}));
  EXPECT_EQ(played(scene, look, 3), (Played{{1, 1}}));
  EXPECT_TRUE(played(scene, look, 9).empty());
  EXPECT_EQ(everPlayed(scene, look.data()), (std::vector<int>{0, 1}));
  // Whatever plays at some time is among them, of any kind of track.
  for (const char* kind : {"linear", "step", "cubic"})
    for (const char* repeat : {"true", "false"}) {
      const Look other = lookWith(
          std::string(R"({"clips": {"*": {"play": {"weight": {"interpolation": ")") + kind +
          R"(", "repeat": )" + repeat +
          R"(, "keys": [[1, 0], [2, 0], [3, 0.5], [4, 0], [5, 0]]}}}, "Run": {"play": {"weight": 0}}}})");
      const std::vector<int> ever = everPlayed(scene, other.data());
      EXPECT_EQ(ever, (std::vector<int>{0, 2}));
      for (double time = -3; time < 9; time += 0.05)
        for (const auto& [clip, weight] : played(scene, other, time))
          EXPECT_TRUE(std::find(ever.begin(), ever.end(), clip) != ever.end()) << kind << " at " << time;
    }
  // By hand it stands still at all times.
  EXPECT_EQ(
      everPlayed(scene, lookWith(R"({"clips": {"Run": {"play": {"weight": {"keys": [[0, 0], [1, 1]]}}}}})",
                                 {{"clips.Run.play.weight", "0"}, {"clips.Sleep.play.weight", "1"}})
                            .data()),
      std::vector<int>{2});
}

std::vector<int> holds(const SceneData& scene, const std::string& json,
                       const std::vector<std::pair<std::string, std::string>>& byHand = {}) {
  return namedHolds(scene, lookWith(json, byHand).data());
}

TEST(Playing, holdsOfNodesAndMaterials) {
  const SceneData scene = sceneWith({"Walk"});
  // Boat (Cloth), Mast, Flag.tip (Skin) below it, Gull (Skin); in what order siblings come is the importer's.
  const auto of = [&](const std::vector<int>& all, const std::string& name) {
    for (size_t n = 0; n < scene.nodes.size(); ++n)
      if (scene.nodes[n].name == name) return all[n];
    return -99;
  };
  const auto expectHolds = [&](const std::vector<int>& all, int boat, int mast, int flag, int gull) {
    EXPECT_EQ(of(all, "Boat"), boat);
    EXPECT_EQ(of(all, "Mast"), mast);
    EXPECT_EQ(of(all, "Flag.tip"), flag);
    EXPECT_EQ(of(all, "Gull"), gull);
  };
  expectHolds(holds(scene, "{}"), -1, -1, -1, -1);
  expectHolds(holds(scene, R"({"animation": {"hold": 5}})"), -1, -1, -1, -1);  // the scene's names no node
  expectHolds(holds(scene, R"({"nodes": {"Gull": {"animation": {"hold": 3}}}})"), -1, -1, -1, 3);
  expectHolds(holds(scene, R"({"nodes": {"Mast": {"animation": {"hold": 3}}}})"), -1, 3, 3, -1);
  expectHolds(holds(scene, R"({"nodes": {"Boat": {"animation": {"hold": 3}}}})"), 3, 3, 3, 3);
  expectHolds(holds(scene, R"({"nodes": {"Boat": {"animation": {"hold": 3}},
                                         "Mast": {"animation": {"hold": 0}}}})"),
              3, 0, 0, 3);
  expectHolds(
      holds(scene, R"({"nodes": {"*": {"animation": {"hold": 4}}, "F*": {"animation": {"hold": 1}}}})"), 4, 4,
      1, 4);
  expectHolds(holds(scene, R"({"materials": {"Skin": {"animation": {"hold": 6}}}})"), -1, -1, 6, 6);
  expectHolds(holds(scene, R"({"materials": {"Skin": {"animation": {"hold": 6}}},
                               "nodes": {"Mast": {"animation": {"hold": 3}}}})"),
              -1, 3, 3, 6);
  expectHolds(holds(scene, R"({"materials": {"*": {"animation": {"hold": 6}}},
                               "nodes": {"Gull": {"animation": {"hold": 2}}}})"),
              6, -1, 6, 2);
  // By hand, with a dot in the name; later ones win.
  expectHolds(holds(scene, R"({"nodes": {"*": {"animation": {"hold": 4}}}})",
                    {{"nodes.Flag.tip.animation.hold", "7"}, {"nodes.Mast.animation.hold", "9"}}),
              4, 9, 7, 4);
}

}  // namespace
}  // namespace scumble::stage
