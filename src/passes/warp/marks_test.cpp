// Breakup marks: from a texture that the look brings, also with its whole histogram kept (Heitz and Neyret
// 2018), and from the built-in one with its contrast by default.
#include <cmath>
#include <functional>
#include <optional>

#include "base/test_folder.h"
#include "tests/support/aov.h"
#include "tests/support/metatexture_reference.h"
#include "tests/support/posed_surface.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "world/example_textures.h"

namespace scumble::passes {
namespace {

using namespace test;

class MarksTest : public BothEyes {
 protected:
  static constexpr int kWidth = 120, kHeight = 90;

  // Not as high as wide, and no two of its axes, directions and channels alike.
  static Pixels ownMarks() {
    constexpr uint32_t kColumns = 64, kRows = 32;
    Pixels pixels{kColumns, kRows, {}};
    for (uint32_t y = 0; y < kRows; ++y)
      for (uint32_t x = 0; x < kColumns; ++x) {
        const double u = 6.283185307 * x / kColumns, v = 6.283185307 * y / kRows;
        // Mostly dark: the mean is not a half.
        const auto byte = [](double value) {
          const double part = 0.5 + 0.48 * value;
          return uint8_t(std::lround(250 * part * part));
        };
        pixels.rgba.insert(pixels.rgba.end(), {byte(std::sin(v)), byte(std::cos(u)),
                                               byte(0.5 * std::sin(u + 0.4 * std::cos(u)) +
                                                    0.3 * std::cos(2 * v - u) + 0.2 * std::sin(v)),
                                               255});
      }
    return pixels;
  }

  // A tilted wall seen in perspective; and what the reference says of marks, pixel by pixel. `finish` makes
  // marks of a blend, `lengthOf` the length of its vector in pixels.
  template <class Finish>
  void compare(const Look& look, const MetaTextureReference& reference, const Finish& finish,
               double tolerance, Image* vectors = nullptr,
               const std::function<double(const glm::dvec4&)>& lengthOf = nullptr) const {
    TestScene s;
    s.add(gridMesh({-2, -1.5f, 0}, {4, 0, -1.5f}, {0.3f, 3, 0.5f}, 1, {2.3f, 1.4f}),
          s.material(TestScene::colored("Wall", {0.5f, 0.5f, 0.5f, 1})));
    const Scene scene = s.load();
    const auto surface = posedSurface(scene.data());
    const auto views = viewsFrom(scene, {{0.5f, 0.4f, 4}, {0, 0, 0}, 45, 15}, kWidth, kHeight, GetParam());
    const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"warp"}));
    if (vectors) *vectors = aov(frame, "warp");
    for (size_t v = 0; v < views.size(); ++v) {
      const auto hits = rasterised(onScreen(surface, views[v], kWidth, kHeight,
                                            [](const auto&, const auto&) { return glm::dvec2(0.0); }),
                                   kWidth, kHeight);
      Difference marks(tolerance);
      std::optional<Difference> lengths;
      if (lengthOf) lengths.emplace(0.5);  // pixels
      double least = 1, most = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          const auto& hit = hits[size_t(y) * kWidth + size_t(x)];
          const glm::dvec4 got = texel(aov(frame, "warp", v), x, y);
          if (!hit || got.w == 0) continue;
          const auto& corners = surface[hit->surface].corners;
          glm::dvec3 point(0.0);
          glm::dvec2 uv(0.0);
          for (size_t k = 0; k < 3; ++k)
            point += hit->barycentric[int(k)] * corners[k].position,
                uv += hit->barycentric[int(k)] * corners[k].uv;
          const glm::dmat2 back =
              glm::inverse(glm::dmat2(pixelsAlong(views[v], point, corners[0].dPdu, kWidth, kHeight),
                                      pixelsAlong(views[v], point, corners[0].dPdv, kWidth, kHeight)));
          const glm::dvec4 blend = reference.at(uv, {back[0][0], back[1][0]}, {back[0][1], back[1][1]}).value;
          const double expected = finish(blend);
          if (lengths) lengths->add(glm::length(glm::dvec2(got)), lengthOf(blend));
          marks.add(got.z, expected);
          least = std::min(least, expected), most = std::max(most, expected);
        }
      EXPECT_GT(marks.count, 5000u);
      EXPECT_LT(marks.beyondPart(), 5e-3) << marks.text() << ", view " << v;
      EXPECT_LT(marks.mean(), tolerance / 4) << marks.text();
      EXPECT_GT(most - least, 0.6) << "they vary";
      if (!lengths) continue;
      EXPECT_EQ(lengths->count, marks.count);
      EXPECT_LT(lengths->beyondPart(), 5e-3) << lengths->text();
    }
  }

  static Knobs quietKnobs(Knobs more) {
    more.insert(more.end(), {{"light.shadowWarp", "0"},
                             {"warp.inflation", "0"},
                             {"warp.metatexture.cyclopean", "off"},
                             {"breakup.metatexture.cyclopean", "off"}});
    return more;
  }
};
INSTANTIATE_BOTH_EYES(MarksTest);

