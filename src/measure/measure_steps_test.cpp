// Steps of poses: how far what moves jumps, by how long it stands.
#include <cmath>

#include "scumble/measure.h"
#include "tests/support/render_test.h"

namespace scumble::measuring {
namespace {

using namespace test;

class MeasureSteps : public RenderTest {
 protected:
  // A board that goes aside by half a metre a second, before a wall that stands.
  static Scene moving(bool moves) {
    TestScene s;
    const int grey = s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})),
              red = s.material(TestScene::colored("Red", {0.8f, 0.2f, 0.2f, 1}));
    s.add(gridMesh({-3, -3, -1}, {6, 0, 0}, {0, 6, 0}, 2), grey);
    s.add(gridMesh({-0.8f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}, 2), red);
    if (moves) s.clip("Goes", {0, 2}, {{0, 0, 0}, {1, 0, 0}});
    return s.load();
  }
  static MeasureOptions small() {
    MeasureOptions options;
    options.width = 160, options.height = 120;
    options.viewpoint.eye = glm::vec3(0, 0, 5);
    options.viewpoint.target = glm::vec3(0);
    options.viewpoint.verticalFov = 40.0f;
    return options;
  }
};

TEST_F(MeasureSteps, jumpsAreAsLongAsPosesStand) {
  const Look look = quietLook({{"warp.amount", "0"}});
  const auto steps = measureSteps(renderer(), moving(true), look, {1, 2, 3, 4}, small());
  ASSERT_TRUE(steps.ok()) << steps.error().message();
  ASSERT_EQ(steps->size(), 4u);
  const double pixelsOfOne = 60 / std::tan(glm::radians(20.0));
  for (const StepMeasurements& of : *steps) {
    EXPECT_DOUBLE_EQ(of.stands, of.hold / 24.0);
    const double jump = 0.5 * of.stands * pixelsOfOne / 5;
    EXPECT_NEAR(of.jump, jump, 0.02 * jump) << of.hold;
    EXPECT_NEAR(of.farJump, jump, 0.02 * jump) << of.hold;
    EXPECT_NEAR(of.jumpDegrees, glm::degrees(std::atan(jump / pixelsOfOne)), 0.02) << of.hold;
    EXPECT_GT(of.moving, 0.03);
    EXPECT_GT(of.changes, 0);
  }
}

TEST_F(MeasureSteps, whatCannotBeMeasuredIsSaid) {
  const Look look = quietLook();
  for (const int hold : {0, -1, 25}) {
    const auto steps = measureSteps(renderer(), moving(true), look, {hold}, small());
    ASSERT_FALSE(steps.ok()) << hold;
    EXPECT_EQ(steps.error().kind, ErrorKind::usage);
  }
  const auto still = measureSteps(renderer(), moving(false), look, {1}, small());
  ASSERT_FALSE(still.ok());
  EXPECT_EQ(still.error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace scumble::measuring
