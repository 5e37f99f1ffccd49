// AOVs as CPU references take them: texels in double precision, and differences of pictures.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scumble/renderer.h"

namespace scumble::test {

const Image& aov(const Frame& frame, const std::string& name, size_t view = 0);

// All channels of a pixel; missing ones are 0. Coordinates outside the picture are moved to its edge.
glm::dvec4 texel(const Image& image, int x, int y);

// The nearest half float, as images of that format store it.
double toHalf(double value);
glm::dvec4 toHalf(const glm::dvec4& value);

// 8 bits by the definition of sRGB's curve (IEC 61966-2-1).
int srgbCode(double linear);

// A picture of doubles.
struct Texels {
  int width = 0, height = 0;
  std::vector<glm::dvec4> values;
  Texels(int w, int h) : width(w), height(h), values(size_t(w) * size_t(h)) {}
  glm::dvec4& at(int x, int y) { return values[size_t(y) * size_t(width) + size_t(x)]; }
  const glm::dvec4& clamped(int x, int y) const {
    return values[size_t(glm::clamp(y, 0, height - 1)) * size_t(width) + size_t(glm::clamp(x, 0, width - 1))];
  }
};

// The blur's texels, a quarter of the size, from its AOV, which is enlarged linearly: exact where the size is
// a multiple of four. Colours are straight, as AOVs are.
Texels quarterTexels(const Image& enlarged);

double smoothstep(double low, double high, double x);

// How two sets of numbers differ; collects, then states it. One that has collected nothing fails the test: a
// loop that never ran proves nothing.
struct Difference {
  size_t count = 0, beyond = 0;  // how many there were, and how many differed by more than the tolerance
  double most = 0, sum = 0;
  double tolerance;
  explicit Difference(double allowed) : tolerance(allowed) {}
  ~Difference();
  void add(double got, double expected);
  double mean() const { return count ? sum / double(count) : 0; }
  double beyondPart() const { return count ? double(beyond) / double(count) : 0; }
  std::string text() const;
};

bool sameBytes(const Image& a, const Image& b);
// Largest difference of any number of two pictures of one size; NaN counts as infinite.
double largestDifference(const Image& a, const Image& b);

}  // namespace scumble::test
