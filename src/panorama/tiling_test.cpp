// How a sphere is cut into parts: every place is shown, by shares that add up, from where its eyes are.
#include "panorama/tiling.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scumble::panorama {
namespace {

constexpr uint32_t kHeight = 512;
constexpr float kPole = 0.25f * kTurn;

std::vector<Panorama> kinds() {
  return {{PanoramaKind::vr180},
          {PanoramaKind::ods},
          {PanoramaKind::mono360},
          {PanoramaKind::ods, 0.063f, 90, 2}};
}
glm::vec3 directionOf(float longitude, float latitude) {
  return turnOf(longitude, latitude) * glm::vec3(0, 0, -1);
}

// What a part has of a place.
float shareOf(const Band& band, int part, float longitude, float latitude) {
  const float up = latitude - band.latitude, towards = up < 0 ? band.below : band.above;
  const float row = towards > 0 ? shareAt(up, towards) : 1;
  if (band.parts == 1) return row;
  const float aside = std::remainder(longitude - band.longitudeOf(part), kTurn);
  return row * shareAt(aside, band.spacing());
}

TEST(Tiling, turnsLookWhereTheySay) {
  for (const float longitude : {0.0f, 1.0f, -2.5f})
    for (const float latitude : {0.0f, 0.7f, -1.2f, kPole}) {
      const glm::mat3 turn = turnOf(longitude, latitude);
      const glm::mat3 none = glm::transpose(turn) * turn;
      for (int i = 0; i < 9; ++i) EXPECT_NEAR(none[i / 3][i % 3], i % 4 == 0 ? 1 : 0, 1e-6f);
      EXPECT_NEAR(glm::determinant(turn), 1, 1e-6f);
      const glm::vec3 ahead = turn * glm::vec3(0, 0, -1);
      // Longitudes grow to the right, latitudes upwards.
      EXPECT_NEAR(ahead.x, std::sin(longitude) * std::cos(latitude), 1e-6f);
      EXPECT_NEAR(ahead.y, std::sin(latitude), 1e-6f);
      EXPECT_NEAR(ahead.z, -std::cos(longitude) * std::cos(latitude), 1e-6f);
      // What is to the right lies level, and an eye's place is there.
      EXPECT_NEAR(turn[0].y, 0, 1e-6f);
      EXPECT_NEAR(glm::distance(placeOf(longitude, 0.03f), 0.03f * turn[0]), 0, 1e-7f);
    }
}

TEST(Tiling, sharesAddUpToOneAndFramesShowThem) {
  for (const Panorama& panorama : kinds()) {
    const Tiling tiling = tilingOf(panorama, kHeight);
    const float margin = glm::radians(panorama.knobHeight) * 40 / 1080;  // at least, where filters look
    int shown = 0;
    for (int i = 0; i < 97; ++i)
      for (int j = 0; j <= 60; ++j) {
        const float longitude = kTurn * (float(i) / 97 - 0.5f), latitude = kPole * (float(j) / 30 - 1);
        const glm::vec3 direction = directionOf(longitude, latitude);
        float sum = 0;
        for (const Band& band : tiling.bands)
          for (int part = 0; part < band.parts; ++part) {
            const float share = shareOf(band, part, longitude, latitude);
            sum += share;
            if (share <= 0) continue;
            ++shown;
            const glm::vec3 d = glm::transpose(turnOf(band.longitudeOf(part), band.latitude)) * direction;
            ASSERT_LT(d.z, 0);
            const glm::vec2 reach = 0.5f * glm::vec2(band.size) / tiling.pixelsOfRadian;
            EXPECT_LE(std::abs(d.x / d.z) + margin, reach.x);
            EXPECT_LE(std::abs(d.y / d.z) + margin, reach.y);
          }
        ASSERT_NEAR(sum, 1, 1e-4f) << longitude << ", " << latitude;
      }
    EXPECT_GT(shown, 97 * 61);
  }
}

// Eyes are as far apart as they are up to 40 degrees, and one overhead.
TEST(Tiling, eyesDrawTogetherTowardsThePoles) {
  float before = 1;
  for (int degrees = 0; degrees <= 90; ++degrees) {
    const float now = easing(glm::radians(float(degrees)));
    EXPECT_EQ(now, easing(-glm::radians(float(degrees))));
    EXPECT_LE(now, before);
    if (degrees <= 40) {
      EXPECT_EQ(now, 1);
    }
    if (degrees >= 85) {
      EXPECT_EQ(now, 0);
    }
    before = now;
  }
  const Tiling tiling = tilingOf({PanoramaKind::ods}, kHeight);
  for (const Band& band : tiling.bands) EXPECT_EQ(band.eyes, 0.5f * 0.063f * easing(band.latitude));
  for (const Band& band : tilingOf({PanoramaKind::mono360}, kHeight).bands) EXPECT_EQ(band.eyes, 0);
}

// From part to part an eye steps along the way it looks, so that what is level does not move at all; what
// moves up or down by that does so by no more than a strip's at 45 degrees.
TEST(Tiling, stepsBetweenPartsAreSmallWhereTheyAreSeen) {
  for (const float strip : {6.0f, 3.0f}) {
    const Tiling tiling = tilingOf({PanoramaKind::ods, 0.063f, 90, strip}, kHeight);
    const float most = 0.5f * 0.063f * glm::radians(strip) * std::sin(0.5f * kPole);
    for (const Band& band : tiling.bands) {
      const float farthest =
          std::min(std::abs(band.latitude) + kShareEnds * std::max(band.below, band.above), kPole);
      if (band.parts > 1) {
        EXPECT_LE(std::sin(farthest) * band.eyes * band.spacing(), 1.001f * most);
      }
    }
  }
  // Half of it takes about twice as many frames.
  RenderOptions options;
  options.width = 1024, options.height = kHeight;
  const auto frames = [&](float strip) {
    return double(planPanorama({PanoramaKind::ods, 0.063f, 90, strip}, options)->frames);
  };
  EXPECT_NEAR(frames(1.5f) / frames(3), 2, 0.1);
}

}  // namespace
}  // namespace scumble::panorama
