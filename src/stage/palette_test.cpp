// The palette rule against the art director's brief: a person judges pictures, this holds what that person
// said in numbers. Distances are in OKLab, where 0.02 is just noticeable side by side and 0.1 is the next
// colour in the box.
#include "stage/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/oklab.h"

namespace scumble::stage {
namespace {

glm::dvec3 srgb(uint32_t rrggbb) {
  return glm::dvec3(look::linearFromSrgb(rrggbb));
}

double distance(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(oklabFromLinear(a) - oklabFromLinear(b));
}

// Calls with linear colours over a grid that is even in sRGB.
template <class Function>
void forColors(int steps, const Function& function) {
  for (int i = 0; i < steps * steps * steps; ++i) {
    const glm::dvec3 s = glm::dvec3(i % steps, i / steps % steps, i / (steps * steps)) / double(steps - 1);
    glm::dvec3 linear;
    for (int c = 0; c < 3; ++c)
      linear[c] = s[c] <= 0.04045 ? s[c] / 12.92 : std::pow((s[c] + 0.055) / 1.055, 2.4);
    function(linear);
  }
}

// -- The brief

// The brief's triads (lit / shadow) are examples painted by hand, not a formula: the rule must come near all
// of them at once. Tolerances: 0.07 for light, which shall stay the model's own colour; 0.11 for shadow,
// about one colour's step.
TEST(Palette, followsTheBriefsTriads) {
  const struct {
    const char* name;
    uint32_t lit, shadowed;
  } triads[] = {
      {"canvas", 0xEADFC8, 0x8E93AC}, {"varnished wood", 0xB8743F, 0x5A3B48}, {"skin", 0xD9A07A, 0x86545A}};
  const PaletteParams params;
  for (const auto& triad : triads) {
    EXPECT_LT(distance(litColor(params, srgb(triad.lit)), srgb(triad.lit)), 0.07) << triad.name;
    EXPECT_LT(distance(shadowedColor(params, srgb(triad.lit)), srgb(triad.shadowed)), 0.11) << triad.name;
  }
}

TEST(Palette, shadowIsCoolerAndSeldomDarkerThanHalfTheLight) {
  const PaletteParams params;
  forColors(17, [&](const glm::dvec3& albedo) {
    const glm::dvec3 lit = oklabFromLinear(litColor(params, albedo)),
                     shadowed = oklabFromLinear(shadowedColor(params, albedo));
    EXPECT_GE(shadowed.x, 0.5 * lit.x);
    EXPECT_LE(shadowed.x, 0.9 * lit.x) << "no shadow to be seen";
    // What is much bluer than the shadow's own tint cannot become bluer still.
    if (lit.z > -0.08) {
      EXPECT_LT(shadowed.z, lit.z);
    }
  });
}

// A colour of its own: at the least one noticeable step from every grey multiple of the lit colour.
TEST(Palette, shadowIsNeverGreyTimesTheLight) {
  const PaletteParams params;
  forColors(13, [&](const glm::dvec3& albedo) {
    const glm::dvec3 lit = litColor(params, albedo), shadowed = shadowedColor(params, albedo);
    double nearest = 1;
    for (int i = 0; i <= 40; ++i) nearest = std::min(nearest, distance(lit * (i / 40.0), shadowed));
    EXPECT_GT(nearest, 0.02) << albedo.r << " " << albedo.g << " " << albedo.b;
  });
}

// "White models do not burn out, black ones do not become holes."
TEST(Palette, whiteAndBlackStayReadable) {
  const PaletteParams params;
  const glm::dvec3 white = oklabFromLinear(litColor(params, glm::dvec3(1.0)));
  EXPECT_LT(white.x, 0.97);
  EXPECT_GT(white.x, 0.85);
  EXPECT_GT(oklabFromLinear(litColor(params, glm::dvec3(0.0))).x, 0.12);
  EXPECT_GT(oklabFromLinear(shadowedColor(params, glm::dvec3(0.0))).x, 0.06);
}

TEST(Palette, lighterStaysLighter) {
  const PaletteParams params;
  double litBefore = -1, shadowedBefore = -1;
  for (int i = 0; i <= 32; ++i) {
    const glm::dvec3 grey(std::pow(i / 32.0, 2.2));
    const double lit = oklabFromLinear(litColor(params, grey)).x,
                 shadowed = oklabFromLinear(shadowedColor(params, grey)).x;
    EXPECT_GT(lit, litBefore);
    EXPECT_GT(shadowed, shadowedBefore);
    litBefore = lit, shadowedBefore = shadowed;
  }
}

TEST(Palette, everyKnobsEndsGiveColours) {
  for (const look::ParamRow& row : PaletteParams::block().rows) {
    for (const double end : {row.min, row.max}) {
      look::LookData look;
      look.assignments.push_back(
          {"", &PaletteParams::block(), &row, {end, look::linearFromSrgb(uint32_t(std::max(0.0, end)))}});
      const PaletteParams params = look.get<PaletteParams>();
      forColors(4, [&](const glm::dvec3& albedo) {
        for (const glm::dvec3& color : {litColor(params, albedo), shadowedColor(params, albedo)})
          for (int c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(color[c])) << row.name;
            ASSERT_GE(color[c], 0) << row.name;
            ASSERT_LE(color[c], 1) << row.name;
          }
      });
    }
  }
}

TEST(Palette, withoutAnyShiftTheRuleChangesNothing) {
  PaletteParams params;
  params.darkest = 0, params.lightest = 1, params.saturation = 1, params.litTintAmount = 0;
  forColors(9,
            [&](const glm::dvec3& albedo) { EXPECT_LT(distance(litColor(params, albedo), albedo), 2e-3); });
}

// -- Grading

TEST(Grade, atItsDefaultsChangesNoBit) {
  LitParams params;
  params.overlay = look::Color(0x123456);  // of which nothing is laid over
  forColors(7, [&](const glm::dvec3& color) { EXPECT_EQ(graded(Grade::of(params), color), color); });
  const PaletteParams palette;
  forColors(5, [&](const glm::dvec3& color) {
    EXPECT_EQ((ColorRule{ColorRule::lit, palette, {}}(color)), litColor(palette, color));
    EXPECT_EQ((ColorRule{ColorRule::shadowed, palette, {}}(color)), shadowedColor(palette, color));
    EXPECT_EQ((ColorRule{ColorRule::painted, palette, {}}(color)), color);
  });
}

TEST(Grade, eachKnobDoesOneThing) {
  const glm::dvec3 soft = linearFromOklab({0.6, 0.03, -0.04});
  const auto labOf = [&](const Grade& grade) { return oklabFromLinear(graded(grade, soft)); };
  const auto expectLab = [](const glm::dvec3& got, const glm::dvec3& expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], expected[i], 2e-4) << "axis " << i;
  };
  Grade grade;
  grade.hue = 90;
  expectLab(labOf(grade), {0.6, 0.04, 0.03});
  grade = {}, grade.saturation = 0;
  expectLab(labOf(grade), {0.6, 0, 0});
  grade = {}, grade.saturation = 1.5f;
  expectLab(labOf(grade), {0.6, 0.045, -0.06});
  grade = {}, grade.brightness = 0.5f;
  expectLab(labOf(grade), {0.3, 0.03, -0.04});
  grade = {}, grade.contrast = 1.5f;
  expectLab(labOf(grade), {0.65, 0.03, -0.04});
  grade = {}, grade.contrast = 0;
  expectLab(labOf(grade), {0.5, 0.03, -0.04});
  grade = {}, grade.overlay = glm::vec3(0.3f, 0.1f, 0.2f), grade.overlayAmount = 1;
  expectLab(labOf(grade), oklabFromLinear(glm::dvec3(grade.overlay)));
  grade.overlayAmount = 0.25f;
  expectLab(labOf(grade),
            glm::mix(glm::dvec3(0.6, 0.03, -0.04), oklabFromLinear(glm::dvec3(grade.overlay)), 0.25));
}

