#include "xr/pointer.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "xr/place.h"

namespace scumble::xr {

namespace {

constexpr uint32_t kDiscSide = 64;      // pixels
constexpr float kWidth = 0.004f;        // metres
constexpr float kDot = 0.012f;          // of its distance from the head
constexpr float kShortest = 1e-3f;      // metres
constexpr float kDiscStrength = 0.85f;  // coverage in its middle

// A pale disc with a soft edge. Stretched it is a line that fades at its ends.
Texels discOf(VkFormat format) {
  Texels texels(format, kDiscSide);
  for (uint32_t y = 0; y < kDiscSide; ++y)
    for (uint32_t x = 0; x < kDiscSide; ++x) {
      const glm::vec2 at = 2.0f * (glm::vec2(x, y) + 0.5f) / float(kDiscSide) - 1.0f;
      const float t = std::clamp((1 - glm::length(at)) / 0.4f, 0.0f, 1.0f);
      texels.set(x, y, {1, 0.97f, 0.9f, kDiscStrength * t * t * (3 - 2 * t)});
    }
  return texels;
}

}  // namespace

Pointer::Pointer(const Instance& instance, XrSession session, const VulkanDevice& device, VkFormat format)
    : picture_(instance.call(), session, device, discOf(format)) {}

void Pointer::addLayers(const Ray& ray, const glm::vec3& head, XrSpace space,
                        std::vector<XrCompositionLayerQuad>& layers) const {
  const auto add = [&](const glm::vec3& place, const glm::vec3& along, glm::vec2 size) {
    // Its face towards the head, as far as it can turn about its length.
    const glm::vec3 side = glm::cross(head - place, along);
    const float aside = glm::length(side), length = glm::length(along);
    if (!(aside > kShortest * length) || !(length > kShortest)) return;
    const glm::vec3 x = along / length, y = side / aside;
    XrCompositionLayerQuad quad{XR_TYPE_COMPOSITION_LAYER_QUAD};
    quad.layerFlags =
        XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT | XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT;
    quad.space = space;
    quad.eyeVisibility = XR_EYE_VISIBILITY_BOTH;
    quad.subImage = picture_.whole();
    quad.pose = xrOf({glm::quat_cast(glm::mat3(x, y, glm::cross(x, y))), place});
    quad.size = {size.x, size.y};
    layers.push_back(quad);
  };
  const glm::vec3 way = ray.to - ray.from, seen = ray.to - head;
  add(0.5f * (ray.from + ray.to), way, {glm::length(way), kWidth});
  const float dot = std::max(kDot * glm::length(seen), kWidth);
  const glm::vec3 right =
      glm::cross(seen, std::abs(seen.y) > 0.9f * glm::length(seen) ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0));
  add(ray.to, right, {dot, dot});
}

}  // namespace scumble::xr
