// Two views in one picture, for players that know no multi-view files.
#include <algorithm>

#include "scumble/image.h"

namespace scumble {
namespace {

// Copies `from` into `to` with its upper left corner at (x, y). Channels go by position: both views come from
// one renderer; where one has fewer, the rest stays 0.
void paste(const Image& from, uint32_t x, uint32_t y, Image* to) {
  const size_t have = from.channels.size(), want = to->channels.size(), both = std::min(have, want);
  const auto copy = [&](const auto& source, auto& target) {
    for (uint32_t row = 0; row < from.height; ++row) {
      const auto* in = source.data() + size_t(row) * from.width * have;
      auto* out = target.data() + (size_t(row + y) * to->width + x) * want;
      for (uint32_t column = 0; column < from.width; ++column, in += have, out += want)
        std::copy_n(in, both, out);
    }
  };
  // Of one format, as they come from one renderer; what has another stays empty.
  if (from.format != to->format) return;
  if (from.format == PixelFormat::float32) copy(from.pixels, to->pixels);
  if (from.format == PixelFormat::half) copy(from.halves, to->halves);
  if (from.format == PixelFormat::srgb8) copy(from.codes, to->codes);
}

// A picture of nothing, of the same kind as another.
Image blank(uint32_t width, uint32_t height, const Image& like) {
  Image image;
  image.width = width;
  image.height = height;
  image.channels = like.channels;
  image.isColor = like.isColor;
  image.format = like.format;
  const size_t numbers = size_t(width) * height * image.channels.size();
  if (like.format == PixelFormat::float32) image.pixels.assign(numbers, 0.0f);
  if (like.format == PixelFormat::half) image.halves.assign(numbers, 0);
  if (like.format == PixelFormat::srgb8) image.codes.assign(numbers, 0);
  return image;
}

// Of alphas the greater counts: from 0 on, bits of halves have the order of their numbers.
template <class Number>
void mix(const std::vector<Number>& right, const Image& of, std::vector<Number>& into, size_t alpha) {
  const size_t channels = of.channels.size();
  for (size_t i = 0; i < std::min(right.size(), into.size()); ++i) {
    const size_t channel = i % channels;
    if (channel == alpha)
      into[i] = std::max(into[i], right[i]);
    else if (channel > 0)
      into[i] = right[i];
  }
}

}  // namespace

Image anaglyph(const Image& left, const Image& right) {
  Image fitted = blank(left.width, left.height, left);
  if (right.width == left.width && right.height == left.height &&
      right.channels.size() == left.channels.size())
    paste(right, 0, 0, &fitted);
  Image both = left;
  const auto alpha = std::find(both.channels.begin(), both.channels.end(), "A");
  const size_t at = size_t(alpha - both.channels.begin());
  mix(fitted.pixels, both, both.pixels, at);
  mix(fitted.halves, both, both.halves, at);
  mix(fitted.codes, both, both.codes, at);
  return both;
}

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
