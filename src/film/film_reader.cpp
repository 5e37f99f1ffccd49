// Films into pictures. ffprobe lists the time stamps without decoding anything; ffmpeg decodes the pictures
// in their order, and those before the first that is wanted are dropped inside it. No seeking: where a seek
// lands depends on the container and on the codec, and counting from the beginning does not.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <future>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/file_bytes.h"
#include "base/pixels.h"
#include "base/srgb.h"
#include "film/child_process.h"
#include "film/ffmpeg.h"
#include "scumble/film.h"

namespace scumble {
namespace {

using film::ChildProcess;

constexpr double kRounding = 1e-3;   // seconds that containers are off
constexpr size_t kReadOn = 200;      // pictures that are read and dropped rather than starting anew
constexpr double kUnknownRate = 25;  // frames a second, where a film says nothing about time

}  // namespace

struct FilmReader::State {
  explicit State(const std::string& path_) : path(path_) {}

  using Picture = std::shared_ptr<const Image>;

  Error unusable(std::string problem, std::string advice) const {
    return {ErrorKind::unusableFile, path, 0, "", std::move(problem), std::move(advice)};
  }
  Error notStarted(int code) const;
  Error notRead(const ChildProcess& program, const std::string& how) const;
  // From ffmpeg's and ffprobe's own words, without our way of naming the file.
  std::string fileName() const { return "file:" + path; }

  Status probe();
  Status start(size_t first);
  Result<Picture> readNext();  // null after the last one
  Result<Picture> get(size_t wanted);
  Result<Picture> at(double time);
  // Waits for the picture that is decoded meanwhile.
  Status meet();

