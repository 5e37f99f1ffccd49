#include "film/checks.h"

namespace scumble::film {

std::string problemWith(const Image& image) {
  if (image.width == 0 || image.height == 0) return "the picture is empty";
  if (image.channels.empty()) return "the picture has no channels";
  if (image.width > INT32_MAX || image.height > INT32_MAX)
    return "the picture is larger than the format allows";
  if (image.format == PixelFormat::half) return "the picture is of half floats";
  const size_t numbers = image.format == PixelFormat::srgb8 ? image.codes.size() : image.pixels.size();
  if (numbers / image.channels.size() / image.width != image.height ||
      numbers != size_t(image.width) * image.height * image.channels.size())
    return "the picture's data does not fit its size";
  return "";
}

}  // namespace scumble::film
