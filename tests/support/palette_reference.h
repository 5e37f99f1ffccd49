// docs/palette.md in double precision: OKLab by its definition, the palette rule, grades, and the polynomial
// that stands for a rule on the GPU.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>

namespace scumble::test {

// OKLab by way of CIE XYZ, as Ottosson 2020 defines it; linear sRGB.
glm::dvec3 referenceLab(const glm::dvec3& linear);
glm::dvec3 referenceLinear(const glm::dvec3& lab);
// From 0xRRGGBB.
glm::dvec3 referenceColor(uint32_t srgb);

// The knobs `palette`, with the defaults that they have.
struct PaletteReference {
  double darkest = 0.20, lightest = 0.93, saturation = 1;
  glm::dvec3 litTint = referenceColor(0xF2B45A);
  double litTintAmount = 0.12;
  double shadowValue = 0.67, shadowSaturation = 0.62, shadowRedden = 0.22, shadowHue = 0, shadowCurve = 1;
  glm::dvec3 shadowTint = referenceColor(0x5E63A6);
  double shadowTintAmount = 0.5;

  glm::dvec3 lit(const glm::dvec3& own) const;
  glm::dvec3 shadowed(const glm::dvec3& own) const;
};

// The knobs `lit` and `shadowed`.
struct GradeReference {
  double hue = 0, saturation = 1, brightness = 1, contrast = 1, overlayAmount = 0;
  glm::dvec3 overlay{1.0};
  glm::dvec3 operator()(const glm::dvec3& color) const;
};

// The least-squares fit of a rule, and what it makes of a colour.
class FitReference {
 public:
  explicit FitReference(const std::function<glm::dvec3(const glm::dvec3&)>& rule);
  glm::dvec3 operator()(const glm::dvec3& linear) const;

 private:
  std::array<glm::dvec3, 10> terms_;
};

// By how much a shadow's colour is multiplied for the sky above and the ground below; `up`: y of the normal.
glm::dvec3 skyTintReference(double amount, double up);

}  // namespace scumble::test
