// scumble render: one image, a range of frames, or a film.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "background.h"
#include "commands.h"
#include "frame_writer.h"
#include "json_option.h"
#include "options.h"
#include "output_files.h"
#include "outputs.h"
#include "panorama_kind.h"
#include "progress.h"
#include "report.h"

namespace scumble::app {

namespace {

using Clock = std::chrono::steady_clock;
double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct RenderArguments {
  SceneArguments scene;
  LookArguments look;
  PictureArguments picture;
  std::string output, frames, background, panorama, stats, graph, exr = "float,zip", svg = "outlines";
  std::vector<std::string> aovs;
  std::optional<double> time;  // seconds
  double fps = 24;
  float strip = Panorama().strip;
  std::optional<int> quality;
  bool quiet = false, resume = false;
  const CLI::App* command = nullptr;

  bool isGiven(const char* option) const { return command->count(option) > 0; }

  // What is said of a panorama, as options that every picture has.
  Status choosePanorama();
  const PanoramaKindRow* kind = nullptr;  // null: no panorama
  // Of a panorama, that and where it is seen from.
  Panorama wanted() const {
    return {kind->kind, picture.ipd, picture.fov.value_or(Panorama().knobHeight), strip};
  }
  PictureArguments camera() const;
};

Status RenderArguments::choosePanorama() {
  const Result<const PanoramaKindRow*> row = panoramaKindOf(panorama);
  if (!row) return row.error();
  kind = *row;
  if (!kind) return Done{};
  if (!isGiven("--size")) picture.size = kind->size;
  if (eyesOf(kind->kind) == 1 && picture.isStereo())
    return usage("--panorama " + panorama + " has one eye, and --stereo asks for two", "use --panorama ods");
  if (!picture.isStereo()) picture.stereo = kind->stereo;
  // Players know how eyes lie side by side or over each other, and nothing else.
  const Result<const StereoLayout*> layout = stereoLayoutOf(picture.stereo);
  if (!layout) return layout.error();
  if (*layout && (*layout)->film == FilmLayout::mono && !(*layout)->isSeparate)
    return usage("a panorama cannot be " + picture.stereo, "use side-by-side, over-under or separate");
  if (picture.fov && !(*picture.fov >= 1 && *picture.fov <= 180))
    return usage("--fov is out of range", "of a panorama it takes 1 to 180 degrees");
  return Done{};
}

PictureArguments RenderArguments::camera() const {
  PictureArguments camera = picture;
  // What is framed is seen by a wide angle.
  constexpr float kFraming = 80;
  if (kind) camera.stereo.clear(), camera.fov = kFraming;
  return camera;
}

constexpr int kMostFrame = 10'000'000;
constexpr double kMostTurn = 86400;   // seconds
constexpr int kStillTurns = 16;       // of eyes, in a film of what stands still
constexpr unsigned kMostWriters = 4;  // beyond them disks are slower than encoders

// "3..17"; nothing when it is not of that form.
std::optional<std::pair<int, int>> parseFrames(const std::string& text) {
  char* end = nullptr;
  const long long first = std::strtoll(text.c_str(), &end, 10);
  if (end == text.c_str() || std::strncmp(end, "..", 2) != 0) return std::nullopt;
  const char* second = end + 2;
  const long long last = std::strtoll(second, &end, 10);
  if (end == second || *end || last < first || first < -kMostFrame || last > kMostFrame) return std::nullopt;
  return std::pair{int(first), int(last)};
}

nlohmann::json statsJson(const FrameStats& stats) {
  nlohmann::json passes = nlohmann::json::array();
  for (const PassTime& pass : stats.passes)
    passes.push_back({{"name", pass.name},
                      {"milliseconds", pass.milliseconds},
                      {"bytesRead", pass.bytesRead},
                      {"fetches", pass.fetches},
                      {"bytesWritten", pass.bytesWritten}});
  return {{"passes", passes},
          {"gpuMilliseconds", stats.gpuMilliseconds},
          {"cpuMilliseconds", stats.cpuMilliseconds},
          {"readbackMilliseconds", stats.readbackMilliseconds},
          {"uploadMilliseconds", stats.uploadMilliseconds},
          {"setupMilliseconds", stats.setupMilliseconds},
          {"pipelines", stats.pipelines},
          {"triangles", stats.triangles},
          {"drawCalls", stats.drawCalls},
          {"deviceBytes", stats.deviceBytes},
          {"imageBytes", stats.imageBytes},
          {"imageBytesUnshared", stats.imageBytesUnshared},
          {"uploadedBytes", stats.uploadedBytes}};
}

// "half,piz" and the like.
Status readExrOptions(const std::string& text, OutputPlan& output) {
  std::stringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "float" || word == "half")
      output.half = word == "half";
    else if (word == "zip" || word == "piz")
      output.exr.compression = word == "zip" ? ExrCompression::zip : ExrCompression::piz;
    else
      return Error{ErrorKind::usage,
                   "",
                   0,
                   "",
                   "--exr " + text + " is not known",
                   "use float or half, and zip or piz, like half,piz"};
  }
  return Done{};
}

