#include "tests/support/palette_reference.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scumble::test {

namespace {

// Rows, as they are printed: sRGB with its D65 white to XYZ, XYZ to cones, roots of cones to OKLab.
const glm::dmat3 kToXyz = glm::transpose(glm::dmat3(0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522,
                                                    0.0721750, 0.0193339, 0.1191920, 0.9503041));
const glm::dmat3 kToCones =
    glm::transpose(glm::dmat3(0.8189330101, 0.3618667424, -0.1288597137, 0.0329845436, 0.9293118715,
                              0.0361456387, 0.0482003018, 0.2643662691, 0.6338517070));
const glm::dmat3 kToLab =
    glm::transpose(glm::dmat3(0.2104542553, 0.7936177850, -0.0040720468, 1.9779984951, -2.4285922050,
                              0.4505937099, 0.0259040371, 0.7827717662, -0.8086757660));

glm::dvec3 turned(const glm::dvec3& lab, double degrees) {
  const double angle = glm::radians(degrees);
  return {lab.x, std::cos(angle) * lab.y - std::sin(angle) * lab.z,
          std::sin(angle) * lab.y + std::cos(angle) * lab.z};
}

// Keeps lightness and hue, and loses chroma until it is inside sRGB.
glm::dvec3 inGamut(glm::dvec3 lab) {
  lab.x = std::clamp(lab.x, 0.0, 1.0);
  const auto withChroma = [&](double part) { return referenceLinear(lab * glm::dvec3(1, part, part)); };
  const auto isInside = [&](double part) {
    const glm::dvec3 c = withChroma(part);
    return std::min({c.x, c.y, c.z}) >= -1e-4 && std::max({c.x, c.y, c.z}) <= 1 + 1e-4;
  };
  double inside = 0, outside = 1;
  if (isInside(1)) inside = 1;
  for (int i = 0; i < 40 && inside < 1; ++i) {
    const double middle = (inside + outside) / 2;
    (isInside(middle) ? inside : outside) = middle;
  }
  return glm::clamp(withChroma(inside), 0.0, 1.0);
}

std::array<double, 10> monomials(const glm::dvec3& r) {
  return {1, r.x, r.y, r.z, r.x * r.x, r.y * r.y, r.z * r.z, r.x * r.y, r.y * r.z, r.z * r.x};
}

glm::dvec3 litLab(const PaletteReference& p, const glm::dvec3& own) {
  glm::dvec3 lab = referenceLab(own);
  lab.x = glm::mix(p.darkest, p.lightest, lab.x);
  const glm::dvec3 tint = referenceLab(p.litTint) * p.litTintAmount * std::clamp(1.15 - lab.x, 0.0, 1.0);
  return {lab.x, p.saturation * lab.y + tint.y, p.saturation * lab.z + tint.z};
}

}  // namespace

glm::dvec3 referenceLab(const glm::dvec3& linear) {
  const glm::dvec3 cones = kToCones * (kToXyz * linear);
  return kToLab * glm::dvec3(std::cbrt(cones.x), std::cbrt(cones.y), std::cbrt(cones.z));
}

glm::dvec3 referenceLinear(const glm::dvec3& lab) {
  const glm::dvec3 roots = glm::inverse(kToLab) * lab;
  return glm::inverse(kToCones * kToXyz) * (roots * roots * roots);
}

glm::dvec3 referenceColor(uint32_t srgb) {
  glm::dvec3 linear;
  for (int c = 0; c < 3; ++c) {
    const double code = double(srgb >> (16 - 8 * c) & 255) / 255;
    linear[c] = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
  }
  return linear;
}

glm::dvec3 PaletteReference::lit(const glm::dvec3& own) const {
  return inGamut(litLab(*this, own));
}

glm::dvec3 PaletteReference::shadowed(const glm::dvec3& own) const {
  const glm::dvec3 light = litLab(*this, own), hued = turned(light, shadowHue),
                   shade = referenceLab(shadowTint) * shadowTintAmount;
  return inGamut({shadowValue * std::pow(std::clamp(light.x, 0.0, 1.0), shadowCurve),
                  shadowSaturation * hued.y + shade.y + shadowRedden * std::max(hued.z, 0.0),
                  shadowSaturation * hued.z + shade.z});
}

glm::dvec3 GradeReference::operator()(const glm::dvec3& color) const {
  glm::dvec3 lab = turned(referenceLab(color), hue);
  lab.x = std::clamp(0.5 + contrast * (brightness * lab.x - 0.5), 0.0, 1.0);
  lab *= glm::dvec3(1, saturation, saturation);
  return inGamut(lab * (1 - overlayAmount) + referenceLab(overlay) * overlayAmount);
}

FitReference::FitReference(const std::function<glm::dvec3(const glm::dvec3&)>& rule) {
  // Normal equations with three right sides.
  double rows[10][13] = {};
  for (int r = 0; r < 7; ++r)
    for (int g = 0; g < 7; ++g)
      for (int b = 0; b < 7; ++b) {
        const glm::dvec3 root = glm::dvec3(r, g, b) / 6.0, value = glm::sqrt(rule(root * root));
        const double weight = 1 / (0.3 + (std::max({r, g, b}) - std::min({r, g, b})) / 6.0);
        const std::array<double, 10> x = monomials(root);
        for (size_t i = 0; i < 10; ++i) {
          for (size_t j = 0; j < 10; ++j) rows[i][j] += weight * x[i] * x[j];
          for (int c = 0; c < 3; ++c) rows[i][10 + c] += weight * x[i] * value[c];
        }
      }
  // Gauss and Jordan, the largest pivot first.
  for (int i = 0; i < 10; ++i) {
    int largest = i;
    for (int k = i + 1; k < 10; ++k)
      if (std::abs(rows[k][i]) > std::abs(rows[largest][i])) largest = k;
    std::swap(rows[i], rows[largest]);
    for (int k = 0; k < 10; ++k) {
      const double part = rows[k][i] / rows[i][i];
      for (int j = 0; j < 13 && k != i; ++j) rows[k][j] -= part * rows[i][j];
    }
  }
  for (int i = 0; i < 10; ++i)
    terms_[size_t(i)] = glm::dvec3(rows[i][10], rows[i][11], rows[i][12]) / rows[i][i];
}

glm::dvec3 FitReference::operator()(const glm::dvec3& linear) const {
  const std::array<double, 10> x = monomials(glm::sqrt(glm::clamp(linear, 0.0, 1.0)));
  glm::dvec3 root(0.0);
  for (size_t i = 0; i < 10; ++i) root += x[i] * terms_[i];
  root = glm::max(root, 0.0);
  return root * root;
}

glm::dvec3 skyTintReference(double amount, double up) {
  const glm::dvec3 sky = 1.0 + amount * glm::dvec3(0, 0.7, 1.6),
                   ground = glm::max(1.0 + amount * glm::dvec3(0.6, -0.4, -1.2), 0.0);
  // Between the two in square roots, as targets hold colours.
  const glm::dvec3 root = glm::mix(glm::sqrt(ground), glm::sqrt(sky), 0.5 + 0.5 * up);
  return root * root;
}

}  // namespace scumble::test
