#include "measure/cooccurrence.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scumble::measuring {

namespace {

constexpr int kLevels = 16;
constexpr double kReach = 2.5;  // standard deviations that the levels cover to either side
constexpr int kDistances[] = {1, 2, 4, 8};
constexpr int kDirections[][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}};

using Table = std::array<double, kLevels * kLevels>;

struct Levels {
  double low = 0, perUnit = 0;
  size_t of(float value) const {
    return size_t(std::clamp((double(value) - low) * perUnit, 0.0, double(kLevels) - 1));
  }
};

Levels levelsOf(std::span<const Field> example, int channel) {
  double sum = 0, squares = 0, count = 0;
  for (const Field& field : example)
    for (size_t pixel = 0; pixel < field.pixelCount(); ++pixel)
      if (field.valid[pixel]) {
        const double value = field.at(pixel)[channel];
        sum += value, squares += value * value, ++count;
      }
  const double mean = sum / std::max(count, 1.0);
  const double deviation = std::sqrt(std::max(squares / std::max(count, 1.0) - mean * mean, 1e-20));
  return {mean - kReach * deviation, kLevels / (2 * kReach * deviation)};
}

// Shares of pairs of levels, either order; all 0 where there are no pairs.
Table tableOf(std::span<const Field> fields, int channel, const Levels& levels, int distance) {
  Table table{};
  double pairs = 0;
  std::vector<uint8_t> level;
  for (const Field& field : fields) {
    level.resize(field.pixelCount());
    for (size_t pixel = 0; pixel < level.size(); ++pixel)
      level[pixel] = uint8_t(levels.of(field.at(pixel)[channel]));
    for (const auto& direction : kDirections) {
      const int dx = direction[0] * distance, dy = direction[1] * distance;
      for (int y = 0; y + dy < field.height; ++y) {
        for (int x = std::max(0, -dx); x + std::max(0, dx) < field.width; ++x) {
          const size_t a = size_t(y) * size_t(field.width) + size_t(x);
          const size_t b = size_t(y + dy) * size_t(field.width) + size_t(x + dx);
          if (!field.isPair(a, b)) continue;
          ++table[size_t(level[a]) * kLevels + level[b]];
          ++table[size_t(level[b]) * kLevels + level[a]];
          pairs += 2;
        }
      }
    }
  }
  for (double& share : table) share /= std::max(pairs, 1.0);
  return table;
}

}  // namespace

double cooccurrenceError(std::span<const Field> example, std::span<const Field> fields) {
  const auto isEmpty = [](std::span<const Field> all) {
    return std::all_of(all.begin(), all.end(), [](const Field& field) { return field.validCount() == 0; });
  };
  if (isEmpty(example) || isEmpty(fields)) return 1;
  double error = 0;
  for (int channel = 0; channel < example[0].channels; ++channel) {
    const Levels levels = levelsOf(example, channel);
    for (const int distance : kDistances) {
      const Table a = tableOf(example, channel, levels, distance),
                  b = tableOf(fields, channel, levels, distance);
      double sum = 0;
      for (size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
      error += 0.5 * sum / (double(std::size(kDistances)) * example[0].channels);
    }
  }
  return error;
}

}  // namespace scumble::measuring