// "centerlines,hidden" and the like.
Status readSvgOptions(const std::string& text, OutputPlan& output) {
  std::stringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    if (word == "outlines" || word == "centerlines")
      output.svg.centerlines = word == "centerlines";
    else if (word == "hidden")
      output.svg.hidden = true;
    else
      return usage("--svg " + text + " is not known",
                   "use outlines or centerlines, and hidden, like centerlines,hidden");
  }
  return Done{};
}

Result<RenderOptions> renderOptions(const RenderArguments& args, const Background& background) {
  Result<RenderOptions> options = args.picture.renderOptions();
  if (!options) return options;
  std::vector<std::string> wanted;
  for (const std::string& name : args.aovs)
    for (const std::string& each : name == "all" ? Renderer::aovNames() : std::vector{name})
      if (!each.empty() && std::find(wanted.begin(), wanted.end(), each) == wanted.end())
        wanted.push_back(each);
  options->aovs = std::move(wanted);
  options->transparent = background.isTransparent();
  return options;
}

// The look with what --background sets.
Result<Look> loadLook(const RenderArguments& args, const Background& background) {
  LookArguments arguments = args.look;
  if (background.isColor()) {
    for (const char* knob : {"background.horizon=", "background.zenith=", "ground.tint="})
      arguments.settings.push_back(knob + args.background);
    arguments.settings.push_back("background.mode=look");
  }
  return arguments.load(args.scene.files[0], args.quiet);
}

// A turn has whole frames, so that its loop closes: the nearest to the seconds that were asked for.
int framesOfTurn(const RenderArguments& args) {
  return int(std::clamp(std::round(*args.picture.turntable * args.fps), 1.0, double(kMostFrame)));
}

// The numbers of all frames that are wanted; nothing for one picture.
Result<std::vector<int>> frameNumbers(const RenderArguments& args, const OutputPlan& output,
                                      const Scene& scene, const Look& look) {
  std::vector<int> numbers;
  if (args.frames.empty()) {
    if (output.kind() != OutputKind::film && !output.isSequence()) return numbers;
    double frames =
        args.picture.turntable ? framesOfTurn(args) : std::ceil(playedSeconds(scene, look) * args.fps - 1e-3);
    // What stands still is seen from both sides often enough.
    if (!(frames >= 1) && output.layout && output.layout->isInTurns)
      frames = kStillTurns * framesInTurn(args.fps);
    if (!(frames >= 1))
      return Error{ErrorKind::usage,
                   "",
                   0,
                   "",
                   "nothing says how long the film is: no clip plays",
                   "add --frames A..B or --turntable"};
    for (int number = 0; number < std::min(frames, double(kMostFrame)); ++number) numbers.push_back(number);
  } else {
    const auto range = *parseFrames(args.frames);
    for (int number = range.first; number <= range.second; ++number) numbers.push_back(number);
  }
  if (args.resume)
    std::erase_if(numbers, [&](int number) { return output.isThere(output.framePath(number)); });
  return numbers;
}

