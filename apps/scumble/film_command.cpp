// scumble film: pictures that are there become a film.
#include <algorithm>
#include <deque>
#include <filesystem>
#include <future>
#include <thread>

#include "commands.h"
#include "options.h"
#include "output_files.h"
#include "outputs.h"
#include "panorama_kind.h"
#include "progress.h"
#include "render_arguments.h"
#include "report.h"

namespace scumble::app {

namespace fs = std::filesystem;

namespace {

constexpr unsigned kMostAhead = 4;  // pictures are large

struct FilmArguments {
  std::string pictures, output, frames, stereo, panorama;
  double fps = 24;
  std::optional<int> quality;
  bool quiet = false;
};

// The numbers in the names of files that are there: from the least to the greatest.
std::vector<int> numbersThere(const std::string& pattern) {
  const fs::path path(pattern);
  const std::string name = path.filename().string();
  const auto [begin, end] = numberIn(name);
  const std::string before = name.substr(0, begin), after = name.substr(end);
  std::optional<int> first, last;
  std::error_code ignored;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(path.has_parent_path() ? path.parent_path() : fs::path("."), ignored)) {
    const std::string found = entry.path().filename().string();
    if (found.size() <= before.size() + after.size() || !found.starts_with(before) || !found.ends_with(after))
      continue;
    const std::string digits = found.substr(before.size(), found.size() - before.size() - after.size());
    const Result<std::vector<int>> number = parseFrames(digits + ".." + digits);
    // Only as it would be written: with as many digits.
    if (!number || fs::path(numbered(pattern, number->front())).filename() != found) continue;
    first = std::min(first.value_or(number->front()), number->front());
    last = std::max(last.value_or(number->front()), number->front());
  }
  if (!first) return {};
  return parseFrames(std::to_string(*first) + ".." + std::to_string(*last)).value();
}

// Pictures as they go into the film.
class Pictures {
 public:
  Pictures(const FilmArguments& args, const StereoLayout* layout)
      : pattern_(args.pictures), fps_(args.fps), layout_(layout) {}

  Result<Image> read(int number) const {
    const std::string path = numbered(pattern_, number);
    if (endingOf(path) != ".exr") return readPicture(path);
    if (!layout_) return readExr(path);
    if (layout_->isInTurns) return readExr(path, kEyes[eyeInTurn(number, fps_)]);
    const Result<Image> left = readExr(path, kEyes[0]), right = readExr(path, kEyes[1]);
    if (!left) return left.error();
    if (!right) return right.error();
    return layout_->arrange(*left, *right);
  }

 private:
  const std::string pattern_;
  const double fps_;
  const StereoLayout* const layout_;
};

Status checkAllThere(const FilmArguments& args, const std::vector<int>& numbers) {
  std::vector<int> missing;
  std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(missing),
               [&](int number) { return !isWholePicture(numbered(args.pictures, number)); });
  if (missing.empty()) return Done{};
  return Error{ErrorKind::unusableFile,
               args.pictures,
               0,
               "",
               "of " + std::to_string(numbers.size()) + " pictures, " + std::to_string(missing.size()) +
                   (missing.size() == 1 ? " is" : " are") + " not there, whole: " + rangesOf(missing),
               "draw them with `scumble render --resume`, or give --frames"};
}

