// What a renderer refuses, and what it says of looks that know other names than the scene.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "scumble/check.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

class Refusals : public RenderTest {
 protected:
  static constexpr int kWidth = 64, kHeight = 48;
  const Scene scene_ = stillLife().load();

  static std::string refusalOf(const Result<Frame>& frame) {
    if (frame) return "";
    EXPECT_EQ(frame.error().kind, ErrorKind::usage) << frame.error().message();
    return frame.error().problem;
  }
  std::string refusalOf(const std::vector<View>& views, const std::vector<View>& previous = {}) {
    RenderOptions options = sized(kWidth, kHeight, {}, 1);
    options.previousViews = previous;
    return refusalOf(renderer().render(scene_, Look(), 0, views, options));
  }
};

TEST_F(Refusals, anotherThreadIsRefusedWhileOneIsInside) {
  const std::vector<View> views = viewsFrom(scene_, {}, kWidth, kHeight);
  const RenderOptions options = sized(kWidth, kHeight, {}, 1);
  const Frame wanted = draw(scene_, Look(), views, options);
  std::atomic<bool> ends = false;
  std::atomic<int> refused = 0, other = 0;
  const auto call = [&] {
    const Result<Frame> frame = renderer().render(scene_, Look(), 0, views, options);
    if (frame)
      other += !sameBytes(aov(*frame, ""), aov(wanted, ""));
    else if (frame.error().problem == "this renderer is in use by another thread" &&
             frame.error().kind == ErrorKind::usage)
      ++refused;
    else
      ++other;
  };
  std::thread second([&] {
    while (!ends) call();
  });
  for (int i = 0; i < 10000 && refused < 20; ++i) call();
  ends = true;
  second.join();
  EXPECT_GE(refused, 20);
  EXPECT_EQ(other, 0);
  // Halves of frames too; and what was refused changed nothing.
  ASSERT_TRUE(renderer().begin(scene_, Look(), 0, views, options).ok());
  std::thread([&] { EXPECT_TRUE(renderer().finish().ok()) << "nobody is inside"; }).join();
  EXPECT_TRUE(sameBytes(aov(draw(scene_, Look(), views, options), ""), aov(wanted, "")));
}

TEST_F(Refusals, viewsOfOtherConventions) {
  const std::vector<View> views = viewsFrom(scene_, {}, kWidth, kHeight);
  std::vector<View> zero = views, other = views;
  zero[0].worldToEye = glm::mat4(0);
  other[0].eyeToClip[3][2] *= -1;  // near is 0 and far is 1
  EXPECT_EQ(refusalOf(views, views), "");
  for (const auto& [present, previous] : {std::pair{zero, views}, {views, zero}})
    EXPECT_EQ(refusalOf(present, previous), "a view's worldToEye places no eye in the world");
  EXPECT_EQ(refusalOf(other), "a view's eyeToClip has a depth that does not fall with the distance");
  EXPECT_NE(refusalOf({View()}), "");
}

TEST_F(Refusals, aCountOfPreviousViewsIsNamedAsThat) {
  const std::vector<View> one = viewsFrom(scene_, {}, kWidth, kHeight),
                          two = viewsFrom(scene_, {}, kWidth, kHeight, Stereo::stereo);
  EXPECT_EQ(refusalOf(one, two), "there are not as many previous views as views");
  EXPECT_EQ(refusalOf(two, one), "there are not as many previous views as views");
  EXPECT_EQ(refusalOf(std::vector<View>{}), "there are 0 views");
}

