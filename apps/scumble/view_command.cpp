// `scumble view`: a window in which scenes are looked at.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "../viewer/viewer.h"
#include "commands.h"
#include "options.h"
#include "report.h"

namespace scumble::app {

namespace {

constexpr int kFilmRate = 24;  // of films that are saved from the window

struct ViewArguments {
  SceneArguments scene;
  LookArguments look;
  PictureArguments picture;
  double time = 0;  // seconds
  std::string shaders;
};

using Files = std::vector<std::string>;

// What belongs to the scenes that were named on the command line holds as long as they are there.
SceneArguments sceneOf(const ViewArguments& args, const Files& files) {
  SceneArguments scene = args.scene;
  const bool isThere =
      files.size() >= scene.files.size() && std::equal(scene.files.begin(), scene.files.end(), files.begin());
  if (!isThere) scene.places.clear(), scene.sceneNumber.reset();
  scene.files = files;
  return scene;
}

LookArguments lookOf(const ViewArguments& args, const viewer::Opened& opened) {
  LookArguments look = args.look;
  look.look = opened.look;
  if (opened.scenes[0] != args.scene.files[0]) look.clip.clear();
  if (!opened.clip.empty()) look.clip = opened.clip;
  return look;
}

// Where the look comes from, or would come from if somebody saved one beside the scene.
viewer::OwnLook ownLookOf(const ViewArguments& args, const Files& files) {
  const std::string name = args.look.lookFor(files[0]);
  if (isLookFile(name)) return {name, name};
  return {name, std::filesystem::path(files[0]).replace_extension(".look.json").string()};
}

Result<Look> loadLook(const ViewArguments& args, const Scene& scene, const viewer::Opened& opened) {
  const LookArguments from = lookOf(args, opened);
  Result<Look> look = from.load(opened.scenes[0], false);
  if (look) look = from.withClip(*look, scene);
  if (look) from.warnOfIdle(*look, scene, opened.scenes[0]);
  return look;
}

Files commandOf(const ViewArguments& args, const viewer::Shown& shown) {
  Files words{"scumble", "render"};
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  const SceneArguments scene = sceneOf(args, shown.opened.scenes);
  const LookArguments look = lookOf(args, shown.opened);
  words.insert(words.end(), scene.files.begin(), scene.files.end());
  for (const std::string& place : scene.places) add("--place", place);
  if (scene.sceneNumber) add("--scene", std::to_string(*scene.sceneNumber));
  if (scene.patternCoordinates != "auto") add("--pattern-coordinates", scene.patternCoordinates);
  if (scene.allowOutside) words.emplace_back("--allow-outside");
  add("--look", look.look), add("--clip", look.clip);
  for (const std::string& setting : look.settings) add("--set", setting);
  for (const auto& [path, value] : shown.edits) add("--set", path + "=" + value);
  add("--background", shown.opened.background);
  // As few digits as mean the same: near (0, 0, 0) hands give places in single precision.
  const auto digits = [](double number) {
    const auto single = float(number);
    return double(single) == number ? fmt::format("{}", single) : fmt::format("{}", number);
  };
  const auto point = [&](const glm::dvec3& p) { return digits(p.x) + "," + digits(p.y) + "," + digits(p.z); };
  std::optional<float> roll = args.picture.roll, field = args.picture.fov;
  if (!shown.viewpoint) {
    add("--camera", args.picture.camera), add("--frame", args.picture.frame),
        add("--orbit", args.picture.orbit);
    add("--eye", args.picture.eye), add("--target", args.picture.target);
  } else {
    const Viewpoint& from = *shown.viewpoint;
    add("--camera", from.camera), add("--frame", from.frame);
    if (from.orbit) add("--orbit", fmt::format("{},{}", from.azimuth, from.elevation));
    if (from.eye) add("--eye", point(*from.eye)), add("--target", point(*from.target));
    roll = from.roll, field = from.verticalFov;
  }
  if (roll) add("--roll", fmt::format("{}", *roll));
  if (field) add("--fov", fmt::format("{}", *field));
  if (shown.film) {
    if (shown.film->isTurn)
      add("--turntable", fmt::format("{}", shown.film->seconds));
    else
      add("--frames",
          fmt::format("0..{}", std::max(0, int(std::lround(shown.film->seconds * kFilmRate)) - 1)));
    add("--fps", std::to_string(kFilmRate));
  } else if (shown.time != 0) {
    add("--time", fmt::format("{}", shown.time));
  }
  if (!shown.stereo.empty()) {
    add("--stereo", shown.stereo);
    if (args.picture.ipdOption->count() > 0) add("--ipd", fmt::format("{}", args.picture.ipd));
  }
  add("--size", fmt::format("{}x{}", shown.width, shown.height));
  if (args.picture.samples != 4) add("--samples", std::to_string(args.picture.samples));
  if (args.picture.seed != 0) add("--seed", std::to_string(args.picture.seed));
  add("--device", args.picture.device);
  return words;
}

// The scene that comes with the program: beside it where it was built, and where it was installed.
std::string demoScene() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* const place : {"share/scumble/demo.glb", "../share/scumble/demo.glb"})
    if (std::filesystem::exists(folder / place, error)) return (folder / place).lexically_normal().string();
  return "";
}