// Two frames are under way on the device while earlier ones are written.
class FrameLoop {
 public:
  // `still`: the views of all frames, unless they move.
  FrameLoop(const RenderArguments& args, const Scene& scene, const Look& look, const RenderOptions& options,
            const Background& background, const Result<std::vector<View>>& still, Renderer& renderer,
            Progress& progress)
      : args_(args),
        scene_(scene),
        look_(look),
        options_(options),
        background_(background),
        still_(still),
        renderer_(renderer),
        progress_(progress) {}

  // One frame for each time; `take` gets them in this order.
  Status draw(const std::vector<double>& times, const std::function<Status(size_t, Frame)>& take) {
    const bool moves = viewsMove(scene_, args_.picture.viewpoint().value(), look_);
    const PictureArguments camera = args_.camera();
    const auto viewsAt = [&](double time) { return moves ? camera.views(scene_, look_, time) : still_; };
    // With two frames under way the device always has work.
    constexpr size_t kUnderWay = 2;
    static_assert(kUnderWay <= size_t(Renderer::kMaxBegun));
    const size_t underWay = args_.kind ? 1 : kUnderWay;
    std::optional<Result<Frame>> panorama;
    for (size_t next = 0, done = 0; done < times.size();) {
      if (next < times.size() && next - done < underWay) {
        const Result<std::vector<View>> views = viewsAt(times[next]);
        if (!views) return views.error();
        RenderOptions options = options_;
        options.previousTime = times[next] - 1 / args_.fps;
        const Result<std::vector<View>> previous = viewsAt(*options.previousTime);
        if (!previous) return previous.error();
        options.previousViews = *previous;
        Result<std::shared_ptr<const Image>> behind = background_.at(times[next]);
        if (!behind) return behind.error();
        options.background = std::move(behind).value();
        if (args_.kind) {
          const Image* const around = options.background.get();
          if (around && around->width != 2 * around->height && done == 0 && !args_.quiet)
            warn({"the background goes all around, and is not twice as wide as high: it is stretched"});
          // Many frames in itself: it keeps the device at work alone.
          options.progress = [&](double part) {
            progress_.part(part);
            return true;
          };
          panorama =
              renderPanorama(renderer_, scene_, look_, times[next], views->front(), args_.wanted(), options);
          if (!*panorama) return panorama->error();
        } else if (const Status status = renderer_.begin(scene_, look_, times[next], *views, options);
                   !status) {
          return status.error();
        }
        ++next;
        continue;
      }
      Result<Frame> frame = panorama ? std::move(*panorama) : renderer_.finish();
      if (!frame) return frame.error();
      if (args_.picture.validate && renderer_.validationMessages() > 0)
        return Error{ErrorKind::internal, "", 0, "", "the validation layers found mistakes",
                     "please report them"};
      if (const Status status = take(done++, std::move(frame).value()); !status) return status.error();
    }
    return Done{};
  }

 private:
  const RenderArguments& args_;
  const Scene& scene_;
  const Look& look_;
  const RenderOptions& options_;
  const Background& background_;
  const Result<std::vector<View>>& still_;
  Renderer& renderer_;
  Progress& progress_;
};

// Of options that count for nothing beside others or for this output.
void warnOfIdle(const RenderArguments& args, const OutputPlan& output) {
  const bool isFilm = output.kind() == OutputKind::film;
  if (args.time && !args.frames.empty()) warn({"--time does nothing beside --frames: frame n is at n / fps"});
  if (args.time && args.frames.empty() && isFilm) warn({"--time does nothing for a film"});
  if (args.kind && args.picture.roll) warn({"--roll does nothing in a panorama, which is level"});
  if (args.kind && isFilm && output.format->film != FilmFormat::mp4)
    warn({"players learn from an MP4 alone that a film is a panorama"});
  if (args.isGiven("--svg") && output.kind() != OutputKind::drawing)
    warn({"--svg does nothing where no SVG is written"});
  if (args.isGiven("--exr") && (isFilm || (output.kind() != OutputKind::exr && output.aovs.empty())))
    warn({"--exr does nothing where no EXR is written"});
  if (!args.kind) {
    args.picture.warnOfIdle();
    if (args.isGiven("--strip")) warn({"--strip does nothing without --panorama"});
  } else if (eyesOf(args.kind->kind) == 1 && args.isGiven("--ipd")) {
    warn({"--ipd does nothing for one eye: --panorama ods has two"});
  }
}

