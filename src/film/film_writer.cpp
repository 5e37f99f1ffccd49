// Films. ffmpeg gets raw frames (made here, so that colours are the same with every version of it) on its
// standard input, and writes into a file without a name. From that file, and from what an earlier call has
// left, the film is put together.
#include <fmt/format.h>

#include <optional>

#include "base/whole_file.h"
#include "film/checks.h"
#include "film/earlier_film.h"
#include "film/ffmpeg_run.h"
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
  const film::PixelSize eye = film::eyeSizeOf(options);
  if (options.projection != FilmProjection::flat && (eye.width % 2 != 0 || eye.height % 2 != 0))
    return "a panorama's film needs an even width and height";
  return "";
}

}  // namespace

struct FilmWriter::State {
  State(const std::string& path_, const FilmOptions& options_)
      : path(path_), options(options_), file(path_), encoder(path_, options_.format) {}

  Status start();
  Status add(const Image& picture);
  Status finish();

  Error usage(std::string problem) const { return {ErrorKind::usage, path, 0, "", std::move(problem), ""}; }
  Error lost(Error error);
  uint64_t framesBefore() const { return earlier ? earlier->frames() : 0; }

  std::string path;
  FilmOptions options;
  WholeFile file;
  film::FfmpegRun encoder;
  std::unique_ptr<film::EarlierFilm> earlier;  // null: none
  uint64_t added = 0;
  std::optional<Error> failure;  // what every later call gives
};

Error FilmWriter::State::lost(Error error) {
  failure = std::move(error);
  return *failure;
}

Status FilmWriter::State::start() {
  if (!file.ok()) return file.commit();
  return encoder.start(film::encoderArguments(options));
}

Status FilmWriter::State::add(const Image& picture) {
  if (failure) return *failure;
  if (std::string problem = film::problemWith(picture); !problem.empty()) return usage(std::move(problem));
  if (picture.width != options.width || picture.height != options.height)
    return usage(fmt::format("a picture of {}x{} does not fit a film of {}x{}", picture.width, picture.height,
                             options.width, options.height));
  const std::vector<uint8_t> planes = film::rawPicture(picture, options.format);
  if (const Status status = encoder.send(planes.data(), planes.size()); !status) return lost(status.error());
  ++added;
  return Done{};
}

Status FilmWriter::State::finish() {
  if (failure) return *failure;
  const uint64_t frames = framesBefore() + added;
  if (frames == 0) return usage("a film needs at least one picture");
  failure = usage("the film is finished already");
  // What is there is the whole film.
  if (added == 0) return Done{};
  if (const Status status = encoder.finish(); !status) return lost(status.error());
  film::FfmpegRun joined(path, options.format);
  if (earlier)
    if (const Status status = earlier->joinTo(encoder.written(), joined); !status)
      return lost(status.error());
  const film::FfmpegRun& last = earlier ? joined : encoder;
  const std::string problem = film::completeFilm(last.written(), options, frames, file);
  if (!problem.empty() && file.ok())
    return lost(last.failed("left something that is no film of ours (" + problem + ")"));
  const Status status = file.commit();
  return status ? status : lost(status.error());
}

FilmWriter::FilmWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}

FilmWriter::~FilmWriter() = default;

Result<std::unique_ptr<FilmWriter>> FilmWriter::make(const std::string& path, const FilmOptions& options,
                                                     bool goesOn) {
  try {
    if (std::string problem = problemWith(options); !problem.empty())
      return Error{ErrorKind::usage, path, 0, "", std::move(problem), ""};
    auto state = std::make_unique<State>(path, options);
    if (goesOn) {
      Result<std::unique_ptr<film::EarlierFilm>> earlier = film::EarlierFilm::open(path, options);
      if (!earlier) return earlier.error();
      state->earlier = std::move(earlier).value();
    }
    if (const Status status = state->start(); !status) return status.error();
    return std::unique_ptr<FilmWriter>(new FilmWriter(std::move(state)));
  } catch (const std::exception&) {
    return Error{ErrorKind::outputNotWritten, path, 0, "", "cannot be written: not enough memory", ""};
  }
}

Result<std::unique_ptr<FilmWriter>> FilmWriter::create(const std::string& path, const FilmOptions& options) {
  return make(path, options, false);
}

Result<std::unique_ptr<FilmWriter>> FilmWriter::resume(const std::string& path, const FilmOptions& options) {
  if (options.format == FilmFormat::gif)
    return Error{ErrorKind::usage, path, 0, "", "a GIF cannot be resumed", "write an MP4 or a WebM"};
  return make(path, options, true);
}

uint64_t FilmWriter::frames() const {
  return state_->framesBefore() + state_->added;
}

Status FilmWriter::add(const Image& picture) {
  try {
    return state_->add(picture);
  } catch (const std::exception&) {
    return state_->lost(
        state_->encoder.lost("cannot be written: not enough memory", "choose a smaller size"));
  }
}

Status FilmWriter::finish() {
  try {
    return state_->finish();
  } catch (const std::exception&) {
    return state_->lost(
        state_->encoder.lost("cannot be written: not enough memory", "choose a smaller size"));
  }
}

}  // namespace scumble
