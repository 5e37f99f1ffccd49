#include "passes/colorize/colorizers.h"

#include <algorithm>
#include <cmath>

#include "passes/color/color_knobs.h"
#include "scene/find_node.h"

namespace scumble::passes {

namespace {

bool isIdentity(const GradeParams& grade) {
  return grade.bias.value == glm::vec3(0.0f) && grade.tint.linear * grade.gain == glm::vec3(1.0f) &&
         grade.gamma.value == glm::vec3(1.0f) && grade.saturation == 1;
}

// The world matrix of the space that a volume is in: a node's, or the world itself.
glm::dmat4 spaceOf(const std::string& node, const scene::SceneData& scene,
                   const std::vector<glm::dmat4>& worlds) {
  return node.empty() ? scene::worldToOrigin(scene) : worlds[size_t(scene::findNode(scene, node))];
}

glm::dmat3 turnedBy(const glm::dvec3& degrees) {
  const glm::dvec3 s = glm::sin(glm::radians(degrees)), c = glm::cos(glm::radians(degrees));
  const glm::dmat3 x(1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x), y(c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y),
      z(c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1);
  return z * y * x;
}

// From the unit shape to the world.
glm::dmat4 unitToWorld(const VolumeParams& volume, const glm::dmat4& space) {
  const bool hasSize = volume.shape == kVolumeEllipsoid || volume.shape == kVolumeBox;
  const glm::dvec3 size = hasSize ? glm::dvec3(volume.size.value) : glm::dvec3(double(volume.radius));
  if (volume.shape == kVolumeScene) return {glm::dmat3(size.x)};
  glm::dmat3 linear = turnedBy(glm::dvec3(volume.rotation.value));
  for (int i = 0; i < 3; ++i) linear[i] *= size[i];
  glm::dmat4 placed(linear);
  placed[3] = glm::dvec4(glm::dvec3(volume.center.value), 1);
  return space * placed;
}

// Units in a metre, if that is the same in all directions; else 0.
double evenScale(const glm::dmat3& toUnit) {
  const glm::dmat3 square = glm::transpose(toUnit) * toUnit;
  const double scale = (square[0][0] + square[1][1] + square[2][2]) / 3;
  for (int i = 0; i < 9; ++i)
    if (!(std::abs(square[i / 3][i % 3] - (i % 4 == 0 ? scale : 0)) <= 1e-6 * scale)) return 0;
  return std::sqrt(scale);
}

int shapeOf(const VolumeParams& volume, double even) {
  switch (int(volume.shape)) {
    case kVolumeSphere:
    case kVolumeEllipsoid:
      return even > 0 ? shared::kShapeSphere : shared::kShapeEllipsoid;
    case kVolumeBox:
      return shared::kShapeBox;
    case kVolumeCapsule:
      return shared::kShapeCapsule;
    case kVolumeHalfSpace:
      return shared::kShapeHalfSpace;
    default:
      return shared::kShapeScene;
  }
}

void setGrade(shared::Colorizer& data, const GradeParams& grade) {
  const glm::vec3 tint = grade.tint.linear * grade.gain;
  data.rows[shared::kRowBias] = {grade.bias.value, 0};
  data.rows[shared::kRowColor] = {tint * grade.saturation, 0};
  data.rows[shared::kRowGray] = {tint * (1 - grade.saturation), 0};
  data.rows[shared::kRowGamma] = {grade.gamma.value, 0};
}

}  // namespace

shared::SightLines sightLines(const shared::ViewUniforms& view) {
  const glm::dmat3 toWorld = glm::transpose(glm::dmat3(view.worldToEye));
  const glm::dvec4 toRay(view.ndcToEyeRay);
  const glm::dvec3 middle(toRay.z, toRay.w, 0), across(toRay.x, 0, 0), down(0, toRay.y, 0), ahead(0, 0, -1);
  const double parallel = view.orthographic;
  shared::SightLines lines;
  int i = 0;
  for (const glm::dvec3& part : {middle, across, down}) {
    lines.ray[i] = toWorld * (part * (1 - parallel) + (i == 0 ? ahead : glm::dvec3(0)));
    lines.origin[i] = toWorld * (part * parallel);
    ++i;
  }
  return lines;
}

bool mayGrade(const look::LookData& look, const std::string& colorizer, const scene::SceneData& scene) {
  const VolumeParams volume = look.getFor<VolumeParams>(look::kColorizers, colorizer);
  const std::string& node = look.text(volume.node);
  return volume.density != 0 && !isIdentity(look.getFor<GradeParams>(look::kColorizers, colorizer)) &&
         (node.empty() || scene::findNode(scene, node) >= 0);
}

bool changesOverlays(const look::LookData& look, const scene::SceneData& scene) {
  constexpr float kFarthest = 2;  // scene radii
  const BackgroundParams background = look.get<BackgroundParams>();
  if (background.air > 0 && background.airStart < kFarthest) return true;
  const std::vector<std::string> colorizers = look.declared(look::kColorizers);
  return std::any_of(colorizers.begin(), colorizers.end(),
                     [&](const std::string& name) { return mayGrade(look, name, scene); });
}

std::vector<PlacedColorizer> placeColorizers(const look::LookData& look, const scene::SceneData& scene,
                                             const std::vector<glm::dmat4>& worlds,
                                             const shared::FrameUniforms& uniforms) {
  std::vector<PlacedColorizer> placed;
  for (const std::string& name : look.declared(look::kColorizers)) {
    if (!mayGrade(look, name, scene)) continue;
    const VolumeParams volume = look.getFor<VolumeParams>(look::kColorizers, name);
    const GradeParams grade = look.getFor<GradeParams>(look::kColorizers, name);
    const glm::dmat4 fromUnit = unitToWorld(volume, spaceOf(look.text(volume.node), scene, worlds)),
                     toUnit = glm::inverse(fromUnit);
    bool isFinite = true;
    for (int i = 0; i < 16; ++i) isFinite &= std::isfinite(float(toUnit[i / 4][i % 4]));
    if (!isFinite || glm::determinant(glm::dmat3(fromUnit)) == 0) continue;

    PlacedColorizer one;
    auto& rows = one.data.rows;
    setGrade(one.data, grade);
    const double even = evenScale(glm::dmat3(toUnit));
    const int shape = shapeOf(volume, even), type = 2 * shape + volume.kind;
    for (int v = 0; v < shared::kMaxViews; ++v) {
      const glm::dvec3 eye(uniforms.views[v].eye);
      // A sphere looks the same from all sides: its space need not be turned.
      const glm::dvec3 there = shape == shared::kShapeSphere ? (eye - glm::dvec3(fromUnit[3])) * even
                                                             : glm::dvec3(toUnit * glm::dvec4(eye, 1));
      rows[shared::kRowEyes + v] = glm::dvec4(there, even);
    }
    for (int i = 0; i < 3; ++i) rows[shared::kRowToUnit + i] = glm::dvec4(glm::dvec3(toUnit[i]), 0);
    const double axis = volume.shape == kVolumeCapsule ? double(volume.length) / double(volume.radius) : 0;
    rows[shared::kRowBias].w = volume.density;
    rows[shared::kRowColor].w = (1 - volume.falloff) / volume.falloff;
    rows[shared::kRowGray].w = float(type);
    rows[shared::kRowGamma].w = float(axis);

    one.features = 1 << type;
    if (grade.gamma.value != glm::vec3(1.0f)) one.features |= shared::kHasGamma;
    if (grade.saturation != 1) one.features |= shared::kHasSaturation;
    if (volume.falloff != 0.5f) one.features |= shared::kHasFalloff;

    one.bounded = volume.shape != kVolumeHalfSpace && volume.shape != kVolumeScene;
    // A little more than the shape: the shader rounds.
    const glm::dvec3 extent = 1.01 * glm::dvec3(1, 1 + axis, 1);
    for (int i = 0; i < 8; ++i)
      one.corners[i] = glm::dvec3(
          fromUnit * glm::dvec4(extent * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1), 1));
    placed.push_back(one);
  }
  return placed;
}

}  // namespace scumble::passes
