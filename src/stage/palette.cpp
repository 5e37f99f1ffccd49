#include "stage/palette.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/oklab.h"

namespace scumble::stage {

namespace {

// Direction of a tint's hue in OKLab's a, b plane, as a shift for an amount of 1.
glm::dvec2 tintShift(const look::Color& tint) {
  const glm::dvec3 lab = oklabFromLinear(glm::dvec3(tint.linear));
  return {lab.y, lab.z};
}

// Makes room for out-of-gamut colours by lowering chroma at constant lightness and hue.
glm::dvec3 toGamut(glm::dvec3 lab) {
  lab.x = std::clamp(lab.x, 0.0, 1.0);
  double low = 0, high = 1;
  const auto inside = [&](double chroma) {
    const glm::dvec3 c = linearFromOklab({lab.x, lab.y * chroma, lab.z * chroma});
    return c.r >= -1e-4 && c.g >= -1e-4 && c.b >= -1e-4 && c.r <= 1.0001 && c.g <= 1.0001 && c.b <= 1.0001;
  };
  if (!inside(1)) {
    for (int i = 0; i < 16; ++i) {
      const double middle = 0.5 * (low + high);
      (inside(middle) ? low : high) = middle;
    }
  } else {
    low = 1;
  }
  return glm::clamp(linearFromOklab({lab.x, lab.y * low, lab.z * low}), 0.0, 1.0);
}

// Turned around the axis of greys.
glm::dvec3 withHue(const glm::dvec3& lab, double degrees) {
  if (degrees == 0) return lab;
  const double angle = glm::radians(degrees), c = std::cos(angle), s = std::sin(angle);
  return {lab.x, c * lab.y - s * lab.z, s * lab.y + c * lab.z};
}

glm::dvec3 litLab(const PaletteParams& params, const glm::dvec3& albedo) {
  glm::dvec3 lab = oklabFromLinear(albedo);
  lab.x = params.darkest + (params.lightest - params.darkest) * lab.x;
  const glm::dvec2 shift = tintShift(params.litTint) * double(params.litTintAmount);
  // White takes little tint, so that it stays white in the light.
  const double room = std::clamp(1.15 - lab.x, 0.0, 1.0);
  lab.y = lab.y * params.saturation + shift.x * room;
  lab.z = lab.z * params.saturation + shift.y * room;
  return lab;
}

}  // namespace

glm::dvec3 litColor(const PaletteParams& params, const glm::dvec3& albedo) {
  return toGamut(litLab(params, albedo));
}

glm::dvec3 shadowedColor(const PaletteParams& params, const glm::dvec3& albedo) {
  glm::dvec3 lab = litLab(params, albedo);
  const glm::dvec2 shift = tintShift(params.shadowTint) * double(params.shadowTintAmount);
  if (params.shadowCurve != 1) lab.x = std::pow(std::clamp(lab.x, 0.0, 1.0), double(params.shadowCurve));
  lab.x *= params.shadowValue;
  lab = withHue(lab, params.shadowHue);
  // Warm colours pass through red on their way to violet; straight across they would turn olive.
  lab.y = lab.y * params.shadowSaturation + shift.x + params.shadowRedden * std::max(lab.z, 0.0);
  lab.z = lab.z * params.shadowSaturation + shift.y;
  return toGamut(lab);
}

glm::dvec3 graded(const Grade& grade, const glm::dvec3& color) {
  if (grade == Grade()) return color;
  glm::dvec3 lab = withHue(oklabFromLinear(color), grade.hue);
  lab.x = std::clamp(0.5 + grade.contrast * (lab.x * grade.brightness - 0.5), 0.0, 1.0);
  lab.y *= grade.saturation;
  lab.z *= grade.saturation;
  return toGamut(glm::mix(lab, oklabFromLinear(glm::dvec3(grade.overlay)), double(grade.overlayAmount)));
}

glm::dvec3 ColorRule::operator()(const glm::dvec3& albedo) const {
  switch (side) {
    case lit:
      return graded(grade, litColor(palette, albedo));
    case shadowed:
      return graded(grade, shadowedColor(palette, albedo));
    default:
      return graded(grade, albedo);
  }
}

namespace {

constexpr int kTerms = shared::kColorMapTerms;
using Terms = std::array<double, kTerms>;

Terms termsOf(const glm::dvec3& r) {
  return {1, r.r, r.g, r.b, r.r * r.r, r.g * r.g, r.b * r.b, r.r * r.g, r.g * r.b, r.b * r.r};
}

// Solves the symmetric positive definite system in place (Cholesky).
void solve(std::array<Terms, kTerms> a, Terms& x) {
  for (int i = 0; i < kTerms; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (int k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      a[i][j] = i == j ? std::sqrt(sum) : sum / a[j][j];
    }
  }
  for (int i = 0; i < kTerms; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= a[i][k] * x[k];
    x[i] /= a[i][i];
  }
  for (int i = kTerms - 1; i >= 0; --i) {
    for (int k = i + 1; k < kTerms; ++k) x[i] -= a[k][i] * x[k];
    x[i] /= a[i][i];
  }
}

}  // namespace

shared::ColorMap fitColorMap(const std::function<glm::dvec3(const glm::dvec3&)>& rule) {
  // Normal equations over a grid of roots.
  constexpr int kGrid = 7;
  std::array<Terms, kTerms> normal{};
  Terms right[3] = {};
  for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
    const glm::dvec3 root = glm::dvec3(i % kGrid, i / kGrid % kGrid, i / (kGrid * kGrid)) / double(kGrid - 1);
    const Terms x = termsOf(root);
    // Greys and soft colours are what scenes are made of; pure primaries count less.
    const double spread = std::max({root.r, root.g, root.b}) - std::min({root.r, root.g, root.b});
    const double weight = 1.0 / (0.3 + spread);
    const glm::dvec3 y = glm::sqrt(rule(root * root));
    for (int j = 0; j < kTerms; ++j) {
      for (int k = 0; k < kTerms; ++k) normal[j][k] += weight * x[j] * x[k];
      for (int c = 0; c < 3; ++c) right[c][j] += weight * y[c] * x[j];
    }
  }
  shared::ColorMap map{};
  for (int c = 0; c < 3; ++c) {
    solve(normal, right[c]);
    for (int k = 0; k < kTerms; ++k) map.terms[k][c] = float(right[c][k]);
  }
  return map;
}

