// Pictures of which it is known how they were painted.
#include "scumble/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "base/oklab.h"

namespace scumble {
namespace {

using Lab = glm::dvec3;
// x and y in heights of the picture, from its upper left corner.
using Painted = std::function<Lab(double x, double y)>;

constexpr int kLines = 540;

Image pictureOf(const Painted& painted, int lines = kLines, double aspect = 1.5, int perPixel = 2) {
  Image image{uint32_t(aspect * lines), uint32_t(lines), {"R", "G", "B"}, {}, true};
  for (uint32_t y = 0; y < image.height; ++y)
    for (uint32_t x = 0; x < image.width; ++x) {
      glm::dvec3 mean(0);
      for (int i = 0; i < perPixel; ++i)
        for (int k = 0; k < perPixel; ++k)
          mean += linearFromOklab(
              painted((x + (i + 0.5) / perPixel) / lines, (y + (k + 0.5) / perPixel) / lines));
      mean /= double(perPixel * perPixel);
      for (int c = 0; c < 3; ++c) image.pixels.push_back(float(mean[c]));
    }
  return image;
}

PictureStudy studied(const Image& image) {
  Result<PictureStudy> study = studyPicture(image);
  EXPECT_TRUE(study.ok()) << study.error().message();
  return study.ok() ? *study : PictureStudy();
}
PictureStudy studied(const Painted& painted) {
  return studied(pictureOf(painted));
}

Lab labOf(const glm::vec3& linear) {
  return oklabFromLinear(glm::dvec3(linear));
}
// Of a lightness, a chroma and a hue.
Lab lch(double lightness, double chroma, double degrees) {
  const double hue = degrees * std::numbers::pi / 180;
  return {lightness, chroma * std::cos(hue), chroma * std::sin(hue)};
}

TEST(Study, familiesAreThoseThatWerePainted) {
  const Lab light = lch(0.82, 0.05, 85), dark = lch(0.42, 0.07, 280);
  const PictureStudy study = studied([&](double x, double) { return x < 0.5 ? dark : light; });
  EXPECT_NEAR(study.dark.share, 1.0 / 3, 0.005);
  EXPECT_NEAR(study.light.share, 2.0 / 3, 0.005);
  EXPECT_NEAR(study.light.lightness, 0.82, 0.002);
  EXPECT_NEAR(study.dark.lightness, 0.42, 0.002);
  EXPECT_NEAR(study.light.chroma, 0.05, 0.002);
  EXPECT_NEAR(study.dark.chroma, 0.07, 0.002);
  EXPECT_NEAR(study.light.hue, 85, 1);
  EXPECT_NEAR(study.dark.hue, 280, 1);
  EXPECT_GT(study.light.agreement, 0.99);
  EXPECT_NEAR(study.division, 0.62, 0.1);
  EXPECT_NEAR(study.darkest, 0.42, 0.002);
  EXPECT_NEAR(study.lightest, 0.82, 0.002);
  // As many of each hue agree on none.
  const PictureStudy wheel =
      studied([](double x, double y) { return lch(0.6, 0.08, 360 * x / 1.5 + 40 * std::floor(3 * y)); });
  EXPECT_LT(wheel.light.agreement * wheel.light.share + wheel.dark.agreement * wheel.dark.share, 0.75);
}

TEST(Study, paletteIsThatOfFlatAreas) {
  const std::vector<std::pair<Lab, double>> painted{{lch(0.93, 0.03, 90), 0.5},
                                                    {lch(0.28, 0.05, 270), 0.25},
                                                    {lch(0.6, 0.17, 35), 0.02},
                                                    {lch(0.58, 0.07, 190), 0.15},
                                                    {lch(0.68, 0.07, 190), 0.08}};
  const PictureStudy study = studied([&](double x, double) {
    double sum = 0;
    for (const auto& [color, share] : painted)
      if (x / 1.5 < (sum += share)) return color;
    return painted.back().first;
  });
  ASSERT_EQ(study.palette.size(), painted.size());
  for (const auto& [color, share] : painted) {
    double least = 1, found = 0;
    for (const PaletteColor& of : study.palette)
      if (const double apart = glm::distance(labOf(of.color), color); apart < least)
        least = apart, found = of.share;
    EXPECT_LT(least, 0.004) << share;
    EXPECT_NEAR(found, share, 0.015);
  }
  EXPECT_GT(study.fewness, 0.995);
  for (size_t i = 1; i < study.palette.size(); ++i)
    EXPECT_GE(study.palette[i - 1].share, study.palette[i].share);
}

TEST(Study, palettesOfManyColorsAreApartAndSaySo) {
  const PictureStudy study = studied(
      [](double x, double y) { return lch(0.35 + 0.5 * y, 0.12 * std::abs(std::sin(5 * x)), 240 * x); });
  ASSERT_LE(study.palette.size(), 16u);
  EXPECT_GE(study.palette.size(), 12u);
  for (size_t i = 0; i < study.palette.size(); ++i)
    for (size_t k = 0; k < i; ++k)
      EXPECT_GE(glm::distance(labOf(study.palette[i].color), labOf(study.palette[k].color)),
                0.99 * kNearColors);
  EXPECT_LT(study.fewness, 0.9);
}

// Discs of three values; with lines around them of a width in pixels at 1080 lines.
Painted discs(double line, const Lab& drawn = lch(0.22, 0.03, 40)) {
  return [=](double x, double y) {
    const double cellX = std::fmod(x, 0.25) - 0.125, cellY = std::fmod(y, 0.25) - 0.125;
    const double apart = std::hypot(cellX, cellY) - 0.085;
    if (std::abs(apart) * 1080 < 0.5 * line) return drawn;
    return apart < 0 ? lch(0.55 + 0.1 * std::floor(3 * x / 1.5), 0.05, 200) : lch(0.92, 0.02, 90);
  };
}

TEST(Study, linesAreSeenWithTheirWidthAndColor) {
  EXPECT_FALSE(studied(discs(0)).lines.isDrawn);
  const Lab drawn = lch(0.22, 0.03, 40);
  for (const double width : {3.0, 4.0, 6.0, 8.0}) {
    const PictureStudy study = studied(discs(width, drawn));
    EXPECT_TRUE(study.lines.isDrawn) << width;
    EXPECT_GT(study.lines.onBorders, 0.75) << width;
    EXPECT_NEAR(study.lines.thin, width, 0.3 * width + 0.3);
    EXPECT_NEAR(study.lines.thick, width, 0.3 * width + 0.3);
    EXPECT_LE(study.lines.thin, study.lines.thick);
    EXPECT_LT(glm::distance(labOf(study.lines.color), drawn), 0.06) << width;
    // Nor are they among the colours of areas, or the darkest of them.
    EXPECT_GT(study.darkest, 0.5) << width;
    for (const PaletteColor& color : study.palette) EXPECT_GT(labOf(color.color).x, 0.45) << width;
  }
}

// A border whose place is given, from top to bottom, and turned by 90 degrees.
Painted border(const std::function<double(double)>& place, bool isTurned = false, double step = 0.3) {
  return [=](double x, double y) {
    return isTurned ? Lab(y > 0.5 + place(x) ? 0.5 : 0.5 + step, 0, 0)
                    : Lab(x > 0.75 + place(y) ? 0.5 : 0.5 + step, 0, 0);
  };
}

TEST(Study, raggednessIsTheDistanceFromASmoothCurve) {
  const auto raggedness = [](const std::function<double(double)>& place, bool isTurned = false) {
    const PictureStudy study = studied(border(place, isTurned));
    EXPECT_GT(study.borders.counted, 5);
    return study.borders.raggedness;
  };
  EXPECT_LT(raggedness([](double) { return 0.0123; }), 0.02);
  EXPECT_LT(raggedness([](double y) { return 0.31 * (y - 0.5); }), 0.25);
  // Bent as a disc of 200 pixels is.
  EXPECT_LT(raggedness([](double y) { return 2.7 * (y - 0.5) * (y - 0.5); }), 0.3);
  for (const double amplitude : {2.0, 4.0, 6.0}) {
    const auto torn = [&](double t) {
      return amplitude / 1080 * std::sin(2 * std::numbers::pi * t * 1080 / 27.0);
    };
    for (const bool isTurned : {false, true})
      EXPECT_NEAR(raggedness(torn, isTurned), amplitude / std::sqrt(2), 0.12 * amplitude);
  }
}

TEST(Study, softBordersAreWide) {
  double before = 0;
  for (const double width : {0.0, 8.0, 16.0, 24.0}) {
    const PictureStudy study = studied([&](double x, double) {
      const double across = width > 0 ? std::clamp((x - 0.75) * 1080 / width + 0.5, 0.0, 1.0) : x > 0.75;
      return Lab(0.4 + 0.4 * across, 0, 0);
    });
    EXPECT_GT(study.borders.width, before + 1) << width;
    if (width > 0) {
      EXPECT_NEAR(study.borders.width, width, 0.2 * width);
    }
    before = study.borders.width;
  }
}

TEST(Study, strokesHaveWidthContrastAndDirection) {
  for (const double width : {6.0, 12.0, 24.0}) {
    // Strokes of two values side by side, at an angle.
    const PictureStudy study = studied([&](double x, double y) {
      const double across = (0.8 * x + 0.6 * y) * 1080 / width;
      return Lab(0.6 + 0.04 * std::sin(std::numbers::pi * across), 0, 0);
    });
    EXPECT_NEAR(study.marks.width, width, 0.45 * width);
    EXPECT_GT(study.marks.direction, 0.9);
    EXPECT_NEAR(study.marks.contrast, 0.034, 0.016) << width;
  }
  // Noise has neither.
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, 0.02);
  const PictureStudy noise =
      studied(pictureOf([&](double, double) { return Lab(0.6 + normal(random), 0, 0); }, kLines, 1.5, 1));
  EXPECT_NEAR(noise.marks.grain, 0.02, 0.003);
  EXPECT_LT(noise.marks.direction, 0.35);
  EXPECT_LT(studied(discs(0)).marks.grain, 1e-4);
}

TEST(Study, paperIsLightGrainedAndInTheCorners) {
  const auto onPaper = [](double paper, double grain, double reach) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal(0, grain);
    return studied(pictureOf(
                       [&](double x, double y) {
                         const double away = std::hypot((x - 0.75) / 1.5, y - 0.5);
                         return Lab((away < reach ? 0.5 : paper) + normal(random), 0, 0.01);
                       },
                       kLines, 1.5, 1))
        .isOnPaper;
  };
  EXPECT_TRUE(onPaper(0.95, 0.01, 0.4));
  EXPECT_FALSE(onPaper(0.95, 0.0005, 0.4)) << "no grain";
  EXPECT_FALSE(onPaper(0.75, 0.01, 0.4)) << "grey";
  EXPECT_FALSE(onPaper(0.95, 0.01, 0.9)) << "corners are painted";
}

