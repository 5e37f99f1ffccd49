// `scumble xr`: a scene in a headset.
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "../viewer/picture_window.h"
#include "commands.h"
#include "interruption.h"
#include "options.h"
#include "output_files.h"
#include "output_format.h"
#include "recorder.h"
#include "report.h"
#include "xr/show.h"

namespace scumble::app {

namespace {

struct XrArguments {
  SceneArguments scene;
  LookArguments look;
  PictureArguments picture;
  double time = 0;  // seconds
  bool standing = false, vignette = true, quiet = false;
  float scale = 1, rate = 90;
  std::string resolution = "auto", synthesis = "off";
  bool spectator = false;
  std::string output, size = "1280x720";
  double fps = 30, steady = 0.3, ready = 3;  // steady, ready: seconds
  std::optional<uint64_t> frames;
};

// What those who do not wear the headset see, and where it goes: a window, a film, or both.
struct Onlookers {
  std::unique_ptr<viewer::PictureWindow> window;
  std::unique_ptr<Recorder> film;
  bool isFilmLost = false;
};

Result<xr::Spectator> spectatorOf(const XrArguments& args) {
  const auto size = parseSize(args.size);
  if (!size || size->first < 16 || size->second < 16 || size->first > 8192 || size->second > 8192)
    return usage("--size " + args.size + " makes no sense", "use 16x16 to 8192x8192 pixels, like 1280x720");
  if (!(args.steady >= 0 && args.steady <= 60))
    return usage("--steady is out of range", "use 0 (as the head goes) to 60 seconds");
  if (!args.output.empty()) {
    const Result<const OutputFormat*> format = formatOf(args.output);
    if (!format) return format.error();
    if ((*format)->kind != OutputKind::film)
      return usage(args.output + " is no film", "record into .mp4, .webm or .gif");
  }
  xr::Spectator spectator;
  spectator.size = {size->first, size->second};
  spectator.inertia = float(args.steady);
  return spectator;
}

// Nothing where nobody looks on.
Status openFor(Onlookers& onlookers, const XrArguments& args, const xr::Spectator& spectator,
               const std::vector<std::string>& inputs) {
  if (!args.output.empty()) {
    const OutputFormat* const format = *formatOf(args.output);
    OutputFiles files(inputs);
    if (Status status = files.add(args.output, "-o"); !status) return status.error();
    FilmOptions film;
    film.format = format->film, film.fps = args.fps;
    film.width = spectator.size.x, film.height = spectator.size.y;
    Result<std::unique_ptr<Recorder>> recorder = Recorder::create(args.output, film);
    if (!recorder) return recorder.error();
    onlookers.film = std::move(recorder).value();
  }
  if (!args.spectator) return Done{};
  auto window =
      viewer::PictureWindow::open("What the headset sees", spectator.size, args.picture.rendererOptions());
  if (!window) {
    Error error = window.error();
    error.advice = "leave out --spectator";
    return error;
  }
  onlookers.window = std::move(window).value();
  return Done{};
}

// The window is of the thread that the program began with, as platforms want it; the headset is of another
// one then.
Result<xr::ShowReport> showTo(xr::Headset& headset, const xr::ShowOptions& show,
                              viewer::PictureWindow* window) {
  if (!window) return headset.show(show);
  std::optional<Result<xr::ShowReport>> report;
  std::thread shower([&] {
    try {
      report.emplace(headset.show(show));
    } catch (const std::exception& failure) {
      report.emplace(Error{ErrorKind::internal, "", 0, "", failure.what(), "please report this"});
    }
    window->end();
  });
  const Status seen = window->run();
  if (!seen && show.tell) show.tell("the window is closed: " + seen.error().problem);
  shower.join();
  return *std::move(report);
}

int run(const XrArguments& args) {
  if (!(std::abs(args.time) < Renderer::kMaxTime))
    return failUsage("--time is out of range", "use a time within a million seconds");
  if (!(args.scale >= 1e-3f && args.scale <= 1e3f))
    return failUsage("--scale is out of range", "use 0.001 to 1000 metres of the scene for one of the room");
  if (!(args.rate >= 0 && args.rate <= 1000))
    return failUsage("--rate is out of range", "use 0 (as the headset has it) to 1000 frames a second");
  std::optional<float> resolution;
  if (args.resolution != "auto") {
    const auto numbers = parseNumbers(args.resolution);
    if (!numbers || numbers->size() != 1 || !(numbers->front() >= 0.1 && numbers->front() <= 1))
      return failUsage("--resolution " + args.resolution + " makes no sense",
                       "use auto, or 0.1 to 1 of the headset's pixels each way");
    resolution = float(numbers->front());
  }
  if (!(args.fps >= 1 && args.fps <= 120))
    return failUsage("--fps is out of range", "use 1 to 120 pictures a second");
  if (!(args.ready >= 0 && args.ready <= 3600))
    return failUsage("--ready is out of range", "use 0 to 3600 seconds");
  const Result<xr::Spectator> spectator = spectatorOf(args);
  if (!spectator) return fail(spectator.error());
  const Result<RenderOptions> quality = args.picture.renderOptions();
  if (!quality) return fail(quality.error());
  const Result<Viewpoint> viewpoint = args.picture.viewpoint();
  if (!viewpoint) return fail(viewpoint.error());
  // Without a headset nothing needs to be read.
  const auto headset = xr::Headset::find();
  if (!headset) return fail(headset.error());
  if ((*headset)->lack()) return fail(*(*headset)->lack());

  Result<Look> look = args.look.load(args.scene.files[0], args.quiet);
  if (!look) return fail(look.error());
  const Result<Scene> scene = args.scene.load(args.quiet);
  if (!scene) return fail(scene.error());
  look = args.look.withClip(*look, *scene);
  if (!look) return fail(look.error());
  if (!args.quiet) args.look.warnOfIdle(*look, *scene, args.scene.files[0]);

  xr::ShowOptions show;
  show.scene = *scene, show.viewpoint = *viewpoint;
  show.looks.emplace_back(args.look.lookFor(args.scene.files[0]), *look);
  for (const ShippedLook& shipped : Look::shipped()) {
    if (shipped.name == show.looks.front().first) continue;
    LookArguments other = args.look;
    other.look = shipped.name;
    Result<Look> loaded = other.load(args.scene.files[0], true);
    if (loaded) loaded = other.withClip(*loaded, *scene);
    if (!loaded) return fail(loaded.error());
    show.looks.emplace_back(shipped.name, std::move(loaded).value());
  }
  // Cameras are looks' as well.
  for (const auto& [name, each] : show.looks) {
    const auto views = makeViews(*scene, *viewpoint, 1, Stereo::mono, 0, each, args.time);
    if (!views) return fail(views.error());
  }
  show.time = args.time;
  show.isStanding = args.standing, show.hasVignette = args.vignette;
  show.scale = args.scale, show.refreshRate = args.rate;
  show.resolution = resolution;
  show.synthesis = args.synthesis == "on"     ? xr::FrameSynthesis::on
                   : args.synthesis == "auto" ? xr::FrameSynthesis::whenLate
                                              : xr::FrameSynthesis::off;
  show.readying = args.ready;
  Onlookers onlookers;
  if (args.spectator || !args.output.empty()) {
    std::vector<std::string> inputs = args.scene.files;
    inputs.insert(inputs.end(), scene->files().begin(), scene->files().end());
    if (Status status = openFor(onlookers, args, *spectator, inputs); !status) return fail(status.error());
    show.spectator = *spectator;
    show.spectator->see = [&](const std::shared_ptr<const Image>& picture, double seconds) {
      if (onlookers.film && !onlookers.isFilmLost) {
        const Status status = onlookers.film->see(picture, seconds);
        onlookers.isFilmLost = !status.ok();
        if (!status && show.tell) show.tell("the film is lost: " + status.error().problem);
      }
      if (onlookers.window) onlookers.window->show(picture);
    };
  }
  show.samples = quality->samples, show.seed = quality->seed;
  show.renderer = args.picture.rendererOptions();
  show.frames = args.frames;
  show.isEnding = [] { return Interruption::came(); };
  if (!args.quiet)
    show.tell = [](const std::string& line) { std::fprintf(stderr, "scumble: %s\n", line.c_str()); };
  // What hands have changed is what this leaves behind: for scripts, too.
  show.changed = [](const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  };
  std::optional<Interruption> interruption(std::in_place);
  const Result<xr::ShowReport> report = showTo(**headset, show, onlookers.window.get());
  interruption.reset();
  // What was seen until something went wrong is kept as well.
  std::optional<Result<Recorder::Report>> film;
  const bool wasSeen = !report || report->frames > 0;
  if (onlookers.film && wasSeen) film = onlookers.film->finish();
  if (film && *film && (*film)->leftOut > 0 && show.tell)
    show.tell(std::to_string((*film)->leftOut) + " of the film's " + std::to_string((*film)->pictures) +
              " pictures came too fast for it; those before them stand longer");
  if (!report) return fail(report.error());
  if (film && !*film) return fail(film->error());
  if (onlookers.film && !wasSeen)
    return fail(Error{ErrorKind::outputNotWritten, args.output, 0, "",
                      "no frame was seen, so there is no film", "let it run for a while"});
  if (report->validationMessages > 0)
    return fail(
        Error{ErrorKind::internal, "", 0, "", "the validation layers found mistakes", "please report them"});
  // Taking the headset off is the usual end; a signal may cut a film short.
  if (!film || !Interruption::came()) return kDone;
  std::fprintf(stderr, "scumble: ended by %s: %s holds what was seen until then\n", Interruption::name(),
               args.output.c_str());
  return Interruption::exitCode();
}

}  // namespace

void addXr(CLI::App& program, int& exitCode) {
  const auto args = std::make_shared<XrArguments>();
  CLI::App* const command = program.add_subcommand("xr", "A headset (OpenXR): stand inside of a scene");
  args->scene.addTo(*command);
  args->look.addTo(*command);
  args->picture.addStandpointTo(*command);
  args->picture.addQualityTo(*command);
  command->add_option("--time", args->time, "Seconds at which it begins")->capture_default_str();
  command->add_flag(
      "--standing", args->standing,
      "The floor of your room lies 1.6 m below the camera; else your head is where the camera is");
  command->add_option("--scale", args->scale, "Metres of the scene that are one of your room")
      ->capture_default_str();
  command->add_flag("--vignette,!--no-vignette", args->vignette,
                    "Whether it is dark around what you look at while a stick moves you (default: it is)");
  command->add_option("--rate", args->rate, "Frames a second, as near as the headset has it; 0: as it is")
      ->capture_default_str();
  command
      ->add_option("--resolution", args->resolution,
                   "Of the headset's pixels, each way: 0.1 to 1, or auto: as many as there is time for, from "
                   "half of them on")
      ->capture_default_str();
  command
      ->add_option(
          "--synthesis", args->synthesis,
          "Half of the frames are made by the runtime, where it can do that: off, on, or auto: from when "
          "on there is no time even for half of the pixels")
      ->check(CLI::IsMember({"off", "on", "auto"}))
      ->capture_default_str();
  command->add_flag("--spectator", args->spectator, "A window for those who do not wear the headset");
  command->add_option("-o,--output", args->output, "Record what such a window shows: .mp4, .webm or .gif");
  command->add_option("--size", args->size, "Pixels of that window and that film")->capture_default_str();
  command->add_option("--fps", args->fps, "Pictures a second of the film")->capture_default_str();
  command
      ->add_option("--steady", args->steady,
                   "How steady the head is that they see by: seconds in which it comes nearer by two thirds")
      ->capture_default_str();
  command
      ->add_option(
          "--ready", args->ready,
          "Seconds for making other looks ready beforehand; those that are not are made as they are taken")
      ->capture_default_str();
  command->add_option("--frames", args->frames, "End when so many were drawn")->check(CLI::NonNegativeNumber);
  command->add_flag("--quiet", args->quiet, "No warnings, and nothing about the headset");
  command->footer("Example: scumble xr boat.glb --look age-of-sail --standing");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