int run(const FilmArguments& args) {
  if (!isNumbered(args.pictures))
    return failUsage("'" + args.pictures + "' names no sequence", "name it like shot.####.png");
  const Result<const OutputFormat*> from = formatOf(args.pictures), to = formatOf(args.output);
  if (!from) return fail(from.error());
  if (!to) return fail(to.error());
  if ((*from)->kind != OutputKind::picture && (*from)->kind != OutputKind::exr)
    return failUsage("'" + args.pictures + "' are no pictures", "give .png, .jpg, .webp or .exr");
  if ((*to)->kind != OutputKind::film)
    return failUsage("'" + args.output + "' is no film", "name it like shot.mp4, .webm or .gif");
  if (const Status status = (*to)->checkQuality(args.quality); !status) return fail(status.error());
  if (const Status status = checkFps(args.fps); !status) return fail(status.error());
  const Result<const PanoramaKindRow*> kind = panoramaKindOf(args.panorama);
  if (!kind) return fail(kind.error());
  const Result<const StereoLayout*> layout =
      stereoLayoutOf(args.stereo.empty() && *kind ? (*kind)->stereo : args.stereo);
  if (!layout) return fail(layout.error());
  Result<std::vector<int>> asked = std::vector<int>();
  if (!args.frames.empty()) asked = parseFrames(args.frames);
  if (!asked) return fail(asked.error());
  OutputFiles files({});
  if (const Status status = files.add(args.output, "the film"); !status) return fail(status.error());
  const std::vector<int> numbers = asked->empty() ? numbersThere(args.pictures) : *asked;
  if (numbers.empty())
    return fail(
        {ErrorKind::unusableFile, args.pictures, 0, "", "there is no such picture", "check the name"});
  if (const Status status = checkAllThere(args, numbers); !status) return fail(status.error());

  FilmOptions options;
  options.format = (*to)->film;
  options.fps = args.fps;
  options.quality = args.quality;
  const StereoLayout* const both = *layout && !(*layout)->isSeparate ? *layout : nullptr;
  if (both) options.layout = both->film;
  if (*kind) options.projection = (*kind)->projection;
  std::unique_ptr<FilmWriter> film;
  Progress progress(int(numbers.size()), args.quiet);
  const Pictures pictures(args, both);
  // The next ones are read while one is encoded.
  const size_t ahead = std::clamp(std::thread::hardware_concurrency(), 1u, kMostAhead);
  std::deque<std::future<Result<Image>>> next;
  for (size_t i = 0, begun = 0; i < numbers.size(); ++i) {
    for (; begun < numbers.size() && begun <= i + ahead; ++begun)
      next.push_back(
          std::async(std::launch::async, [&, number = numbers[begun]] { return pictures.read(number); }));
    const Result<Image> picture = next.front().get();
    next.pop_front();
    if (!picture) {
      // Whole by its ends, and damaged between them.
      Error damaged = picture.error();
      damaged.advice = "delete it, and draw it again with `scumble render --resume`";
      return fail(damaged);
    }
    if (!film) {
      options.width = picture->width, options.height = picture->height;
      Result<std::unique_ptr<FilmWriter>> created = FilmWriter::create(args.output, options);
      if (!created) return fail(created.error());
      film = std::move(created).value();
    }
    if (picture->width != options.width || picture->height != options.height)
      return fail({ErrorKind::unusableFile, numbered(args.pictures, numbers[i]), 0, "",
                   "it has " + std::to_string(picture->width) + " x " + std::to_string(picture->height) +
                       " pixels, and those before it " + std::to_string(options.width) + " x " +
                       std::to_string(options.height),
                   "give --frames of one size"});
    if (const Status status = film->add(*picture); !status) return fail(status.error());
    progress.done("picture " + std::to_string(numbers[i]));
  }
  if (const Status status = film->finish(); !status) return fail(status.error());
  return kDone;
}

}  // namespace

void addFilm(CLI::App& program, int& exitCode) {
  auto args = std::make_shared<FilmArguments>();
  CLI::App* command = program.add_subcommand("film", "A film of pictures that are there");
  command
      ->add_option(
          "PICTURES", args->pictures,
          "A sequence, like shot.####.png: .png, .jpg, .webp or .exr, as `scumble render` writes them")
      ->required();
  command->add_option("-o,--output", args->output, "The film: .mp4, .webm or .gif, by ffmpeg")->required();
  command
      ->add_option(
          "--frames", args->frames,
          "Which of them (default: from the least number that is there to the greatest); all must be "
          "there, whole")
      ->type_name("A..B");
  command->add_option("--fps", args->fps, "Frames a second")->capture_default_str();
  command->add_option("--quality", args->quality,
                      "Constant quality, lower is better: MP4 0 to 51 (16), WebM 0 to 63 (20)");
  command->add_option("--stereo", args->stereo,
                      "How two eyes lie in them, for players; of .exr with two views, how they are laid; "
                      "separate: they are one "
                      "eye's: " +
                          stereoLayoutNames());
  command
      ->add_option("--panorama", args->panorama,
                   "What they are a panorama of, for players: vr180, ods or mono360")
      ->type_name("KIND");
  command->add_flag("--quiet", args->quiet, "No progress");
  command->footer("Example: scumble film shot.####.png -o shot.mp4");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
