#include "xr/eye_images.h"

#include "xr/failure.h"

namespace scumble::xr {

EyeImages::EyeImages(const Functions& call, XrSession session, VkFormat format, glm::uvec2 size)
    : size_(size), isDepth_(format == VK_FORMAT_D32_SFLOAT) {
  const XrSwapchainUsageFlags usage =
      isDepth_ ? XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
  const Swapchain::Kind one{format, usage | XR_SWAPCHAIN_USAGE_SAMPLED_BIT, size.x, size.y};
  Swapchain::Kind both = one;
  both.layers = kEyes;
  try {
    chains_.push_back(std::make_unique<Swapchain>(call, session, both));
  } catch (const XrFailure& failure) {
    if (failure.isLoss()) throw;
    for (size_t eye = 0; eye < kEyes; ++eye)
      chains_.push_back(std::make_unique<Swapchain>(call, session, one));
  }
}

std::vector<VulkanTarget> EyeImages::acquire(size_t firstView, const std::string& aov) {
  std::vector<VkImage> images;
  for (const auto& chain : chains_) images.push_back(chain->acquire());
  std::vector<VulkanTarget> targets;
  for (size_t eye = 0; eye < kEyes; ++eye) {
    const Swapchain::Kind& kind = chains_[chainOf(eye)]->kind();
    VulkanTarget& target = targets.emplace_back();
    target.image = images[chainOf(eye)];
    target.format = kind.format;
    target.extent = {kind.width, kind.height};
    target.layer = layerOf(eye);
    // As runtimes want them back (XR_KHR_vulkan_enable2).
    target.after = isDepth_ ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                            : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    target.view = firstView + eye;
    target.aov = aov;
  }
  return targets;
}

void EyeImages::release() {
  for (const auto& chain : chains_) chain->release();
}

XrSwapchainSubImage EyeImages::part(size_t eye, glm::uvec2 size) const {
  return chains_[chainOf(eye)]->part(size.x, size.y, layerOf(eye));
}

}  // namespace scumble::xr