shared::ColorMap constantColorMap(const glm::vec3& linear) {
  shared::ColorMap map{};
  map.terms[0] = glm::sqrt(linear);
  return map;
}

shared::ColorMap identityColorMap() {
  shared::ColorMap map{};
  for (int c = 0; c < 3; ++c) map.terms[1 + c][c] = 1;
  return map;
}

glm::vec3 apply(const shared::ColorMap& map, const glm::vec3& linear) {
  const Terms terms = termsOf(glm::sqrt(glm::clamp(glm::dvec3(linear), 0.0, 1.0)));
  glm::vec3 root(0.0f);
  for (int k = 0; k < kTerms; ++k) root += float(terms[k]) * map.terms[k];
  root = glm::max(root, 0.0f);
  return root * root;
}

bool hasGround(const scene::SceneData& scene, const look::LookData& look, bool overPicture) {
  const int mode = look.get<GroundParams>().mode;
  if (mode != 0) return mode == 1;
  if (overPicture) return true;
  return !scene.bounds.isLow();  // such a scene brings its own
}

PlaneTints planeTints(float planes, const SceneColors& colors) {
  // Roots that are less than a twelfth apart are one colour, a quarter several.
  const float many = glm::smoothstep(0.08f, 0.25f, colors.variety);
  const float amount = planes * (1 - many);
  return {glm::vec3(1.0f) + amount * glm::vec3(0.03f, 0.07f, 0.13f),
          glm::max(glm::vec3(1.0f) - amount * glm::vec3(0.13f, 0.18f, 0.24f), 0.0f)};
}