TEST(Grade, staysInsideSrgb) {
  for (const float extreme : {0.0f, 3.0f})
    forColors(5, [&](const glm::dvec3& color) {
      const glm::dvec3 c = graded({117, extreme, extreme, 3, 0.3f, {1, 0, 0}}, color);
      for (int i = 0; i < 3; ++i) EXPECT_TRUE(c[i] >= 0 && c[i] <= 1) << c[i];
    });
}

TEST(Palette, hueAndCurveOfTheShadow) {
  PaletteParams params;
  params.shadowTintAmount = 0, params.shadowRedden = 0, params.shadowSaturation = 1;
  const glm::dvec3 albedo(0.25, 0.16, 0.2), lit = oklabFromLinear(litColor(params, albedo));
  params.shadowHue = 180;
  glm::dvec3 dark = oklabFromLinear(shadowedColor(params, albedo));
  EXPECT_NEAR(dark.x, params.shadowValue * lit.x, 1e-3);
  EXPECT_NEAR(dark.y, -lit.y, 1e-3);
  EXPECT_NEAR(dark.z, -lit.z, 1e-3);
  params.shadowHue = 90;  // from a towards b, from red towards yellow
  dark = oklabFromLinear(shadowedColor(params, albedo));
  EXPECT_NEAR(dark.y, -lit.z, 1e-3);
  EXPECT_NEAR(dark.z, lit.y, 1e-3);
  params.shadowHue = 0, params.shadowCurve = 2;
  dark = oklabFromLinear(shadowedColor(params, albedo));
  EXPECT_NEAR(dark.x, params.shadowValue * lit.x * lit.x, 1e-3);
  EXPECT_NEAR(dark.y, lit.y, 1e-3);
}

