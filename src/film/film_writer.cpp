// Films. ffmpeg gets raw frames (made here, so that colours are the same with every version of it) on its
// standard input, and writes into a file without a name, so that no kill of any process leaves one. From that
// file the film is put together.
#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/passing_file.h"
#include "base/whole_file.h"
#include "film/checks.h"
#include "film/child_process.h"
#include "film/ffmpeg.h"
#include "film/film_format.h"
#include "scumble/film.h"

namespace scumble {
namespace {

constexpr uint32_t kLargestSide = 16384;  // x264's limit

std::string problemWith(const FilmOptions& options) {
  if (options.width == 0 || options.height == 0) return "the film has no size";
  if (options.width > kLargestSide || options.height > kLargestSide)
    return fmt::format("{}x{} is larger than a film can be ({} a side)", options.width, options.height,
                       kLargestSide);
  if (!(options.fps >= 0.01 && options.fps <= 1000))
    return fmt::format("{} frames a second are not from 0.01 to 1000", options.fps);
  const film::FormatFacts& format = film::factsOf(options.format);
  if (options.fps > format.fastest)
    return fmt::format("{} frames a second are more than the {} of a GIF", options.fps, format.fastest);
  if (options.quality && format.worstQuality < 0) return "a GIF has no quality to choose";
  if (options.quality && (*options.quality < 0 || *options.quality > format.worstQuality))
    return fmt::format("the quality {} is not from 0 to {}", *options.quality, format.worstQuality);
  if (options.layout == FilmLayout::sideBySide && options.width % 2 != 0)
    return "two eyes side by side need an even width";
  if (options.layout == FilmLayout::overUnder && options.height % 2 != 0)
    return "two eyes over each other need an even height";
  // A column or row more would move its middle.
  const film::EyeSize eye = film::eyeSizeOf(options);
  if (options.projection != FilmProjection::flat && (eye.width % 2 != 0 || eye.height % 2 != 0))
    return "a panorama's film needs an even width and height";
  return "";
}

std::vector<std::string> ffmpegCommand(const FilmOptions& options) {
  std::vector<std::string> command{"ffmpeg",    "-hide_banner", "-nostdin", "-nostats",
                                   "-loglevel", "error",        "-y"};
  for (std::string& word : film::encoderArguments(options)) command.push_back(std::move(word));
  command.push_back(fmt::format("/proc/self/fd/{}", film::ChildProcess::kPassed));
  return command;
}

}  // namespace

struct FilmWriter::State {
  State(const std::string& path_, const FilmOptions& options_)
      : path(path_), options(options_), file(path_) {}
  ~State() {
    if (scratch >= 0) close(scratch);
  }

  Status start();
  Status add(const Image& picture);
  Status finish();

  Error usage(std::string problem) const { return {ErrorKind::usage, path, 0, "", std::move(problem), ""}; }
  Error lost(std::string problem, std::string advice);
  Error encoderFailed(const std::string& how);
  std::string writeSequence() const {
    return "write " + std::filesystem::path(path).stem().string() + ".####.png";
  }

  const char* encoder() const { return film::factsOf(options.format).encoder; }

  std::string path;
  FilmOptions options;
  WholeFile file;
  int scratch = -1;  // where ffmpeg writes to; it has no name
  film::ChildProcess ffmpeg;
  uint64_t frames = 0;
  std::optional<Error> failure;  // what every later call gives
};

Error FilmWriter::State::lost(std::string problem, std::string advice) {
  failure = Error{ErrorKind::outputNotWritten, path, 0, "", std::move(problem), std::move(advice)};
  return *failure;
}

// What ffmpeg has said, in our words where we know what it means.
Error FilmWriter::State::encoderFailed(const std::string& how) {
  const std::string& said = ffmpeg.said();
  // The last one is how the signal is called that ends a child beyond a limit.
  for (const char* reason : {"No space left on device", "Disk quota exceeded", "File too large",
                             static_cast<const char*>(strsignal(SIGXFSZ))})
    if ((said + how).find(reason) != std::string::npos)
      return lost(std::string("cannot be written: ") + reason,
                  "make room on the disk or choose another place");
  if (said.find("Unknown encoder") != std::string::npos)
    return lost(fmt::format("this ffmpeg has no {0}, which films are encoded with", encoder()),
                fmt::format("install an ffmpeg with {0}, or {1}", encoder(), writeSequence()));
  const std::string line = film::lastLine(said);
  return lost("cannot be written: ffmpeg " + how + (line.empty() ? "" : ": " + line),
              writeSequence() + " instead");
}

Status FilmWriter::State::start() {
  if (!file.ok()) return file.commit();
  PassingFile passing = openPassingFile(folderOf(path));
  const int code = passing.descriptor < 0 ? errno : 0;
  if (!passing.name.empty()) unlink(passing.name.c_str());
  scratch = passing.descriptor;
  if (code != 0)
    return lost("cannot be written: " + std::generic_category().message(code),
                "choose another place for the output");

  const int problem = ffmpeg.start(ffmpegCommand(options), scratch);
  if (problem == ENOENT)
    return lost("films need the program ffmpeg, which is not installed",
                "install ffmpeg, or " + writeSequence());
  if (problem != 0)
    return lost("ffmpeg cannot be started: " + std::generic_category().message(problem),
                "repair that, or " + writeSequence());
  return Done{};
}

Status FilmWriter::State::add(const Image& picture) {
  if (failure) return *failure;
  if (std::string problem = film::problemWith(picture); !problem.empty()) return usage(std::move(problem));
  if (picture.width != options.width || picture.height != options.height)
    return usage(fmt::format("a picture of {}x{} does not fit a film of {}x{}", picture.width, picture.height,
                             options.width, options.height));
  const std::vector<uint8_t> planes = film::rawPicture(picture, options.format);
  if (!ffmpeg.send(planes.data(), planes.size())) {
    const std::string how = ffmpeg.finish();
    return encoderFailed(how.empty() ? "ended too early" : how);
  }
  ++frames;
  return Done{};
}

Status FilmWriter::State::finish() {
  if (failure) return *failure;
  if (frames == 0) return usage("a film needs at least one picture");
  if (const std::string how = ffmpeg.finish(); !how.empty()) return encoderFailed(how);
  const std::string problem = film::completeFilm(scratch, options, frames, file);
  if (!problem.empty() && file.ok())
    return encoderFailed("left something that is no film of ours (" + problem + ")");
  Status status = file.commit();
  failure = status ? usage("the film is finished already") : status.error();
  return status;
}

FilmWriter::FilmWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}

FilmWriter::~FilmWriter() = default;

Result<std::unique_ptr<FilmWriter>> FilmWriter::create(const std::string& path, const FilmOptions& options) {
  try {
    if (std::string problem = problemWith(options); !problem.empty())
      return Error{ErrorKind::usage, path, 0, "", std::move(problem), ""};
    auto state = std::make_unique<State>(path, options);
    if (const Status status = state->start(); !status) return status.error();
    return std::unique_ptr<FilmWriter>(new FilmWriter(std::move(state)));
  } catch (const std::exception&) {
    return Error{ErrorKind::outputNotWritten, path, 0, "", "cannot be written: not enough memory", ""};
  }
}

Status FilmWriter::add(const Image& picture) {
  try {
    return state_->add(picture);
  } catch (const std::exception&) {
    return state_->lost("cannot be written: not enough memory", "choose a smaller size");
  }
}

Status FilmWriter::finish() {
  try {
    return state_->finish();
  } catch (const std::exception&) {
    return state_->lost("cannot be written: not enough memory", "choose a smaller size");
  }
}

}  // namespace scumble
