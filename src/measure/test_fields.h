// Fields whose measures are known.
#pragma once

#include <cmath>
#include <numbers>

#include "base/tileable_noise.h"
#include "measure/field.h"

namespace scumble::measuring::test {

template <class ValueAt>
Field fieldFrom(int width, int height, const ValueAt& valueAt) {
  Field field(width, height, 1);
  for (size_t pixel = 0; pixel < field.pixelCount(); ++pixel) {
    const size_t column = pixel % size_t(width), row = pixel / size_t(width);
    *field.at(pixel) = float(valueAt(double(column) + 0.5, double(row) + 0.5));
    field.valid[pixel] = 1;
  }
  return field;
}

// The same sine along x and along y, `frequency` cycles a pixel; its standard deviation is 1.
inline Field sines(int size, double frequency, double shiftX = 0) {
  return fieldFrom(size, size, [&](double x, double y) {
    const double turn = 2 * std::numbers::pi * frequency;
    return std::cos(turn * (x - shiftX)) + std::cos(turn * y);
  });
}

// Every pixel at random, normally distributed enough: mean 0, standard deviation 1.
inline Field whiteNoise(int size, uint32_t seed) {
  return fieldFrom(size, size, [&](double x, double y) {
    double sum = 0;
    for (uint32_t i = 0; i < 12; ++i)
      sum += hash(hash(hash(seed * 12 + i) + uint32_t(x)) + uint32_t(y)) / 4294967296.0;
    return sum - 6;
  });
}

// A disc is left of the field.
inline Field masked(Field field, double radius) {
  for (size_t pixel = 0; pixel < field.pixelCount(); ++pixel) {
    const size_t column = pixel % size_t(field.width), row = pixel / size_t(field.width);
    const double x = double(column) - 0.5 * field.width, y = double(row) - 0.5 * field.height;
    if (std::hypot(x, y) > radius) field.valid[pixel] = 0;
  }
  return field;
}

}  // namespace scumble::measuring::test
