// `scumble xr`: a scene in a headset.
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "commands.h"
#include "options.h"
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
  std::string resolution = "auto";
  std::optional<uint64_t> frames;
};

// Somebody at the keyboard wants it to end.
volatile std::sig_atomic_t interrupted = 0;

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
    if (!numbers || numbers->size() != 1 || !(numbers->front() >= 0.1f && numbers->front() <= 1))
      return failUsage("--resolution " + args.resolution + " makes no sense",
                       "use auto, or 0.1 to 1 of the headset's pixels each way");
    resolution = numbers->front();
  }
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
  show.samples = quality->samples, show.seed = quality->seed;
  show.renderer = args.picture.rendererOptions();
  show.frames = args.frames;
  show.isEnding = [] { return interrupted != 0; };
  if (!args.quiet)
    show.tell = [](const std::string& line) { std::fprintf(stderr, "scumble: %s\n", line.c_str()); };
  std::signal(SIGINT, [](int) {
    interrupted = 1;
    // A runtime that does not answer cannot be asked to end; who asks twice means it.
    std::signal(SIGINT, SIG_DFL);
  });
  const Result<xr::ShowReport> report = (*headset)->show(show);
  std::signal(SIGINT, SIG_DFL);
  if (!report) return fail(report.error());
  if (report->validationMessages > 0)
    return fail(
        Error{ErrorKind::internal, "", 0, "", "the validation layers found mistakes", "please report them"});
  return kDone;
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
  command->add_option("--frames", args->frames, "End when so many were drawn");
  command->add_flag("--quiet", args->quiet, "No warnings, and nothing about the headset");
  command->footer("Example: scumble xr boat.glb --look age-of-sail --standing");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
