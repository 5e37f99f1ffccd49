#include "scene/texels.h"

#include <algorithm>
#include <cmath>

namespace scumble::scene {

namespace {

// A texture's coordinate in [0, 1).
double wrapped(double x, Wrap wrap) {
  if (!std::isfinite(x)) return 0;
  switch (wrap) {
    case Wrap::clampToEdge:
      return std::clamp(x, 0.0, 1.0 - 1e-9);
    case Wrap::mirroredRepeat: {
      const double t = x - 2 * std::floor(0.5 * x);
      return std::min(t > 1 ? 2 - t : t, 1.0 - 1e-9);
    }
    default:
      return x - std::floor(x);
  }
}

}  // namespace

const std::vector<glm::vec2>& coordinatesOf(const Primitive& primitive, const TextureUse& use) {
  return use.uvSet == 1 && !primitive.uv1.empty() ? primitive.uv1 : primitive.uv0;
}

glm::dvec4 texelAt(const TextureImage& image, const TextureUse& use, const glm::vec2& uv) {
  const glm::vec3 at = use.transform * glm::vec3(uv, 1.0f);
  const auto index = [](double t, uint32_t size) { return std::min(size_t(t * size), size_t(size) - 1); };
  const size_t x = index(wrapped(at.x, use.sampler.wrapU), image.width),
               y = index(wrapped(at.y, use.sampler.wrapV), image.height);
  const uint8_t* p = &image.rgba[4 * (y * image.width + x)];
  return glm::dvec4(p[0], p[1], p[2], p[3]) / 255.0;
}

}  // namespace scumble::scene
