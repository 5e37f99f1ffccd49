#include "render_arguments.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <sstream>

#include "report.h"

namespace scumble::app {

namespace {

constexpr int kMostFrame = 10'000'000;
constexpr double kMostTurn = 86400;  // seconds
constexpr int kStillTurns = 16;      // of eyes, in a film of what stands still
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
    numbers = parseFrames(args.frames).value();
  }
  if ((args.resume || args.missing) && output.kind() != OutputKind::film)
    std::erase_if(numbers, [&](int number) { return output.isThere(output.framePath(number)); });
  return numbers;
}

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

}  // namespace

Result<std::vector<int>> parseFrames(const std::string& text) {
  const Error noRange = usage("--frames " + text + " is no range",
                              "write it like 0..23, with numbers up to " + std::to_string(kMostFrame));
  char* end = nullptr;
  const long long first = std::strtoll(text.c_str(), &end, 10);
  if (end == text.c_str() || std::strncmp(end, "..", 2) != 0) return noRange;
  const char* second = end + 2;
  const long long last = std::strtoll(second, &end, 10);
  if (end == second || *end || last < first || first < -kMostFrame || last > kMostFrame) return noRange;
  std::vector<int> numbers(size_t(last - first + 1));
  std::iota(numbers.begin(), numbers.end(), int(first));
  return numbers;
}

Status checkFps(double fps) {
  if (fps >= 0.01 && fps <= 1000) return Done{};
  return usage("--fps is out of range", "use 0.01 to 1000 frames a second");
}

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

Result<RenderPlan> planRender(RenderArguments args) {
  Result<Background> background = Background::make(args.background);
  if (!background) return background.error();
  if (const Status status = args.choosePanorama(); !status) return status.error();
  Result<RenderOptions> options = renderOptions(args, *background);
  if (!options) return options.error();
  const Result<const StereoLayout*> layout = stereoLayoutOf(args.picture.stereo);
  if (!layout) return layout.error();
  Result<OutputPlan> output = OutputPlan::make(args.output, args.scene.files[0], *layout,
                                               !args.frames.empty() || args.picture.turntable, *options);
  if (!output) return output.error();
  output->fps = args.fps;
  if (args.kind) {
    output->projection = args.kind->projection;
    if (output->kind() == OutputKind::drawing) return usage("a panorama is no drawing", "write a picture");
    if (const auto plan = planPanorama(args.wanted(), *options); !plan) return plan.error();
  }
  output->quality = args.quality;
  if (const Status status = output->format->checkQuality(args.quality); !status) return status.error();
  if (const Status status = readExrOptions(args.exr, *output); !status) return status.error();
  if (const Status status = readSvgOptions(args.svg, *output); !status) return status.error();
  options->drawing = output->kind() == OutputKind::drawing;
  // What is written is told apart from what is read.
  std::vector<std::string> inputs = args.scene.files;
  inputs.push_back(args.look.lookFor(args.scene.files[0]));
  inputs.push_back(background->file());
  OutputFiles files(inputs);
  for (const std::string& file : output->files(output->path))
    if (const Status status = files.add(file, "the picture"); !status) return status.error();
  if (const Status status = files.add(args.stats, "--stats"); !status) return status.error();
  if (const Status status = files.add(args.graph, "--graph"); !status) return status.error();
  const bool isFilm = output->kind() == OutputKind::film;
  // Times and frames.
  if (!args.frames.empty()) {
    const Result<std::vector<int>> range = parseFrames(args.frames);
    if (!range) return range.error();
    if (range->size() > 1 && !output->isSequence() && !isFilm)
      return usage("several frames cannot go into one '" + output->path + "'",
                   "name it like picture.####.png, or picture.mp4");
  }
  const bool isGif = isFilm && output->format->film == FilmFormat::gif;
  if ((isFilm && args.missing) || (isGif && args.resume))
    return usage(args.missing ? "--missing looks for files of frames, and a film is one file"
                              : "a GIF cannot be resumed; .mp4 and .webm can",
                 "write name.####.png, then make the film of those with `scumble film`");
  if (const Status status = checkFps(args.fps); !status) return status.error();
  if (!(std::abs(args.time.value_or(0)) < Renderer::kMaxTime))
    return usage("--time is out of range", "it is in seconds, up to a million");
  if (args.picture.turntable) {
    if (!(*args.picture.turntable > 0 && *args.picture.turntable <= kMostTurn))
      return usage("--turntable is out of range", "give seconds above 0, a day at most");
    if (args.frames.empty() && !args.time && !isFilm && !output->isSequence())
      return usage("a turn does not go into one '" + output->path + "'",
                   "name it like picture.mp4 or picture.####.png, or say --time");
    args.picture.turntable = framesOfTurn(args) / args.fps;
  }
  // Look and scene.
  Result<Look> look = loadLook(args, *background);
  if (!look) return look.error();
  // One renderer draws it, with one look.
  SceneOptions loading;
  loading.keepsVertices = false;
  Result<Scene> scene = args.scene.load(args.quiet, loading);
  if (!scene) return scene.error();
  for (const std::vector<std::string>& read : {look->files(), scene->files()})
    if (const Status status = files.addInputs(read); !status) return status.error();
  look = args.look.withClip(*look, *scene);
  if (!look) return look.error();
  // A camera that does not exist is found before there is a device.
  Result<std::vector<View>> views = args.camera().views(*scene, *look);
  if (!views) return views.error();
  Result<std::vector<int>> numbers = frameNumbers(args, *output, *scene, *look);
  if (!numbers) return numbers.error();
  if (output->isSequence())
    for (const int number : *numbers)
      for (const std::string& file : output->files(output->framePath(number)))
        if (const Status status = files.check(file, "a frame"); !status) return status.error();
  // What does nothing is told.
  if (!args.quiet) {
    warnOfIdle(args, *output);
    args.look.warnOfIdle(*look, *scene, args.scene.files[0]);
  }
  const bool isPicture = args.frames.empty() && !isFilm && !output->isSequence();
  for (const int number : *numbers)
    if (const double seconds = number / args.fps;
        !(std::abs(seconds - 1 / args.fps) < Renderer::kMaxTime && std::abs(seconds) < Renderer::kMaxTime))
      return usage("a frame's time is out of range",
                   "frame n is at n / fps seconds, which may be up to a million");
  return RenderPlan{std::move(args),           std::move(background).value(), std::move(options).value(),
                    std::move(output).value(), std::move(look).value(),       std::move(scene).value(),
                    std::move(views).value(),  std::move(numbers).value(),    isPicture};
}

