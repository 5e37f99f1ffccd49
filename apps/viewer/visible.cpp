#include "visible.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/glm.hpp>
#include <iterator>
#include <limits>

#include "knob_text.h"

namespace scumble::viewer {

namespace {

constexpr float kGolden = 0.618034f;

glm::vec3 hue(float turn) {
  const glm::vec3 third = glm::fract(turn + glm::vec3(0, 2.0f / 3, 1.0f / 3));
  return glm::clamp(glm::abs(third * 6.0f - 3.0f) - 1.0f, 0.0f, 1.0f);
}

// The finite numbers of one channel.
struct Range {
  float low = std::numeric_limits<float>::infinity(), high = -low;
  float placed(float value) const {
    return std::clamp(high > low ? (value - low) / (high - low) : value, 0.0f, 1.0f);
  }
};

std::vector<Range> rangesOf(const Image& image) {
  const size_t channels = image.channels.size();
  std::vector<Range> ranges(channels);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    if (!std::isfinite(image.pixels[i])) continue;
    Range& range = ranges[i % channels];
    range.low = std::min(range.low, image.pixels[i]), range.high = std::max(range.high, image.pixels[i]);
  }
  return ranges;
}

}  // namespace

std::vector<uint8_t> visibleBytes(const Image& image, const std::string& aov) {
  const size_t channels = image.channels.size(), count = size_t(image.width) * image.height;
  std::vector<uint8_t> bytes(4 * count, 255);
  const std::vector<Range> ranges = rangesOf(image);
  float longest = 1e-6f;
  if (aov == "motion")
    for (size_t c = 0; c < channels; ++c)
      longest = std::max({longest, std::abs(ranges[c].low), std::abs(ranges[c].high)});
  for (size_t i = 0; i < count; ++i) {
    const float* const pixel = image.pixels.data() + i * channels;
    const auto at = [&](size_t c) { return c < channels && std::isfinite(pixel[c]) ? pixel[c] : 0.0f; };
    glm::vec3 shown(0);
    if (image.isColor && channels >= 3) {
      shown = curveOf(glm::max(glm::vec3(at(0), at(1), at(2)), 0.0f) * (channels > 3 ? at(3) : 1.0f));
    } else if (aov == "normal") {
      const glm::vec3 normal(at(0), at(1), at(2));
      if (normal != glm::vec3(0)) shown = 0.5f * normal + 0.5f;
    } else if (aov == "id" || aov == "cryptomatte") {
      if (at(0) > 0) shown = 0.25f + 0.7f * hue(glm::fract(at(0) * kGolden));
    } else if (aov == "motion") {
      const glm::vec2 motion(at(0), at(1));
      shown =
          hue(std::atan2(motion.y, motion.x) / 6.2831853f) * std::min(glm::length(motion) / longest, 1.0f);
    } else if (channels == 1) {
      const float placed = std::isfinite(pixel[0]) ? ranges[0].placed(pixel[0]) : 0.0f;
      shown = glm::vec3(aov == "depth" && std::isfinite(pixel[0]) ? 1 - 0.9f * placed : placed);
    } else {
      for (size_t c = 0; c < std::min<size_t>(channels, 3); ++c)
        if (std::isfinite(pixel[c])) shown[int(c)] = ranges[c].placed(pixel[c]);
    }
    for (int c = 0; c < 3; ++c)
      bytes[4 * i + size_t(c)] = uint8_t(std::lround(255 * std::clamp(shown[c], 0.0f, 1.0f)));
  }
  return bytes;
}

std::string pixelText(const Image& image, uint32_t x, uint32_t y) {
  std::string text;
  for (size_t c = 0; c < image.channels.size(); ++c) {
    char number[32];
    const auto end =
        std::to_chars(number, std::end(number), image.at(x, y, uint32_t(c)), std::chars_format::general, 3);
    text += (text.empty() ? "" : "  ") + image.channels[c] + " " + std::string(number, end.ptr);
  }
  return text;
}

}  // namespace scumble::viewer
