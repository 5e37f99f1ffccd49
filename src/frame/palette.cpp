#include "frame/palette.h"

#include <algorithm>

#include "base/oklab.h"

namespace scumble::frame {

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

glm::dvec3 litColor(const PaletteParams& params, const glm::dvec3& albedo) { return toGamut(litLab(params, albedo)); }

glm::dvec3 shadowedColor(const PaletteParams& params, const glm::dvec3& albedo) {
  glm::dvec3 lab = litLab(params, albedo);
  const glm::dvec2 shift = tintShift(params.shadowTint) * double(params.shadowTintAmount);
  lab.x *= params.shadowValue;
  lab.y = lab.y * params.shadowSaturation + shift.x;
  lab.z = lab.z * params.shadowSaturation + shift.y;
  return toGamut(lab);
}

glm::vec3 AffineColorMap::apply(const glm::vec3& linear) const {
  const glm::vec3 c = glm::max(matrix * glm::sqrt(glm::clamp(linear, 0.0f, 1.0f)) + offset, 0.0f);
  return c * c;
}

bool hasGround(const scene::SceneData& scene, const look::LookData& look) {
  const int mode = look.get<GroundParams>().mode;
  if (mode != 0) return mode == 1;
  // A scene that is wide and low, or seen from inside by its own camera, brings its own ground.
  const glm::vec3 size = scene.bounds.max - scene.bounds.min;
  return size.y > 0.12f * std::max(size.x, size.z);
}

AffineColorMap fitColorMap(const std::function<glm::dvec3(const glm::dvec3&)>& rule) {
  // Normal equations over a grid of roots: unknowns are three coefficients and an offset for each output channel.
  constexpr int kGrid = 5;
  glm::dmat4 normal(0.0);
  glm::dvec4 right[3] = {};
  for (int i = 0; i < kGrid * kGrid * kGrid; ++i) {
    const glm::dvec3 root = glm::dvec3(i % kGrid, i / kGrid % kGrid, i / (kGrid * kGrid)) / double(kGrid - 1);
    const glm::dvec4 x(root, 1.0);
    // Greys and soft colours are what scenes are made of; pure primaries count less.
    const double spread = std::max({root.r, root.g, root.b}) - std::min({root.r, root.g, root.b});
    const double weight = 1.0 / (0.1 + spread * spread);
    const glm::dvec3 y = glm::sqrt(rule(root * root));
    normal += weight * glm::outerProduct(x, x);
    for (int c = 0; c < 3; ++c) right[c] += weight * y[c] * x;
  }
  const glm::dmat4 inverse = glm::inverse(normal);
  AffineColorMap map;
  for (int c = 0; c < 3; ++c) {
    const glm::dvec4 row = inverse * right[c];
    for (int k = 0; k < 3; ++k) map.matrix[k][c] = float(row[k]);
    map.offset[c] = float(row[3]);
  }
  return map;
}

BackgroundColors automaticBackground(const SceneColors& colors) {
  const glm::dvec3 scene = oklabFromLinear(glm::dvec3(colors.meanRootRgb * colors.meanRootRgb));
  // Light scenes stand before a middle value, dark ones before a light one; hue leans away from the scene's own.
  const double lightness = scene.x > 0.62 ? std::clamp(scene.x - 0.26, 0.55, 0.66) : std::clamp(scene.x + 0.34, 0.76, 0.88);
  const glm::dvec2 own(scene.y, scene.z);
  const glm::dvec2 away = glm::length(own) > 0.02 ? -own / glm::length(own) : glm::dvec2(0.0);
  const auto color = [&](double l, glm::dvec2 ab) { return glm::vec3(toGamut({l, ab.x, ab.y})); };
  const glm::dvec2 warm(0.012, 0.040), cool(-0.028, -0.018);
  return {color(lightness, 0.8 * warm + 0.010 * away), color(lightness - 0.07, cool + 0.012 * away),
          color(lightness - 0.035, warm + 0.004 * away)};
}

}  // namespace scumble::frame
