// The paper under a watercolour: it is one paper at every size of the picture, lit from where the light is,
// and what is drawn over the wash ends where that does.
#include <cmath>
#include <functional>

#include "base/test_folder.h"
#include "scumble/image.h"
#include "tests/support/aov.h"
#include "tests/support/plain_wash.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"

namespace scumble::watercolor {
namespace {

using namespace test;

class Paper : public BothEyes {
 protected:
  // A board from x, y on, as seen from the front; the picture is 2 metres high at its distance.
  static TestScene boardFrom(float x, float y) {
    TestScene s;
    s.add(gridMesh({x, -9, 0}, {9 - x, 0, 0}, {0, y + 9, 0}, 2),
          s.material(TestScene::unlit("Board", {0.3f, 0.3f, 0.3f, 1})));
    return s;
  }
  Frame paint(const TestScene& s, const Knobs& knobs, uint32_t width, uint32_t height) {
    const Scene scene = s.load();
    views_ = viewsFrom(scene, {{0, 0, 5}, {0, 0, 0}, float(glm::degrees(2 * std::atan(0.2))), 0, 0.02f},
                       width, height, GetParam());
    return draw(scene, quietLook(plainWash(knobs)), views_, sized(width, height));
  }
  // Means of squares of pixels.
  static std::vector<double> reduced(const Image& image, uint32_t by) {
    std::vector<double> values;
    for (uint32_t y = 0; y + by <= image.height; y += by)
      for (uint32_t x = 0; x + by <= image.width; x += by) {
        double sum = 0;
        for (uint32_t i = 0; i < by * by; ++i) sum += texel(image, int(x + i % by), int(y + i / by)).x;
        values.push_back(sum / (by * by));
      }
    return values;
  }
  static double deviation(const std::vector<double>& values) {
    double sum = 0, squares = 0;
    for (const double value : values) sum += value, squares += value * value;
    const double mean = sum / double(values.size());
    return std::sqrt(std::max(squares / double(values.size()) - mean * mean, 0.0));
  }

