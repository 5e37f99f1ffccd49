#include "film/codes.h"

#include <algorithm>
#include <cmath>

#include "film/srgb.h"

namespace scumble::film {

void encodeRow(const Image& image, uint32_t y, uint32_t padded, uint8_t* out) {
  const SrgbEncoder& encode = SrgbEncoder::instance();
  const size_t channels = image.channels.size();
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

std::vector<uint8_t> rgbaOf(const Image& image, bool& opaque) {
  const SrgbEncoder& encode = SrgbEncoder::instance();
  const size_t channels = image.channels.size();
  std::vector<uint8_t> codes(size_t(image.width) * image.height * 4);
  const float* in = image.pixels.data();
  opaque = true;
  for (size_t i = 0; i < codes.size(); i += 4, in += channels) {
    codes[i] = encode(in[0]);
    codes[i + 1] = channels > 1 ? encode(in[1]) : codes[i];
    codes[i + 2] = channels > 2 ? encode(in[2]) : (channels == 1 ? codes[i] : uint8_t(0));
    const float alpha = channels == 4 ? (in[3] > 0 ? std::min(in[3], 1.0f) : 0.0f) : 1.0f;
    codes[i + 3] = uint8_t(std::lround(alpha * 255.0));
    opaque &= codes[i + 3] == 255;
  }
  return codes;
}

}  // namespace scumble::film