TEST(Study, sizeOfThePictureCountsForNothing) {
  const PictureStudy one = studied(pictureOf(discs(5), 540)),
                     two = studied(pictureOf(discs(5), 1080, 1.5, 1));
  EXPECT_EQ(one.width, two.width);
  EXPECT_EQ(two.height, kStudyLines);
  EXPECT_NEAR(one.lines.thin, two.lines.thin, 0.3);
  EXPECT_NEAR(one.division, two.division, 0.01);
  EXPECT_EQ(one.palette.size(), two.palette.size());
  // One of fewer lines is looked at as it is.
  const PictureStudy small = studied(pictureOf(discs(0), 270));
  EXPECT_EQ(small.height, 270u);
  EXPECT_NEAR(small.division, studied(discs(0)).division, 0.01);
}

// A corner's square is a part of the shorter side; memory beside the picture is none of it.
TEST(Study, narrowPicturesAreLookedAtWithinThem) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(0.9, 1);
  const auto noise = [&](double, double) { return Lab(any(random), 0, 0); };
  EXPECT_TRUE(studied(pictureOf(noise, 800, 100.0 / 800, 1)).isOnPaper);
  EXPECT_EQ(studied(pictureOf(noise, 64, 40, 1)).height, 64u);
}

TEST(Study, specksAreNoLines) {
  const PictureStudy study = studied([](double x, double y) {
    return std::max(std::abs(x - 0.7), std::abs(y - 0.4)) < 0.003 ? Lab(0.2, 0, 0) : Lab(0.7, 0, -0.05);
  });
  EXPECT_FALSE(study.lines.isDrawn);
  EXPECT_LT(study.lines.offBorders, 0.1);
}

