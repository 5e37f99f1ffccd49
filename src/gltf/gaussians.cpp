#include "gltf/gaussians.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "base/srgb.h"
#include "gltf/strokes.h"

namespace scumble::gltf {

namespace {

constexpr uint64_t kPoints = 0;
constexpr float kRadius = 2;  // standard deviations

}  // namespace

bool areGaussians(const JsonView& primitive) {
  return primitive.count("mode", 4) == kPoints && primitive.extension(kGaussianSplatting);
}

std::vector<StrokePoint> readGaussians(const Import& import, const JsonView& primitive,
                                       ImportWarnings& warnings) {
  const JsonView attributes = primitive.object("attributes"),
                 extension = primitive.extension(kGaussianSplatting);
  if (!attributes) primitive.failAt("attributes", "is missing");
  if (primitive.has("indices")) warnings.add(primitive.path(), "indices of Gaussians are ignored");
  if (extension.text("kernel", "ellipse") != "ellipse")
    warnings.add(extension.path(), "Gaussians of another kernel are drawn as ellipses");
  if (attributes.has("KHR_gaussian_splatting:SH_DEGREE_1_COEF_0"))
    warnings.add(primitive.path(),
                 "colours of Gaussians that change with the view are drawn as from everywhere");
  const bool isLinear = extension.text("colorSpace", "").starts_with("lin");

  const size_t count = openPoints(import, attributes, "POSITION", 3, 3, 0).count;
  import.budget.takeBytes(count * (2 * sizeof(StrokePoint)), primitive.path());
  const auto read = [&](const char* semantic, int components) {
    std::vector<float> numbers(count * size_t(components));
    readFloats(openPoints(import, attributes, semantic, components, components, count), {}, components,
               numbers.data());
    return numbers;
  };
  const std::vector<float> positions = read("POSITION", 3),
                           turns = read("KHR_gaussian_splatting:ROTATION", 4),
                           deviations = read("KHR_gaussian_splatting:SCALE", 3),
                           opacities = read("KHR_gaussian_splatting:OPACITY", 1),
                           harmonics = read("KHR_gaussian_splatting:SH_DEGREE_0_COEF_0", 3);
  std::vector<StrokePoint> points(count);
  for (size_t i = 0; i < count; ++i) {
    StrokePoint& point = points[i];
    point.position = glm::make_vec3(&positions[3 * i]);
    point.orientation = {turns[4 * i + 3], turns[4 * i], turns[4 * i + 1], turns[4 * i + 2]};
    const glm::vec3 reach = kRadius * glm::abs(glm::make_vec3(&deviations[3 * i]));
    point.radius = std::max({reach.x, reach.y, reach.z});
    point.shape = reach / std::max(point.radius, 1e-30f);
    for (int c = 0; c < 3; ++c) {
      const double shown = std::clamp(0.5 + kHarmonic * double(harmonics[3 * i + size_t(c)]), 0.0, 1.0);
      point.color[c] = float(isLinear ? shown : linearFromSrgb(shown));
    }
    point.color.a = opacities[i];
  }
  return points;
}

}  // namespace scumble::gltf