// A look with these knobs whose breakup map, or field and breakup map, are a file of these bytes.
Look lookWith(const Pixels& pixels, bool fieldToo, const Knobs& knobs) {
  // Writers take linear colours.
  Image image{pixels.width, pixels.height, {"R", "G", "B"}, {}, true};
  for (size_t i = 0; i < pixels.rgba.size(); ++i) {
    const double c = pixels.rgba[i] / 255.0;
    if (i % 4 != 3)
      image.pixels.push_back(float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4)));
  }
  const TestFolder folder;
  const Status written = writePng(folder.file("marks.png"), image);
  EXPECT_TRUE(written.ok());
  const std::string uses = R"({"metatexture": {"example": "marks.png"}})";
  folder.put("look.json", R"({"breakup": )" + uses + (fieldToo ? R"(, "warp": )" + uses : "") + "}");
  Result<Look> look = Look::load(folder.file("look.json"));
  EXPECT_TRUE(look.ok()) << look.error().message();
  for (const auto& [path, value] : knobs) EXPECT_TRUE(look->set(path, value).ok()) << path;
  return *look;
}

TEST_P(MarksTest, fromATextureOfTheLook) {
  const Pixels pixels = ownMarks();
  MetaTextureReference reference;
  reference.texture.pixels = pixels;
  reference.mean = meanOf(pixels);
  reference.size = 60, reference.height = 0.5;  // a texel is about a pixel
  reference.skew = MetaTextureReference::exact;
  reference.skewLevels = 2;
  reference.base = 3;
  const double amount = 1.2;
  const Knobs own{{"ground.mode", "off"},
                  {"breakup.amount", "1.2"},
                  {"breakup.metatexture.size", "720"},
                  {"breakup.metatexture.base", "3"},
                  {"breakup.metatexture.contrast", "gaussian"}};
  const Look look = lookWith(pixels, false, quietKnobs(own));
  Image vectors, without;
  compare(
      look, reference,
      [&](const glm::dvec4& blend) {
        return std::clamp((blend.z - reference.mean.z) * amount + reference.mean.z, 0.0, 1.0);
      },
      0.03, &vectors);

  // Vectors do not know of it.
  MetaTextureReference builtIn;
  builtIn.texture.pixels = builtInExample(0);
  builtIn.mean = meanOf(builtIn.texture.pixels);
  builtIn.size = 256, builtIn.skew = MetaTextureReference::exact, builtIn.skewLevels = 2;
  compare(
      quietLook(quietKnobs({{"breakup.amount", "1"},
                            {"breakup.metatexture.size", "3072"},
                            {"breakup.metatexture.contrast", "gaussian"}})),
      builtIn, [](const glm::dvec4& blend) { return std::clamp(blend.z, 0.0, 1.0); }, 0.06, &without);
  ASSERT_EQ(vectors.pixels.size(), without.pixels.size());
  size_t same = 0, marked = 0;
  for (size_t i = 0; i < vectors.pixels.size(); i += 4) {
    same += vectors.pixels[i] == without.pixels[i] && vectors.pixels[i + 1] == without.pixels[i + 1];
    marked += std::abs(vectors.pixels[i + 2] - without.pixels[i + 2]) > 0.1f;
  }
  EXPECT_EQ(same, vectors.pixels.size() / 4);
  EXPECT_GT(marked, 1000u);
}

