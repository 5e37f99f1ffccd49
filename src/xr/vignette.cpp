#include "xr/vignette.h"

#include <algorithm>
#include <cmath>

#include "xr/failure.h"

namespace scumble::xr {

namespace {

constexpr uint32_t kSide = 512;  // pixels
constexpr float kReach = 3;      // tangent of the angle at which the picture ends, where it is strongest
constexpr float kFree = 0.466f, kDark = 1;  // of 25 and 45 degrees
constexpr float kOpening = 1.5f;            // so many times wider, and one, it is where it is weakest

float openingAt(float strength) {
  return 1 + kOpening * (1 - std::clamp(strength, 0.0f, 1.0f));
}

// Black, with how dark it is as alpha.
Texels pictureOf(VkFormat format) {
  Texels picture(format, kSide);
  const auto across = [](uint32_t pixel) { return kReach * (2 * (float(pixel) + 0.5f) / kSide - 1); };
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x)
      picture.set(x, y, {0, 0, 0, darknessAt(std::hypot(across(x), across(y)), 1)});
  return picture;
}

}  // namespace

float darknessAt(float tangent, float strength) {
  const float t = std::clamp((tangent / openingAt(strength) - kFree) / (kDark - kFree), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

Vignette::Vignette(const Instance& instance, XrSession session, const VulkanDevice& device, VkFormat format)
    : call_(instance.call()), picture_(call_, session, device, pictureOf(format)) {
  const XrReferenceSpaceCreateInfo space{
      XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, XR_REFERENCE_SPACE_TYPE_VIEW, {{0, 0, 0, 1}, {0, 0, 0}}};
  must(call_.CreateReferenceSpace(session, &space, &head_), "xrCreateReferenceSpace");
}

Vignette::~Vignette() {
  call_.DestroySpace(head_);
}

std::optional<XrCompositionLayerQuad> Vignette::layer(float strength) const {
  if (!(strength > 0)) return std::nullopt;
  XrCompositionLayerQuad quad{XR_TYPE_COMPOSITION_LAYER_QUAD};
  quad.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
  quad.space = head_;
  quad.eyeVisibility = XR_EYE_VISIBILITY_BOTH;
  quad.subImage = picture_.whole();
  quad.pose = {{0, 0, 0, 1}, {0, 0, -1}};
  const float side = 2 * kReach * openingAt(strength);
  quad.size = {side, side};
  return quad;
}

}  // namespace scumble::xr
