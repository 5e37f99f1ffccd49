#include "film/film_format.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstring>

#include "film/codes.h"
#include "film/frame_rate.h"
#include "film/mp4.h"
#include "film/yuv.h"

namespace scumble::film {

namespace {

// Fixed, as the bytes depend on it.
constexpr int kThreads = 8;

constexpr FormatFacts kFacts[] = {
    {"libx264", "h264", 16, 51, 1000}, {"libvpx-vp9", "vp9", 20, 63, 1000}, {"gif", "gif", -1, -1, 50}};

void append(std::vector<std::string>& to, const std::vector<std::string>& words) {
  to.insert(to.end(), words.begin(), words.end());
}

// Once for the container, once for the stream. The transfer curve is sRGB's, because the codes are.
const std::vector<std::string> kColors{"-color_range",
                                       "tv",
                                       "-colorspace",
                                       "bt709",
                                       "-color_primaries",
                                       "bt709",
                                       "-color_trc",
                                       "iec61966-2-1",
                                       "-chroma_sample_location",
                                       "left"};

std::vector<std::string> mp4Words(const FilmOptions& options, int quality) {
  std::string x264 = "colorprim=bt709:transfer=iec61966-2-1:colormatrix=bt709:range=tv";
  // Arrangement types of H.264's frame packing message.
  if (options.layout == FilmLayout::sideBySide) x264 += ":frame-packing=3";
  if (options.layout == FilmLayout::overUnder) x264 += ":frame-packing=4";
  std::vector<std::string> words{"-c:v",     "libx264",
                                 "-preset",  "medium",
                                 "-crf",     std::to_string(quality),
                                 "-pix_fmt", "yuv420p",
                                 "-threads", std::to_string(kThreads)};
  append(words, kColors);
  append(words, {"-x264-params", x264});
  return words;
}

std::vector<std::string> webmWords(int quality) {
  // Constant quality alone: without a bit rate of 0 it would be a limit.
  std::vector<std::string> words{"-c:v",          "libvpx-vp9",
                                 "-crf",          std::to_string(quality),
                                 "-b:v",          "0",
                                 "-deadline",     "good",
                                 "-cpu-used",     "3",
                                 "-row-mt",       "0",
                                 "-tile-columns", "2",
                                 "-pix_fmt",      "yuv420p",
                                 "-threads",      std::to_string(kThreads)};
  append(words, kColors);
  return words;
}

std::vector<std::string> gifWords() {
  // A palette a picture: nothing has to be kept until the film's end, and a film through many colours has
  // all of them. Error diffusion only where the picture changes.
  return {"-filter_complex",
          "[0:v]split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=sierra2_4a",
          "-c:v",
          "gif",
          "-loop",
          "0"};
}

std::string copyFilm(int descriptor, const std::string& start, WholeFile& out) {
  std::vector<char> bytes(1 << 20);
  uint64_t position = 0;
  while (true) {
    const ssize_t count = pread(descriptor, bytes.data(), bytes.size(), off_t(position));
    if (count < 0) return "it cannot be read";
    if (count == 0) break;
    if (position == 0 &&
        (size_t(count) < start.size() || std::memcmp(bytes.data(), start.data(), start.size()) != 0))
      return "it does not begin like one";
    out.write(bytes.data(), size_t(count));
    position += uint64_t(count);
  }
  return position == 0 ? "it is empty" : "";
}

}  // namespace

const FormatFacts& factsOf(FilmFormat format) {
  return kFacts[size_t(format)];
}

PixelSize eyeSizeOf(const FilmOptions& options) {
  return {options.layout == FilmLayout::sideBySide ? options.width / 2 : options.width,
          options.layout == FilmLayout::overUnder ? options.height / 2 : options.height};
}

PixelSize storedSizeOf(const FilmOptions& options) {
  if (options.format == FilmFormat::gif) return {options.width, options.height};
  return {(options.width + 1) & ~1u, (options.height + 1) & ~1u};
}

std::vector<std::string> encoderArguments(const FilmOptions& options) {
  const bool isGif = options.format == FilmFormat::gif;
  const FrameRate rate = frameRateOf(options.fps);
  const auto [width, height] = storedSizeOf(options);
  std::vector<std::string> words{"-f", "rawvideo", "-pixel_format", isGif ? "rgb24" : "yuv420p"};
  if (!isGif) append(words, {"-color_range", "tv"});
  append(words, {"-video_size", fmt::format("{}x{}", width, height), "-framerate",
                 fmt::format("{}/{}", rate.numerator, rate.denominator), "-i", "pipe:0"});
  if (!isGif) append(words, {"-map", "0:v:0"});
  append(words, {"-map_metadata", "-1"});
  const int quality = options.quality.value_or(factsOf(options.format).defaultQuality);
  append(words, options.format == FilmFormat::mp4    ? mp4Words(options, quality)
                : options.format == FilmFormat::webm ? webmWords(quality)
                                                     : gifWords());
  append(words, {"-flags:v", "+bitexact"});
  append(words, containerArguments(options));
  return words;
}

std::vector<std::string> containerArguments(const FilmOptions& options) {
  std::vector<std::string> words;
  if (options.format == FilmFormat::webm) {
    // The muxer makes its StereoMode of it; the index goes in front, so that films play while they load.
    if (options.layout == FilmLayout::sideBySide)
      append(words, {"-metadata:s:v:0", "stereo_mode=left_right"});
    if (options.layout == FilmLayout::overUnder) append(words, {"-metadata:s:v:0", "stereo_mode=top_bottom"});
    append(words, {"-cues_to_front", "1"});
  }
  // No dates and no version of the container's writer.
  constexpr const char* kContainers[] = {"mp4", "webm", "gif"};
  append(words, {"-fflags", "+bitexact", "-f", kContainers[size_t(options.format)]});
  return words;
}

std::vector<uint8_t> rawPicture(const Image& picture, FilmFormat format) {
  return format == FilmFormat::gif ? rgbOverBlack(picture) : yuv420(picture);
}

std::string completeFilm(int descriptor, const FilmOptions& options, uint64_t frames, WholeFile& out) {
  if (options.format == FilmFormat::mp4) return rearrangeMp4(descriptor, options, frames, out);
  return copyFilm(descriptor, options.format == FilmFormat::gif ? "GIF89a" : "\x1a\x45\xdf\xa3", out);
}

}  // namespace scumble::film
