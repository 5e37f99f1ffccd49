#include "film/yuv.h"

#include <algorithm>
#include <cmath>

#include "film/codes.h"

namespace scumble::film {
namespace {

// BT.709's weights of red and blue in luma; green has the rest.
constexpr double kRed = 0.2126, kBlue = 0.0722, kGreen = 1 - kRed - kBlue;

constexpr int kFraction = 18;  // bits; sums of eight codes still fit an int

constexpr int fixed(double value) {
  return int(value * (1 << kFraction) + (value < 0 ? -0.5 : 0.5));
}

// One output as a weighted sum of codes 0 ... 255. `range`: how many steps the output has from 0 to 1.
struct Weights {
  int red, green, blue;

  int sum(const int* rgb) const { return red * rgb[0] + green * rgb[1] + blue * rgb[2]; }
};
constexpr double kLumaStep = 219 / 255.0, kChromaStep = 224 / 255.0;
constexpr Weights kLuma = {fixed(kRed * kLumaStep), fixed(kGreen* kLumaStep), fixed(kBlue* kLumaStep)};
// Cb = (B - Y) / (2 (1 - Kb)), and Cr alike. Each adds up to 0, so that greys have no colour.
constexpr double kCb = kChromaStep / (2 * (1 - kBlue)), kCr = kChromaStep / (2 * (1 - kRed));
constexpr Weights kBlueDifference = {fixed(-kRed * kCb), -fixed(-kRed* kCb) - fixed((1 - kBlue) * kCb),
                                     fixed((1 - kBlue) * kCb)};
constexpr Weights kRedDifference = {fixed((1 - kRed) * kCr), -fixed((1 - kRed) * kCr) - fixed(-kBlue* kCr),
                                    fixed(-kBlue* kCr)};

uint8_t rounded(int sum, int offset, int extraBits) {
  const int bits = kFraction + extraBits;
  return uint8_t(offset + ((sum + (1 << (bits - 1))) >> bits));
}

}  // namespace

std::vector<uint8_t> yuv420(const Image& image) {
  const uint32_t width = (image.width + 1) & ~1u, height = (image.height + 1) & ~1u;
  const size_t lumaSize = size_t(width) * height, chromaSize = lumaSize / 4;
  std::vector<uint8_t> planes(lumaSize + 2 * chromaSize);
  uint8_t* luma = planes.data();
  uint8_t* blue = luma + lumaSize;
  uint8_t* red = blue + chromaSize;

  std::vector<uint8_t> rows[2] = {std::vector<uint8_t>(size_t(width) * 3),
                                  std::vector<uint8_t>(size_t(width) * 3)};
  for (uint32_t y = 0; y < height; y += 2) {
    for (uint32_t i = 0; i < 2; ++i) {
      encodeRow(image, std::min(y + i, image.height - 1), width, rows[i].data());
      for (uint32_t x = 0; x < width; ++x) {
        const uint8_t* code = &rows[i][size_t(x) * 3];
        const int rgb[3] = {code[0], code[1], code[2]};
        *luma++ = rounded(kLuma.sum(rgb), 16, 0);
      }
    }
    // 1 2 1 across, as the sample lies on the left pixel of a pair, and 1 1 down: eight in all.
    for (uint32_t x = 0; x < width; x += 2) {
      const size_t left = size_t(x > 0 ? x - 1 : 0) * 3, middle = size_t(x) * 3, right = size_t(x + 1) * 3;
      int rgb[3];
      for (size_t c = 0; c < 3; ++c)
        rgb[c] = rows[0][left + c] + 2 * rows[0][middle + c] + rows[0][right + c] + rows[1][left + c] +
                 2 * rows[1][middle + c] + rows[1][right + c];
      *blue++ = rounded(kBlueDifference.sum(rgb), 128, 3);
      *red++ = rounded(kRedDifference.sum(rgb), 128, 3);
    }
  }
  return planes;
}

}  // namespace scumble::film
