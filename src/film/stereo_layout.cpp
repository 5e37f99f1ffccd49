// Two views in one picture, for players that know no multi-view files.
#include <algorithm>

#include "scumble/image.h"

namespace scumble {
namespace {

// Copies `from` into `to` with its upper left corner at (x, y). Channels go by position: both views come from
// one renderer; where one has fewer, the rest stays 0.
void paste(const Image& from, uint32_t x, uint32_t y, Image* to) {
  const size_t have = from.channels.size(), want = to->channels.size(), both = std::min(have, want);
  for (uint32_t row = 0; row < from.height; ++row) {
    const float* in = from.pixels.data() + size_t(row) * from.width * have;
    float* out = to->pixels.data() + (size_t(row + y) * to->width + x) * want;
    for (uint32_t column = 0; column < from.width; ++column, in += have, out += want)
      std::copy_n(in, both, out);
  }
}

// A picture of nothing, of the same kind as another.
Image blank(uint32_t width, uint32_t height, const Image& like) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = like.channels;
  image.isColor = like.isColor;
  image.pixels.assign(size_t(width) * height * image.channels.size(), 0.0f);
  return image;
}

}  // namespace

Image sideBySide(const Image& left, const Image& right) {
  Image both = blank(left.width + right.width, std::max(left.height, right.height), left);
  paste(left, 0, 0, &both);
  paste(right, left.width, 0, &both);
  return both;
}

Image overUnder(const Image& left, const Image& right) {
  Image both = blank(std::max(left.width, right.width), left.height + right.height, left);
  paste(left, 0, 0, &both);
  paste(right, 0, left.height, &both);
  return both;
}

}  // namespace scumble
