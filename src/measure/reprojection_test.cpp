#include "measure/reprojection.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "measure/statistics.h"
#include "measure/test_fields.h"
#include "scumble/view.h"

namespace scumble::measuring {
namespace {

using namespace test;

constexpr int kSize = 64;

// A wall at 10 m across the picture and a narrower one before it at 5 m, seen from (x, 0, 0) along -z.
struct Walls {
  View view;
  Surface surface;
  Field pattern{kSize, kSize, 1};  // attached to the walls
  explicit Walls(float x) : surface{Field(kSize, kSize, 3), Field(kSize, kSize, 1)} {
    view.worldToEye = glm::translate(glm::mat4(1.0f), glm::vec3(-x, 0, 0));
    view.eyeToClip = perspectiveProjection(glm::radians(40.0f), 1, 0.1f);
    const float perMetre = std::tan(glm::radians(20.0f)) * 2 / kSize;
    surface.pixel = perMetre;
    for (size_t pixel = 0; pixel < surface.position.pixelCount(); ++pixel) {
      const size_t column = pixel % kSize, row = pixel / kSize;
      const float rayX = (float(column) + 0.5f - 0.5f * kSize) * perMetre,
                  rayY = -(float(row) + 0.5f - 0.5f * kSize) * perMetre;
      const float depth = std::abs(rayX * 5 + x) < 0.6f ? 5.0f : 10.0f;
      const glm::vec3 point(rayX * depth + x, rayY * depth, -depth);
      for (int c = 0; c < 3; ++c) surface.position.at(pixel)[c] = point[c];
      *surface.depth.at(pixel) = depth;
      *pattern.at(pixel) = std::sin(3 * point.x) + std::sin(2 * point.y + point.z);
      surface.position.valid[pixel] = surface.depth.valid[pixel] = pattern.valid[pixel] = 1;
    }
  }
};

Field motionOf(const Surface& now, const View& view, const View& earlier) {
  Field motion(kSize, kSize, 2);
  motion.valid.assign(motion.pixelCount(), 1);
  for (size_t pixel = 0; pixel < motion.pixelCount(); ++pixel) {
    const float* p = now.position.at(pixel);
    const auto place = [&](const View& v) {
      const glm::vec4 clip = v.eyeToClip * v.worldToEye * glm::vec4(p[0], p[1], p[2], 1);
      return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * float(kSize);
    };
    const glm::vec2 moved = place(view) - place(earlier);
    motion.at(pixel)[0] = moved.x, motion.at(pixel)[1] = moved.y;
  }
  return motion;
}

TEST(Reprojection, whatIsAttachedToTheSurfaceDoesNotChange) {
  const Walls earlier(0), now(0.37f);
  for (const Places& places :
       {placesByMotion(motionOf(now.surface, now.view, earlier.view), now.surface, earlier.surface),
        placesByProjection(now.surface, earlier.surface, earlier.view.eyeToClip * earlier.view.worldToEye)}) {
    const FieldDifference moved = difference(sampleAt(earlier.pattern, places), now.pattern);
    EXPECT_GT(moved.pixels, size_t(kSize * kSize / 3));
    EXPECT_LT(moved.relative, 0.01);
  }
  EXPECT_GT(difference(earlier.pattern, now.pattern).relative, 0.3);
}

TEST(Reprojection, whatWasHiddenDoesNotCount) {
  const Walls earlier(0), now(1);
  const Places places =
      placesByProjection(now.surface, earlier.surface, earlier.view.eyeToClip * earlier.view.worldToEye);
  const float edge = 0.6f;  // seen from 0, the near wall hides twice its size of the far one
  for (size_t pixel = 0; pixel < places.pixelCount(); ++pixel) {
    const float* p = now.surface.position.at(pixel);
    if (p[2] > -9) continue;
    if (std::abs(p[0]) < 2 * edge - 0.2f) {
      EXPECT_FALSE(places.valid[pixel]) << p[0];
    }
    const bool inPicture = std::abs(p[0]) < 3 && std::abs(p[1]) < 3;
    if (std::abs(p[0]) > 2 * edge + 0.5f && inPicture) {
      EXPECT_TRUE(places.valid[pixel]) << p[0];
    }
  }
}

TEST(Reprojection, emptyPixelsDoNotCount) {
  Walls earlier(0), now(0);
  earlier.surface.position.valid[20 * kSize + 20] = 0;
  now.surface.position.valid[40 * kSize + 40] = 0;
  const Places places =
      placesByProjection(now.surface, earlier.surface, earlier.view.eyeToClip * earlier.view.worldToEye);
  EXPECT_FALSE(places.valid[20 * kSize + 20]);
  EXPECT_FALSE(places.valid[40 * kSize + 40]);
  EXPECT_TRUE(places.valid[30 * kSize + 12]);
}

// A wall across the picture, a pixel of which covers `pixel` metres, in a parallel projection or at `depth`.
Surface wallOf(float pixel, bool parallel, float depth) {
  Surface surface{Field(16, 16, 3), Field(16, 16, 1), parallel ? pixel : pixel / depth, parallel};
  for (size_t i = 0; i < surface.position.pixelCount(); ++i) {
    const size_t column = i % 16, row = i / 16;
    surface.position.at(i)[0] = pixel * (float(column) + 0.5f);
    surface.position.at(i)[1] = pixel * float(row);
    *surface.depth.at(i) = depth;
    surface.position.valid[i] = surface.depth.valid[i] = 1;
  }
  return surface;
}
bool isFollowed(const Surface& now, const Surface& earlier) {
  Field still(16, 16, 2);
  still.valid.assign(still.pixelCount(), 1);
  return placesByMotion(still, now, earlier).valid[8 * 16 + 8];
}

TEST(Reprojection, pointsAreTheSameWithinTwoFootprints) {
  for (const bool parallel : {false, true})
    for (const float pixel : {0.01f, 5.0f}) {
      const Surface now = wallOf(pixel, parallel, 40);
      for (const auto& [footprints, same] : {std::pair(0.0f, true), {2.15f, true}, {2.25f, false}}) {
        Surface earlier = now;
        for (size_t i = 0; i < earlier.position.pixelCount(); ++i)
          earlier.position.at(i)[2] += footprints * pixel;
        EXPECT_EQ(isFollowed(now, earlier), same) << parallel << pixel << " " << footprints;
      }
    }
}

TEST(Reprojection, noEdgeIsAmongThePixelsOfTheKernel) {
  // Pixel 8 at its centre takes 6 to 11 along each axis.
  for (const bool parallel : {false, true})
    for (int x = 0; x < 16; ++x)
      for (const bool across : {false, true}) {
        const Surface now = wallOf(0.1f, parallel, 40);
        Surface earlier = now;
        *earlier.depth.at(size_t(across ? 8 * 16 + x : x * 16 + 8)) += 30 * 0.1f;
        EXPECT_EQ(isFollowed(now, earlier), x < 6 || x > 11) << x;
      }
}

}  // namespace
}  // namespace scumble::measuring
