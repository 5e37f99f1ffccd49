#include "film/codes.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"

namespace scumble::film {

namespace {

// A picture of codes as rows of red, green, blue and alpha.
struct CodeReader {
  const uint8_t* in;
  size_t channels;
  explicit CodeReader(const Image& image, size_t firstRow)
      : in(image.codes.data() + firstRow * image.width * image.channels.size()),
        channels(image.channels.size()) {}
  void next(uint8_t* out) {
    out[0] = in[0];
    out[1] = channels > 1 ? in[1] : in[0];
    out[2] = channels > 2 ? in[2] : channels == 1 ? in[0] : uint8_t(0);
    out[3] = channels == 4 ? in[3] : uint8_t(255);
    in += channels;
  }
};

}  // namespace

void encodeRow(const Image& image, uint32_t y, uint32_t padded, uint8_t* out) {
  const SrgbEncoder& encode = SrgbEncoder::instance();
  const size_t channels = image.channels.size();
  if (image.format == PixelFormat::srgb8) {
    const std::array<float, 256>& linear = linearFromSrgb8();
    CodeReader reader(image, y);
    for (uint32_t x = 0; x < image.width; ++x, out += 3) {
      uint8_t code[4];
      reader.next(code);
      for (int c = 0; c < 3; ++c)
        out[c] = code[3] == 255 ? code[c] : encode(linear[code[c]] * (float(code[3]) / 255.0f));
    }
    for (uint32_t x = image.width; x < padded; ++x, out += 3) std::copy_n(out - 3, 3, out);
    return;
  }
  const float* in = image.pixels.data() + size_t(y) * image.width * channels;
  for (uint32_t x = 0; x < image.width; ++x, in += channels, out += 3) {
    const float alpha = channels == 4 ? (in[3] > 0 ? std::min(in[3], 1.0f) : 0.0f) : 1.0f;
    out[0] = encode(in[0] * alpha);
    out[1] = channels > 1 ? encode(in[1] * alpha) : out[0];
    out[2] = channels > 2 ? encode(in[2] * alpha) : (channels == 1 ? out[0] : uint8_t(0));
  }
  for (uint32_t x = image.width; x < padded; ++x, out += 3) std::copy_n(out - 3, 3, out);
}

std::vector<uint8_t> rgbOverBlack(const Image& image) {
  const size_t row = size_t(image.width) * 3;
  std::vector<uint8_t> codes(row * image.height);
  for (uint32_t y = 0; y < image.height; ++y) encodeRow(image, y, image.width, codes.data() + row * y);
  return codes;
}

bool encodeRgba(const Image& image, uint32_t begin, uint32_t end, uint8_t* out) {
  const SrgbEncoder& encode = SrgbEncoder::instance();
  const size_t channels = image.channels.size();
  uint8_t leastAlpha = 255;
  if (image.format == PixelFormat::srgb8) {
    CodeReader reader(image, begin);
    for (size_t left = size_t(end - begin) * image.width; left > 0; --left, out += 4) {
      reader.next(out);
      leastAlpha = std::min(leastAlpha, out[3]);
    }
    return leastAlpha == 255;
  }
  const float* in = image.pixels.data() + size_t(begin) * image.width * channels;
  for (size_t left = size_t(end - begin) * image.width; left > 0; --left, in += channels, out += 4) {
    out[0] = encode(in[0]);
    out[1] = channels > 1 ? encode(in[1]) : out[0];
    out[2] = channels > 2 ? encode(in[2]) : (channels == 1 ? out[0] : uint8_t(0));
    out[3] = channels == 4 ? alphaCode(in[3]) : uint8_t(255);
    leastAlpha = std::min(leastAlpha, out[3]);
  }
  return leastAlpha == 255;
}

}  // namespace scumble::film
