// How full a line is at a place on its edge, by numbers that follow from paper 004, section 2.4, and from
// docs/ink.md, and not from the text that is compiled for pictures.
#include <gtest/gtest.h>

#include <cmath>

#include "features/ink/fullness.shared.h"

namespace scumble::shared {
namespace {

// An outline in the open, of half a width of 4 pixels of a centimetre each, ten metres away: what lies beyond
// it is far away but for a scene of a kilometre.
InkPlace outlineBefore(float behind) {
  InkPlace place{};
  place.distance = 10, place.beyond = 10 + behind;
  place.hidden = 0, place.pixel = 0.01f, place.radius = 4;
  place.turn = {1, 0}, place.reach = 1, place.isOutline = 1;
  return place;
}
constexpr float kScene = 1000;

double eased(double t) {
  t = std::min(std::max(t, 0.0), 1.0);
  return t * t * (3 - 2 * t);
}

// "An outline is full where what lies behind it is `fade` widths behind, and tapers where that comes nearer."
TEST(InkFullness, outlinesTaperByWidthsOfWhatLiesBehind) {
  for (const float fade : {0.5f, 3.0f, 10.0f})
    for (const float part : {0.0f, 0.1f, 0.25f, 0.5f, 0.75f, 0.99f, 1.0f, 1.5f}) {
      const float width = 2 * 4 * 0.01f;
      EXPECT_NEAR(inkFullness(outlineBefore(part * fade * width), kScene, fade, 1), eased(part), 1e-4)
          << fade << " widths, " << part;
    }
  // A thinner line than a pixel tapers as one of a pixel does.
  InkPlace thin = outlineBefore(0.015f);
  thin.radius = 0.1f;
  EXPECT_NEAR(inkFullness(thin, kScene, 3, 1), eased(0.5), 1e-4);
  // Without a fade it is there or not.
  EXPECT_EQ(inkFullness(outlineBefore(1e-3f), kScene, 0, 1), 1);
  EXPECT_EQ(inkFullness(outlineBefore(-1e-3f), kScene, 0, 1), 0);
}

// The form against the world: by the part of the scene's radius that what lies behind is away.
TEST(InkFullness, outlinesBeforeTheWorldAreWiderAndWhole) {
  for (const float part : {0.05f, 0.1f, 0.2f, 0.25f, 0.3f, 0.4f, 0.5f, 0.6f, 2.0f}) {
    InkPlace place = outlineBefore(part * kScene);
    EXPECT_NEAR(inkFullness(place, kScene, 3, 1.8f), 1 + 0.8 * eased((part - 0.1) / 0.3), 1e-4) << part;
    place.turn = {0.5f, 0};
    place.reach = 0.5f;
    const double whole = eased((part - 0.2) / 0.4);
    EXPECT_NEAR(inkFullness(place, kScene, 3, 1), 0.25 + 0.75 * whole, 1e-4) << part;
  }
}

// What an edge is besides an outline is the least that is left of it; inner lines know of nothing but what
// hides them; and what is hidden is gone, whatever it is.
TEST(InkFullness, innerLinesAndHiddenOnes) {
  InkPlace closing = outlineBefore(0);
  closing.turn = {0, 0.4f};
  EXPECT_FLOAT_EQ(inkFullness(closing, kScene, 3, 1), 0.4f);
  for (const float hidden : {-5.0f, 0.9f, 1.25f, 1.5f, 1.75f, 2.0f, 9.0f})
    for (const uint32_t isOutline : {0u, 1u}) {
      InkPlace place = outlineBefore(isOutline ? 5.0f : 0.0f);
      place.isOutline = isOutline;
      place.hidden = hidden;
      EXPECT_NEAR(inkFullness(place, kScene, 3, 1), 1 - eased(hidden - 1.0), 1e-4) << hidden;
    }
}

// Something must lie before a line on both of its sides. On the form's side it is one place of two at which
// that is found; beyond an outline, where there is nothing of its own, both must have it.
TEST(InkFullness, whatHidesIsOnBothSides) {
  constexpr float kNo = 0, kYes = 3;
  for (const vec2 beyond : {vec2(kNo, kNo), vec2(kNo, kYes), vec2(kYes, kNo), vec2(kYes, kYes)})
    for (const vec2 before : {vec2(kNo, kNo), vec2(kNo, kYes), vec2(kYes, kNo), vec2(kYes, kYes)}) {
      const bool isBefore = before.x > 1 || before.y > 1;
      const bool anyBeyond = beyond.x > 1 || beyond.y > 1, allBeyond = beyond.x > 1 && beyond.y > 1;
      EXPECT_EQ(inkHidden(beyond, before, 0) > 1, isBefore && anyBeyond);
      EXPECT_EQ(inkHidden(beyond, before, 1) > 1, isBefore && allBeyond);
    }
  EXPECT_EQ(inkHidden({1.2f, 1.4f}, {1.6f, 1.8f}, 0), 1.4f);
  EXPECT_EQ(inkHidden({1.2f, 1.4f}, {1.6f, 1.8f}, 1), 1.2f);
  EXPECT_EQ(inkHidden({1.7f, 1.9f}, {1.3f, 1.5f}, 1), 1.5f);
}

// By pixels, as what they measure there; and a surface that is the edge's own hides nothing of it, however it
// leads towards the eye, but for one that is too steep to tell.
TEST(InkFullness, whatIsBeforeAnEdgeIsMeasuredInPixels) {
  constexpr float kPixel = 0.02f, kAway = 1.5f;
  const auto before = [&](float expected, float seen) {
    return inkBefore(10, expected, seen, kPixel, kAway);
  };
  // The edge's surface goes on evenly, and something else is seen before it.
  for (const float pixels : {0.25f, 0.5f, 0.75f, 1.0f, 4.0f})
    EXPECT_NEAR(before(10, 10 - pixels * kPixel), pixels / 0.5, 0.02) << pixels;
  EXPECT_LT(before(10, 12), 0) << "farther away";
  // Its own surface, rising by a pixel a pixel: exactly there, and by the tolerance off.
  const float rise = kAway * kPixel;
  EXPECT_NEAR(before(10 - rise, 10 - rise), 0, 1e-3);
  EXPECT_NEAR(before(10 - rise, 10 - rise - 0.5f * kPixel - 0.06f * rise), 1, 0.01);
  EXPECT_GT(before(10 - rise, 10 - rise - 2 * kPixel), 2) << "something before the surface as well";
  EXPECT_LE(before(10 - rise, 10 - 0.25f * kPixel), 0.51f) << "hardly before the edge: nothing before it";
  // Rising by 1.5 pixels a pixel it may still be its own; at twice that what is seen tells nothing.
  EXPECT_NEAR(before(10 - 1.5f * rise, 10 - 1.5f * rise), 0, 1e-3);
  EXPECT_GT(before(10 - 3 * rise, 10 - 3 * rise), 1);
}

TEST(InkFullness, depthsAreLinearOnTheScreenWhereASurfaceIsFlat) {
  for (const float distance : {0.1f, 3.0f, 4e4f}) {
    EXPECT_FLOAT_EQ(inkLinear(distance, 0), 1 / distance);
    EXPECT_FLOAT_EQ(inkLinear(distance, 1), distance);
    for (const float parallel : {0.0f, 1.0f})
      EXPECT_FLOAT_EQ(inkLinear(inkLinear(distance, parallel), parallel), distance);
  }
  // Along an edge, and half of it beyond, but never behind the eye.
  EXPECT_FLOAT_EQ(inkDepthAlong(0.2f, 0.4f, 0.25f), 0.25f);
  EXPECT_FLOAT_EQ(inkDepthAlong(0.2f, 0.4f, 1.25f), 0.45f);
  EXPECT_FLOAT_EQ(inkDepthAlong(0.2f, 0.4f, 7), 0.5f);
  EXPECT_FLOAT_EQ(inkDepthAlong(0.2f, 0.4f, -0.25f), 0.15f);
  EXPECT_FLOAT_EQ(inkDepthAlong(0.1f, 0.9f, -0.5f), 0.05f);
  // Beyond its ends it is no farther from them than a pixel.
  EXPECT_FLOAT_EQ(inkNoFurther(7, 10, 0.5f, 0.02f), 7);
  EXPECT_FLOAT_EQ(inkNoFurther(7, 10, 1.2f, 0.02f), 9.98f);
  EXPECT_FLOAT_EQ(inkNoFurther(12, 10, -0.2f, 0.02f), 10.02f);
  EXPECT_FLOAT_EQ(inkNoFurther(9.99f, 10, -0.2f, 0.02f), 9.99f);
}

// An outline that is drawn along a part of its edge ends softly, over 8 pixels or half of the edge.
TEST(InkFullness, outlinesEndSoftlyWhereTheyReach) {
  for (const float along : {-1.0f, 0.0f, 0.3f, 1.0f, 2.0f}) EXPECT_FLOAT_EQ(inkReach(along, {0, 1}, 100), 1);
  for (const float along : {0.0f, 0.5f, 1.0f}) EXPECT_FLOAT_EQ(inkReach(along, {1, 1}, 100), 0) << along;
  // Up to three quarters, within 8 of 100 pixels.
  const float to = 0.75f * 1.08f;
  for (const float part : {0.0f, 0.25f, 0.5f, 1.0f})
    EXPECT_NEAR(inkReach(to - 0.08f * (1 - part), {0, 0.75f}, 100), 1 - eased(part), 1e-3) << part;
  EXPECT_FLOAT_EQ(inkReach(0.4f, {0, 0.75f}, 100), 1);
  EXPECT_FLOAT_EQ(inkReach(0.9f, {0, 0.75f}, 100), 0);
  // From a quarter on, mirrored; and of an edge of 4 pixels over half of it.
  EXPECT_NEAR(inkReach(1 - to, {0.25f, 1}, 100), 0, 1e-3);
  EXPECT_NEAR(inkReach(1 - to + 0.08f, {0.25f, 1}, 100), 1, 1e-3);
  EXPECT_NEAR(inkReach(0.875f, {0, 0.75f}, 4), eased(0.5), 1e-3);
}

// A bit for each of 32 parts of an edge, between whose middles it goes over evenly.
TEST(InkFullness, partsOfAnEdgeAreSeen) {
  const uint32_t seen = 0x0000FFF0u;
  for (int part = 0; part < 32; ++part)
    EXPECT_FLOAT_EQ(inkSeen((float(part) + 0.5f) / 32, seen), part >= 4 && part < 16 ? 1 : 0) << part;
  EXPECT_NEAR(inkSeen(4.0f / 32, seen), 0.5, 1e-6);
  EXPECT_NEAR(inkSeen(15.75f / 32, seen), 0.75, 1e-6);
  EXPECT_EQ(inkSeen(-3, 1), 1);
  EXPECT_EQ(inkSeen(5, 0x80000000u), 1);
  EXPECT_EQ(inkSeen(5, 0x7FFFFFFFu), 0);
}

}  // namespace
}  // namespace scumble::shared
