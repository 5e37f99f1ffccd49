// What a renderer refuses, and what it says of looks that know other names than the scene.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"

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
  EXPECT_EQ(settingsWithoutEffect(scene, look), Names()) << "it may be for many scenes";
  EXPECT_EQ(settingsWithoutEffect(scene, look, true), (Names{"materials.Mian", "nodes.Nobody"}));
  for (const std::string name : {"Nope*", "Nope", "*"})
    ASSERT_TRUE(look.set("materials." + name + ".warp.amount", "2").ok());
  EXPECT_EQ(settingsWithoutEffect(scene, look), (Names{"materials.Nope*", "materials.Nope"}));
  EXPECT_EQ(settingsWithoutEffect(scene, look, true).size(), 4u);
}

}  // namespace
}  // namespace scumble
