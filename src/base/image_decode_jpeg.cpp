#include "base/image_decode_jpeg.h"

#include <csetjmp>
#include <cstdio>
#include <cstring>
// jpeglib.h needs stdio.h before it.
#include <jpeglib.h>

namespace scumble {

namespace {

// A progressive file may hold any number of scans over the whole picture, each a few bytes long.
constexpr int kMaxScans = 200;

struct JpegDecoder {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  jmp_buf jump{};
  char message[JMSG_LENGTH_MAX] = {};
};

JpegDecoder& decoderOf(j_common_ptr info) {
  return *static_cast<JpegDecoder*>(info->client_data);
}

[[noreturn]] void onError(j_common_ptr info) {
  JpegDecoder& decoder = decoderOf(info);
  info->err->format_message(info, decoder.message);
  std::longjmp(decoder.jump, 1);
}

void onMessage(j_common_ptr info, int level) {
  if (level < 0) ++info->err->num_warnings;
}

void onProgress(j_common_ptr info) {
  if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number <= kMaxScans) return;
  JpegDecoder& decoder = decoderOf(info);
  std::strcpy(decoder.message, "it has too many scans");
  std::longjmp(decoder.jump, 1);
}

void start(JpegDecoder& decoder, Bytes bytes) {
  decoder.info.err = jpeg_std_error(&decoder.errors);
  decoder.errors.error_exit = onError;
  decoder.errors.emit_message = onMessage;
  decoder.errors.output_message = [](j_common_ptr) {};
  decoder.info.client_data = &decoder;
  jpeg_create_decompress(&decoder.info);
  decoder.progress.progress_monitor = onProgress;
  decoder.info.progress = &decoder.progress;
  jpeg_mem_src(&decoder.info, bytes.data(), bytes.size());
  jpeg_read_header(&decoder.info, TRUE);
}

// Adobe's programs write CMYK inverted, and nobody else writes it.
void convertRow(const uint8_t* cmyk, uint8_t* rgba, size_t width) {
  for (size_t x = 0; x < width; ++x, cmyk += 4, rgba += 4) {
    const unsigned k = cmyk[3];
    rgba[0] = static_cast<uint8_t>(cmyk[0] * k / 255);
    rgba[1] = static_cast<uint8_t>(cmyk[1] * k / 255);
    rgba[2] = static_cast<uint8_t>(cmyk[2] * k / 255);
    rgba[3] = 255;
  }
}

// No object with a destructor lives between setjmp and a call that may jump.
bool readSizeGuarded(JpegDecoder& decoder, Bytes bytes, uint32_t& width, uint32_t& height) {
  if (setjmp(decoder.jump)) return false;
  start(decoder, bytes);
  width = decoder.info.image_width;
  height = decoder.info.image_height;
  return true;
}

bool decodeGuarded(JpegDecoder& decoder, Bytes bytes, Pixels& image, uint8_t* cmykRow) {
  if (setjmp(decoder.jump)) return false;
  start(decoder, bytes);
  jpeg_decompress_struct& info = decoder.info;
  const bool cmyk = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
  info.out_color_space = cmyk ? JCS_CMYK : JCS_EXT_RGBA;
  jpeg_start_decompress(&info);
  if (info.output_width != image.width || info.output_height != image.height || info.output_components != 4)
    return false;
  while (info.output_scanline < info.output_height) {
    uint8_t* target = image.rgba.data() + size_t(info.output_scanline) * image.width * 4;
    JSAMPROW row = cmyk ? cmykRow : target;
    if (jpeg_read_scanlines(&info, &row, 1) != 1) return false;
    if (cmyk) convertRow(cmykRow, target, image.width);
  }
  return true;
}

}  // namespace

bool readJpegSize(Bytes bytes, uint32_t& width, uint32_t& height, std::string& problem) {
  JpegDecoder decoder;
  const bool good = readSizeGuarded(decoder, bytes, width, height);
  if (!good) problem = std::string("it is a damaged JPEG: ") + decoder.message;
  jpeg_destroy_decompress(&decoder.info);
  return good;
}

bool decodeJpeg(Bytes bytes, Pixels& image, std::string& problem) {
  JpegDecoder decoder;
  std::vector<uint8_t> row(size_t(image.width) * 4);
  const bool good = decodeGuarded(decoder, bytes, image, row.data());
  if (!good)
    problem = std::string("it is a damaged JPEG: ") +
              (decoder.message[0] ? decoder.message : "its sizes contradict");
  else if (decoder.errors.num_warnings > 0)
    problem = "it is a damaged JPEG";
  jpeg_destroy_decompress(&decoder.info);
  return good;
}

}  // namespace scumble
