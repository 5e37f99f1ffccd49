// Marks that are known to stay, to come and to go.
#include "measure/mark_lives.h"

#include <gtest/gtest.h>

#include "measure/test_fields.h"

namespace scumble::measuring {
namespace {

using namespace test;

constexpr int kSide = 128;
constexpr double kZoom = 1.05;
const glm::vec2 kCentre(0.2f, -0.3f);

struct Disc {
  double x, y, radius;  // pixels
};
Field discs(const std::vector<Disc>& all) {
  return fieldFrom(kSide, kSide, [&](double x, double y) {
    double most = 0;
    for (const Disc& disc : all)
      most = std::max(most, std::hypot(x - disc.x, y - disc.y) < disc.radius ? 1.0 : 0.0);
    return most;
  });
}
Disc magnified(const Disc& disc) {
  const auto along = [](double at, float fixed) {
    const double still = (double(fixed) + 1) / 2 * kSide;
    return still + (at - still) * kZoom;
  };
  return {along(disc.x, kCentre.x), along(disc.y, kCentre.y), disc.radius * kZoom};
}
MarkCount count(const std::vector<Disc>& before, const std::vector<Disc>& after) {
  return countMarks(discs(before), discs(after), kZoom, kCentre, 0.5f);
}

const Disc kOne{40, 40, 6}, kOther{90, 70, 4}, kThird{60, 100, 5};

TEST(MarkLives, whatIsMagnifiedLives) {
  const MarkCount lives = count({kOne, kOther}, {magnified(kOne), magnified(kOther)});
  EXPECT_EQ(lives.marksBefore, 2u);
  EXPECT_EQ(lives.died, 0u);
  EXPECT_EQ(lives.born, 0u);
  // Smaller than it was, or beside where it was, it lives as well.
  Disc small = magnified(kOne);
  small.radius = 1;
  EXPECT_EQ(count({kOne}, {small}).died, 0u);
  EXPECT_EQ(count({kOne}, {small}).born, 0u);
}

TEST(MarkLives, whatGoesAndComesIsCounted) {
  const MarkCount gone = count({kOne, kOther}, {magnified(kOne)});
  EXPECT_EQ(gone.marksBefore, 2u);
  EXPECT_EQ(gone.died, 1u);
  EXPECT_EQ(gone.born, 0u);
  const MarkCount come = count({kOne}, {magnified(kOne), kOther, kThird});
  EXPECT_EQ(come.marksBefore, 1u);
  EXPECT_EQ(come.died, 0u);
  EXPECT_EQ(come.marksAfter, 3u);
  EXPECT_EQ(come.born, 2u);
}

// What is smaller than a dozen pixels comes and goes with the grid.
TEST(MarkLives, specksAreNoMarks) {
  const MarkCount lives = count({kOne, {80, 30, 1.5}}, {magnified(kOne), {30, 90, 1.5}});
  EXPECT_EQ(lives.marksBefore, 1u);
  EXPECT_EQ(lives.marksAfter, 1u);
  EXPECT_EQ(lives.died + lives.born, 0u);
}

// A mark that another one only touches at its rim is not that one.
TEST(MarkLives, aMarkLivesInItsMiddle) {
  Disc beside = magnified(kOne);
  beside.x += 9;
  EXPECT_EQ(count({kOne}, {beside}).died, 1u);
  beside.x -= 7;
  EXPECT_EQ(count({kOne}, {beside}).died, 0u);
}

// What is magnified out of the picture has not died.
TEST(MarkLives, theBorderDoesNotCount) {
  const MarkCount lives = count({{2, 60, 1.5}, {60, 0, 5}}, {});
  EXPECT_EQ(lives.marksBefore, 0u);
  EXPECT_EQ(lives.died, 0u);
  Field before = discs({kOne, kOther});
  const Field after = discs({});
  before.valid[size_t(40) * kSide + 46] = 0;  // beside the one
  EXPECT_EQ(countMarks(before, after, kZoom, kCentre, 0.5f).died, 1u);
}

}  // namespace
}  // namespace scumble::measuring
