#include "film/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace scumble::film {
namespace {

constexpr double kPixelsPerDegree = 67;  // the paper's default: 0.7 m from a 0.7 m wide 4K screen

using Color = std::array<double, 3>;
using Plane = std::vector<float>;

struct Planes {
  int width = 0, height = 0;
  std::array<Plane, 3> plane;
};

// -- Colour spaces, white point D65 as the colour (1, 1, 1)

Color xyzFromLinear(const Color& c) {
  return {0.4124564 * c[0] + 0.3575761 * c[1] + 0.1804375 * c[2],
          0.2126729 * c[0] + 0.7151522 * c[1] + 0.0721750 * c[2],
          0.0193339 * c[0] + 0.1191920 * c[1] + 0.9503041 * c[2]};
}

Color linearFromXyz(const Color& c) {
  return {3.2404542 * c[0] - 1.5371385 * c[1] - 0.4985314 * c[2],
          -0.9692660 * c[0] + 1.8760108 * c[1] + 0.0415560 * c[2],
          0.0556434 * c[0] - 0.2040259 * c[1] + 1.0572252 * c[2]};
}

const Color kWhite = xyzFromLinear({1, 1, 1});

// A linear opponent space: luminance, red-green, blue-yellow.
Color ycxczFromLinear(const Color& color) {
  const Color xyz = xyzFromLinear(color);
  const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Color linearFromYcxcz(const Color& color) {
  const double y = (color[0] + 16) / 116, x = y + color[1] / 500, z = y - color[2] / 200;
  return linearFromXyz({x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

double labCurve(double t) {
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

// L*a*b*, with a* and b* scaled by lightness: differences of hue are seen less in the dark (Hunt's effect).
Color huntLabFromLinear(const Color& color) {
  const Color xyz = xyzFromLinear(color);
  const double x = labCurve(xyz[0] / kWhite[0]), y = labCurve(xyz[1] / kWhite[1]),
               z = labCurve(xyz[2] / kWhite[2]);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

double hyab(const Color& a, const Color& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// -- Filters: all are sums of separable ones

using Kernel = std::vector<double>;  // odd length, the middle is the pixel itself

// Convolves rows with `across`, then columns with `down`; outside the picture its border goes on.
Plane convolve(const Plane& in, int width, int height, const Kernel& across, const Kernel& down) {
  const int radius = int(across.size() / 2);
  Plane half(in.size()), out(in.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int k = -radius; k <= radius; ++k)
        sum += across[k + radius] * in[size_t(y) * width + std::clamp(x + k, 0, width - 1)];
      half[size_t(y) * width + x] = float(sum);
    }
  // Row by row, so that memory is read in its order.
  Kernel sums(width);
  for (int y = 0; y < height; ++y) {
    std::fill(sums.begin(), sums.end(), 0.0);
    for (int k = -radius; k <= radius; ++k) {
      const float* row = half.data() + size_t(std::clamp(y + k, 0, height - 1)) * width;
      for (int x = 0; x < width; ++x) sums[x] += down[k + radius] * row[x];
    }
    std::transform(sums.begin(), sums.end(), out.begin() + size_t(y) * width,
                   [](double v) { return float(v); });
  }
  return out;
}

// The contrast sensitivity function of one opponent channel: a1 g(b1) + a2 g(b2), where g(b) = sqrt(pi / b)
// exp(-pi^2 r^2 / b), r in degrees (the paper's equation 4 and table 1).
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kSensitivity[3] = {
    {1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

Plane seeThroughEye(const Plane& in, int width, int height, const Sensitivity& s) {
  constexpr double pi = std::numbers::pi;
  const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * kPixelsPerDegree));
  const auto gaussian = [&](double b, double* sum) {
    Kernel kernel;
    *sum = 0;
    for (int k = -radius; k <= radius; ++k) {
      const double r = k / kPixelsPerDegree;
      kernel.push_back(std::exp(-pi * pi * r * r / b));
      *sum += kernel.back();
    }
    return kernel;
  };
  // The two-dimensional kernels weigh a sqrt(pi / b) sum^2; together they are normalised to 1.
  double sum1 = 0, sum2 = 0;
  Kernel first = gaussian(s.b1, &sum1), second = gaussian(s.b2, &sum2);
  const double weight1 = s.a1 * std::sqrt(pi / s.b1) * sum1 * sum1,
               weight2 = s.a2 * std::sqrt(pi / s.b2) * sum2 * sum2;
  for (double& v : first) v /= sum1;
  for (double& v : second) v /= sum2;
  Plane out = convolve(in, width, height, first, first);
  if (weight2 == 0) return out;
  const Plane other = convolve(in, width, height, second, second);
  const double share = weight1 / (weight1 + weight2);
  for (size_t i = 0; i < out.size(); ++i) out[i] = float(share * out[i] + (1 - share) * other[i]);
  return out;
}

// Lengths of the first (edges) and second (points, lines) Gaussian derivatives of luminance, 0 ... 1.
struct Features {
  Plane edge, point;
};

// The paper normalises derivative kernels so that their positive and their negative weights add up to 1 and
// -1.
void normalise(Kernel* kernel) {
  double positive = 0, negative = 0;
  for (double v : *kernel) (v > 0 ? positive : negative) += std::abs(v);
  for (double& v : *kernel) v /= v > 0 ? positive : negative;
}

Features featuresOf(const Plane& luminance, int width, int height) {
  const double sigma = 0.5 * 0.082 * kPixelsPerDegree;  // a feature is 0.082 degrees wide
  const int radius = int(std::ceil(3 * sigma));
  Kernel smooth, first, second;
  double sum = 0;
  for (int k = -radius; k <= radius; ++k) {
    const double g = std::exp(-k * k / (2 * sigma * sigma));
    smooth.push_back(g);
    first.push_back(-k * g);
    second.push_back((k * k / (sigma * sigma) - 1) * g);
    sum += g;
  }
  for (double& v : smooth) v /= sum;
  normalise(&first);
  normalise(&second);
  const auto length = [&](const Kernel& derivative) {
    Plane x = convolve(luminance, width, height, derivative, smooth);
    const Plane y = convolve(luminance, width, height, smooth, derivative);
    for (size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
    return x;
  };
  return {length(first), length(second)};
}

// -- The metric

Planes opponentColors(const Image& image, double background) {
  Planes planes;
  planes.width = int(image.width);
  planes.height = int(image.height);
  const size_t pixels = size_t(image.width) * image.height, channels = image.channels.size();
  for (Plane& plane : planes.plane) plane.resize(pixels);
  const auto clamped = [](float v) { return v > 0 ? std::min(double(v), 1.0) : 0.0; };  // NaN: 0
  for (size_t i = 0; i < pixels; ++i) {
    const float* in = image.pixels.data() + i * channels;
    const double alpha = channels == 4 ? clamped(in[3]) : 1;
    Color color = {};
    for (size_t c = 0; c < 3; ++c) {
      const double value = channels == 1 ? clamped(in[0]) : c < channels ? clamped(in[c]) : 0;
      color[c] = value * alpha + background * (1 - alpha);
    }
    const Color opponent = ycxczFromLinear(color);
    for (size_t c = 0; c < 3; ++c) planes.plane[c][i] = float(opponent[c]);
  }
  return planes;
}

// Maps HyAB distances to 0 ... 1: a power, and then the upper 60 percent of the range squeezed into the last
// 5, since beyond that everything just looks wrong.
double colorError(double distance) {
  static const double most = std::pow(hyab(huntLabFromLinear({0, 1, 0}), huntLabFromLinear({0, 0, 1})), 0.7);
  constexpr double knee = 0.4, kneeValue = 0.95;
  const double raised = std::pow(distance, 0.7);
  if (raised < knee * most) return kneeValue / (knee * most) * raised;
  return std::min(1.0, kneeValue + (raised - knee * most) / (most - knee * most) * (1 - kneeValue));
}

Difference compareOver(const Image& a, const Image& b, double background) {
  const Image* images[2] = {&a, &b};
  Planes seen[2];
  Features features[2];
  for (int i = 0; i < 2; ++i) {
    Planes& planes = seen[i] = opponentColors(*images[i], background);
    Plane luminance = planes.plane[0];
    for (float& y : luminance) y = (y + 16) / 116;
    features[i] = featuresOf(luminance, planes.width, planes.height);
    for (int c = 0; c < 3; ++c)
      planes.plane[c] = seeThroughEye(planes.plane[c], planes.width, planes.height, kSensitivity[c]);
  }
  Difference difference;
  const size_t pixels = seen[0].plane[0].size();
  const auto tilesOf = [](uint32_t side) { return (side + kDifferenceTile - 1) / kDifferenceTile; };
  std::vector<double> sums(size_t(tilesOf(a.width)) * tilesOf(a.height));
  for (size_t i = 0; i < pixels; ++i) {
    Color lab[2];
    for (int k = 0; k < 2; ++k) {
      Color color = linearFromYcxcz({seen[k].plane[0][i], seen[k].plane[1][i], seen[k].plane[2][i]});
      for (double& v : color) v = std::clamp(v, 0.0, 1.0);
      lab[k] = huntLabFromLinear(color);
    }
    const double byColor = colorError(hyab(lab[0], lab[1]));
    const double edge = std::abs(features[0].edge[i] - features[1].edge[i]);
    const double point = std::abs(features[0].point[i] - features[1].point[i]);
    const double byFeature = std::sqrt(std::min(1.0, std::max(edge, point) / std::numbers::sqrt2));
    const double value = byColor == 0 ? 0 : std::pow(byColor, 1 - byFeature);
    difference.mean += value / double(pixels);
    difference.max = std::max(difference.max, value);
    const size_t tileRow = i / a.width / kDifferenceTile, tileColumn = i % a.width / kDifferenceTile;
    sums[tileRow * tilesOf(a.width) + tileColumn] += value;
  }
  // Tiles that the border cuts count as if they were whole: a few pixels are no place.
  const double whole = double(kDifferenceTile) * kDifferenceTile;
  difference.tile = std::min(1.0, *std::max_element(sums.begin(), sums.end()) / whole);
  return difference;
}

bool hasAlpha(const Image& image) {
  if (image.channels.size() != 4) return false;
  for (size_t i = 3; i < image.pixels.size(); i += 4)
    if (!(image.pixels[i] >= 1)) return true;
  return false;
}

}  // namespace

Difference comparePictures(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height || a.pixels.empty() || b.pixels.empty()) return {1, 1, 1};
  Difference difference = compareOver(a, b, 0);
  if (hasAlpha(a) || hasAlpha(b)) {
    const Difference overWhite = compareOver(a, b, 1);
    difference.mean = std::max(difference.mean, overWhite.mean);
    difference.tile = std::max(difference.tile, overWhite.tile);
    difference.max = std::max(difference.max, overWhite.max);
  }
  return difference;
}

}  // namespace scumble::film
