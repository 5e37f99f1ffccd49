// The beacon hangs where its knobs say, casts a shadow, moves with time, and costs nothing where it is not
// shown.
#include "scumble/check.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::sample {
namespace {

using namespace test;

class Beacons : public BothEyes {
 protected:
  static constexpr int kWidth = 64, kHeight = 48;

  struct Seen {
    size_t pixels = 0;
    double height = 0;  // of their middle, pixels from above
  };
  // What the object of the feature covers.
  Seen seenWith(const Knobs& knobs, double time, size_t view) {
    const Scene scene = stillLife().load();
    const auto views = viewsFrom(scene, {{0, 4, 16}, {0, 2, 0}, 40}, kWidth, kHeight, GetParam());
    Result<Frame> frame =
        renderer().render(scene, quietLook(knobs), time, views, sized(kWidth, kHeight, {"id"}));
    if (!frame) throw std::runtime_error(frame.error().message());
    Seen seen;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const int id = int(texel(aov(*frame, "id", view), x, y).x);
        if (id == 0 || frame->objects.at(size_t(id - 1)) != "Beacon") continue;
        ++seen.pixels;
        seen.height += y;
      }
    if (seen.pixels > 0) seen.height /= double(seen.pixels);
    return seen;
  }
};
INSTANTIATE_BOTH_EYES(Beacons);

TEST_P(Beacons, hangsWhereItsKnobsSay) {
  for (size_t view = 0; view < viewCount(); ++view) {
    EXPECT_EQ(seenWith({}, 0, view).pixels, 0u);
    const Seen low = seenWith({{"sample.shown", "on"}, {"sample.height", "0.3"}}, 0, view),
               high = seenWith({{"sample.shown", "on"}, {"sample.height", "0.8"}}, 0, view);
    EXPECT_GT(low.pixels, 5u);
    EXPECT_GT(high.pixels, 5u);
    EXPECT_LT(high.height, low.height - 2);
  }
}

TEST_P(Beacons, goesUpAndDown) {
  const Knobs knobs{{"sample.shown", "on"}, {"sample.sways", "1"}};
  for (size_t view = 0; view < viewCount(); ++view) {
    const Seen at = seenWith(knobs, 0, view), up = seenWith(knobs, 1, view), down = seenWith(knobs, 3, view),
               again = seenWith(knobs, 4, view);
    EXPECT_LT(up.height, at.height - 1);
    EXPECT_GT(down.height, at.height + 1);
    EXPECT_EQ(again.pixels, at.pixels);
    EXPECT_DOUBLE_EQ(again.height, at.height);
  }
}

TEST_P(Beacons, whatIsSetOfOneThatIsNotShownIsFound) {
  Look look = quietLook({{"sample.height", "1"}});
  const std::vector<Finding> findings = check(stillLife().load(), look);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, Finding::Kind::notThere);
  EXPECT_EQ(findings[0].setting, "sample");
  EXPECT_NE(findings[0].problem.find("sample.shown=on"), std::string::npos);
}

}  // namespace
}  // namespace scumble::sample