  std::vector<View> views_;
};
INSTANTIATE_BOTH_EYES(Paper);

// What a picture of many pixels shows of the relief, a small one shows as well, as far as it has the pixels
// for it.
TEST_P(Paper, reliefIsTheSameAtEverySize) {
  for (const char* size : {"420", "1600"}) {
    const Knobs lit{{"watercolor.relief", "0.3"}, {"watercolor.paperSize", size}};
    const Frame large = paint(boardFrom(-9, 9), lit, 640, 480),
                small = paint(boardFrom(-9, 9), lit, 160, 120);
    for (size_t v = 0; v < viewCount(); ++v) {
      const double whole = deviation(reduced(aov(large, "", v), 4)),
                   part = deviation(reduced(aov(small, "", v), 1));
      EXPECT_GT(whole, 0.001);
      EXPECT_NEAR(part / whole, 1, 0.3) << "paper of " << size << ", view " << v;
    }
  }
}

// And edges wobble as far, in parts of the picture.
TEST_P(Paper, wobbleIsTheSameAtEverySize) {
  const Knobs moved{{"watercolor.wobble", "30"}, {"watercolor.paperSize", "1600"}};
  // Where the board's upper edge lies in each column, in parts of the height.
  const auto edges = [&](uint32_t by) {
    const Frame frame = paint(boardFrom(-9, 0), moved, 160 * by, 120 * by);
    std::vector<std::vector<double>> places;
    for (size_t v = 0; v < viewCount(); ++v) {
      const Image& image = aov(frame, "", v);
      std::vector<double>& of = places.emplace_back();
      for (uint32_t x = 0; x < image.width; x += by) {
        double white = 0;
        for (uint32_t y = 0; y < image.height; ++y) white += (texel(image, int(x), int(y)).x - 0.3) / 0.7;
        of.push_back(white / image.height);
      }
    }
    return places;
  };
  const auto small = edges(1), large = edges(6);
  for (size_t v = 0; v < viewCount(); ++v) {
    EXPECT_GT(deviation(large[v]), 0.002);
    EXPECT_NEAR(deviation(small[v]) / deviation(large[v]), 1, 0.2);
  }
}

// Pigment gathers as far inside of a border, and as much, whatever the picture's size.
TEST_P(Paper, edgesAreAsWideAtEverySize) {
  const Knobs dark{{"watercolor.edges", "2"}, {"watercolor.edgeWidth", "128"}};
  // Of rows of the whole height, a narrow strip of it.
  const auto profile = [&](uint32_t by) {
    const Frame frame = paint(boardFrom(-9, 0), dark, 8 * by, 270 * by);
    std::vector<std::vector<double>> rows;
    for (size_t v = 0; v < viewCount(); ++v) {
      std::vector<double>& of = rows.emplace_back();
      const std::vector<double> values = reduced(aov(frame, "", v), by);
      for (size_t y = 0; y < 270; ++y) {
        of.push_back(0);
        for (size_t x = 0; x < 8; ++x) of.back() += values[y * 8 + x] / 8;
      }
    }
    return rows;
  };
  const auto small = profile(1), large = profile(8);
  for (size_t v = 0; v < viewCount(); ++v)
    for (size_t y = 140; y < 200; y += 4) EXPECT_NEAR(small[v][y], large[v][y], 0.02) << y;
}

// (Section 4.2.) A paper that leans one way all over is as bright as the place of the light says: where that
// is seen, or at its range; as near as its depth.
TEST_P(Paper, lightStandsWhereTheScenesDoes) {
  const TestFolder folder;
  // Files hold codes: 204, 128 and 230 of 255, which is (0.6, 0, 0.8).
  const Image leaning{1, 1, {"R", "G", "B", "A"}, {0.603827f, 0.215861f, 0.791298f, 1}};
  ASSERT_TRUE(writePng(folder.file("leaning.png"), leaning).ok());
  constexpr int kWidth = 80, kHeight = 60;
  struct Case {
    glm::vec3 light;
    bool isLamp;
    double at;  // across the picture, from -1 to 1 in it
    const char *depth, *range;
  };
  // The picture is 8/3 metres wide where the board is, five metres before the eye.
  for (const Case& c :
       {Case{{0.1f, 0.1f, -1}, false, 0.375, "3", "2"}, Case{{-0.1f, 0, -1}, false, -0.375, "1.5", "2"},
        Case{{-0.8f, 0.5f, 0.3f}, false, -2, "3", "2"}, Case{{0.8f, 0.5f, 0.3f}, false, 0.7, "3", "0.7"},
        Case{{20, 3, -20}, true, 2, "3", "2"}, Case{{4, 3, -20}, true, 0.6, "3", "2"}}) {
    TestScene s = boardFrom(-9, 9);
    if (c.isLamp) {
      s.json()["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 1}}};
      s.json()["scenes"][0]["nodes"].push_back(s.json()["nodes"].size());
      s.json()["nodes"].push_back({{"translation", {c.light.x, c.light.y, c.light.z}},
                                   {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    } else {
      s.light(c.light);
    }
    const Frame frame = paint(s,
                              {{"watercolor.relief", "1"},
                               {"watercolor.strength", "0"},
                               {"watercolor.white", "#808080"},
                               {"watercolor.normals", folder.file("leaning.png")},
                               {"watercolor.lightDepth", c.depth},
                               {"watercolor.lightRange", c.range}},
                              kWidth, kHeight);
    for (size_t v = 0; v < viewCount(); ++v)
      for (int x = 4; x < kWidth; x += 12) {
        const glm::dvec2 normal = glm::normalize(glm::dvec2(0.6, 0.8));
        const double aside = (c.at - (2 * (x + 0.5) / kWidth - 1)) / std::stod(c.depth);
        const double expected = 0.2159 * glm::clamp(normal.x * aside + normal.y, 0.0, 1.35);
        EXPECT_NEAR(texel(aov(frame, "", v), x, kHeight / 2).x, expected, 0.01) << c.at << ", " << x;
      }
  }
}

}  // namespace
}  // namespace scumble::watercolor