void SceneColorSum::add(const ColorSample& sample) {
  const glm::dvec3 linear = sample.root * sample.root;
  sum_ += sample.area * sample.root;
  squares_ += sample.area * linear;
  const double lightness = std::clamp(oklabFromLinear(linear).x, 0.0, 1.0);
  values_[std::min(size_t(lightness * SceneColors::kValues), SceneColors::kValues - 1)] += sample.area;
  area_ += sample.area;
}

void SceneColorSum::add(const SceneColorSum& other) {
  sum_ += other.sum_;
  squares_ += other.squares_;
  for (size_t i = 0; i < values_.size(); ++i) values_[i] += other.values_[i];
  area_ += other.area_;
}

SceneColors SceneColorSum::colors() const {
  SceneColors colors;
  if (!(area_ > 0)) return colors;
  const glm::dvec3 mean = sum_ / area_, variance = glm::max(squares_ / area_ - mean * mean, 0.0);
  colors.meanRootRgb = glm::vec3(mean);
  colors.variety = float(std::sqrt(variance.r + variance.g + variance.b));
  for (size_t i = 0; i < colors.values.size(); ++i) colors.values[i] = float(values_[i] / area_);
  return colors;
}

namespace {

// The lightness of a background that stands apart from the most of a scene, in the light and in shadow, and
// is as near to `usual` as that allows. Of a form, about a third lies in shadow.
double lightnessApart(const SceneColors& colors, double usual) {
  const PaletteParams rule;
  // A step of value is 0.1: less than one is lost, two are enough.
  const auto apart = [](double from, double value) {
    return glm::smoothstep(0.08, 0.2, std::abs(from - value));
  };
  double best = usual, most = -1;
  for (double lightness = std::min(usual, 0.68); lightness < 0.915; lightness += 0.005) {
    double score = -0.25 * std::abs(lightness - usual);
    for (size_t i = 0; i < colors.values.size(); ++i) {
      const double own = (double(i) + 0.5) / double(colors.values.size());
      const double lit = rule.darkest + (rule.lightest - rule.darkest) * own, dark = rule.shadowValue * lit;
      score += colors.values[i] * (2 * apart(lightness, lit) + apart(lightness, dark)) / 3;
    }
    if (score > most) most = score, best = lightness;
  }
  return best;
}

}  // namespace

BackgroundColors automaticBackground(const SceneColors& colors) {
  const glm::dvec3 scene = oklabFromLinear(glm::dvec3(colors.meanRootRgb * colors.meanRootRgb));
  // Light scenes stand before a middle value and cool air; all others before a light value, warm cream unless
  // they are warm themselves. Two steps of value are about 0.2 of lightness.
  const double usual =
      scene.x > 0.74 ? std::clamp(scene.x - 0.21, 0.62, 0.70) : std::clamp(scene.x + 0.34, 0.84, 0.91);
  const double lightness = lightnessApart(colors, usual);
  const double middle = 1 - glm::smoothstep(0.70, 0.84, lightness);
  const double warmth = std::clamp((scene.y + scene.z) / 0.08, -1.0, 1.0);
  const double coolness = glm::mix(0.38 + 0.40 * warmth, 0.80 + 0.20 * warmth, middle);
  const glm::dvec2 warm(0.018, 0.050), cool(-0.034, -0.044);
  const auto color = [&](double l, double mix) {
    const glm::dvec2 ab = glm::mix(warm, cool, glm::clamp(mix, 0.0, 1.0));
    return glm::vec3(toGamut({l, ab.x, ab.y}));
  };
  return {color(lightness + 0.035, coolness - 0.10), color(lightness - 0.045, coolness + 0.10),
          color(lightness, coolness - 0.14)};
}

}  // namespace scumble::stage