std::vector<double> RenderPlan::times() const {
  std::vector<double> times;
  for (const int number : numbers) times.push_back(number / args.fps);
  const bool leavesOut = args.resume || args.missing;
  if (isPicture && !(leavesOut && output.isThere(output.path))) times.push_back(args.time.value_or(0));
  return times;
}

std::vector<std::string> RenderPlan::inputs() const {
  std::vector<std::string> inputs = args.scene.files;
  for (const std::vector<std::string>& read : {scene.files(), look.files()})
    inputs.insert(inputs.end(), read.begin(), read.end());
  if (!background.file().empty()) inputs.push_back(background.file());
  return inputs;
}

void RenderArguments::addTo(CLI::App& command) {
  scene.addTo(command);
  command.add_option(
      "-o,--output", output,
      "The picture: .png, .jpg, .webp (8 bit sRGB) or .exr (linear float, both eyes as views); "
      "name.####.png for a sequence; .mp4, .webm or .gif for a film, by ffmpeg; .svg for the look's lines "
      "(default: the scene's name + .png in the current folder)");
  look.addTo(command);
  picture.addTo(command);
  picture.addStereoTo(command);
  picture.addTurntableTo(command);
  command
      .add_option(
          "--panorama", panorama,
          "Something to stand inside of, level, from where the camera is: vr180 (both eyes, the half "
          "that lies ahead), ods (both, all around) or mono360. --size is that of one eye's "
          "picture (2048x2048, or 4096x2048), --stereo how eyes lie in it (side-by-side, or over-under), "
          "and --fov how many degrees the 1080 lines are that looks count by (90)")
      ->type_name("KIND");
  command
      .add_option("--strip", strip,
                  "Degrees of a panorama for which an eye keeps its place, 0.5 to 15: less where --ipd is "
                  "large or things are near, and their edges have steps")
      ->capture_default_str();
  command.add_option("--time", time, "Seconds (default: 0)");
  command
      .add_option(
          "--frames", frames,
          "A range of frames; frame n is at n / fps seconds (default for films: as long as clips play)")
      ->type_name("A..B");
  command.add_option("--fps", fps, "Frames a second")->capture_default_str();
  command.add_option(
      "--quality", quality,
      "JPEG: 1 to 100 (default 92), WebP: 0 to 100, which is lossless (90), higher is better; films, "
      "constant quality, lower is better: MP4 0 to 51 (16), WebM 0 to 63 (20)");
  command.add_option("--exr", exr, "EXR: float or half (facts stay float), zip or piz")
      ->capture_default_str();
  command
      .add_option(
          "--svg", svg,
          "SVG: outlines, as wide as lines are, or centerlines, for plotters; and hidden for hidden ones")
      ->capture_default_str();
  std::string names;
  for (const std::string& name : Renderer::aovNames()) names += (names.empty() ? "" : ", ") + name;
  command
      .add_option("--aov", aovs,
                  "Also write a pass's output, into the EXR as layers or beside another picture as "
                  "NAME.AOV.exr: all, "
                  "or some of " +
                      names)
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--background", background,
                     "What is behind everything: a colour (#RRGGBB, #RGB or a name of CSS), transparent, or "
                     "a picture (.png, .jpg, .webp) or film; "
                     "before those, the ground shows only the shadows on it");
  command_ = &command;
}

void RenderArguments::addCallTo(CLI::App& command) {
  command.add_flag("--resume", resume,
                   "Leave out frames whose files are there, whole, or that a film has (.mp4, .webm)");
  command.add_flag(
      "--missing", missing,
      "Draw nothing: name the frames whose files are not there, whole (exit code 3 where there are any)");
  command.add_option("--stats", stats, "Write JSON with milliseconds of each pass, counts and memory")
      ->type_name("FILE");
  command
      .add_option("--graph", graph,
                  "Write the steps of a frame, with what each reads and writes, for Graphviz (dot -Tsvg)")
      ->type_name("FILE");
  command.add_flag("--quiet", quiet, "No warnings and no progress");
}

}  // namespace scumble::app
