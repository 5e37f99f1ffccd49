// Pictures in memory, and the files they go into.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scumble/result.h"

namespace scumble {

// A picture of float channels, interleaved, row 0 at the top. Colours are linear; alpha is straight.
struct Image {
  uint32_t width = 0, height = 0;
  std::vector<std::string> channels;  // names, e.g. {"R", "G", "B", "A"}, in the order of the data
  std::vector<float> pixels;          // width * height * channels.size()

  float at(uint32_t x, uint32_t y, uint32_t channel) const {
    return pixels[(size_t(y) * width + x) * channels.size() + channel];
  }
};

// One layer of an EXR file. The beauty's name is empty: its channels are plain R, G, B, A.
struct ImageLayer {
  std::string name;  // e.g. "final-shadow"
  std::string view;  // "left", "right", or empty where there is one view only
  const Image* image = nullptr;
};

// 8 bit sRGB, straight alpha (kept when `image` has four channels and is not opaque everywhere).
// The file appears whole or not at all. Fails with ErrorKind::outputNotWritten.
Status writePng(const std::string& path, const Image& image);

// Reads what writePng writes, and any other PNG, as linear floats (R, G, B, A).
Result<Image> readPng(const std::string& path);

// 32-bit float, ZIP compressed; alpha is straight, as in Image. Channels are named LAYER.CHANNEL. In stereo
// (layers with views) the standard multiView attribute lists the views, "left" first; the picture's channels
// are R, G, B, A for the left eye and right.R ... for the right one, those of layers LAYER.left.CHANNEL and
// LAYER.right.CHANNEL, since OpenEXR gives only names without a period to the default view. All layers have
// one size.
Status writeExr(const std::string& path, const std::vector<ImageLayer>& layers);

// A report beside pictures, e.g. JSON. The file appears whole or not at all. Fails with
// ErrorKind::outputNotWritten.
Status writeText(const std::string& path, const std::string& text);

// Two pictures in one: left | right, or left over right.
Image sideBySide(const Image& left, const Image& right);
Image overUnder(const Image& left, const Image& right);

}  // namespace scumble
