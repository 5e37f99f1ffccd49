// The palette rule, grades and the polynomials that carry them to the GPU, against docs/palette.md in double
// precision.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/oklab.h"
#include "stage/palette.h"
#include "tests/support/palette_reference.h"

namespace scumble::stage {
namespace {

using namespace test;

// OKLab's constants have ten digits, those of sRGB's matrix seven.
constexpr double kLabNear = 5e-4;

void expectNear(const glm::dvec3& got, const glm::dvec3& expected, double near, const std::string& what) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], expected[i], near) << what << ", axis " << i;
}

// Calls with linear colours, even in their square roots.
template <class Function>
void forRoots(int steps, const Function& function) {
  for (int r = 0; r < steps; ++r)
    for (int g = 0; g < steps; ++g)
      for (int b = 0; b < steps; ++b) {
        const glm::dvec3 root = glm::dvec3(r, g, b) / double(steps - 1);
        function(root * root, std::to_string(r) + " " + std::to_string(g) + " " + std::to_string(b));
      }
}

// Ottosson's own table, of XYZ to two or three digits, and the way there and back.
TEST(OklabRule, isTheDefinition) {
  forRoots(6, [](const glm::dvec3& linear, const std::string& what) {
    expectNear(oklabFromLinear(linear), referenceLab(linear), kLabNear, what);
    expectNear(linearFromOklab(referenceLab(linear)), linear, 2e-3, what);
    expectNear(referenceLinear(referenceLab(linear)), linear, 1e-9, what);
  });
  expectNear(oklabFromLinear(glm::dvec3(1)), {1, 0, 0}, 1e-4, "white");
  // Published for sRGB's primaries.
  expectNear(oklabFromLinear({1, 0, 0}), {0.62796, 0.22486, 0.12585}, 1e-4, "red");
  expectNear(oklabFromLinear({0, 1, 0}), {0.86644, -0.23389, 0.17950}, 1e-4, "green");
  expectNear(oklabFromLinear({0, 0, 1}), {0.45201, -0.03246, -0.31153}, 1e-4, "blue");
}

// Each knob away from its default, and all together.
TEST(PaletteRule, isWhatItsPageSays) {
  struct Case {
    const char* name;
    double PaletteReference::*reference;
    float PaletteParams::*knob;
    double value;
  };
  const Case cases[] = {
      {"darkest", &PaletteReference::darkest, &PaletteParams::darkest, 0.05},
      {"lightest", &PaletteReference::lightest, &PaletteParams::lightest, 0.8},
      {"saturation", &PaletteReference::saturation, &PaletteParams::saturation, 1.4},
      {"litTintAmount", &PaletteReference::litTintAmount, &PaletteParams::litTintAmount, 0.7},
      {"shadowValue", &PaletteReference::shadowValue, &PaletteParams::shadowValue, 0.5},
      {"shadowSaturation", &PaletteReference::shadowSaturation, &PaletteParams::shadowSaturation, 1.1},
      {"shadowRedden", &PaletteReference::shadowRedden, &PaletteParams::shadowRedden, 0.6},
      {"shadowHue", &PaletteReference::shadowHue, &PaletteParams::shadowHue, -70},
      {"shadowCurve", &PaletteReference::shadowCurve, &PaletteParams::shadowCurve, 1.7},
      {"shadowTintAmount", &PaletteReference::shadowTintAmount, &PaletteParams::shadowTintAmount, 1.2}};
  const auto compare = [](const PaletteParams& params, const PaletteReference& reference,
                          const std::string& name) {
    forRoots(4, [&](const glm::dvec3& own, const std::string& what) {
      // Linear RGB; the gamut's border is found to 2^-16 of the chroma, and may lie 1e-4 outside.
      expectNear(litColor(params, own), reference.lit(own), 1e-3, name + " lit " + what);
      expectNear(shadowedColor(params, own), reference.shadowed(own), 1e-3, name + " shadowed " + what);
    });
  };
  PaletteParams all;
  PaletteReference allReference;
  compare(all, allReference, "defaults");
  for (const Case& c : cases) {
    PaletteParams one;
    PaletteReference oneReference;
    one.*c.knob = all.*c.knob = float(c.value);
    oneReference.*c.reference = allReference.*c.reference = c.value;
    compare(one, oneReference, c.name);
  }
  all.litTint.linear = look::linearFromSrgb(0x40C0A0), allReference.litTint = referenceColor(0x40C0A0);
  all.shadowTint.linear = look::linearFromSrgb(0x802010), allReference.shadowTint = referenceColor(0x802010);
  compare(all, allReference, "all");
}

TEST(PaletteRule, gradesAreWhatTheirPageSays) {
  for (const auto& [hue, saturation, brightness, contrast, amount] : {std::tuple{0.0, 1.0, 1.0, 1.0, 0.0},
                                                                      {50.0, 1.0, 1.0, 1.0, 0.0},
                                                                      {-120.0, 0.4, 0.8, 1.3, 0.0},
                                                                      {20.0, 1.8, 1.3, 0.6, 0.35},
                                                                      {0.0, 1.0, 1.0, 1.0, 1.0}}) {
    const glm::dvec3 overlay(0.1, 0.3, 0.6);
    const Grade grade{float(hue),      float(saturation), float(brightness),
                      float(contrast), float(amount),     glm::vec3(overlay)};
    const GradeReference reference{hue, saturation, brightness, contrast, amount, overlay};
    forRoots(4, [&](const glm::dvec3& color, const std::string& what) {
      expectNear(graded(grade, color), reference(color), 1e-3, what);
    });
  }
}

// The nearest quadratic polynomial in square roots, weighted towards greys: the very one, not only a near
// one.
TEST(PaletteRule, fitIsTheLeastSquares) {
  const PaletteReference palette;
  const std::function<glm::dvec3(const glm::dvec3&)> rules[] = {
      [&](const glm::dvec3& c) { return palette.lit(c); },
      [&](const glm::dvec3& c) { return palette.shadowed(c); },
      // Bends sharply, so that every weight shows.
      [](const glm::dvec3& c) { return glm::dvec3(c.y > 0.4 ? 1.0 : 0.1, std::abs(c.x - c.z), c.x * c.y); }};
  for (const auto& rule : rules) {
    const shared::ColorMap map = fitColorMap(rule);
    const FitReference reference(rule);
    forRoots(5, [&](const glm::dvec3& own, const std::string& what) {
      // The map is of floats.
      expectNear(glm::dvec3(apply(map, glm::vec3(own))), reference(own), 2e-5, what);
    });
  }
}

}  // namespace
}  // namespace scumble::stage
