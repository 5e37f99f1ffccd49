// What both eyes see of one point of a surface: the same marks, lines, washes and colours, in every pass of
// every look that ships. Which points those are, the AOV `position` says.
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"

namespace scumble {
namespace {

using namespace test;

constexpr uint32_t kEyeWidth = 240, kEyeHeight = 160;

// Where the right eye sees what the left one does at a pixel; nothing where it does not, or where another
// object, or a step of the same, is near: what is there is drawn from what is beside it.
class SamePoints {
 public:
  SamePoints(const Frame& frame, const std::vector<View>& eyes) : frame_(frame), eyes_(eyes) {}

  std::optional<glm::ivec2> inRightEye(int x, int y) const {
    const Image& position = aov(frame_, "position");
    if (!isPlain(0, x, y)) return std::nullopt;
    const glm::vec3 point(texel(position, x, y));
    const glm::vec4 clip = eyes_[1].eyeToClip * eyes_[1].worldToEye * glm::vec4(point, 1);
    const glm::vec2 at = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(kEyeWidth, kEyeHeight);
    const glm::ivec2 there(glm::floor(at));
    if (there.x < kMargin || there.y < kMargin || there.x >= int(kEyeWidth) - kMargin ||
        there.y >= int(kEyeHeight) - kMargin || !isPlain(1, there.x, there.y))
      return std::nullopt;
    // Hidden from the right eye by something else.
    const glm::vec3 other(texel(aov(frame_, "position", 1), there.x, there.y));
    const float far = aov(frame_, "depth").at(uint32_t(x), uint32_t(y), 0);
    if (glm::distance(point, other) > 0.1f * far) return std::nullopt;
    return there;
  }
  static constexpr int kMargin = 4;

 private:
  bool isPlain(size_t eye, int x, int y) const {
    const Image &id = aov(frame_, "id", eye), &depth = aov(frame_, "depth", eye);
    const float own = id.at(uint32_t(x), uint32_t(y), 0), far = depth.at(uint32_t(x), uint32_t(y), 0);
    if (own == 0) return false;
    for (int j = -kMargin; j <= kMargin; ++j)
      for (int i = -kMargin; i <= kMargin; ++i)
        if (texel(id, x + i, y + j).x != double(own) ||
            std::abs(texel(depth, x + i, y + j).x - far) > 0.1 * far)
          return false;
    return true;
  }
  const Frame& frame_;
  const std::vector<View>& eyes_;
};

class StereoMarks : public RenderTest {
 protected:
  const Scene scene = stillLife().load();
  const std::vector<View> eyes =
      viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}, 40, 0, 0.2f}, kEyeWidth, kEyeHeight, Stereo::stereo);

  static RenderOptions withAovs(std::vector<std::string> names) {
    for (const char* needed : {"position", "depth", "id"}) names.emplace_back(needed);
    return sized(kEyeWidth, kEyeHeight, names);
  }

  // The part of the points of which the left eye sees what the right one does not see within a pixel.
  struct Shares {
    size_t points = 0;
    std::map<std::string, double> off;
  };
  Shares differences(const Look& look, std::vector<std::string> names) const {
    const Frame frame = draw(scene, look, eyes, withAovs(names));
    const SamePoints points(frame, eyes);
    std::vector<std::array<glm::ivec2, 2>> pairs;
    for (int y = SamePoints::kMargin; y < int(kEyeHeight) - SamePoints::kMargin; ++y)
      for (int x = SamePoints::kMargin; x < int(kEyeWidth) - SamePoints::kMargin; ++x)
        if (const auto there = points.inRightEye(x, y)) pairs.push_back({glm::ivec2(x, y), *there});
    Shares shares{pairs.size(), {}};
    names.emplace_back("");
    for (const std::string& name : names) {
      size_t off = 0;
      for (const auto& [here, there] : pairs)
        off += differs(name, aov(frame, name), here, aov(frame, name, 1), there);
      shares.off[name] = double(off) / double(pairs.size());
    }
    return shares;
  }

 private:
  static bool differs(const std::string& name, const Image& left, const glm::ivec2& here, const Image& right,
                      const glm::ivec2& there) {
    // Of what has a quarter of the pixels, within one of those.
    const int reach = name == "pigment" ? 4 : 1;
    for (uint32_t c = 0; c < left.channels.size(); ++c) {
      float least = INFINITY, most = -INFINITY;
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i) {
          const float value = right.at(uint32_t(there.x + i), uint32_t(there.y + j), c);
          least = std::min(least, value), most = std::max(most, value);
        }
      const float own = left.at(uint32_t(here.x), uint32_t(here.y), c);
      // Of vectors in pixels, or of numbers as they are.
      const float tolerance = name == "warp" && c < 2 ? 0.5f : 0.05f * std::max(1.0f, std::abs(own));
      if (own < least - tolerance || own > most + tolerance) return true;
    }
    return false;
  }
};

TEST_F(StereoMarks, bothEyesSeeThemOnOnePoint) {
  NOT_WITH_SANITIZERS();
  std::vector<std::string> names = Renderer::aovNames();
  for (const char* other : {"shadow-map", "position", "depth", "id", "motion", "cryptomatte"})
    std::erase(names, other);
  for (const ShippedLook& shipped : Look::shipped()) {
    const Look look = *Look::load(shipped.name);
    const Shares shares = differences(look, names);
    EXPECT_GT(shares.points, 5000u);
    for (const auto& [name, part] : shares.off) {
      // Paper is not the surface's: it lies on the screen, for both eyes in one direction (docs/xr.md).
      if (name.empty() && hasKnob("watercolor.shown") && settingOf(look, "watercolor.shown") == "true")
        continue;
      // The finest marks are smaller than a pixel here, and pigment is laid down at a quarter of the size: of
      // twice as many pixels each way half as many differ.
      EXPECT_LT(part, name == "warp"      ? 0.035
                      : name == "pigment" ? 0.02
                                          : 0.002)
          << name << " of look " << shipped.name;
    }
  }
}

// What lies on the screen does not, and is found by that.
TEST_F(StereoMarks, whatLiesOnTheScreenIsFound) {
  NOT_WITH_SANITIZERS();
  const Look look = quietLook({{"warp.amount", "40"}, {"warp.metatexture.mode", "screen"}});
  EXPECT_GT(differences(look, {"warp"}).off.at("warp"), 0.3);
}

}  // namespace
}  // namespace scumble
