#include "study/plane.h"

#include <algorithm>
#include <cmath>

#include "base/oklab.h"

namespace scumble::study {

namespace {

// One row or column for one after the other: `from` and `to` are called with an index along the axis.
template <class Along>
Plane filtered(const Plane& plane, const Along& along) {
  Plane across(plane.width, plane.height), both(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y)
    along(
        plane.width, [&](int x) { return plane.at(x, y); }, [&](int x, float v) { across.at(x, y) = v; });
  for (int x = 0; x < plane.width; ++x)
    along(
        plane.height, [&](int y) { return across.at(x, y); }, [&](int y, float v) { both.at(x, y) = v; });
  return both;
}

template <class Better>
Plane extreme(const Plane& plane, int reach, const Better& better) {
  return filtered(plane, [&](int count, const auto& from, const auto& to) {
    for (int i = 0; i < count; ++i) {
      float best = from(i);
      for (int k = std::max(0, i - reach); k <= std::min(count - 1, i + reach); ++k)
        best = better(best, from(k));
      to(i, best);
    }
  });
}

float larger(float a, float b) {
  return std::max(a, b);
}
float smaller(float a, float b) {
  return std::min(a, b);
}

// The parts of the pixels along one axis that lie in each of fewer, wider ones.
struct Slot {
  int first = 0;
  std::vector<double> parts;
};
std::vector<Slot> slots(int count, int fewer) {
  std::vector<Slot> all{size_t(fewer)};
  const double step = double(count) / fewer;
  for (int i = 0; i < fewer; ++i) {
    const double from = i * step, to = std::min(double(count), (i + 1) * step);
    Slot& slot = all[size_t(i)];
    slot.first = int(from);
    for (int k = slot.first; k < count && k < to; ++k)
      slot.parts.push_back((std::min(to, k + 1.0) - std::max(from, double(k))) / (to - from));
  }
  return all;
}

}  // namespace

LabPicture labOf(const Image& colors, uint32_t lines) {
  const int width = int(colors.width), height = int(colors.height);
  const int fewer = std::min(height, int(lines));
  const int narrower = std::max(1, int(std::lround(double(width) * fewer / height)));
  const size_t channels = colors.channels.size();
  // Rows first: a picture of many pixels is gone through once.
  std::vector<glm::dvec3> row{size_t(width)};
  const std::vector<Slot> down = slots(height, fewer), across = slots(width, narrower);
  LabPicture lab{Plane(narrower, fewer), Plane(narrower, fewer), Plane(narrower, fewer), 1080.0 / fewer};
  for (int y = 0; y < fewer; ++y) {
    std::fill(row.begin(), row.end(), glm::dvec3(0));
    const Slot& rows = down[size_t(y)];
    for (size_t k = 0; k < rows.parts.size(); ++k) {
      const float* pixel = &colors.pixels[(size_t(rows.first) + k) * size_t(width) * channels];
      for (int x = 0; x < width; ++x, pixel += channels) {
        const double alpha = channels > 3 ? std::clamp(double(pixel[3]), 0.0, 1.0) : 1.0;
        const glm::dvec3 color = glm::clamp(glm::dvec3(pixel[0], pixel[1], pixel[2]), 0.0, 1.0);
        row[size_t(x)] += rows.parts[k] * (color * alpha + (1 - alpha));
      }
    }
    for (int x = 0; x < narrower; ++x) {
      glm::dvec3 mean(0);
      const Slot& columns = across[size_t(x)];
      for (size_t k = 0; k < columns.parts.size(); ++k)
        mean += columns.parts[k] * row[size_t(columns.first) + k];
      const glm::dvec3 color = oklabFromLinear(mean);
      lab.lightness.at(x, y) = float(color.x);
      lab.a.at(x, y) = float(color.y);
      lab.b.at(x, y) = float(color.z);
    }
  }
  return lab;
}

glm::vec3 rgbOf(const glm::dvec3& lab) {
  return glm::clamp(linearFromOklab(lab), 0.0, 1.0);
}

Plane difference(const Plane& a, const Plane& b) {
  Plane result = a;
  for (size_t i = 0; i < result.values.size(); ++i) result.values[i] -= b.values[i];
  return result;
}

Plane blurred(const Plane& plane, double deviation) {
  const int reach = std::max(1, int(std::ceil(3 * deviation)));
  std::vector<float> weights;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i) sum += std::exp(-0.5 * i * i / (deviation * deviation));
  for (int i = -reach; i <= reach; ++i)
    weights.push_back(float(std::exp(-0.5 * i * i / (deviation * deviation)) / sum));
  return filtered(plane, [&](int count, const auto& from, const auto& to) {
    for (int i = 0; i < count; ++i) {
      float mean = 0;
      for (int k = -reach; k <= reach; ++k)
        mean += weights[size_t(k + reach)] * from(std::clamp(i + k, 0, count - 1));
      to(i, mean);
    }
  });
}

Plane greatestWithin(const Plane& plane, int reach) {
  return extreme(plane, reach, larger);
}

Plane leastWithin(const Plane& plane, int reach) {
  return extreme(plane, reach, smaller);
}

Plane closed(const Plane& plane, int reach) {
  return leastWithin(greatestWithin(plane, reach), reach);
}

Plane steepness(const Plane& plane) {
  Plane steep(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      const int left = std::max(0, x - 1), right = std::min(plane.width - 1, x + 1);
      const int up = std::max(0, y - 1), down = std::min(plane.height - 1, y + 1);
      steep.at(x, y) = std::hypot((plane.at(right, y) - plane.at(left, y)) / float(right - left),
                                  (plane.at(x, down) - plane.at(x, up)) / float(down - up));
    }
  return steep;
}

Plane transposed(const Plane& plane) {
  Plane turned(plane.height, plane.width);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) turned.at(y, x) = plane.at(x, y);
  return turned;
}

double quantile(std::vector<float>& values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + std::lround(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace scumble::study