TEST(Study, fewLinesLeaveEdgesAndStrokesOut) {
  for (const int lines : {128, 256}) {
    const std::string text =
        lookTextOf(studied(pictureOf(border([](double y) { return 0.3 * y; }), lines)), "");
    for (const char* knob : {"\"warp\"", "\"shadow\"", "\"texture\""})
      EXPECT_EQ(text.find(knob), std::string::npos) << lines << knob;
  }
}

TEST(Study, whatIsTransparentIsWhitePaper) {
  Image image = pictureOf([](double, double) { return Lab(0.5, 0, 0); }, 80);
  Image clear{image.width, image.height, {"R", "G", "B", "A"}, {}, true};
  for (size_t i = 0; i < image.pixels.size(); i += 3)
    clear.pixels.insert(clear.pixels.end(), {0.1f, 0.1f, 0.1f, i % 2 ? 1.0f : 0.0f});
  EXPECT_NEAR(studied(clear).lightest, 1, 1e-3);
}

TEST(Study, refusesWhatIsNoPicture) {
  const auto kindOf = [](const Image& image) { return studyPicture(image).error().kind; };
  Image small{63, 100, {"R", "G", "B"}, std::vector<float>(63 * 100 * 3), true};
  EXPECT_EQ(kindOf(small), ErrorKind::usage);
  Image grey{100, 100, {"Y"}, std::vector<float>(100 * 100), false};
  EXPECT_EQ(kindOf(grey), ErrorKind::usage);
  Image endless{100, 100, {"R", "G", "B"}, std::vector<float>(100 * 100 * 3), true};
  EXPECT_TRUE(studyPicture(endless).ok());
  Image turned = endless, less = endless;
  turned.channels = {"B", "G", "R"}, less.pixels.pop_back();
  endless.pixels[777] = INFINITY;
  for (const Image& image : {endless, turned, less}) EXPECT_EQ(kindOf(image), ErrorKind::usage);
  // So narrow that little is left of it.
  EXPECT_EQ(kindOf(Image{64, 9000, {"R", "G", "B"}, std::vector<float>(64 * 9000 * 3), true}),
            ErrorKind::usage);
}

