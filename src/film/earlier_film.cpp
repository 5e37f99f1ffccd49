// ffprobe says what the film is, and ffmpeg joins it with the rest by copying packets (its concat demuxer).
// H.264's parameter sets stand once in an MP4, in front of all pictures: both parts must agree in them to the
// byte. A film of one black picture, encoded as the rest will be, tells that before hours
// are drawn.
#include "film/earlier_film.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>
#include <vector>

#include "film/child_process.h"
#include "film/ffmpeg.h"
#include "film/film_format.h"
#include "film/frame_rate.h"

namespace scumble::film {
namespace {

constexpr double kSameRate = 1e-4;  // relative: 24 and 24000/1001 differ by 1e-3
constexpr double kRounding = 1e-3;  // seconds: a WebM counts whole milliseconds
constexpr int kDecodedAhead = 2;    // frames: x264's preset medium

// Facts of a film, in ffprobe's words.
struct Facts {
  double streams = 0, width = 0, height = 0, rate = 0;  // frames a second
  std::string codec, eyes, projection;
  std::string headers;        // a hash of what stands in front of all pictures
  std::vector<double> times;  // of pictures, seconds, in their order
};

// Empty `problem`: these are the facts.
struct Probed {
  Facts facts;
  std::string problem;
};

Result<Probed> probe(int descriptor, const FfmpegRun& run) {
  const std::string name = fmt::format("file:/proc/self/fd/{}", ChildProcess::kPassed);
  const std::string entries =
      "packet=pts_time:stream=codec_name,width,height,avg_frame_rate,extradata_hash:"
      "stream_side_data=side_data_type,type,projection:format=nb_streams";
  ChildProcess ffprobe;
  const int code =
      ffprobe.start({"ffprobe", "-v", "error", "-protocol_whitelist", "file", "-select_streams", "v:0",
                     "-show_data_hash", "md5", "-show_entries", entries, "-of", "compact", name},
                    {descriptor}, ChildProcess::Output::received);
  if (code == ENOENT)
    return run.lost("to go on with a film needs the program ffprobe, which is not installed",
                    "install ffmpeg with ffprobe");
  if (code != 0)
    return run.lost("ffprobe cannot be started: " + std::generic_category().message(code), "repair that");
  const std::string list = ffprobe.receiveRest();
  const std::string how = ffprobe.finish();
  // Damage is told too where ffprobe reads on.
  std::string said = lastLine(ffprobe.said());
  if (said.starts_with(name + ": ")) said.erase(0, name.size() + 2);
  Probed probed;
  if (!how.empty() || !said.empty()) {
    probed.problem = "it cannot be read: " + (said.empty() ? "ffprobe " + how : said);
    return probed;
  }
  Facts& facts = probed.facts;
  for (size_t at = 0; at < list.size();) {
    const size_t end = std::min(list.find('\n', at), list.size());
    const std::string_view line(list.data() + at, end - at);
    at = end + 1;
    if (line.starts_with("packet|")) {
      facts.times.push_back(number(field(line, "pts_time")).value_or(-1));
    } else if (line.starts_with("stream|")) {
      facts.codec = field(line, "codec_name");
      facts.width = number(field(line, "width")).value_or(0);
      facts.height = number(field(line, "height")).value_or(0);
      facts.rate = fraction(field(line, "avg_frame_rate"));
      facts.headers = field(line, "extradata_hash");
    } else if (line.starts_with("format|")) {
      facts.streams = number(field(line, "nb_streams")).value_or(0);
    }
    // Side data come on the stream's line and on lines of their own.
    if (const std::string eyes = field(line, "type"); !eyes.empty()) facts.eyes = eyes;
    if (const std::string projection = field(line, "projection"); !projection.empty())
      facts.projection = projection;
  }
  std::sort(facts.times.begin(), facts.times.end());
  return probed;
}

// How ffprobe calls what the options say.
std::string eyesIn(const FilmOptions& options) {
  if (options.layout == FilmLayout::sideBySide) return "side by side";
  if (options.layout == FilmLayout::overUnder) return "top and bottom";
  // A panorama of one eye says so, in an MP4.
  return options.projection != FilmProjection::flat && options.format == FilmFormat::mp4 ? "2D" : "";
}

std::string projectionIn(const FilmOptions& options) {
  if (options.format != FilmFormat::mp4) return "";
  constexpr const char* kNames[] = {"", "equirectangular", "tiled equirectangular"};
  return kNames[size_t(options.projection)];
}

double rateIn(const FilmOptions& options) {
  const FrameRate rate = frameRateOf(options.fps);
  return double(rate.numerator) / rate.denominator;
}

// Difference from a film that the options write, in words; empty where there is none.
std::string difference(const Facts& facts, const FilmOptions& options) {
  const auto orNone = [](const std::string& text) { return text.empty() ? "none" : text; };
  const PixelSize size = storedSizeOf(options);
  const char* const codec = factsOf(options.format).codec;
  const double rate = rateIn(options);
  if (facts.codec.empty() || facts.times.empty()) return "it has no pictures";
  if (facts.streams != 1) return "it holds more than pictures";
  if (facts.codec != codec) return fmt::format("its codec is {}, not {}", facts.codec, codec);
  if (facts.width != size.width || facts.height != size.height)
    return fmt::format("it has {} x {} pixels, not {} x {}", facts.width, facts.height, size.width,
                       size.height);
  if (!(std::abs(facts.rate - rate) <= rate * kSameRate))
    return fmt::format("it has {:.6g} frames a second, not {:.6g}", facts.rate, rate);
  for (size_t i = 0; i < facts.times.size(); ++i)
    if (!(std::abs(facts.times[i] - double(i) / rate) <= kRounding))
      return "its pictures do not come in even steps of time";
  if (facts.eyes != eyesIn(options))
    return fmt::format("its layout of eyes is {}, not {}", orNone(facts.eyes), orNone(eyesIn(options)));
  if (facts.projection != projectionIn(options))
    return fmt::format("its projection is {}, not {}", orNone(facts.projection),
                       orNone(projectionIn(options)));
  return "";
}

// The bitstream filter that gives packets the times of one film: N is a packet's number in it, from 0 on.
std::string timesFilter(const FilmOptions& options) {
  const FrameRate rate = frameRateOf(options.fps);
  const auto at = [&](const std::string& frame) {
    return fmt::format("floor({}*{}/{}/TB+0.5)", frame, rate.denominator, rate.numerator);
  };
  // A WebM's packets come in the order of pictures, and two parts would be rounded to milliseconds each.
  if (options.format == FilmFormat::webm) return "setts=ts=" + at("N");
  // H.264's come in the order of decoding, kDecodedAhead frames early; but those of one or two pictures do
  // not, and such a part would overlap with the next one or leave a gap.
  return "setts=pts=PTS:dts=" + at(fmt::format("(N-{})", kDecodedAhead));
}

// The headers that pictures encoded with these options have.
Result<std::string> headersFor(const std::string& path, const FilmOptions& options) {
  FfmpegRun sample(path, options.format);
  const PixelSize size = storedSizeOf(options);
  const std::vector<uint8_t> picture(size_t(size.width) * size.height * 3 / 2);
  if (const Status status = sample.start(encoderArguments(options)); !status) return status.error();
  if (const Status status = sample.send(picture.data(), picture.size()); !status) return status.error();
  if (const Status status = sample.finish(); !status) return status.error();
  Result<Probed> probed = probe(sample.written(), sample);
  if (!probed) return probed.error();
  if (!probed->problem.empty()) return sample.failed("left something that is no film: " + probed->problem);
  return probed->facts.headers;
}

}  // namespace

EarlierFilm::~EarlierFilm() {
  close(descriptor_);
}

Result<std::unique_ptr<EarlierFilm>> EarlierFilm::open(const std::string& path, const FilmOptions& options) {
  const auto unfit = [&](const std::string& why) {
    return Error{ErrorKind::usage,
                 path,
                 0,
                 "",
                 "this film cannot be resumed: " + why,
                 "give the options that it was made with, or another name, or delete it"};
  };
  // Without blocking: a pipe is none.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0 && errno == ENOENT) return std::unique_ptr<EarlierFilm>();
  if (descriptor < 0) return unfit("it cannot be read: " + std::generic_category().message(errno));
  std::unique_ptr<EarlierFilm> film(new EarlierFilm(descriptor, options));
  struct stat facts = {};
  if (fstat(descriptor, &facts) != 0 || !S_ISREG(facts.st_mode)) return unfit("it is no ordinary file");

  const Result<Probed> probed = probe(descriptor, FfmpegRun(path, options.format));
  if (!probed) return probed.error();
  if (!probed->problem.empty()) return unfit(probed->problem);
  if (const std::string what = difference(probed->facts, options); !what.empty()) return unfit(what);
  if (options.format == FilmFormat::mp4) {
    const Result<std::string> headers = headersFor(path, options);
    if (!headers) return headers.error();
    if (*headers != probed->facts.headers)
      return unfit("it was encoded in another way: of another quality, or by another version of ffmpeg");
  }
  film->frames_ = probed->facts.times.size();
  return film;
}

Status EarlierFilm::joinTo(int rest, FfmpegRun& joined) const {
  // Packets stay as they lie in the file (auto_convert would put the parameter sets into the stream). Its
  // exact length, in microseconds, is where the rest begins: the file states it rounded.
  const std::string list =
      fmt::format("ffconcat version 1.0\nfile '{}'\nduration {:.6f}\nfile '{}'\n", FfmpegRun::inputName(0),
                  double(frames_) / rateIn(options_), FfmpegRun::inputName(1));
  std::vector<std::string> words{
      "-protocol_whitelist", "file,pipe", "-f", "concat", "-safe",  "0",
      "-auto_convert",       "0",         "-i", "pipe:0", "-map",   "0:v:0",
      "-map_metadata",       "-1",        "-c", "copy",   "-bsf:v", timesFilter(options_)};
  for (std::string& word : containerArguments(options_)) words.push_back(std::move(word));
  if (Status status = joined.start(words, {descriptor_, rest}); !status) return status;
  if (Status status = joined.send(list.data(), list.size()); !status) return status;
  return joined.finish();
}

}  // namespace scumble::film
