// The ocean as an object among others.
#include "tests/support/aov.h"
#include "tests/support/render_test.h"

namespace scumble::ocean {
namespace {

using namespace test;

class OceanObjects : public BothEyes {};
INSTANTIATE_BOTH_EYES(OceanObjects);

// Ground and ocean may be there at once.
TEST_P(OceanObjects, groundAndOceanHaveNamesOfTheirOwn) {
  constexpr int kWidth = 48, kHeight = 36;
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {-0.7f, 0.8f, 0.4f}}, kWidth, kHeight, GetParam());
  const auto nameBelow = [&](const char* ground, const char* level, size_t view) {
    const Frame frame = draw(scene,
                             quietLook({{"ground.mode", ground},
                                        {"ocean.mode", "on"},
                                        {"ocean.tiles", "1"},
                                        {"ocean.wind", "0"},
                                        {"ocean.level", level}}),
                             views, sized(kWidth, kHeight, {"id"}));
    const int id = int(texel(aov(frame, "id", view), 0, kHeight - 1).x);
    return id > 0 ? frame.objects.at(size_t(id - 1)) : std::string();
  };
  for (size_t view = 0; view < viewCount(); ++view) {
    EXPECT_EQ(nameBelow("on", "-100", view), "Ground");
    EXPECT_EQ(nameBelow("on", "0.5", view), "Ocean");
    EXPECT_EQ(nameBelow("auto", "0.5", view), "Ocean");
  }
}

}  // namespace
}  // namespace scumble::ocean
