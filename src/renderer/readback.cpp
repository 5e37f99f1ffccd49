#include "renderer/readback.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "look/param.h"
#include "scene/parallel.h"

namespace scumble::renderer {

namespace {

// Lookup tables cost less than a conversion each for a million pixels.
const std::vector<float>& halfTable() {
  static const std::vector<float> table = [] {
    std::vector<float> t(65536);
    for (uint32_t i = 0; i < 65536; ++i) t[i] = glm::unpackHalf1x16(uint16_t(i));
    return t;
  }();
  return table;
}

const std::array<float, 256>& srgbTable() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (uint32_t i = 0; i < 256; ++i) t[i] = look::linearFromSrgb(i).b;
    return t;
  }();
  return table;
}

// Reads `channels` channels of one pixel.
void readPixel(VkFormat format, const std::byte* data, size_t pixel, uint32_t channels, float* out) {
  switch (format) {
    case VK_FORMAT_R16G16B16A16_SFLOAT: {
      const auto* p = reinterpret_cast<const uint16_t*>(data) + pixel * 4;
      for (uint32_t c = 0; c < channels; ++c) out[c] = halfTable()[p[c]];
      break;
    }
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB: {
      const auto* p = reinterpret_cast<const uint8_t*>(data) + pixel * 4;
      for (uint32_t c = 0; c < channels; ++c)
        out[c] = format == VK_FORMAT_R8G8B8A8_SRGB && c < 3 ? srgbTable()[p[c]] : float(p[c]) / 255.0f;
      break;
    }
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      std::memcpy(out, data + pixel * 16, channels * 4);
      break;
    default:  // D32
      std::memcpy(out, data + pixel * 4, 4);
  }
}

uint64_t bytesOf(const gpu::ImageDesc& desc) {
  return uint64_t(desc.width) * desc.height * desc.layers * gpu::bytesPerPixel(desc.format);
}

std::vector<std::string> channelNames(Slot slot) {
  if (slot == Slot::matte)
    return {"id0", "coverage0", "id1", "coverage1", "id2", "coverage2", "id3", "coverage3"};
  static const char* const kNames[] = {"R", "G", "B", "A"};
  return {kNames, kNames + slotInfo(slot).channels};
}

bool isColor(Slot slot) {
  switch (slot) {
    case Slot::lit:
    case Slot::shadowed:
    case Slot::color:
    case Slot::limit:
    case Slot::colorize:
    case Slot::finalColor:
    case Slot::plain:
      return true;
    default:
      return false;
  }
}

// What is accumulated under partial coverage comes back premultiplied by it.
bool isPremultiplied(Slot slot) {
  return isColor(slot) || slot == Slot::shadow || slot == Slot::blur;
}

Image enlarge(const Image& small, uint32_t width, uint32_t height) {
  Image large{width, height, small.channels, {}};
  const size_t channels = small.channels.size();
  large.pixels.resize(size_t(width) * height * channels);
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      const float sx = std::clamp((float(x) + 0.5f) * float(small.width) / float(width) - 0.5f, 0.0f,
                                  float(small.width - 1));
      const float sy = std::clamp((float(y) + 0.5f) * float(small.height) / float(height) - 0.5f, 0.0f,
                                  float(small.height - 1));
      const uint32_t x0 = uint32_t(sx), y0 = uint32_t(sy);
      const uint32_t x1 = std::min(x0 + 1, small.width - 1), y1 = std::min(y0 + 1, small.height - 1);
      const float fx = sx - float(x0), fy = sy - float(y0);
      for (uint32_t c = 0; c < channels; ++c) {
        const float top = small.at(x0, y0, c) * (1 - fx) + small.at(x1, y0, c) * fx;
        const float bottom = small.at(x0, y1, c) * (1 - fx) + small.at(x1, y1, c) * fx;
        large.pixels[(size_t(y) * width + x) * channels + c] = top * (1 - fy) + bottom * fy;
      }
    }
  return large;
}

}  // namespace

void Readback::declare(FrameBuilder& frame, Slot slot) {
  slot_ = slot;
  images_ = {frame.slot(slot)};
  if (slot == Slot::matte) images_.push_back(frame.slot(Slot::matteRest));
  std::vector<gpu::ResourceUse> uses;
  for (const gpu::ResourceId image : images_) uses.push_back({image, gpu::Use::copySource});
  frame.addStep("readback", std::move(uses), [this](VkCommandBuffer commands) {
    for (size_t i = 0; i < images_.size(); ++i) {
      const gpu::Image& image = resources_->image(images_[i]);
      VkBufferImageCopy copy{};
      copy.bufferOffset = i * bytesOf(image.desc());
      copy.imageSubresource = {
          VkImageAspectFlags(gpu::isDepthFormat(image.desc().format) ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                                     : VK_IMAGE_ASPECT_COLOR_BIT),
          0, 0, image.desc().layers};
      copy.imageExtent = {image.desc().width, image.desc().height, 1};
      vkCmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                             buffers_[frame_].handle(), 1, &copy);
    }
    gpu::memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
  });
}

void Readback::create(FrameBuilder& frame, const FrameResources& resources) {
  resources_ = &resources;
  const uint64_t bytes = images_.size() * bytesOf(resources.image(images_.front()).desc());
  for (gpu::Buffer& buffer : buffers_)
    buffer = gpu::Buffer(frame.device(), bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryKind::readback);
}

std::vector<Image> Readback::images(uint32_t frame, uint32_t width, uint32_t height) const {
  const gpu::ImageDesc& desc = resources_->image(images_.front()).desc();
  const std::vector<std::string> names = channelNames(slot_);
  const size_t channels = names.size();
  const uint32_t channelsAnImage = slotInfo(slot_).channels;
  const size_t pixelsALayer = size_t(desc.width) * desc.height;
  std::vector<Image> images;
  halfTable();
  for (uint32_t layer = 0; layer < desc.layers; ++layer) {
    Image image{desc.width, desc.height, names, {}};
    image.isColor = isColor(slot_);
    image.pixels.resize(pixelsALayer * channels);
    constexpr uint32_t kRows = 64;
    scene::parallelFor((desc.height + kRows - 1) / kRows, scene::threadCount(0), [&](size_t band) {
      const size_t first = band * kRows * desc.width;
      const size_t last = std::min(first + size_t(kRows) * desc.width, pixelsALayer);
      for (size_t i = first; i < last; ++i) {
        float* out = &image.pixels[i * channels];
        for (size_t part = 0; part < images_.size(); ++part)
          readPixel(desc.format, buffers_[frame].mapped() + part * bytesOf(desc), layer * pixelsALayer + i,
                    channelsAnImage, out + part * channelsAnImage);
        if (isPremultiplied(slot_) && out[3] > 0.0f && out[3] < 1.0f)
          for (uint32_t c = 0; c < (slot_ == Slot::blur ? 2u : 3u); ++c)
            out[c] /= out[3];  // the blur's B is depth
        if (slot_ == Slot::lit || slot_ == Slot::shadowed)
          for (uint32_t c = 0; c < 3; ++c) out[c] *= out[c];
      }
    });
    if (slot_ == Slot::blur) image = enlarge(image, width, height);
    images.push_back(std::move(image));
  }
  return images;
}

}  // namespace scumble::renderer
