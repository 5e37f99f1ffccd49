#include "world/backdrop.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "shading/luminance.shared.h"

namespace scumble::world {

namespace {

constexpr VkFormat kFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

// To the nearest half float. Without branches, since millions of them are made for each picture of a film.
uint16_t halfOf(float value) {
  const float f = std::clamp(value, 0.0f, 65504.0f);  // NaN stays, and becomes some number
  const uint32_t bits = std::bit_cast<uint32_t>(f);
  const uint32_t normal = (bits + 0x0FFFu + (bits >> 13 & 1u) - (112u << 23)) >> 13;
  // Adding a half puts the bits of numbers that are too small for an exponent where they belong.
  const uint32_t tiny = std::bit_cast<uint32_t>(f + 0.5f) - std::bit_cast<uint32_t>(0.5f);
  return uint16_t(f < 0x1p-14f ? tiny : normal);
}

uint32_t levelsOf(const glm::uvec2& size) {
  return uint32_t(std::bit_width(std::max(size.x, size.y)));
}

void moveLevel(VkCommandBuffer commands, VkImage image, uint32_t first, uint32_t count, VkImageLayout from,
               VkImageLayout to) {
  constexpr VkAccessFlags2 kAll = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = barrier.dstAccessMask = kAll;
  barrier.oldLayout = from, barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, first, count, 0, 1};
  VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &dependency);
}

gpu::ImageDesc descOf(const glm::uvec2& size) {
  gpu::ImageDesc desc{kFormat, size.x, size.y};
  desc.arrayView = false;
  desc.mipLevels = levelsOf(size);
  return desc;
}

}  // namespace

glm::uvec2 Backdrop::sizeFor(const Image& picture, uint32_t width, uint32_t height) {
  const uint32_t finer = std::max(1u, std::min(picture.width / width, picture.height / height));
  return {picture.width / finer, picture.height / finer};
}

Backdrop::Backdrop(gpu::Device& device, const glm::uvec2& size)
    : device_(&device),
      image_(device, descOf(size),
             VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT) {
}

// Boxes of whole texels, from the middle of the picture, and their mean.
void Backdrop::convert(const Image& picture, uint16_t* texels) const {
  const uint32_t width = size().x, height = size().y,
                 finer = std::min(picture.width / width, picture.height / height);  // as sizeFor() chose it
  const uint32_t left = (picture.width - width * finer) / 2, top = (picture.height - height * finer) / 2;
  const size_t channels = picture.channels.size();
  const float part = 1.0f / float(finer * finer);
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x, texels += 4) {
      glm::vec3 sum(0.0f);
      for (uint32_t j = 0; j < finer; ++j) {
        const size_t row = size_t(top + y * finer + j) * picture.width + left + size_t(x) * finer;
        const float* in = picture.pixels.data() + row * channels;
        for (uint32_t i = 0; i < finer; ++i, in += channels)
          sum += glm::vec3(in[0], in[1], in[2]) * (channels == 4 ? in[3] : 1.0f);
      }
      sum *= part;
      const float luminance = glm::dot(sum, shared::kLuminance);
      for (int c = 0; c < 3; ++c) texels[c] = halfOf(sum[c]);
      texels[3] = halfOf(luminance * luminance);
    }
}

void Backdrop::upload(VkCommandBuffer commands, uint32_t frame, const std::shared_ptr<const Image>& picture) {
  if (picture == last_) return;
  last_ = picture;
  gpu::Buffer& staging = staging_[frame];
  const uint32_t width = size().x, height = size().y, levels = image_.desc().mipLevels;
  if (!staging.handle())
    staging = gpu::Buffer(*device_, uint64_t(width) * height * gpu::bytesPerPixel(kFormat),
                          VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::upload);
  convert(*picture, reinterpret_cast<uint16_t*>(staging.mapped()));

  // Level 0; then each one from the one before.
  moveLevel(commands, image_.handle(), 0, levels, VK_IMAGE_LAYOUT_UNDEFINED,
            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = {width, height, 1};
  vkCmdCopyBufferToImage(commands, staging.handle(), image_.handle(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                         &copy);
  for (uint32_t level = 1; level < levels; ++level) {
    moveLevel(commands, image_.handle(), level - 1, 1, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
              VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const auto corner = [&](uint32_t l) {
      return VkOffset3D{int32_t(std::max(1u, width >> l)), int32_t(std::max(1u, height >> l)), 1};
    };
    VkImageBlit blit{};
    blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level - 1, 0, 1};
    blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
    blit.srcOffsets[1] = corner(level - 1), blit.dstOffsets[1] = corner(level);
    vkCmdBlitImage(commands, image_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image_.handle(),
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
  }
  if (levels > 1)
    moveLevel(commands, image_.handle(), 0, levels - 1, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
              VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  moveLevel(commands, image_.handle(), levels - 1, 1, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

}  // namespace scumble::world