int run(RenderArguments args) {
  const auto start = Clock::now();
  nlohmann::json steps = nlohmann::json::object();
  auto lapStart = start;
  const auto lap = [&](const char* name) {
    steps[name] = millisecondsSince(lapStart);
    lapStart = Clock::now();
  };

  // Check everything that can be checked before anything is drawn.
  const Result<Background> background = Background::make(args.background);
  if (!background) return fail(background.error());
  if (const Status status = args.choosePanorama(); !status) return fail(status.error());
  Result<RenderOptions> options = renderOptions(args, *background);
  if (!options) return fail(options.error());
  const Result<const StereoLayout*> layout = stereoLayoutOf(args.picture.stereo);
  if (!layout) return fail(layout.error());
  Result<OutputPlan> output = OutputPlan::make(args.output, args.scene.files[0], *layout,
                                               !args.frames.empty() || args.picture.turntable, *options);
  if (!output) return fail(output.error());
  output->fps = args.fps;
  if (args.kind) {
    output->projection = args.kind->projection;
    if (output->kind() == OutputKind::drawing)
      return failUsage("a panorama is no drawing", "write a picture");
    if (const auto plan = planPanorama(args.wanted(), *options); !plan) return fail(plan.error());
  }
  output->quality = args.quality;
  if (const Status status = output->format->checkQuality(args.quality); !status) return fail(status.error());
  if (const Status status = readExrOptions(args.exr, *output); !status) return fail(status.error());
  if (const Status status = readSvgOptions(args.svg, *output); !status) return fail(status.error());
  options->drawing = output->kind() == OutputKind::drawing;
  // What is written is told apart from what is read.
  std::vector<std::string> inputs = args.scene.files;
  inputs.push_back(args.look.lookFor(args.scene.files[0]));
  inputs.push_back(background->file());
  OutputFiles files(inputs);
  for (const std::string& file : output->files(output->path))
    if (const Status status = files.add(file, "the picture"); !status) return fail(status.error());
  if (const Status status = files.add(args.stats, "--stats"); !status) return fail(status.error());
  if (const Status status = files.add(args.graph, "--graph"); !status) return fail(status.error());
  const bool isFilm = output->kind() == OutputKind::film;
  // Times and frames.
  if (!args.frames.empty()) {
    const auto range = parseFrames(args.frames);
    if (!range)
      return failUsage("--frames " + args.frames + " is no range",
                       "write it like 0..23, with numbers up to 10000000");
    if (range->first != range->second && !output->isSequence() && !isFilm)
      return failUsage("several frames cannot go into one '" + output->path + "'",
                       "name it like picture.####.png, or picture.mp4");
  }
  if (isFilm && args.resume)
    return failUsage("a film cannot be resumed",
                     "write name.####.png with --resume, then make the film of those");
  if (!(args.fps >= 0.01 && args.fps <= 1000))
    return failUsage("--fps is out of range", "use 0.01 to 1000 frames a second");
  if (!(std::abs(args.time.value_or(0)) < Renderer::kMaxTime))
    return failUsage("--time is out of range", "it is in seconds, up to a million");
  if (args.picture.turntable) {
    if (!(*args.picture.turntable > 0 && *args.picture.turntable <= kMostTurn))
      return failUsage("--turntable is out of range", "give seconds above 0, a day at most");
    if (args.frames.empty() && !args.time && !isFilm && !output->isSequence())
      return failUsage("a turn does not go into one '" + output->path + "'",
                       "name it like picture.mp4 or picture.####.png, or say --time");
    args.picture.turntable = framesOfTurn(args) / args.fps;
  }
  // Look and scene.
  Result<Look> look = loadLook(args, *background);
  if (!look) return fail(look.error());
  // One renderer draws it, with one look.
  SceneOptions loading;
  loading.keepsVertices = false;
  const Result<Scene> scene = args.scene.load(args.quiet, loading);
  if (!scene) return fail(scene.error());
  for (const std::vector<std::string>& read : {look->files(), scene->files()})
    if (const Status status = files.addInputs(read); !status) return fail(status.error());
  look = args.look.withClip(*look, *scene);
  if (!look) return fail(look.error());
  // A camera that does not exist is found before there is a device.
  const Result<std::vector<View>> views = args.camera().views(*scene, *look);
  if (!views) return fail(views.error());
  const Result<std::vector<int>> numbers = frameNumbers(args, *output, *scene, *look);
  if (!numbers) return fail(numbers.error());
  if (output->isSequence())
    for (const int number : *numbers)
      for (const std::string& file : output->files(output->framePath(number)))
        if (const Status status = files.check(file, "a frame"); !status) return fail(status.error());
  // What does nothing is told.
  if (!args.quiet) {
    warnOfIdle(args, *output);
    args.look.warnOfIdle(*look, *scene, args.scene.files[0]);
  }
  const bool isPicture = args.frames.empty() && !isFilm && !output->isSequence();
  std::vector<double> times;
  for (const int number : *numbers) times.push_back(number / args.fps);
  for (const double time : times)
    if (!(std::abs(time - 1 / args.fps) < Renderer::kMaxTime && std::abs(time) < Renderer::kMaxTime))
      return failUsage("a frame's time is out of range",
                       "frame n is at n / fps seconds, which may be up to a million");
  if (isPicture && !(args.resume && output->isThere(output->path))) times.push_back(args.time.value_or(0));
  lap("sceneMilliseconds");
  // The device.
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(args.picture.rendererOptions());
  if (!renderer) return fail(renderer.error());
  lap("deviceMilliseconds");
  // What is put over black is so in floats.
  if (output->kind() != OutputKind::exr && !options->transparent) options->formats[""] = PixelFormat::srgb8;

  // Draw, and write beside it: pictures on several threads, a film in order.
  std::optional<FilmOutput> film;
  if (isFilm) {
    Result<FilmOutput> created = FilmOutput::create(*output);
    if (!created) return fail(created.error());
    film = std::move(created).value();
  }
  Progress progress(int(times.size()), args.quiet);
  const int writers = isFilm ? 1 : int(std::clamp(std::thread::hardware_concurrency() / 2, 1u, kMostWriters));
  FrameWriter writer(
      writers,
      [&](const Frame& frame, int number) {
        return film ? film->add(frame, number)
                    : output->write(
                          frame, output->framePath(isPicture ? std::nullopt : std::optional(number)), number);
      },
      [&](int number) { progress.done("frame " + std::to_string(number)); });
  nlohmann::json frameStats = nlohmann::json::array();
  FrameLoop loop(args, *scene, *look, *options, *background, views, **renderer, progress);
  Status status = loop.draw(times, [&](size_t i, Frame frame) {
    for (const Drawing& drawing : frame.drawings)
      if (drawing.leftOut > 0)
        warn({std::to_string(drawing.leftOut) + " lines are left out of the drawing: there are too many"});
    frameStats.push_back(statsJson(frame.stats));
    return writer.add(isPicture ? 0 : (*numbers)[i], std::move(frame));
  });
  // What has been drawn is kept, whatever came after it.
  if (const Status written = writer.finish(); status && !written) status = written;
  if (status && film) status = film->finish();
  if (!status) return fail(status.error());
  const double rendering = millisecondsSince(lapStart);

  // Reports.
  if (!args.stats.empty()) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const SceneTimings& import = scene->timings();
    const nlohmann::json report{{"device", (*renderer)->gpu().name},
                                {"driver", (*renderer)->gpu().driver},
                                {"size", {options->width, options->height}},
                                {"samples", options->samples},
                                {"views", output->viewCount()},
                                {"import",
                                 {{"read", import.read},
                                  {"parse", import.parse},
                                  {"geometry", import.geometry},
                                  {"images", import.images}}},
                                {"steps", steps},
                                {"renderMilliseconds", rendering},
                                {"writeMilliseconds", writer.milliseconds()},
                                {"totalMilliseconds", millisecondsSince(start)},
                                {"peakResidentBytes", uint64_t(usage.ru_maxrss) * 1024},
                                {"frames", frameStats}};
    if (const Status written = writeText(args.stats, textOf(report)); !written) return fail(written.error());
  }
  if (!args.graph.empty())
    if (const Status written = writeText(args.graph, (*renderer)->graph()); !written)
      return fail(written.error());
  return kDone;
}

}  // namespace

