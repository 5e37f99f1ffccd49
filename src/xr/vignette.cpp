#include "xr/vignette.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <vector>

#include "xr/failure.h"
#include "xr/upload.h"

namespace scumble::xr {

namespace {

constexpr uint32_t kSide = 512;  // pixels
constexpr float kReach = 3;      // tangent of the angle at which the picture ends, where it is strongest
constexpr float kFree = 0.466f, kDark = 1;  // of 25 and 45 degrees
constexpr float kOpening = 1.5f;            // so many times wider, and one, it is where it is weakest

float openingAt(float strength) {
  return 1 + kOpening * (1 - std::clamp(strength, 0.0f, 1.0f));
}

// Black, with how dark it is as alpha: in any order of channels and any curve. Of bytes, or of half floats.
std::vector<uint8_t> pictureOf(VkFormat format) {
  const size_t bytes = format == VK_FORMAT_R16G16B16A16_SFLOAT ? 2 : 1;
  std::vector<uint8_t> picture(4 * bytes * kSide * kSide, 0);
  const auto across = [](uint32_t pixel) { return kReach * (2 * (float(pixel) + 0.5f) / kSide - 1); };
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) {
      const float alpha = darknessAt(std::hypot(across(x), across(y)), 1);
      const uint16_t code = bytes == 2 ? glm::packHalf1x16(alpha) : uint16_t(std::lround(255 * alpha));
      std::memcpy(&picture[bytes * (4 * (size_t(y) * kSide + x) + 3)], &code, bytes);
    }
  return picture;
}

}  // namespace

float darknessAt(float tangent, float strength) {
  const float t = std::clamp((tangent / openingAt(strength) - kFree) / (kDark - kFree), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

Vignette::Vignette(const Instance& instance, XrSession session, const VulkanDevice& device, VkFormat format)
    : call_(instance.call()) {
  try {
    create(session, device, format);
  } catch (...) {
    destroy();
    throw;
  }
}

Vignette::~Vignette() {
  destroy();
}

void Vignette::destroy() {
  if (swapchain_) call_.DestroySwapchain(swapchain_);
  if (head_) call_.DestroySpace(head_);
}

void Vignette::create(XrSession session, const VulkanDevice& device, VkFormat format) {
  const XrReferenceSpaceCreateInfo space{
      XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, XR_REFERENCE_SPACE_TYPE_VIEW, {{0, 0, 0, 1}, {0, 0, 0}}};
  must(call_.CreateReferenceSpace(session, &space, &head_), "xrCreateReferenceSpace");
  XrSwapchainCreateInfo info{XR_TYPE_SWAPCHAIN_CREATE_INFO};
  info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT |
                    XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
  info.format = format;
  info.width = info.height = kSide;
  info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
  must(call_.CreateSwapchain(session, &info, &swapchain_), "xrCreateSwapchain");
  const auto images = imagesOf(call_, swapchain_);

  uint32_t index = 0;
  const XrSwapchainImageAcquireInfo acquire{XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO};
  must(call_.AcquireSwapchainImage(swapchain_, &acquire, &index), "xrAcquireSwapchainImage");
  const XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
  must(call_.WaitSwapchainImage(swapchain_, &wait), "xrWaitSwapchainImage");
  upload(device, images.at(index), {kSide, kSide}, pictureOf(format));
  const XrSwapchainImageReleaseInfo release{XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO};
  must(call_.ReleaseSwapchainImage(swapchain_, &release), "xrReleaseSwapchainImage");
}

std::optional<XrCompositionLayerQuad> Vignette::layer(float strength) const {
  if (!(strength > 0)) return std::nullopt;
  XrCompositionLayerQuad quad{XR_TYPE_COMPOSITION_LAYER_QUAD};
  quad.layerFlags = XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT;
  quad.space = head_;
  quad.eyeVisibility = XR_EYE_VISIBILITY_BOTH;
  quad.subImage.swapchain = swapchain_;
  quad.subImage.imageRect = {{0, 0}, {int32_t(kSide), int32_t(kSide)}};
  quad.pose = {{0, 0, 0, 1}, {0, 0, -1}};
  const float side = 2 * kReach * openingAt(strength);
  quad.size = {side, side};
  return quad;
}

}  // namespace scumble::xr