// -- The maps that carry the rule to the GPU

struct FitError {
  double mean = 0, max = 0;
};
template <class Rule>
FitError errorOfFit(const Rule& rule) {
  const shared::ColorMap map = fitColorMap(rule);
  FitError error;
  int count = 0;
  forColors(13, [&](const glm::dvec3& albedo) {
    const double d = distance(glm::dvec3(apply(map, glm::vec3(albedo))), rule(albedo));
    error.mean += d, error.max = std::max(error.max, d), ++count;
  });
  error.mean /= count;
  return error;
}

// Measured over the sRGB cube at the defaults: light 0.010 on average and 0.085 at most (at black, where the
// rule's cube root is steepest), shadow 0.007 and 0.059.
TEST(PaletteFit, staysNearTheRule) {
  const PaletteParams params;
  const FitError lit = errorOfFit([&](const glm::dvec3& c) { return litColor(params, c); });
  EXPECT_LT(lit.mean, 0.016);
  EXPECT_LT(lit.max, 0.12);
  const FitError shadowed = errorOfFit([&](const glm::dvec3& c) { return shadowedColor(params, c); });
  EXPECT_LT(shadowed.mean, 0.014);
  EXPECT_LT(shadowed.max, 0.12);
}

// Grades are part of the rule. Moderate ones fit as well as the rule itself; a contrast that cuts lightness
// off at black and white bends too sharply for a quadratic polynomial.
TEST(PaletteFit, grades) {
  const auto errorUnder = [](const Grade& grade) { return errorOfFit(ColorRule{ColorRule::lit, {}, grade}); };
  for (const Grade& grade : {Grade{40, 1, 1, 1, 0, {}}, Grade{0, 0.3f, 1, 1, 0, {}},
                             Grade{0, 1.5f, 1, 1, 0, {}}, Grade{0, 1, 0.7f, 1, 0, {}},
                             Grade{0, 1, 1, 1.4f, 0, {}}, Grade{0, 1, 1, 1, 0.5f, {0.1f, 0.2f, 0.5f}}}) {
    EXPECT_LT(errorUnder(grade).mean, 0.04);
    EXPECT_LT(errorUnder(grade).max, 0.25);
  }
  EXPECT_LT(errorUnder({0, 1, 1, 3, 0, {}}).mean, 0.08);
}

// A rule that is such a polynomial itself must come back exactly: that tries the solver without the rule's
// own bends.
TEST(PaletteFit, isExactForWhatItCanExpress) {
  const auto quadratic = [](const glm::dvec3& linear) {
    const glm::dvec3 r = glm::sqrt(linear);
    const glm::dvec3 root = 0.1 + 0.5 * r + 0.2 * r * glm::dvec3(r.g, r.b, r.r) + 0.15 * r * r;
    return root * root;
  };
  EXPECT_LT(errorOfFit(quadratic).max, 1e-4);
  EXPECT_LT(errorOfFit([](const glm::dvec3& c) { return c; }).max, 2e-3);
}

TEST(PaletteFit, constantAndIdentity) {
  const glm::vec3 color(0.2f, 0.5f, 0.04f);
  forColors(5, [&](const glm::dvec3& albedo) {
    EXPECT_NEAR(glm::length(apply(constantColorMap(color), glm::vec3(albedo)) - color), 0, 1e-6);
    EXPECT_NEAR(glm::length(apply(identityColorMap(), glm::vec3(albedo)) - glm::vec3(albedo)), 0, 1e-6);
  });
  // Out of range, as blended vertex colours may be: clamped, and never a number that is none.
  const glm::vec3 odd = apply(identityColorMap(), {-1, 4, 0.5f});
  EXPECT_NEAR(glm::length(odd - glm::vec3(0, 1, 0.5f)), 0, 1e-6);
}

// -- The background

double lightnessOf(const glm::vec3& linear) {
  return oklabFromLinear(glm::dvec3(linear)).x;
}

SceneColors sceneOf(const glm::dvec3& linear) {
  SceneColorSum sum;
  sum.add({1, glm::sqrt(linear)});
  return sum.colors();
}

// "A background two steps away in value from the model": a step is 0.1 of OKLab lightness, and each of the
// background's three colours may lie a third of a step off. Scenes of a lightness between the two rules have
// less: light lies not far enough above them and the middle value not far enough below.
TEST(Background, standsTwoStepsOfValueAwayFromTheScene) {
  forColors(9, [&](const glm::dvec3& linear) {
    const BackgroundColors background = automaticBackground(sceneOf(linear));
    const double scene = oklabFromLinear(linear).x;
    if (scene > 0.60 && scene < 0.82) return;
    for (const glm::vec3& part : {background.horizon, background.zenith, background.ground})
      EXPECT_GT(std::abs(lightnessOf(part) - scene), 0.13)
          << "scene " << scene << " background " << lightnessOf(part);
  });
}