void addRender(CLI::App& program, int& exitCode) {
  auto args = std::make_shared<RenderArguments>();
  CLI::App* command = program.add_subcommand("render", "Render one image, a range of frames, or a film");
  args->scene.addTo(*command);
  command->add_option(
      "-o,--output", args->output,
      "The picture: .png, .jpg, .webp (8 bit sRGB) or .exr (linear float, both eyes as views); "
      "name.####.png for a sequence; .mp4, .webm or .gif for a film, by ffmpeg; .svg for the look's lines "
      "(default: the scene's name + .png in the current folder)");
  args->look.addTo(*command);
  args->picture.addTo(*command);
  args->picture.addStereoTo(*command);
  args->picture.addTurntableTo(*command);
  command
      ->add_option(
          "--panorama", args->panorama,
          "Something to stand inside of, level, from where the camera is: vr180 (both eyes, the half "
          "that lies ahead), ods (both, all around) or mono360. --size is that of one eye's "
          "picture (2048x2048, or 4096x2048), --stereo how eyes lie in it (side-by-side, or over-under), "
          "and --fov how many degrees the 1080 lines are that looks count by (90)")
      ->type_name("KIND");
  command
      ->add_option("--strip", args->strip,
                   "Degrees of a panorama for which an eye keeps its place, 0.5 to 15: less where --ipd is "
                   "large or things are near, and their edges have steps")
      ->capture_default_str();
  command->add_option("--time", args->time, "Seconds (default: 0)");
  command
      ->add_option(
          "--frames", args->frames,
          "A range of frames; frame n is at n / fps seconds (default for films: as long as clips play)")
      ->type_name("A..B");
  command->add_option("--fps", args->fps, "Frames a second")->capture_default_str();
  command->add_flag("--resume", args->resume, "Leave out frames whose files are there, whole");
  command->add_option(
      "--quality", args->quality,
      "JPEG: 1 to 100 (default 92), WebP: 0 to 100, which is lossless (90), higher is better; films, "
      "constant quality, lower is better: MP4 0 to 51 (16), WebM 0 to 63 (20)");
  command->add_option("--exr", args->exr, "EXR: float or half (facts stay float), zip or piz")
      ->capture_default_str();
  command
      ->add_option(
          "--svg", args->svg,
          "SVG: outlines, as wide as lines are, or centerlines, for plotters; and hidden for hidden ones")
      ->capture_default_str();
  std::string names;
  for (const std::string& name : Renderer::aovNames()) names += (names.empty() ? "" : ", ") + name;
  command
      ->add_option("--aov", args->aovs,
                   "Also write a pass's output, into the EXR as layers or beside another picture as "
                   "NAME.AOV.exr: all, "
                   "or some of " +
                       names)
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--background", args->background,
                      "What is behind everything: a colour (#RRGGBB, #RGB or a name of CSS), transparent, or "
                      "a picture (.png, .jpg, .webp) or film; "
                      "before those, the ground shows only the shadows on it");
  command->add_option("--stats", args->stats, "Write JSON with milliseconds of each pass, counts and memory")
      ->type_name("FILE");
  command
      ->add_option("--graph", args->graph,
                   "Write the steps of a frame, with what each reads and writes, for Graphviz (dot -Tsvg)")
      ->type_name("FILE");
  command->add_flag("--quiet", args->quiet, "No warnings and no progress");
  command->footer("Example: scumble render boat.glb -o boat.png --orbit 30,15 --set shadow.threshold=0.4");
  args->command = command;
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
