#include "tests/support/aov.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace scumble::test {

const Image& aov(const Frame& frame, const std::string& name, size_t view) {
  for (const Frame::Layer& layer : frame.layers)
    if (layer.name == name) return layer.views.at(layer.views.size() == 1 ? 0 : view);
  throw std::runtime_error("the frame has no layer '" + name + "'");
}

glm::dvec4 texel(const Image& image, int x, int y) {
  x = std::clamp(x, 0, int(image.width) - 1), y = std::clamp(y, 0, int(image.height) - 1);
  glm::dvec4 value(0.0);
  for (uint32_t c = 0; c < image.channels.size(); ++c) value[int(c)] = image.at(uint32_t(x), uint32_t(y), c);
  return value;
}

double toHalf(double value) {
  return glm::unpackHalf1x16(glm::packHalf1x16(float(value)));
}
glm::dvec4 toHalf(const glm::dvec4& v) {
  return {toHalf(v.x), toHalf(v.y), toHalf(v.z), toHalf(v.w)};
}

Texels quarterTexels(const Image& enlarged) {
  const int w = int(enlarged.width) / 4, h = int(enlarged.height) / 4;
  if (w * 4 != int(enlarged.width) || h * 4 != int(enlarged.height))
    throw std::runtime_error("the size is not a multiple of four");
  // Pixels 4 i + 2 and 4 i + 3 are 7/8 t + 1/8 next and 5/8 t + 3/8 next; the last texel fills its pixels.
  const auto row = [&](int i, int y) {
    return i == w - 1 ? texel(enlarged, 4 * w - 1, y)
                      : 1.5 * texel(enlarged, 4 * i + 2, y) - 0.5 * texel(enlarged, 4 * i + 3, y);
  };
  Texels small(w, h);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      small.at(x, y) = y == h - 1 ? row(x, 4 * h - 1) : 1.5 * row(x, 4 * y + 2) - 0.5 * row(x, 4 * y + 3);
  return small;
}

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Difference::~Difference() {
  if (count == 0) ADD_FAILURE() << "nothing was compared";
}

void Difference::add(double got, double expected) {
  double d = std::abs(got - expected);
  if (got == expected) d = 0;  // infinities
  if (std::isnan(d)) d = std::numeric_limits<double>::infinity();
  ++count;
  beyond += d > tolerance;
  most = std::max(most, d);
  sum += d;
}

std::string Difference::text() const {
  std::ostringstream out;
  out << count << " numbers, differences: mean " << mean() << ", most " << most << ", " << beyond
      << " beyond " << tolerance;
  return out.str();
}

bool sameBytes(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

double largestDifference(const Image& a, const Image& b) {
  Difference difference(0);
  for (size_t i = 0; i < a.pixels.size(); ++i) difference.add(a.pixels[i], b.pixels.at(i));
  return difference.most;
}

int srgbCode(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  return int(std::lround(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055)));
}

}  // namespace scumble::test
