// WebP files, by libwebp. The format says of itself that values are sRGB.
#include <webp/encode.h>

#include <exception>
#include <new>

#include "film/checks.h"
#include "film/codes.h"
#include "film/whole_file.h"
#include "scumble/image.h"

namespace scumble {
namespace {

constexpr int kLossless = 100;  // the quality that is

struct Encoder {
  WebPPicture picture{};
  WebPMemoryWriter written{};
  Encoder() { WebPMemoryWriterInit(&written); }
  ~Encoder() {
    WebPPictureFree(&picture);
    WebPMemoryWriterClear(&written);
  }
};

Error wrong(const std::string& path, ErrorKind kind, std::string problem, std::string advice) {
  return {kind, path, 0, "", std::move(problem), std::move(advice)};
}

bool encode(Encoder& encoder, const std::vector<uint8_t>& rgba, bool opaque, uint32_t width, uint32_t height,
            int quality) {
  WebPConfig config;
  WebPPicture& picture = encoder.picture;
  if (!WebPConfigInit(&config) || !WebPPictureInit(&picture)) return false;
  config.lossless = quality == kLossless;
  // Of a lossless picture it says how hard to try; its colours under nothing are kept as well.
  config.quality = config.lossless ? 75.0f : float(quality);
  config.exact = config.lossless;
  config.method = 4;
  config.use_sharp_yuv = 1;  // edges of strokes keep their colours
  picture.use_argb = 1;
  picture.width = int(width), picture.height = int(height);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &encoder.written;
  const int stride = int(width) * 4;
  return (opaque ? WebPPictureImportRGBX(&picture, rgba.data(), stride)
                 : WebPPictureImportRGBA(&picture, rgba.data(), stride)) &&
         WebPEncode(&config, &picture);
}

}  // namespace

Status writeWebp(const std::string& path, const Image& image, int quality) {
  try {
    if (std::string problem = film::problemWith(image); !problem.empty())
      return wrong(path, ErrorKind::internal, std::move(problem), "please report this");
    if (quality < 0 || quality > 100)
      return wrong(path, ErrorKind::usage, "the quality " + std::to_string(quality) + " is not from 0 to 100",
                   "higher is better and larger, 100 is lossless");
    if (image.width > WEBP_MAX_DIMENSION || image.height > WEBP_MAX_DIMENSION)
      return wrong(path, ErrorKind::outputNotWritten, "is larger than a WebP can be", "write a PNG");
    bool opaque = true;
    const std::vector<uint8_t> rgba = film::rgbaOf(image, opaque);
    film::WholeFile file(path);
    Encoder encoder;
    if (!encode(encoder, rgba, opaque, image.width, image.height, quality)) throw std::bad_alloc();
    file.write(encoder.written.mem, encoder.written.size);
    return file.commit();
  } catch (const std::exception&) {
    return wrong(path, ErrorKind::outputNotWritten, "cannot be written: not enough memory",
                 "choose a smaller size");
  }
}

}  // namespace scumble
