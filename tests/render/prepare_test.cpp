// No stalls: after prepare() no pipeline is compiled while frames run, and what prepare() has rehearsed shows
// in no picture.
#include <gtest/gtest.h>

#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

class Prepare : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 64, kHeight = 40;
  const Scene scene = stillLife().load();
  std::unique_ptr<Renderer> fresh = [] {
    RendererOptions options;
    options.device = testDevice();
    options.validation = true;
    auto made = Renderer::create(options);
    if (!made) throw std::runtime_error(made.error().message());
    return std::move(made).value();
  }();

  std::vector<View> views(uint32_t width = kWidth, uint32_t height = kHeight) const {
    return viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, width, height, GetParam());
  }
  Frame drawn(const Look& look, double time, uint32_t width = kWidth, uint32_t height = kHeight) {
    auto frame = fresh->render(scene, look, time, views(width, height), sized(width, height));
    if (!frame) throw std::runtime_error(frame.error().message());
    EXPECT_EQ(fresh->validationMessages(), 0);
    return std::move(frame).value();
  }
};
INSTANTIATE_BOTH_EYES(Prepare);

// Tracks that switch passes on and off, and go through the numbers that pipelines are made for.
Look moving() {
  const auto look = Look::fromJson(R"({
    "limit": {"palette": {"keys": [[0, "off"], [1, "dusk"]], "interpolation": "step"}},
    "final": {"ripple": {"keys": [[0, "paper"], [0.5, "layered"]], "interpolation": "step"}},
    "texture": {"amount": {"keys": [[0, 0], [2, 1]]}},
    "shadow": {"indicationSteps": {"keys": [[0, 2], [2, 6]]}}
  })",
                                   "moving.look.json");
  if (!look) throw std::runtime_error(look.error().message());
  return *look;
}

TEST_P(Prepare, nothingIsCompiledWhileTracksRun) {
  const Look look = moving();
  // Without it there is something to compile.
  EXPECT_GT(drawn(look, 0).stats.pipelines, 10u);
  EXPECT_GT(drawn(look, 1.5).stats.pipelines, 1u);
  ASSERT_TRUE(fresh->prepare(scene, look, views(), sized(kWidth, kHeight)).ok());
  for (int i = 0; i <= 40; ++i) EXPECT_EQ(drawn(look, 0.06 * i).stats.pipelines, 0u) << i;
}

TEST_P(Prepare, itsRehearsalsShowNowhere) {
  const Look look = moving();
  std::vector<Frame> before;
  for (const double time : {0.0, 0.7, 1.6}) before.push_back(drawn(look, time));
  ASSERT_TRUE(fresh->prepare(scene, look, views(), sized(kWidth, kHeight)).ok());
  for (size_t i = 0; i < before.size(); ++i) {
    const Frame after = drawn(look, std::vector<double>{0.0, 0.7, 1.6}[i]);
    for (size_t v = 0; v < viewCount(); ++v)
      EXPECT_EQ(after.layers[0].views[v].pixels, before[i].layers[0].views[v].pixels) << i;
  }
}

TEST_P(Prepare, everySizeThatWasPrepared) {
  const Look look;
  constexpr glm::uvec2 kSizes[] = {{64, 40}, {123, 77}, {16, 90}};
  for (const glm::uvec2 size : kSizes)
    ASSERT_TRUE(fresh->prepare(scene, look, views(size.x, size.y), sized(size.x, size.y)).ok());
  for (int round = 0; round < 2; ++round)
    for (const glm::uvec2 size : kSizes) {
      const FrameStats stats = drawn(look, 0, size.x, size.y).stats;
      EXPECT_EQ(stats.pipelines, 0u) << size.x;
    }
}

TEST_P(Prepare, anyOneKnob) {
  NOT_WITH_SANITIZERS();
  const Look look;
  ASSERT_TRUE(fresh->prepare(scene, look, views(), sized(kWidth, kHeight), Rehearsal::knobs).ok());
  const std::pair<const char*, const char*> settings[] = {{"limit.palette", "four-blues"},
                                                          {"final.ripple", "layered"},
                                                          {"final.ripple", "paper"},
                                                          {"texture.amount", "0.3"},
                                                          {"texture.blend", "multiply"},
                                                          {"shadow.indicationSteps", "3"},
                                                          {"warp.metatexture.skip", "true"},
                                                          {"breakup.amount", "0"},
                                                          {"shadow.steps", "3"},
                                                          {"warp.distance", "0.5"},
                                                          {"light.terminator", "0.7"},
                                                          {"background.mode", "colours"},
                                                          {"warp.metatexture.contrast", "histogram"}};
  size_t tried = 0;
  for (const auto& [path, value] : settings) {
    Look changed = look;
    if (!changed.set(path, value).ok()) continue;
    ++tried;
    EXPECT_EQ(drawn(changed, 0).stats.pipelines, 0u) << path << " = " << value;
  }
  EXPECT_GE(tried, 9u);
  // Of one material or node as well.
  const std::string material = scene.summary().materialNames.at(0);
  for (const char* knob : {"texture.amount=0.3", "texture.blend=multiply", "warp.distance=0.5",
                           "warp.metatexture.contrast=histogram", "shadow.steps=3"}) {
    const std::string text = knob;
    const size_t equals = text.find('=');
    Look changed = look;
    if (!changed.set("materials." + material + "." + text.substr(0, equals), text.substr(equals + 1)).ok())
      continue;
    EXPECT_EQ(drawn(changed, 0).stats.pipelines, 0u) << text;
  }
}

// Any two of those that take other pipelines. For one eye: which pipelines those are does not depend on how
// many there are, and for any one knob both are tried.
TEST_P(Prepare, anyTwoKnobs) {
  NOT_WITH_SANITIZERS();
  if (viewCount() == 2) GTEST_SKIP() << "for one eye";
  const Look look;
  ASSERT_TRUE(fresh->prepare(scene, look, views(), sized(kWidth, kHeight), Rehearsal::pairs).ok());
  const std::pair<const char*, KnobValue> settings[] = {
      {"limit.palette", "four-blues"}, {"final.ripple", "layered"},
      {"final.ripple", "paper"},       {"texture.amount", 0.3},
      {"texture.blend", "multiply"},   {"shadow.indicationSteps", 3},
      {"breakup.amount", 0.0},         {"warp.metatexture.contrast", "histogram"},
      {"warp.distance", 0.5},          {"warp.metatexture.skew", "exact"}};
  for (const auto& [first, value] : settings)
    for (const auto& [second, other] : settings) {
      // Which of two knobs was set first makes no difference.
      if (std::string_view(first) > second) continue;
      Look changed = look;
      ASSERT_TRUE(changed.set(first, value).ok()) << first;
      ASSERT_TRUE(changed.set(second, other).ok()) << second;
      EXPECT_EQ(drawn(changed, 0).stats.pipelines, 0u) << first << " and " << second;
    }
}

TEST_P(Prepare, isRefusedWhereAFrameWouldBe) {
  EXPECT_EQ(fresh->prepare(Scene(), Look(), views(), sized(kWidth, kHeight)).error().kind, ErrorKind::usage);
  EXPECT_EQ(fresh->prepare(scene, Look(), {}, sized(kWidth, kHeight)).error().kind, ErrorKind::usage);
  ASSERT_TRUE(fresh->begin(scene, Look(), 0, views(), sized(kWidth, kHeight)).ok());
  EXPECT_EQ(fresh->prepare(scene, Look(), views(), sized(kWidth, kHeight)).error().kind, ErrorKind::usage);
  EXPECT_TRUE(fresh->finish().ok());
}

}  // namespace
}  // namespace scumble