// Black and white at once, as pandas are: their mean stands apart from a light background, and the white does
// not. What is a small part decides nothing where it costs the rest.
TEST(Background, standsApartFromBothMassesOfAScene) {
  const auto groundOf = [](std::initializer_list<std::pair<double, double>> parts) {
    SceneColorSum sum;
    for (const auto& [area, root] : parts) sum.add({area, glm::dvec3(root)});
    return lightnessOf(automaticBackground(sum.colors()).ground);
  };
  const double white = lightnessOf(glm::vec3(litColor({}, glm::dvec3(0.9))));
  const double black = lightnessOf(glm::vec3(litColor({}, glm::dvec3(0.01))));
  EXPECT_GT(groundOf({{1, 0.3}}), 0.8) << "a dark scene by itself has a light ground";
  for (const double part : {0.25, 0.5, 0.75}) {
    const double ground = groundOf({{part, 0.95}, {1 - part, 0.1}});
    EXPECT_GT(white - ground, 0.13) << part;
    EXPECT_GT(ground - black, 0.2) << part;
  }
  EXPECT_NEAR(groundOf({{0.03, 0.95}, {0.97, 0.1}}), groundOf({{1, 0.1}}), 0.05);
  // A value that lies near the usual background has another.
  for (double root = 0.02; root < 1; root += 0.02) {
    const double lit = lightnessOf(glm::vec3(litColor({}, glm::dvec3(root * root))));
    EXPECT_GT(std::abs(groundOf({{1, root}}) - lit), 0.12) << root;
  }
}

TEST(SceneColors, areMeanDeviationAndPartsByArea) {
  SceneColorSum sum;
  EXPECT_EQ(sum.colors().meanRootRgb, glm::vec3(0.5f)) << "nothing is grey";
  EXPECT_EQ(sum.colors().variety, 0);
  sum.add({3, glm::dvec3(1.0)});
  sum.add({1, glm::dvec3(0.0)});
  const SceneColors colors = sum.colors();
  EXPECT_NEAR(colors.meanRootRgb.g, 0.75, 1e-6);
  EXPECT_NEAR(colors.variety, std::sqrt(3 * 0.75 * 0.25), 1e-6);
  EXPECT_FLOAT_EQ(colors.values.front(), 0.25f);
  EXPECT_FLOAT_EQ(colors.values.back(), 0.75f);
  EXPECT_FLOAT_EQ(std::accumulate(colors.values.begin(), colors.values.end(), 0.0f), 1.0f);
}

TEST(Background, isQuietAndNeitherBlackNorBurntOut) {
  forColors(9, [&](const glm::dvec3& linear) {
    const BackgroundColors background = automaticBackground(sceneOf(linear));
    for (const glm::vec3& part : {background.horizon, background.zenith, background.ground}) {
      const glm::dvec3 lab = oklabFromLinear(glm::dvec3(part));
      EXPECT_GT(lab.x, 0.5);
      EXPECT_LT(lab.x, 0.95);
      EXPECT_LT(std::hypot(lab.y, lab.z), 0.09) << "a background that shouts";
    }
    EXPECT_GT(lightnessOf(background.horizon), lightnessOf(background.zenith)) << "the far is lighter";
    EXPECT_LT(distance(glm::dvec3(background.horizon), glm::dvec3(background.zenith)), 0.2);
  });
}

TEST(Ground, followsItsKnobAndTheScenesShape) {
  scene::SceneData tall, flat;
  tall.bounds.add({-1, 0, -1}), tall.bounds.add({1, 2, 1});
  flat.bounds.add({-10, 0, -10}), flat.bounds.add({10, 1, 10});
  // A pier is low beside its longer side, whichever that is.
  for (const glm::vec3& size : {glm::vec3(20, 1, 2), glm::vec3(2, 1, 20)}) {
    scene::SceneData pier;
    pier.bounds.add(glm::vec3(0.0f)), pier.bounds.add(size);
    EXPECT_FALSE(hasGround(pier, {}, false));
  }
  look::LookData look;
  EXPECT_TRUE(hasGround(tall, look, false));
  EXPECT_FALSE(hasGround(flat, look, false));
  const look::ParamRow& mode = GroundParams::block().rows[0];
  ASSERT_STREQ(mode.name, "mode");
  look.assignments.push_back({"", &GroundParams::block(), &mode, {1, {}}});
  EXPECT_TRUE(hasGround(flat, look, false));
  look.assignments.push_back({"", &GroundParams::block(), &mode, {2, {}}});
  EXPECT_FALSE(hasGround(tall, look, false));
}

}  // namespace
}  // namespace scumble::stage
