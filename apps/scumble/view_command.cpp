// `scumble view`: a window in which scenes are looked at.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "../viewer/viewer.h"
#include "commands.h"
#include "options.h"
#include "report.h"

namespace scumble::app {

namespace {

struct ViewArguments {
  SceneArguments scene;
  LookArguments look;
  PictureArguments picture;
  double time = 0;  // seconds
};

// Where the look comes from, or would come from if somebody saved one beside the scene.
std::string lookFileOf(const ViewArguments& args) {
  std::string name = args.look.lookFor(args.scene.files[0]);
  if (name.find('/') != std::string::npos || endingOf(name) == ".json") return name;
  return std::filesystem::path(args.scene.files[0]).replace_extension(".look.json").string();
}

// As a shell takes it.
std::string quoted(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

std::string commandOf(const ViewArguments& args, const viewer::Shown& shown) {
  std::string text = "scumble render";
  const auto add = [&](const std::string& option, const std::string& value) {
    if (!value.empty()) text += " " + option + " " + quoted(value);
  };
  for (const std::string& file : args.scene.files) text += " " + quoted(file);
  for (const std::string& place : args.scene.places) add("--place", place);
  if (args.scene.sceneNumber) add("--scene", std::to_string(*args.scene.sceneNumber));
  if (args.scene.patternCoordinates != "auto") add("--pattern-coordinates", args.scene.patternCoordinates);
  if (args.scene.allowOutside) text += " --allow-outside";
  add("--look", shown.look.empty() ? args.look.look : shown.look), add("--clip", args.look.clip);
  for (const std::string& setting : args.look.settings) add("--set", setting);
  for (const auto& [path, value] : shown.edits) add("--set", path + "=" + value);
  const auto point = [](const glm::vec3& p) { return fmt::format("{},{},{}", p.x, p.y, p.z); };
  std::optional<float> roll = args.picture.roll, field = args.picture.fov;
  if (!shown.viewpoint) {
    add("--camera", args.picture.camera), add("--frame", args.picture.frame),
        add("--orbit", args.picture.orbit);
    add("--eye", args.picture.eye), add("--target", args.picture.target);
  } else {
    const Viewpoint& from = *shown.viewpoint;
    if (from.orbit) add("--orbit", fmt::format("{},{}", from.azimuth, from.elevation));
    if (from.eye) add("--eye", point(*from.eye)), add("--target", point(*from.target));
    roll = from.roll, field = from.verticalFov;
  }
  if (roll) add("--roll", fmt::format("{}", *roll));
  if (field) add("--fov", fmt::format("{}", *field));
  if (shown.time != 0) add("--time", fmt::format("{}", shown.time));
  add("--size", fmt::format("{}x{}", shown.width, shown.height));
  if (args.picture.samples != 4) add("--samples", std::to_string(args.picture.samples));
  if (args.picture.seed != 0) add("--seed", std::to_string(args.picture.seed));
  add("--device", args.picture.device);
  return text;
}

int run(const ViewArguments& args) {
  if (!(std::abs(args.time) < Renderer::kMaxTime))
    return failUsage("--time is out of range", "use a time within a million seconds");
  const Result<RenderOptions> options = args.picture.renderOptions();
  if (!options) return fail(options.error());
  if (options->width == 0 || options->height == 0)
    return failUsage("'" + args.picture.size + "' has no area", "write it like 1280x720");
  const Result<Viewpoint> viewpoint = args.picture.viewpoint();
  if (!viewpoint) return fail(viewpoint.error());
  args.picture.warnOfIdle();

  viewer::ViewerOptions view;
  view.title = std::filesystem::path(args.scene.files[0]).filename().string();
  view.sources.sceneFiles = args.scene.files;
  view.sources.lookName = args.look.lookFor(args.scene.files[0]);
  view.sources.lookFile = lookFileOf(args);
  view.sources.loadScene = [&] { return args.scene.load(false); };
  view.sources.loadLook = [&](const Scene& scene, const std::string& name) -> Result<Look> {
    LookArguments from = args.look;
    if (!name.empty()) from.look = name;
    Result<Look> look = from.load(args.scene.files[0], false);
    if (look) look = from.withClip(*look, scene);
    if (look) from.warnOfIdle(*look, scene, args.scene.files[0]);
    return look;
  };
  view.command = [&](const viewer::Shown& shown) { return commandOf(args, shown); };
  view.viewpoint = *viewpoint;
  view.time = args.time;
  view.width = options->width, view.height = options->height;
  view.samples = options->samples, view.seed = options->seed;
  view.renderer = args.picture.rendererOptions();
  const Status status = viewer::runViewer(view);
  return status ? kDone : fail(status.error());
}

}  // namespace

void addView(CLI::App& program, int& exitCode) {
  const auto args = std::make_shared<ViewArguments>();
  CLI::App* const command =
      program.add_subcommand("view", "A window: look at scenes, move the camera, play clips");
  args->scene.addTo(*command);
  args->look.addTo(*command);
  args->picture.addTo(*command);
  command->add_option("--time", args->time, "Seconds at which it begins")->capture_default_str();
  command->footer(
      "Example: scumble view boat.glb --look dusk\nIn the window, H shows what keys and mouse do.");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