int run(ViewArguments args) {
  if (args.scene.files.empty()) {
    const std::string demo = demoScene();
    if (demo.empty()) return failUsage("there is no scene to show", "give one: scumble view boat.glb");
    args.scene.files.push_back(demo);
  }
  if (!(std::abs(args.time) < Renderer::kMaxTime))
    return failUsage("--time is out of range", "use a time within a million seconds");
  const Result<RenderOptions> options = args.picture.renderOptions();
  if (!options) return fail(options.error());
  if (options->width == 0 || options->height == 0)
    return failUsage("'" + args.picture.size + "' has no area", "write it like 1280x720");
  const Result<Viewpoint> viewpoint = args.picture.viewpoint();
  if (!viewpoint) return fail(viewpoint.error());
  viewer::ViewerOptions view;
  view.sources.opened.scenes = args.scene.files;
  // One that is asked for is chosen, as in the window: the scene's own is another.
  view.sources.opened.look = std::exchange(args.look.look, "");
  view.sources.loadScene = [&](const Files& files, const scumble::Progress& progress) {
    SceneOptions reading;
    reading.progress = progress;
    // They are read while somebody writes them.
    reading.mapsFiles = false;
    return sceneOf(args, files).load(false, reading);
  };
  view.sources.loadLook = [&](const Scene& scene, const viewer::Opened& opened) {
    return loadLook(args, scene, opened);
  };
  view.sources.ownLook = [&](const Files& files) { return ownLookOf(args, files); };
  view.command = [&](const viewer::Shown& shown) { return commandOf(args, shown); };
  view.viewpoint = *viewpoint;
  view.time = args.time;
  view.width = options->width, view.height = options->height;
  view.samples = options->samples, view.seed = options->seed;
  view.stereo = args.picture.stereo, view.ipd = args.picture.ipd;
  view.renderer = args.picture.rendererOptions();
  view.shaderBuild = args.shaders;
  view.stateFolder = stateFolder();
  const Status status = viewer::runViewer(view);
  return status ? kDone : fail(status.error());
}

}  // namespace

void addView(CLI::App& program, int& exitCode) {
  const auto args = std::make_shared<ViewArguments>();
  CLI::App* const command =
      program.add_subcommand("view", "A window: look at scenes, move the camera, play clips");
  args->scene.addTo(*command, "the demo");
  args->look.addTo(*command);
  args->picture.addTo(*command);
  args->picture.addStereoTo(*command);
  command->add_option("--time", args->time, "Seconds at which it begins")->capture_default_str();
  command
      ->add_option("--shaders", args->shaders,
                   "A folder of a build, whose shaders are read anew as they are saved")
      ->type_name("BUILD");
  command->footer(
      "Example: scumble view boat.glb --look dusk\nIn the window, H shows what keys and mouse do.");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
