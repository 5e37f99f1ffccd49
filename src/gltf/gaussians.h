// Gaussians of captured places, and of paintings as points: POINTS primitives with KHR_gaussian_splatting.
#pragma once

#include <vector>

#include "gltf/import.h"
#include "scene/painting.h"

namespace scumble::gltf {

constexpr const char* kGaussianSplatting = "KHR_gaussian_splatting";
constexpr double kHarmonic = 0.28209479177387814;  // spherical harmonic of degree 0: sqrt(1 / (4 pi))

// True for a primitive that is a cloud of them.
bool areGaussians(const JsonView& primitive);

// Each becomes a point: POSITION; :ROTATION, a quaternion; :SCALE, standard deviations in metres; :OPACITY;
// its colour from :SH_DEGREE_0_COEF_0, by the extension's colorSpace. Colours that change with the side they
// are seen from (higher degrees), and kernels that are no ellipse, are taken for plain ones with a warning.
// Fails where one of them is missing or has another count.
std::vector<StrokePoint> readGaussians(const Import& import, const JsonView& primitive,
                                       ImportWarnings& warnings);

}  // namespace scumble::gltf