  std::string path;
  std::vector<double> times;  // seconds from the first picture, in their order
  std::string filter;         // what ffmpeg does to pictures
  std::unique_ptr<ChildProcess> ffmpeg;
  size_t next = 0;  // the picture that ffmpeg gives next
  size_t current = 0;
  Picture picture;                     // the one with the number `current`
  std::future<Result<Picture>> ahead;  // the picture after it
};

Error FilmReader::State::notStarted(int code) const {
  if (code == ENOENT)
    return unusable("films need the programs ffmpeg and ffprobe, which are not installed",
                    "install ffmpeg, or give a picture (.png, .jpg, .webp)");
  return unusable("cannot be read: ffmpeg cannot be started: " + std::generic_category().message(code),
                  "repair that, or give a picture (.png, .jpg, .webp)");
}

Error FilmReader::State::notRead(const ChildProcess& program, const std::string& how) const {
  std::string why = film::lastLine(program.said());
  if (why.starts_with(fileName() + ": ")) why.erase(0, fileName().size() + 2);
  return unusable("is no film that ffmpeg can read: " + (why.empty() ? "it " + how : why),
                  "give a film, or a picture (.png, .jpg, .webp)");
}

Status FilmReader::State::probe() {
  // Ask ffprobe.
  FileBytes bytes;
  std::string problem;
  if (!bytes.open(path, problem)) return unusable(problem, "check the name");

  ChildProcess ffprobe;
  const int code = ffprobe.start(
      {"ffprobe", "-v", "error", "-protocol_whitelist", "file", "-select_streams", "v:0", "-show_entries",
       "packet=pts_time,flags:stream=height,color_space,avg_frame_rate", "-of", "compact", fileName()},
      {}, ChildProcess::Output::received);
  if (code != 0) return notStarted(code);
  const std::string list = ffprobe.receiveRest();
  if (const std::string how = ffprobe.finish(); !how.empty()) return notRead(ffprobe, how);

  // A line for each packet, which is a picture, and one for the film.
  double rate = kUnknownRate;
  bool areKnown = true, isStream = false;
  std::string matrix;
  for (size_t at = 0; at < list.size();) {
    const size_t end = std::min(list.find('\n', at), list.size());
    const std::string_view line(list.data() + at, end - at);
    at = end + 1;
    if (line.starts_with("packet|")) {
      if (film::field(line, "flags").find('D') != std::string::npos) continue;  // decoded, and not shown
      const std::optional<double> time = film::number(film::field(line, "pts_time"));
      areKnown &= time.has_value();
      times.push_back(time.value_or(0));
    } else if (line.starts_with("stream|")) {
      isStream = true;
      if (const double known = film::fraction(film::field(line, "avg_frame_rate")); known > 0) rate = known;
      // As players do where a film does not say: small ones are television's.
      const std::string space = film::field(line, "color_space");
      if (space.empty() || space == "unknown" || space == "reserved")
        matrix = film::number(film::field(line, "height")).value_or(0) >= 720 ? ":in_color_matrix=bt709" : "";
    }
  }
  if (!isStream || times.empty())
    return unusable("has no pictures", "give a film, or a picture (.png, .jpg, .webp)");
  // When each is shown, from the first on.
  if (areKnown) {
    std::sort(times.begin(), times.end());
    // Packets that are never shown, as VP8 has them, have the time of the next picture.
    times.erase(std::unique(times.begin(), times.end()), times.end());
    const double first = times.front();
    for (double& time : times) time -= first;
  } else {
    for (size_t i = 0; i < times.size(); ++i) times[i] = double(i) / rate;
  }
  filter = "scale=w=iw*sar:h=ih" + matrix +
           ":flags=bicubic+accurate_rnd+full_chroma_int+full_chroma_inp+bitexact,setsar=1";
  return Done{};
}

Status FilmReader::State::start(size_t first) {
  ffmpeg = std::make_unique<ChildProcess>();
  next = first;
  const std::string chosen = first > 0 ? fmt::format("select=gte(n\\,{}),", first) : "";
  const int code = ffmpeg->start(
      {"ffmpeg",    "-hide_banner", "-nostdin", "-nostats",   "-loglevel", "error", "-protocol_whitelist",
       "file,pipe", "-i",           fileName(), "-map",       "0:v:0",     "-vf",   chosen + filter,
       "-fps_mode", "passthrough",  "-f",       "image2pipe", "-c:v",      "ppm",   "-pix_fmt",
       "rgb24",     "pipe:1"},
      {}, ChildProcess::Output::received);
  return code == 0 ? Status(Done{}) : Status(notStarted(code));
}

// "P6", width, height and 255, parted by white space, one such after the last; then three bytes a pixel.
Result<FilmReader::State::Picture> FilmReader::State::readNext() {
  std::string header;
  int words = 0;
  for (char c; words < 4 && ffmpeg->receive(&c, 1) == 1 && header.size() < 64; header += c)
    words += c == '\n' || c == ' ';
  if (words < 4) return Picture();
  unsigned width = 0, height = 0;
  if (std::sscanf(header.c_str(), "P6 %u %u 255", &width, &height) != 2 || width == 0 || height == 0 ||
      width > kMaxImageSide || height > kMaxImageSide)
    return unusable("is no film that can be shown: its pictures have no usable size", "use another film");
  std::vector<uint8_t> codes(size_t(width) * height * 3);
  if (ffmpeg->receive(codes.data(), codes.size()) < codes.size()) return Picture();
  ++next;

  auto image = std::make_shared<Image>();
  image->width = width, image->height = height;
  image->channels = {"R", "G", "B"};
  image->pixels.resize(codes.size());
  const std::array<float, 256>& linear = linearFromSrgb8();
  std::transform(codes.begin(), codes.end(), image->pixels.begin(),
                 [&](uint8_t code) { return linear[code]; });
  return Picture(std::move(image));
}

Status FilmReader::State::meet() {
  if (!ahead.valid()) return Done{};
  Result<Picture> got = ahead.get();
  if (!got) return got.error();
  // None: the film has ended before its time stamps do, which get() finds out by itself.
  if (*got) picture = *got, current = next - 1;
  return Done{};
}

Result<FilmReader::State::Picture> FilmReader::State::get(size_t wanted) {
  if (picture && current == wanted) return picture;
  if (const Status status = meet(); !status) return status.error();
  if (picture && current == wanted) return picture;
  if (!ffmpeg || next > wanted || wanted - next > kReadOn)
    if (const Status status = start(wanted); !status) return status.error();
  for (;;) {
    Result<Picture> got = readNext();
    if (!got) return got;
    if (!*got) break;
    picture = *got, current = next - 1;
    if (current == wanted) return picture;
  }
  return Picture();
}

Result<FilmReader::State::Picture> FilmReader::State::at(double time) {
  const auto indexOf = [&] {
    const auto later = std::upper_bound(times.begin(), times.end(), time + kRounding);
    return size_t(std::max<std::ptrdiff_t>(later - times.begin() - 1, 0));
  };
  Result<Picture> got = get(indexOf());
  if (got && !*got) {
    // Fewer pictures than time stamps: a damaged end. How many there are does not depend on where one began.
    if (const Status status = start(0); !status) return status.error();
    for (;;) {
      const Result<Picture> some = readNext();
      if (!some) return some.error();
      if (!*some) break;
    }
    const std::string how = ffmpeg->finish();
    if (next == 0) return notRead(*ffmpeg, how.empty() ? "has no pictures" : how);
    times.resize(std::min(next, times.size()));
    ffmpeg.reset();
    picture.reset();
    got = get(indexOf());
    if (got && !*got) return unusable("cannot be read to its end", "use another film");
  }
  if (got && ffmpeg && !ahead.valid() && next == current + 1 && next < times.size())
    ahead = std::async(std::launch::async, [this] { return readNext(); });
  return got;
}

FilmReader::FilmReader(std::unique_ptr<State> state) : state_(std::move(state)) {}

FilmReader::~FilmReader() = default;

Result<std::unique_ptr<FilmReader>> FilmReader::open(const std::string& path) {
  try {
    auto state = std::make_unique<State>(path);
    if (const Status status = state->probe(); !status) return status.error();
    std::unique_ptr<FilmReader> reader(new FilmReader(std::move(state)));
    // What cannot be decoded is found out now.
    if (const auto first = reader->at(0); !first) return first.error();
    return reader;
  } catch (const std::exception&) {
    return Error{ErrorKind::unusableFile, path, 0, "", "cannot be read: not enough memory", ""};
  }
}

Result<std::shared_ptr<const Image>> FilmReader::at(double time) {
  try {
    return state_->at(time);
  } catch (const std::exception&) {
    return Error{ErrorKind::unusableFile, state_->path, 0, "", "cannot be read: not enough memory", ""};
  }
}

double FilmReader::lastTime() const {
  return state_->times.back();
}

}  // namespace scumble