// A caller that stops is obeyed, wherever it does so, and nothing is left of the frame.
TEST_F(Refusals, whoCancelsGetsNoFrame) {
  const std::vector<View> views = viewsFrom(scene_, {}, kWidth, kHeight, Stereo::stereo);
  RendererOptions options;
  options.device = testDevice();
  options.validation = true;
  std::vector<std::pair<LogLevel, std::string>> log;
  options.log = [&](LogLevel level, const std::string& text) { log.emplace_back(level, text); };
  const auto fresh = std::move(Renderer::create(options)).value();
  ASSERT_EQ(log.size(), 1u);
  EXPECT_EQ(log[0].first, LogLevel::information);
  EXPECT_NE(log[0].second.find(fresh->gpu().name), std::string::npos);

  RenderOptions frame = sized(kWidth, kHeight);
  const Frame expected = draw(scene_, Look(), views, frame);
  size_t calls = 0;
  for (size_t stopAt = 0;; ++stopAt) {
    double before = 0;
    calls = 0;
    frame.progress = [&](double part) {
      EXPECT_GE(part, before);
      EXPECT_LE(part, 1);
      before = part;
      return ++calls <= stopAt;
    };
    const Result<Frame> drawn = fresh->render(scene_, Look(), 0, views, frame);
    if (drawn) {
      EXPECT_EQ(before, 1);
      EXPECT_TRUE(sameBytes(drawn->layers[0].views[1], expected.layers[0].views[1]));
      break;
    }
    ASSERT_EQ(drawn.error().kind, ErrorKind::cancelled) << drawn.error().message();
    EXPECT_EQ(calls, stopAt + 1);
  }
  EXPECT_GT(calls, 8u);
  frame.progress = {};
  for (size_t i = 0; i < log.size(); ++i) EXPECT_NE(log[i].first, LogLevel::error) << log[i].second;
  EXPECT_EQ(fresh->validationMessages(), 0);

  // What a callback throws is the caller's, and leaves nothing behind either.
  const auto another = std::move(Renderer::create(options)).value();
  for (size_t throwAt = 0;; ++throwAt) {
    size_t told = 0;
    frame.progress = [&](double) {
      if (told++ == throwAt) throw std::runtime_error("enough");
      return true;
    };
    try {
      ASSERT_TRUE(another->render(scene_, Look(), 0, views, frame).ok());
      break;
    } catch (const std::runtime_error& thrown) {
      EXPECT_STREQ(thrown.what(), "enough");
    }
    frame.progress = {};
    if (throwAt % 3 == 0) {
      EXPECT_TRUE(sameBytes(another->render(scene_, Look(), 0, views, frame)->layers[0].views[1],
                            expected.layers[0].views[1]))
          << throwAt;
    }
  }
  EXPECT_EQ(another->validationMessages(), 0);

  // All of a rehearsal is one way from 0 to 1.
  double last = 0;
  frame.progress = [&](double part) {
    EXPECT_GE(part, last);
    last = part;
    return true;
  };
  ASSERT_TRUE(fresh->prepare(scene_, Look(), views, frame).ok());
  EXPECT_EQ(last, 1);
  frame.progress = [](double part) { return part < 0.5; };
  EXPECT_EQ(fresh->prepare(scene_, Look(), views, frame).error().kind, ErrorKind::cancelled);
  frame.progress = {};
  EXPECT_TRUE(sameBytes(fresh->render(scene_, Look(), 0, views, frame)->layers[0].views[0],
                        expected.layers[0].views[0]));
}

TEST(WithoutEffect, namesThatTheSceneDoesNotHave) {
  const Scene scene = stillLife().load();
  const std::string material = scene.summary().materialNames.at(0);
  const auto member = [](const std::string& name) {
    return "\"" + name + "\": {\"warp\": {\"amount\": 1}, \"surface\": {\"indication\": 0}}";
  };
  Look look = *Look::fromJson("{\"materials\": {" + member(material) + ", " + member("Mian") + ", " +
                                  member("Sail*") + ", " + member("Ground") +
                                  "}, \"nodes\": {\"Nobody\": {\"animation\": {\"hold\": 2}}}}",
                              "a.json");
  using Names = std::vector<std::string>;
  const auto found = [&](bool isForScene, bool bySet) {
    Names names;
    for (const Finding& one : check(scene, look, isForScene)) {
      EXPECT_EQ(one.kind, Finding::Kind::noSuchName);
      EXPECT_FALSE(one.problem.empty());
      if (one.bySet == bySet) names.push_back(one.setting);
    }
    return names;
  };
  EXPECT_EQ(found(false, false), Names()) << "it may be for many scenes";
  EXPECT_EQ(found(true, false), (Names{"materials.Mian", "nodes.Nobody"}));
  for (const std::string name : {"Nope*", "Nope", "*"})
    ASSERT_TRUE(look.set("materials." + name + ".warp.amount", "2").ok());
  EXPECT_EQ(found(false, true), (Names{"materials.Nope*", "materials.Nope"}));
  EXPECT_EQ(found(true, true), (Names{"materials.Nope*", "materials.Nope"}));
  EXPECT_EQ(found(true, false).size(), 2u);
  EXPECT_TRUE(check(Scene(), look, true).empty());
}

}  // namespace
}  // namespace scumble
