// Any PNG as linear floats. The file is not trusted: what it says is checked before memory is taken for it.
#include <png.h>
#include <sys/stat.h>

#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <exception>
#include <memory>
#include <system_error>

#include "base/srgb.h"
#include "film/picture_limits.h"
#include "scumble/image.h"

namespace scumble {

using film::kMostPixels;
using film::unusable;

namespace {

constexpr png_alloc_size_t kMostChunkBytes = 1 << 20;  // all chunks that are kept are far smaller
// Deflate cannot make data more than 1032 times smaller; the rest is for tiny files.
constexpr uint64_t kMostRatio = 1032, kSlack = 4096;

struct Decoded {
  uint32_t width = 0, height = 0;
  bool wide = false;            // 16 bit a sample, in the machine's byte order
  std::vector<uint8_t> bytes;   // RGBA
  std::vector<png_bytep> rows;  // into bytes
  std::string problem;
};

[[noreturn]] void onError(png_structp png, png_const_charp message) {
  // Nothing may throw between here and the jump's target.
  try {
    static_cast<Decoded*>(png_get_error_ptr(png))->problem = message;
  } catch (...) {
  }
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

// libpng reports errors by longjmp: so nothing with a destructor lives in this function, all of it is in
// `decoded`.
bool decode(FILE* file, uint64_t fileSize, Decoded* decoded) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, decoded, onError, onWarning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_init_io(png, file);
  // Notes, profiles and the like are passed over: libpng would first take the memory that they claim to need.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_chunk_malloc_max(png, kMostChunkBytes);
  png_read_info(png, info);
  decoded->width = png_get_image_width(png, info);
  decoded->height = png_get_image_height(png, info);
  const uint64_t pixels = uint64_t(decoded->width) * decoded->height;
  if (pixels > kMostPixels) png_error(png, "it has more pixels than this program accepts");
  if (uint64_t(png_get_rowbytes(png, info)) * decoded->height > fileSize * kMostRatio + kSlack)
    png_error(png, "it is too short for the size that it states");

  // Whatever it is becomes RGBA: palettes, grey, transparent colours, 1 to 16 bits. Colour space notes (gAMA,
  // cHRM, iCCP) are not looked at, as glTF asks for its textures: values are sRGB.
  decoded->wide = png_get_bit_depth(png, info) == 16;
  png_set_expand(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
  if (decoded->wide && std::endian::native == std::endian::little) png_set_swap(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const size_t rowBytes = size_t(decoded->width) * 4 * (decoded->wide ? 2 : 1);
  if (png_get_rowbytes(png, info) != rowBytes) png_error(png, "its pixel format is not known");
  bool enough = true;
  try {
    decoded->bytes.resize(rowBytes * decoded->height);
    decoded->rows.resize(decoded->height);
  } catch (const std::exception&) {
    enough = false;
  }
  if (!enough) png_error(png, "it is too large for this machine's memory");
  for (uint32_t y = 0; y < decoded->height; ++y) decoded->rows[y] = decoded->bytes.data() + rowBytes * y;
  png_read_image(png, decoded->rows.data());
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

Image toLinear(const Decoded& decoded) {
  Image image;
  image.width = decoded.width;
  image.height = decoded.height;
  image.channels = {"R", "G", "B", "A"};
  image.isColor = true;
  const size_t pixels = size_t(image.width) * image.height;
  image.pixels.resize(pixels * 4);
  float* out = image.pixels.data();
  if (decoded.wide) {
    std::vector<float> table(65536);
    for (size_t code = 0; code < table.size(); ++code)
      table[code] = float(linearFromSrgb(double(code) / 65535));
    const uint16_t* in = reinterpret_cast<const uint16_t*>(decoded.bytes.data());
    for (size_t i = 0; i < pixels; ++i, in += 4, out += 4) {
      for (int c = 0; c < 3; ++c) out[c] = table[in[c]];
      out[3] = float(in[3]) / 65535;
    }
  } else {
    const std::array<float, 256>& table = linearFromSrgb8();
    const uint8_t* in = decoded.bytes.data();
    for (size_t i = 0; i < pixels; ++i, in += 4, out += 4) {
      for (int c = 0; c < 3; ++c) out[c] = table[in[c]];
      out[3] = float(in[3]) / 255;
    }
  }
  return image;
}

}  // namespace

Result<Image> readPng(const std::string& path) {
  // A folder or a pipe would open, and then fail oddly or wait for ever.
  struct stat facts = {};
  if (stat(path.c_str(), &facts) != 0)
    return unusable(path, "cannot be read: " + std::generic_category().message(errno), "check the name");
  if (!S_ISREG(facts.st_mode)) return unusable(path, "is not a file", "name a PNG file");
  const std::unique_ptr<FILE, int (*)(FILE*)> file(fopen(path.c_str(), "rb"), fclose);
  if (!file)
    return unusable(path, "cannot be read: " + std::generic_category().message(errno),
                    "check its permissions");
  try {
    Decoded decoded;
    if (decode(file.get(), uint64_t(facts.st_size), &decoded)) return toLinear(decoded);
    return unusable(path, "is not a usable PNG: " + decoded.problem,
                    "save it again from the program that made it");
  } catch (const std::exception&) {
    return unusable(path, "is too large for this machine's memory", "use a smaller picture");
  }
}

}  // namespace scumble
