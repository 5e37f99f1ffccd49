// Tests that draw: one renderer for the whole process, with the validation layers; a message from them fails
// the test.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "scumble/renderer.h"
#include "tests/support/test_scene.h"

namespace scumble::test {

class RenderTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  // The renderer of the process, and a second one whose image passes are of the other kind.
  static Renderer& renderer();
  static Renderer& otherRenderer();

  // A frame; throws what render() reports, which fails the test.
  static Frame draw(const Scene& scene, const Look& look, const std::vector<View>& views,
                    const RenderOptions& options);

 private:
  int messagesBefore_ = 0;
};

// The same for one view and for two.
class BothEyes : public RenderTest, public ::testing::WithParamInterface<Stereo> {
 protected:
  static size_t viewCount() { return GetParam() == Stereo::stereo ? 2 : 1; }
};
std::string stereoName(const ::testing::TestParamInfo<Stereo>& info);
#define INSTANTIATE_BOTH_EYES(suite)                                                              \
  INSTANTIATE_TEST_SUITE_P(Views, suite,                                                          \
                           ::testing::Values(::scumble::Stereo::mono, ::scumble::Stereo::stereo), \
                           ::scumble::test::stereoName)

// That two frames have the same layers and views, to the byte.
void expectSame(const Frame& a, const Frame& b, const std::string& what = "");

// Settings by their paths, as Look::set takes them.
using Knobs = std::vector<std::pair<std::string, std::string>>;

// Those of them that the program has: features may have been left out of it.
Knobs thoseThere(const Knobs& knobs);
bool hasKnob(const std::string& path);

// A look without what tests of single passes do not want: no ground, a background of the look's own colours,
// no air, no bloom. Then the given knobs.
Look quietLook(const Knobs& knobs = {});

// What a look says of a knob for the whole scene, as Look::set takes it; the default where it says nothing.
// Of knobs that are no colours.
std::string settingOf(const Look& look, const std::string& path);

// Views from an eye to a target; two eyes stand `ipd` apart. Angles in degrees.
struct Stand {
  glm::vec3 eye{0, 0, 5}, target{0, 0, 0};
  float fov = 40, roll = 0, ipd = 0.2f;
};
std::vector<View> viewsFrom(const Scene& scene, const Stand& stand, uint32_t width, uint32_t height,
                            Stereo stereo = Stereo::mono);
// A view by a parallel projection along -Z from (0, 0, 5); `halfHeight` metres above and below the origin.
View parallelView(float halfHeight, float aspect);

RenderOptions sized(uint32_t width, uint32_t height, std::vector<std::string> aovs = {},
                    uint32_t samples = 1);

}  // namespace scumble::test
