// WebP files, by libwebp. The format says of itself that values are sRGB.
#include <webp/encode.h>

#include "film/codes.h"
#include "film/lossy_write.h"
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
  const film::Lossy webp{0, "higher is better and larger, 100 is lossless", "WebP", WEBP_MAX_DIMENSION};
  return film::writeLossy(path, image, quality, webp, [&](WholeFile& file) {
    std::vector<uint8_t> rgba(size_t(image.width) * image.height * 4);
    const bool opaque = film::encodeRgba(image, 0, image.height, rgba.data());
    Encoder encoder;
    if (!encode(encoder, rgba, opaque, image.width, image.height, quality)) return false;
    file.write(encoder.written.mem, encoder.written.size);
    return true;
  });
}

}  // namespace scumble