TEST(Study, looksAreWholeWhateverThePicture) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0, 1);
  const std::pair<const char*, Painted> pictures[] = {
      {"black", [](double, double) { return Lab(0, 0, 0); }},
      {"white", [](double, double) { return Lab(1, 0, 0); }},
      {"one colour", [](double, double) { return lch(0.5, 0.1, 300); }},
      {"noise", [&](double, double) { return lch(any(random), 0.3 * any(random), 360 * any(random)); }},
      {"two", [](double x, double) { return Lab(x < 0.01 ? 0.0 : 1.0, 0, 0); }},
      {"lines", discs(5)}};
  for (const auto& [name, painted] : pictures) {
    const PictureStudy study = studied(pictureOf(painted, 128, 1.5, 1));
    const std::string text = lookTextOf(study, "a \"b\"\n\\c\xff.png");
    const Result<Look> look = Look::fromJson(text, "test.json");
    ASSERT_TRUE(look.ok()) << name << ": " << look.error().message() << "\n" << text;
    EXPECT_TRUE(look->warnings().empty()) << name;
    EXPECT_EQ(look->description().substr(0, 9), "After a \"");
  }
}

TEST(Study, looksHaveWhatWasFound) {
  const PictureStudy study = studied(discs(0));
  const Look look = std::move(Look::fromJson(lookTextOf(study, "discs"), "test.json")).value();
  const auto number = [&](const char* knob) { return std::get<double>(look.get(knob).value()); };
  EXPECT_NEAR(number("palette.darkest"), study.darkest, 1e-3);
  EXPECT_NEAR(number("palette.lightest"), study.lightest, 1e-3);
  EXPECT_NEAR(number("palette.shadowValue"), study.dark.lightness / study.light.lightness, 1e-3);
  ASSERT_EQ(std::get<int>(look.get("limit.colors").value()), int(study.palette.size()));
  for (size_t k = 0; k < study.palette.size(); ++k)
    EXPECT_LT(glm::distance(std::get<glm::vec3>(look.get("limit.color" + std::to_string(k + 1)).value()),
                            study.palette[k].color),
              0.01);
}

}  // namespace
}  // namespace scumble
