#include "interface_input.h"

#include <gtest/gtest.h>

namespace scumble::viewer {
namespace {

size_t fits(std::initializer_list<Event> events) {
  return distinguishable(std::deque<Event>(events));
}

// A frame sees states: what goes down and up within one would never have happened.
TEST(InterfaceInput, aTapTakesTwoFrames) {
  EXPECT_EQ(fits({Key{65, true, false, 0}, Key{65, false, false, 0}}), 1u);
  EXPECT_EQ(fits({MouseButton{0, true, 0}, MouseButton{0, false, 0}}), 1u);
  EXPECT_EQ(fits({Key{65, true, false, 0}, Key{66, true, false, 0}}), 2u);
  EXPECT_EQ(fits({Key{65, true, false, 0}, Key{65, true, true, 0}}), 2u);
}

// The place at which a button goes down counts.
TEST(InterfaceInput, aButtonGoesDownWhereTheMouseIs) {
  EXPECT_EQ(fits({MouseMoved{{1, 1}}, MouseMoved{{2, 2}}, MouseButton{0, true, 0}}), 3u);
  EXPECT_EQ(fits({MouseButton{0, true, 0}, MouseMoved{{2, 2}}}), 1u);
  EXPECT_EQ(fits({MouseMoved{{2, 2}}, MouseButton{0, false, 0}}), 1u);
  EXPECT_EQ(fits({MouseWheel{{0, 1}}, MouseMoved{{2, 2}}}), 1u);
  EXPECT_EQ(fits({MouseWheel{{0, 1}}, MouseButton{0, true, 0}}), 1u);
}

TEST(InterfaceInput, lettersComeWithTheirKey) {
  EXPECT_EQ(fits({Key{65, true, false, 0}, Character{97}, Key{66, true, false, 0}}), 2u);
  EXPECT_EQ(fits({MouseButton{0, false, 0}, Key{65, true, false, 0}}), 1u);
  EXPECT_EQ(fits({}), 0u);
  EXPECT_EQ(fits({Dropped{{"a.glb"}}, Focus{false}}), 2u);
}

}  // namespace
}  // namespace scumble::viewer
