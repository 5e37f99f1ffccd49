#include "measure/magnify.h"

#include <gtest/gtest.h>

namespace scumble::measuring {
namespace {

glm::vec2 placeOf(const View& view, const glm::vec3& point) {
  const glm::vec4 clip = view.eyeToClip * view.worldToEye * glm::vec4(point, 1);
  return glm::vec2(clip) / clip.w;
}

TEST(Magnify, movesAwayFromTheCentre) {
  View view;
  const glm::vec2 centre(0.25f, -0.5f);
  for (const bool parallel : {false, true}) {
    view.eyeToClip = parallel ? orthographicProjection(1.5f, 1.6f, 0.1f, 10)
                              : perspectiveProjection(glm::radians(40.0f), 1.6f, 0.1f);
    const glm::vec3 point(0.4f, 0.3f, -2);
    const glm::vec2 expected = centre + 3.0f * (placeOf(view, point) - centre),
                    found = placeOf(magnified(view, 3, centre), point);
    EXPECT_NEAR(found.x, expected.x, 1e-5f);
    EXPECT_NEAR(found.y, expected.y, 1e-5f);
  }
}

TEST(Magnify, findsWhereTheSceneFillsThePicture) {
  Field seen(80, 40, 1);
  for (int y = 20; y < 36; ++y)
    for (int x = 4; x < 30; ++x) seen.valid[size_t(y * 80 + x)] = 1;
  for (int i = 0; i < 200; ++i) seen.valid[size_t(i)] = 1;  // thin, and not nearer to the middle
  const glm::vec2 centre = zoomCentre(seen, 4);
  Field shown = seen;
  shown.valid.assign(shown.valid.size(), 1);
  keepMagnified(shown, 4, centre);
  EXPECT_EQ(shown.validCount(), 20u * 10u);
  for (size_t pixel = 0; pixel < shown.pixelCount(); ++pixel) {
    if (shown.valid[pixel]) {
      EXPECT_TRUE(seen.valid[pixel]) << pixel % 80 << ", " << pixel / 80;
    }
  }
}

TEST(Magnify, staysInTheMiddleWhereAllIsAlike) {
  Field seen(80, 40, 1);
  seen.valid.assign(seen.valid.size(), 1);
  const glm::vec2 centre = zoomCentre(seen, 8);
  EXPECT_LT(std::abs(centre.x), 0.03f);
  EXPECT_LT(std::abs(centre.y), 0.06f);
}

}  // namespace
}  // namespace scumble::measuring
