// JPEG files: baseline, by libjpeg, one scan.
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
// jpeglib.h needs stdio.h before it.
#include <jpeglib.h>

#include "film/codes.h"
#include "film/lossy_write.h"
#include "scumble/image.h"

namespace scumble {
namespace {

// An EXIF block whose only word is that colours are sRGB: a TIFF header, a first directory that points to
// EXIF's own, and in that ColorSpace (0xA001) = 1.
constexpr uint8_t kExif[] = {'E', 'x', 'i',  'f',  0, 0,                                       //
                             'M', 'M', 0,    42,   0, 0, 0, 8,                                 //
                             0,   1,   0x87, 0x69, 0, 4, 0, 0, 0, 1, 0, 0, 0, 26, 0, 0, 0, 0,  //
                             0,   1,   0xA0, 0x01, 0, 3, 0, 0, 0, 1, 0, 1, 0, 0,  0, 0, 0, 0};

constexpr int kFullChromaFrom = 90;  // quality

struct JpegEncoder {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  jmp_buf jump{};
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  ~JpegEncoder() {
    jpeg_destroy_compress(&info);
    std::free(bytes);
  }
};

[[noreturn]] void onWriteError(j_common_ptr info) {
  std::longjmp(static_cast<JpegEncoder*>(info->client_data)->jump, 1);
}

// Nothing in here has a destructor, since libjpeg jumps out of it.
bool encode(JpegEncoder& encoder, const uint8_t* codes, uint32_t width, uint32_t height, int quality) {
  jpeg_compress_struct& info = encoder.info;
  info.err = jpeg_std_error(&encoder.errors);
  encoder.errors.error_exit = onWriteError;
  encoder.errors.output_message = [](j_common_ptr) {};
  info.client_data = &encoder;
  if (setjmp(encoder.jump)) return false;
  jpeg_create_compress(&info);
  jpeg_mem_dest(&info, &encoder.bytes, &encoder.size);
  info.image_width = width;
  info.image_height = height;
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, quality, TRUE);
  info.optimize_coding = TRUE;
  info.dct_method = JDCT_ISLOW;
  if (quality >= kFullChromaFrom) info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;
  jpeg_start_compress(&info, TRUE);
  jpeg_write_marker(&info, JPEG_APP0 + 1, kExif, sizeof kExif);
  while (info.next_scanline < height) {
    auto* row = const_cast<JSAMPROW>(codes + size_t(info.next_scanline) * width * 3);
    jpeg_write_scanlines(&info, &row, 1);
  }
  jpeg_finish_compress(&info);
  return true;
}

}  // namespace

Status writeJpeg(const std::string& path, const Image& image, int quality) {
  const film::Lossy jpeg{1, "higher is better and larger", "JPEG", JPEG_MAX_DIMENSION};
  return film::writeLossy(path, image, quality, jpeg, [&](WholeFile& file) {
    const std::vector<uint8_t> codes = film::rgbOverBlack(image);
    JpegEncoder encoder;
    if (!encode(encoder, codes.data(), image.width, image.height, quality)) return false;
    file.write(encoder.bytes, encoder.size);
    return true;
  });
}

}  // namespace scumble
