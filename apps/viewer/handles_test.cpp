// What is added to looks, and a camera's keys against the views that they give.
#include "handles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "knob_text.h"
#include "tests/support/loaded_test_gltf.h"

namespace scumble::viewer {
namespace {

Look with(Look look, const Edits& edits) {
  for (const auto& [path, value] : edits) {
    const Status status = look.set(path, value);
    EXPECT_TRUE(status.ok()) << path << "=" << value << ": " << status.error().message();
  }
  return look;
}

TEST(VisibleHandles, whatIsAddedHasANameOfItsOwnAndAPlace) {
  ASSERT_GE(addables().size(), 6u);
  Look look;
  std::set<std::string> sections;
  int sized = 0;
  for (const Addable& what : addables()) {
    sections.insert(what.section);
    std::set<std::string> names;
    for (int time = 0; time < 3; ++time) {
      const Added made = added(what, look, {1, 2, -3.00001f}, 0.7f);
      look = with(look, made.edits);
      EXPECT_EQ(made.target.section, what.section);
      EXPECT_TRUE(names.insert(made.target.name).second) << made.target.name;
      const std::vector<std::string> declared = look.names(what.section);
      EXPECT_EQ(declared.back(), made.target.name);
      // Its kind, its place and its size are told in a few digits.
      EXPECT_TRUE(std::any_of(made.edits.begin(), made.edits.end(),
                              [&](const auto& edit) { return edit.second == what.word; }));
      EXPECT_TRUE(std::any_of(made.edits.begin(), made.edits.end(),
                              [&](const auto& edit) { return edit.second == "1,2,-3"; }));
      sized += std::any_of(made.edits.begin(), made.edits.end(),
                           [&](const auto& edit) { return edit.second == "0.7"; });
    }
  }
  EXPECT_TRUE(sections.count("colorizers"));
  EXPECT_GE(sized, 3 * 3) << "spheres, capsules and half-spaces at least";
  // In a scene of millimetres too.
  const Added small = added(addables().front(), Look(), {0, 0, 0}, 0.003f);
  with(Look(), small.edits);
  EXPECT_TRUE(std::any_of(small.edits.begin(), small.edits.end(),
                          [](const auto& edit) { return edit.second == "0.003"; }));
}

// The look's camera stands where the hand's did.
TEST(VisibleHandles, aCameraIsKeptWhereItStands) {
  const Scene scene = loaded(scene::quad());
  Viewpoint hand;
  hand.eye = {3, 2, 4}, hand.target = {0.25f, 0.5f, -0.125f}, hand.roll = 12.0f, hand.verticalFov = 40.0f;
  Viewpoint later = hand;
  later.eye = {-2, 1, 3}, later.roll = -5.0f, later.verticalFov = 28.0f;
  Look look;
  for (const auto& [viewpoint, time] : {std::pair(hand, 1.0), std::pair(later, 3.0)}) {
    const Result<Turn> turn = cameraKeyed(scene, look, viewpoint, time);
    ASSERT_TRUE(turn.ok());
    look = with(look, turn->edits);
  }
  for (const auto& [viewpoint, time] : {std::pair(hand, 1.0), std::pair(later, 3.0), std::pair(later, 9.0)}) {
    const auto wanted = makeViews(scene, viewpoint, 1.5f),
               seen = makeViews(scene, {}, 1.5f, Stereo::mono, 0.063f, look, time);
    ASSERT_TRUE(wanted.ok() && seen.ok());
    for (int i = 0; i < 16; ++i) {
      EXPECT_NEAR(wanted->front().worldToEye[i / 4][i % 4], seen->front().worldToEye[i / 4][i % 4], 1e-4f);
      EXPECT_NEAR(wanted->front().eyeToClip[i / 4][i % 4], seen->front().eyeToClip[i / 4][i % 4], 1e-4f);
    }
  }
  const auto between = makeViews(scene, {}, 1.5f, Stereo::mono, 0.063f, look, 2);
  ASSERT_TRUE(between.ok());
  const glm::vec3 eye(glm::inverse(between->front().worldToEye)[3]);
  EXPECT_LT(glm::distance(eye, {0.5f, 1.5f, 3.5f}), 1e-3f) << "half way";
  EXPECT_FALSE(cameraKeyed(Scene(), look, hand, 0).ok());
}

}  // namespace
}  // namespace scumble::viewer
