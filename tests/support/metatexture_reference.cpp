#include "tests/support/metatexture_reference.h"

#include <algorithm>
#include <cmath>

namespace scumble::test {

glm::dvec4 RepeatingTexture::sample(const glm::dvec2& uv) const {
  const glm::dvec2 at = uv * glm::dvec2(pixels.width, pixels.height) - 0.5, corner = glm::floor(at),
                   f = at - corner;
  const auto texel = [&](int dx, int dy) {
    const auto wrap = [](double v, uint32_t n) { return size_t(v - n * std::floor(v / n)); };
    const uint8_t* p = &pixels.rgba[4 * (wrap(corner.y + dy, pixels.height) * pixels.width +
                                         wrap(corner.x + dx, pixels.width))];
    return glm::dvec4(p[0], p[1], p[2], p[3]) / 255.0;
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x), f.y);
}

glm::dvec4 meanOf(const Pixels& pixels) {
  glm::dvec4 sum(0.0);
  for (size_t i = 0; i < pixels.rgba.size(); ++i) sum[int(i % 4)] += pixels.rgba[i] / 255.0;
  return sum * 4.0 / double(pixels.rgba.size());
}

glm::dvec4 deviationOf(const Pixels& pixels) {
  const glm::dvec4 mean = meanOf(pixels);
  glm::dvec4 squares(0.0);
  for (size_t i = 0; i < pixels.rgba.size(); ++i) {
    const double d = pixels.rgba[i] / 255.0 - mean[int(i % 4)];
    squares[int(i % 4)] += d * d;
  }
  return glm::sqrt(squares * 4.0 / double(pixels.rgba.size()));
}

MetaTextureReference::Result MetaTextureReference::at(const glm::dvec2& uv, const glm::dvec2& gradU,
                                                      const glm::dvec2& gradV, double alpha,
                                                      const glm::bvec2& wraps) const {
  const auto beta = [&](double t) {
    t = std::clamp((t - 0.5) / blend + 0.5, 0.0, 1.0);
    return std::clamp((t * t * (3 - 2 * t) - skip) / (1 - 2 * skip), 0.0, 1.0);
  };
  const double lu = glm::length(gradU), lv = glm::length(gradV);
  Result result{};
  if (skew == exact)
    result.q = std::clamp(-2 * glm::dot(gradU, gradV) / (lu * lu + lv * lv), -0.95, 0.95);
  else if (skew == approximate)
    result.q = -std::atan(std::min(lu, lv) / std::max(lu, lv)) * glm::dot(gradU / lu, gradV / lv);

  // The two quantised levels of skew, and between them.
  const double scaled = skewLevels * result.q, lower = std::floor(scaled);
  const double between = skew == off ? 0 : beta(scaled - lower);
  const double turned = contour ? beta(2 * std::log2(lu / lv) - 0.5) : 0;
  for (int level = 0; level < (skew == off ? 1 : 2); ++level) {
    const double q = std::clamp((lower + level) / skewLevels, -0.95, 0.95);
    const double psi = skew == off ? 0 : skew == exact ? 0.5 * std::asin(q) : std::atan(0.5 * q);
    const double c = std::cos(psi), s = std::sin(psi);
    const glm::dvec2 gu = c * gradU + s * gradV, gv = s * gradU + c * gradV;
    // Below 45 degrees between them the extent along counts instead of the gradient: 1 / |dS/du'|, times
    // sqrt 2.
    const double sine = std::abs(gu.x * gv.y - gu.y * gv.x) / glm::length(gu) / glm::length(gv);
    const double along = skew == off ? 1 : std::min(1.0, std::sqrt(2.0) * sine);
    const glm::dvec2 e =
        -glm::log2(alpha * size * along * glm::dvec2(glm::length(gu), height * glm::length(gv))) /
        std::log2(base);
    const double share = level == 0 ? 1 - between : between;
    result.exponent += share * e;
    double finest = 0;  // by going around
    for (int i = 0; i < 720; ++i) {
      const double angle = i * 3.14159265358979 / 720;
      const glm::dvec2 way(std::cos(angle), std::sin(angle));
      const double u = std::pow(base, e.x) * size * glm::dot(gu, way),
                   v = std::pow(base, e.y) * size * height * glm::dot(gv, way);
      finest = std::max(finest, u * u + v * v);
    }
    result.fineness += share * finest;
    const glm::dvec2 whole = glm::floor(e), b(beta(e.x - whole.x), beta(e.y - whole.y));
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const glm::dvec2 scale(std::pow(base, whole.x + i), std::pow(base, whole.y + j));
        // Coordinates that wrap and do not meet by themselves run there and back.
        const auto folded = [&](const glm::dvec2& p) {
          return glm::dvec2(wraps.x ? std::abs(p.x - std::round(p.x)) : p.x,
                            wraps.y ? std::abs(p.y - std::round(p.y)) : p.y);
        };
        const auto skewed = [&](const glm::dvec2& p) {
          return glm::dvec2(c * p.x + s * p.y, c * p.y + s * p.x);
        };
        const bool straight = psi == 0 && levelRotation == 0;
        glm::dvec2 at;
        for (int axis = 0; axis < 2; ++axis) {
          const double n = std::round(scale[axis]);
          const bool meets = straight && n >= 1 && std::abs(scale[axis] - n) < 1e-6 * n;
          at[axis] = scale[axis] * (meets ? uv : skewed(folded(uv)))[axis];
        }
        const double angle = 0.5 * (whole.x + i + whole.y + j) * levelRotation;
        at = {std::cos(angle) * at.x - std::sin(angle) * at.y,
              std::sin(angle) * at.x + std::cos(angle) * at.y};
        // Copies start at different places, so that they are independent.
        glm::dvec2 start = shift;
        if (skew != off) start += (lower + level) * glm::dvec2(0.3711, 0.7133);
        at += nested ? scale * start : start + 0.618034 * (whole + glm::dvec2(i, j));
        const double part = share * (i ? b.x : 1 - b.x) * (j ? b.y : 1 - b.y);
        for (const bool swapped : {false, true}) {
          const double orientShare = part * (swapped ? turned : 1 - turned);
          if (orientShare > 0)
            result.copies.push_back(
                {orientShare, swapped ? glm::dvec2(at.y, at.x) : at, scale.x * gu, scale.y * gv});
        }
      }
  }
  glm::dvec4 sum(0.0);
  for (const Copy& copy : result.copies) {
    sum += copy.share * texture.sample(copy.at);
    result.variance += copy.share * copy.share;
  }
  result.fineness = std::sqrt(result.fineness);
  result.value = mean + (sum - mean) / (contrast ? std::sqrt(result.variance) : 1.0);
  return result;
}

}  // namespace scumble::test
