#include "base/image_decode.h"

#include <png.h>
#include <webp/decode.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "base/image_decode_jpeg.h"

namespace scumble {

namespace {

enum class Format { unknown, png, jpeg, webp, ktx2, dds };

Format formatOf(Bytes b) {
  const auto startsWith = [&](std::string_view magic, size_t at = 0) {
    return b.size() >= at + magic.size() && std::memcmp(b.data() + at, magic.data(), magic.size()) == 0;
  };
  if (startsWith("\x89PNG\r\n\x1a\n")) return Format::png;
  if (startsWith("\xff\xd8\xff")) return Format::jpeg;
  if (startsWith("RIFF") && startsWith("WEBP", 8)) return Format::webp;
  if (startsWith("\xabKTX 20\xbb")) return Format::ktx2;
  if (startsWith("DDS ")) return Format::dds;
  return Format::unknown;
}

struct PngSource {
  Bytes bytes;
  size_t at = 0;
  std::string* problem;
};

void readPng(png_structp png, png_bytep out, png_size_t size) {
  PngSource& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (size > source.bytes.size() - source.at) png_error(png, "it ends too early");
  std::memcpy(out, source.bytes.data() + source.at, size);
  source.at += size;
}

[[noreturn]] void pngError(png_structp png, png_const_charp message) {
  *static_cast<PngSource*>(png_get_error_ptr(png))->problem = std::string("it is a damaged PNG: ") + message;
  png_longjmp(png, 1);
}

void pngWarning(png_structp, png_const_charp) {}  // what libpng can live with, so can we

// No object with a destructor lives between setjmp and a call that may jump: the vectors belong to the
// caller.
bool decodePngInto(png_structp png, png_infop info, PngSource& source, Pixels& image,
                   std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_read_fn(png, &source, readPng);
  png_set_user_limits(png, kMaxImageSide, kMaxImageSide);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, 0);
  png_read_info(png, info);
  png_set_expand(png);  // palettes and small depths to 8 bits, tRNS to alpha
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_filler(png, 0xff, PNG_FILLER_AFTER);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const size_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
  if (width != image.width || height != image.height || png_get_rowbytes(png, info) != width * 4)
    png_error(png, "its header contradicts itself");
  for (size_t y = 0; y < height; ++y) rows[y] = image.rgba.data() + y * width * 4;
  png_read_image(png, rows.data());
  return true;  // what follows the pixels does not matter
}

bool decodePng(Bytes bytes, Pixels& image, std::string& problem) {
  PngSource source{bytes, 0, &problem};
  std::vector<png_bytep> rows(image.height);
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, pngError, pngWarning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool good = info && decodePngInto(png, info, source, image, rows);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!good && problem.empty()) problem = "there is no memory to decode it";
  return good;
}

uint32_t bigEndian32(const uint8_t* p) {
  return uint32_t(p[0]) << 24 | p[1] << 16 | p[2] << 8 | p[3];
}

}  // namespace

bool readImageSize(Bytes bytes, uint32_t& width, uint32_t& height, std::string& problem) {
  width = height = 0;
  switch (formatOf(bytes)) {
    case Format::png:
      if (bytes.size() < 33 || std::memcmp(bytes.data() + 12, "IHDR", 4) != 0) {
        problem = "it is a damaged PNG: it has no header";
        return false;
      }
      width = bigEndian32(bytes.data() + 16);
      height = bigEndian32(bytes.data() + 20);
      break;
    case Format::jpeg:
      if (!readJpegSize(bytes, width, height, problem)) return false;
      break;
    case Format::webp: {
      int w = 0, h = 0;
      if (!WebPGetInfo(bytes.data(), bytes.size(), &w, &h)) {
        problem = "it is a damaged WebP";
        return false;
      }
      width = static_cast<uint32_t>(w);
      height = static_cast<uint32_t>(h);
      break;
    }
    case Format::ktx2:
      problem = "it is a KTX2 image, which cannot be decoded here";
      return false;
    case Format::dds:
      problem = "it is a DDS image, which cannot be decoded here";
      return false;
    case Format::unknown:
      problem = "it is neither PNG nor JPEG nor WebP";
      return false;
  }
  if (width == 0 || height == 0 || width > kMaxImageSide || height > kMaxImageSide) {
    problem = "it claims to be " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
    return false;
  }
  return true;
}

bool decodeImage(Bytes bytes, Pixels& image, std::string& problem) {
  if (!readImageSize(bytes, image.width, image.height, problem)) return false;
  image.rgba.resize(size_t(image.width) * image.height * 4);
  switch (formatOf(bytes)) {
    case Format::png:
      return decodePng(bytes, image, problem);
    case Format::jpeg:
      return decodeJpeg(bytes, image, problem);
    default:
      if (WebPDecodeRGBAInto(bytes.data(), bytes.size(), image.rgba.data(), image.rgba.size(),
                             static_cast<int>(image.width * 4)))
        return true;
      problem = "it is a damaged WebP, or one that moves";
      return false;
  }
}

}  // namespace scumble
