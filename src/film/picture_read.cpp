// Pictures of any of the formats that are read for textures, and photographs upright.
#include <algorithm>
#include <cstring>
#include <exception>

#include "base/file_bytes.h"
#include "base/image_decode.h"
#include "base/srgb.h"
#include "film/picture_limits.h"
#include "scumble/image.h"

namespace scumble {

using film::kMostPixels;
using film::unusable;

namespace {

// Numbers of a TIFF block, in its byte order; 0 beyond its end.
struct Tiff {
  Bytes bytes;
  bool bigEndian;
  uint32_t number(size_t at, size_t size) const {
    uint32_t value = 0;
    if (at + size > bytes.size()) return 0;
    for (size_t i = 0; i < size; ++i) value |= uint32_t(bytes[at + i]) << 8 * (bigEndian ? size - 1 - i : i);
    return value;
  }
};

// EXIF's orientation, 1 (upright) to 8; 1 for whatever has none.
uint32_t orientationOf(Bytes jpeg) {
  if (jpeg.size() < 4 || jpeg[0] != 0xFF || jpeg[1] != 0xD8) return 1;
  for (size_t at = 2; at + 4 <= jpeg.size() && jpeg[at] == 0xFF && jpeg[at + 1] != 0xDA;) {
    const size_t length = size_t(jpeg[at + 2]) << 8 | jpeg[at + 3];
    const Bytes segment =
        jpeg.subspan(at + 4, std::min(std::max<size_t>(length, 2) - 2, jpeg.size() - at - 4));
    if (jpeg[at + 1] == 0xE1 && segment.size() > 14 && std::memcmp(segment.data(), "Exif\0\0", 6) == 0) {
      const Tiff tiff{segment.subspan(6), segment[6] == 'M'};
      const size_t directory = tiff.number(4, 4), entries = tiff.number(directory, 2);
      for (size_t i = 0; i < entries; ++i) {
        const size_t entry = directory + 2 + 12 * i;
        if (tiff.number(entry, 2) != 0x0112) continue;
        const uint32_t value = tiff.number(entry + 8, 2);
        return value >= 1 && value <= 8 ? value : 1;
      }
    }
    at += 2 + std::max<size_t>(length, 2);
  }
  return 1;
}

// From 5 on, rows of the file are columns of the picture.
Image upright(const Pixels& pixels, uint32_t orientation) {
  const bool turned = orientation >= 5;
  const bool fromRight = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool fromBelow = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  const uint32_t w = pixels.width, h = pixels.height;
  Image image;
  image.width = turned ? h : w, image.height = turned ? w : h;
  image.channels = {"R", "G", "B", "A"};
  image.isColor = true;
  image.pixels.resize(size_t(w) * h * 4);
  const std::array<float, 256>& linear = linearFromSrgb8();
  float* out = image.pixels.data();
  for (uint32_t y = 0; y < image.height; ++y)
    for (uint32_t x = 0; x < image.width; ++x, out += 4) {
      const uint32_t i = turned ? y : x, j = turned ? x : y;
      const uint8_t* in =
          &pixels.rgba[(size_t(fromBelow ? h - 1 - j : j) * w + (fromRight ? w - 1 - i : i)) * 4];
      for (int c = 0; c < 3; ++c) out[c] = linear[in[c]];
      out[3] = float(in[3]) / 255;
    }
  return image;
}

Error tooLarge(const std::string& path) {
  return unusable(path, "has more than " + std::to_string(kMaxImageSide) + " pixels a side",
                  "use a smaller picture");
}

}  // namespace

Result<Image> readPicture(const std::string& path) {
  try {
    FileBytes file;
    std::string problem;
    if (!file.open(path, problem, FileAccess::read)) return unusable(path, problem, "check the name");
    const Bytes bytes = file.bytes();
    // Sixteen bits a channel stay what they are.
    if (bytes.size() >= 4 && std::memcmp(bytes.data(), "\x89PNG", 4) == 0) {
      Result<Image> png = readPng(path);
      if (png && std::max(png->width, png->height) > kMaxImageSide) return tooLarge(path);
      return png;
    }
    Pixels pixels;
    if (!readImageSize(bytes, pixels.width, pixels.height, problem))
      return unusable(path, "is no usable picture: " + problem, "give a PNG, a JPEG or a WebP");
    if (std::max(pixels.width, pixels.height) > kMaxImageSide) return tooLarge(path);
    if (uint64_t(pixels.width) * pixels.height > kMostPixels)
      return unusable(path, "has more pixels than this program accepts", "use a smaller picture");
    // Some are shown in spite of their damage, with what is wrong with them.
    if (!decodeImage(bytes, pixels, problem) || !problem.empty())
      return unusable(path, "is no usable picture: " + problem,
                      "save it again from the program that made it");
    return upright(pixels, orientationOf(bytes));
  } catch (const std::exception&) {
    return unusable(path, "is too large for this machine's memory", "use a smaller picture");
  }
}

}  // namespace scumble
