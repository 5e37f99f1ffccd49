// Pictures as planes of numbers, and what is done to them before anything is counted.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scumble/image.h"

namespace scumble::study {

struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;  // row 0 at the top

  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(size_t(w) * size_t(h)) {}
  float& at(int x, int y) { return values[size_t(y) * size_t(width) + size_t(x)]; }
  float at(int x, int y) const { return values[size_t(y) * size_t(width) + size_t(x)]; }
};

// A picture in OKLab.
struct LabPicture {
  Plane lightness, a, b;
  double pixelsAt1080 = 1;  // how many pixels at 1080 lines one of these is

  glm::dvec3 at(size_t pixel) const { return {lightness.values[pixel], a.values[pixel], b.values[pixel]}; }
};

// Colours of linear RGB over white, of at most this many lines: each pixel is the mean, in linear light, of
// the area that it takes the place of.
LabPicture labOf(const Image& colors, uint32_t lines);
// Linear RGB of OKLab, the nearest in sRGB by channel.
glm::vec3 rgbOf(const glm::dvec3& lab);

Plane difference(const Plane& a, const Plane& b);

// Convolved with a Gaussian of this deviation; the picture's ends go on.
Plane blurred(const Plane& plane, double deviation);
// Without what is dark and thinner than 2 reach + 1: the greatest within `reach` in x and y, and of that the
// least.
Plane closed(const Plane& plane, int reach);
Plane greatestWithin(const Plane& plane, int reach);
Plane leastWithin(const Plane& plane, int reach);
// Length of the gradient, by differences of neighbours.
Plane steepness(const Plane& plane);
Plane transposed(const Plane& plane);

// The value that this share of the numbers is below; 0 where there are none. Changes their order.
double quantile(std::vector<float>& values, double share);

}  // namespace scumble::study