// Heitz and Neyret: values become those of a Gaussian of the same rank (mean 1/2, deviation 1/6), blends keep
// its variance, and the rank leads back.
class RankTwin {
 public:
  explicit RankTwin(const Pixels& pixels) : twin(pixels) {
    for (size_t i = 0; i < pixels.rgba.size(); ++i)
      counts_[i % 4][pixels.rgba[i]] += 4.0 / double(pixels.rgba.size());
    for (size_t c = 0; c < 3; ++c) {
      // Half of a value's own share counts to its rank.
      double below = 0;
      uint8_t gaussianOf[256];
      for (size_t value = 0; value < 256; ++value) {
        int byte = 0;
        while (byte < 255 && rankOf((byte + 0.5) / 255) < below + 0.5 * counts_[c][value]) ++byte;
        gaussianOf[value] = uint8_t(byte);
        below += counts_[c][value];
      }
      for (size_t i = c; i < twin.rgba.size(); i += 4) twin.rgba[i] = gaussianOf[twin.rgba[i]];
    }
  }
  double back(double gaussian, size_t channel) const {
    const double rank = rankOf(std::clamp(gaussian, 0.0, 1.0));
    size_t value = 0;
    for (double upTo = counts_[channel][0]; value < 255 && upTo < rank;) upTo += counts_[channel][++value];
    return double(value) / 255;
  }
  Pixels twin;

 private:
  static double rankOf(double gaussian) { return 0.5 * std::erfc((0.5 - gaussian) * 6 / std::sqrt(2.0)); }
  double counts_[4][256] = {};
};

MetaTextureReference defaultReference(const Pixels& pixels, double size) {
  MetaTextureReference reference;
  reference.texture.pixels = pixels;
  reference.mean = meanOf(pixels);
  reference.size = size, reference.height = double(pixels.height) / pixels.width;
  reference.skew = MetaTextureReference::exact, reference.skewLevels = 2;
  return reference;
}

// Knobs as they are, but for the size: the built-in marks are near enough to a Gaussian, so that contrast is
// restored by the variance.
TEST_P(MarksTest, contrastByDefault) {
  const MetaTextureReference reference = defaultReference(builtInExample(0), 256);
  const double amount = 1, mean = reference.mean.z;
  compare(
      quietLook(quietKnobs({{"breakup.metatexture.size", "3072"}})), reference,
      [&](const glm::dvec4& blend) { return std::clamp((blend.z - mean) * amount + mean, 0.0, 1.0); }, 0.06);
}

// Vectors and marks are around the example's own mean (docs/metatexture.md), also where its histogram is kept
// and is mostly dark.
TEST_P(MarksTest, theHistogramsOwnMean) {
  const Pixels pixels = ownMarks();
  const RankTwin ranks(pixels);
  const glm::dvec4 mean = meanOf(pixels);
  ASSERT_LT(std::max({mean.x, mean.y, mean.z}), 0.4);
  const Look look = lookWith(pixels, true,
                             quietKnobs({{"ground.mode", "off"},
                                         {"breakup.amount", "2"},
                                         {"warp.amount", "48"},
                                         {"warp.metatexture.size", "720"},
                                         {"breakup.metatexture.size", "720"},
                                         {"warp.metatexture.contrast", "histogram"},
                                         {"breakup.metatexture.contrast", "histogram"}}));
  const MetaTextureReference reference = defaultReference(ranks.twin, 60);
  compare(
      look, reference,
      [&](const glm::dvec4& blend) {
        return std::clamp((ranks.back(blend.z, 2) - mean.z) * 2 + mean.z, 0.0, 1.0);
      },
      0.1, nullptr,
      [&](const glm::dvec4& blend) {
        const glm::dvec2 vector(ranks.back(blend.x, 0) - mean.x, ranks.back(blend.y, 1) - mean.y);
        return 48 * kHeight / 1080.0 * std::min(2.0, 2 * glm::length(vector));
      });
}

}  // namespace
}  // namespace scumble::passes
