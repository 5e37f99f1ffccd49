// The simplified picture behind everything (docs/backdrop.md), a Kuwahara filter of samples of coarser mip
// levels, against the same in double precision from the picture's own texels.
#include <cmath>
#include <numbers>

#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"

namespace scumble::passes {
namespace {

using namespace test;

constexpr int kFlatWidth = 128, kFlatHeight = 96;

class SimplifyTest : public BothEyes {
 protected:
  // Slow changes, noise in one half, and edges.
  static std::shared_ptr<Image> noisy(uint32_t width, uint32_t height) {
    auto image = std::make_shared<Image>();
    image->width = width, image->height = height, image->channels = {"R", "G", "B"};
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) {
        const float u = (float(x) + 0.5f) / float(width), v = (float(y) + 0.5f) / float(height);
        const uint32_t hash = (x * 2654435761u ^ y * 2246822519u ^ (x * y) * 3266489917u) >> 9;
        const bool inside = std::hypot(u - 0.5f, 0.75f * (v - 0.5f)) < 0.2f;
        const float noise = (u > 0.5f ? 0.3f : 0.02f) * float(hash % 255) / 255;
        for (const float value : {inside ? 0.7f : 0.1f, 0.2f + 0.4f * v, 0.5f - 0.4f * u})
          image->pixels.push_back(value + noise);
      }
    return image;
  }

  static double luminance(const glm::dvec4& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

  // Alpha is the square of the luminance. All in half floats.
  static std::vector<Texels> levelsOf(const Image& picture) {
    std::vector<Texels> levels;
    levels.emplace_back(int(picture.width), int(picture.height));
    for (int y = 0; y < levels[0].height; ++y)
      for (int x = 0; x < levels[0].width; ++x) {
        glm::dvec4 c = texel(picture, x, y);
        c.w = luminance(c) * luminance(c);
        levels[0].at(x, y) = toHalf(c);
      }
    for (int level = 1; level < 4; ++level) {
      const Texels& finer = levels.back();
      Texels half(finer.width / 2, finer.height / 2);
      for (int y = 0; y < half.height; ++y)
        for (int x = 0; x < half.width; ++x)
          half.at(x, y) =
              toHalf(0.25 * (finer.clamped(2 * x, 2 * y) + finer.clamped(2 * x + 1, 2 * y) +
                             finer.clamped(2 * x, 2 * y + 1) + finer.clamped(2 * x + 1, 2 * y + 1)));
      levels.push_back(std::move(half));
    }
    return levels;
  }

  // Between texels and between levels.
  static glm::dvec4 sample(const std::vector<Texels>& levels, const glm::dvec2& uv, double level) {
    const auto inLevel = [&](const Texels& texels) {
      const glm::dvec2 at = uv * glm::dvec2(texels.width, texels.height) - 0.5, corner = glm::floor(at),
                       f = at - corner;
      const int x = int(corner.x), y = int(corner.y);
      return glm::mix(glm::mix(texels.clamped(x, y), texels.clamped(x + 1, y), f.x),
                      glm::mix(texels.clamped(x, y + 1), texels.clamped(x + 1, y + 1), f.x), f.y);
    };
    const int lower = int(level);
    return glm::mix(inLevel(levels[size_t(lower)]), inLevel(levels[size_t(lower) + 1]), level - lower);
  }

  // `radius`: pixels of the frame; `density`: texels a pixel.
  static glm::dvec3 simplified(const std::vector<Texels>& levels, const glm::dvec2& pixel, double radius,
                               double density) {
    const double level = std::max(0.0, std::log2(0.8 * radius * density));
    glm::dvec4 sum(0.0);
    for (int i = 0; i < 8; ++i) {
      const double angle = (i + 0.5) * std::numbers::pi / 4;
      const glm::dvec2 at = pixel + 0.6 * radius * glm::dvec2(std::cos(angle), std::sin(angle));
      const glm::dvec4 area = sample(levels, at / glm::dvec2(kFlatWidth, kFlatHeight), level);
      const double square = luminance(area) * luminance(area),
                   variance = std::max(area.w - square, 0.0) / (square + 1e-3);
      sum += glm::dvec4(glm::dvec3(area), 1) / (variance * variance + 1e-5);
    }
    return glm::dvec3(sum) / sum.w;
  }
};
INSTANTIATE_BOTH_EYES(SimplifyTest);

TEST_P(SimplifyTest, areasWithTheLeastVarianceCount) {
  NOT_WITH_SANITIZERS();
  TestScene s;
  s.add(sphereMesh({0, -9, 0}, 0.5f, 8), s.material(TestScene::colored("Grey", {0.5f, 0.5f, 0.5f, 1})));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 5}, {0, 1, 0}}, kFlatWidth, kFlatHeight, GetParam());
  // Of a picture with as many texels, and of a finer one.
  for (const auto& [radius, density] : {std::pair{0.5, 1.0}, {2.5, 1.0}, {3.6, 1.0}, {3.0, 1.5}}) {
    const auto picture = noisy(uint32_t(kFlatWidth * density), uint32_t(kFlatHeight * density));
    const std::vector<Texels> levels = levelsOf(*picture);
    RenderOptions options = sized(kFlatWidth, kFlatHeight, {"color"});
    options.background = picture;
    const Look look = quietLook({{"background.style", "0"},
                                 {"background.warp", "none"},
                                 {"background.simplify", std::to_string(radius * 1080 / kFlatHeight)}});
    const Frame frame = draw(scene, look, views, options);
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference difference(0.012);
      double changed = 0;
      for (int y = 1; y < kFlatHeight; y += 3)
        for (int x = 1; x < kFlatWidth; x += 3) {
          ASSERT_EQ(texel(aov(frame, "color", v), x, y).w, 0) << "only the picture is there";
          glm::dvec3 expected = simplified(levels, glm::dvec2(x, y) + 0.5, radius, density);
          // Less than a pixel is simplified in part.
          if (radius < 1) expected = glm::mix(glm::dvec3(texel(*picture, x, y)), expected, radius);
          for (int c = 0; c < 3; ++c) difference.add(texel(aov(frame, "", v), x, y)[c], expected[c]);
          if (density == 1) changed += glm::length(expected - glm::dvec3(texel(*picture, x, y)));
        }
      if (density == 1) {
        EXPECT_GT(changed, 0.005 / 9 * kFlatWidth * kFlatHeight) << radius;
      }
      // Filter weights have steps of 1/256, and variances are differences of half floats.
      EXPECT_LT(difference.beyondPart(), 0.01) << radius << ": " << difference.text();
      EXPECT_LT(difference.mean(), 2e-3) << radius << ": " << difference.text();
    }
  }
}

}  // namespace
}  // namespace scumble::passes
