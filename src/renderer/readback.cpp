#include "renderer/readback.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "base/srgb.h"
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

// A picture of nothing, in a format.
Image blank(uint32_t width, uint32_t height, const std::vector<std::string>& channels, PixelFormat format) {
  Image image{width, height, channels, {}};
  const size_t numbers = size_t(width) * height * channels.size();
  image.format = format;
  if (format == PixelFormat::float32) image.pixels.resize(numbers);
  if (format == PixelFormat::half) image.halves.resize(numbers);
  if (format == PixelFormat::srgb8) image.codes.resize(numbers);
  return image;
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

void Readback::declare(FrameBuilder& frame, const Aov& aov, const std::vector<gpu::Handle>& images) {
  aov_ = aov;
  images_ = images;
  frame.step("readback", [this](VkCommandBuffer commands) {
    for (size_t i = 0; i < images_.size(); ++i) {
      const gpu::Image& image = resources_->image(images_[i]);
      VkBufferImageCopy copy{};
      copy.bufferOffset = i * bytesOf(image.desc());
      copy.imageSubresource = {gpu::aspectOf(image.desc().format), 0, 0, image.desc().layers};
      copy.imageExtent = {image.desc().width, image.desc().height, 1};
      vkCmdCopyImageToBuffer(commands, image.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                             buffers_[frame_].handle(), 1, &copy);
    }
  });
  for (const gpu::Handle image : images) frame.use(image, gpu::Use::copySource);
  // Each frame in flight has a buffer of its own; the CPU reads it next.
  const gpu::Outside before, after{VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
  frame.use(frame.graph().importBuffer(std::string(*aov.name ? aov.name : "picture") + " on the CPU", before,
                                       after),
            gpu::Use::copyTarget);
}

void Readback::bind(const gpu::GraphResources& resources) {
  resources_ = &resources;
  for (gpu::Buffer& buffer : buffers_) buffer = gpu::Buffer();
}

void Readback::setFrame(gpu::Device& device, uint32_t frame) {
  frame_ = frame;
  const uint64_t bytes = images_.size() * bytesOf(resources_->image(images_.front()).desc());
  if (!buffers_[frame].handle())
    buffers_[frame] = gpu::Buffer(device, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryKind::readback);
}

std::vector<Image> Readback::images(uint32_t frame, uint32_t width, uint32_t height,
                                    PixelFormat format) const {
  const gpu::ImageDesc& desc = resources_->image(images_.front()).desc();
  std::vector<std::string> names;
  for (const char* const name : aov_.channels)
    if (name) names.emplace_back(name);
  const size_t channels = names.size();
  const uint32_t channelsAnImage = uint32_t(channels / images_.size());
  const size_t pixelsALayer = size_t(desc.width) * desc.height;
  // Linear, straight.
  const auto readStraight = [&](size_t pixel, float* out) {
    for (size_t part = 0; part < images_.size(); ++part)
      readPixel(desc.format, buffers_[frame].mapped() + part * bytesOf(desc), pixel, channelsAnImage,
                out + part * channelsAnImage);
    if (aov_.premultiplied > 0 && out[3] > 0.0f && out[3] < 1.0f)
      for (uint32_t c = 0; c < aov_.premultiplied; ++c) out[c] /= out[3];
    if (aov_.isSquareRoot)
      for (uint32_t c = 0; c < 3; ++c) out[c] *= out[c];
  };

  std::vector<Image> images;
  halfTable();
  const SrgbEncoder& encode = SrgbEncoder::instance();
  // Enlarging is done in floats.
  const bool isSmall = !aov_.hasOwnSize && (desc.width != width || desc.height != height);
  const PixelFormat first = isSmall ? PixelFormat::float32 : format;
  for (uint32_t layer = 0; layer < desc.layers; ++layer) {
    Image image = blank(desc.width, desc.height, names, first);
    constexpr uint32_t kRows = 64;
    scene::parallelFor((desc.height + kRows - 1) / kRows, scene::threadCount(0), [&](size_t band) {
      const size_t begin = band * kRows * desc.width;
      const size_t end = std::min(begin + size_t(kRows) * desc.width, pixelsALayer);
      std::array<float, std::tuple_size_v<decltype(Aov::channels)>> straight;
      for (size_t i = begin; i < end; ++i) {
        if (first == PixelFormat::float32) {
          readStraight(layer * pixelsALayer + i, &image.pixels[i * channels]);
          continue;
        }
        readStraight(layer * pixelsALayer + i, straight.data());
        for (size_t c = 0; c < channels; ++c)
          if (first == PixelFormat::half)
            image.halves[i * channels + c] = glm::packHalf1x16(straight[c]);
          else
            image.codes[i * channels + c] = c == 3 ? alphaCode(straight[c]) : encode(straight[c]);
      }
    });
    if (isSmall) image = enlarge(image, width, height);
    if (isSmall && format == PixelFormat::half) {
      for (const float value : image.pixels) image.halves.push_back(glm::packHalf1x16(value));
      image.pixels.clear();
      image.format = format;
    }
    image.isColor = aov_.isColor;
    images.push_back(std::move(image));
  }
  return images;
}

}  // namespace scumble::renderer
