// scumble paint: strokes for meshes that have none.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "commands.h"
#include "options.h"
#include "output_files.h"
#include "progress.h"
#include "report.h"
#include "scumble/paint.h"

namespace scumble::app {

namespace {

struct PaintArguments {
  std::string scene, out, direction, flow = "curvature";
  PaintOptions options;
  std::optional<float> size, height;
  LookArguments look;
  bool underLook = false;
  std::string device;
  bool quiet = false;
};

int run(const PaintArguments& args) {
  PaintOptions options = args.options;
  if (args.size) options.size = *args.size;
  if (args.size && *args.size == 0)
    return failUsage("--stroke 0 paints nothing", "leave it out, or give a size");
  if (args.height) options.height = *args.height;
  if (args.height && *args.height < 0) return failUsage("--height is below 0", "give 0 or more");
  if (args.flow == "direction")
    options.flow = PaintFlow::direction;
  else if (args.flow != "curvature")
    return failUsage("--flow '" + args.flow + "' is not known", "it is curvature or direction");
  if (!args.direction.empty()) {
    const std::optional<std::vector<double>> numbers = parseNumbers(args.direction);
    if (!numbers || numbers->size() != 3)
      return failUsage("--direction '" + args.direction + "' is no direction", "write it like 0,-1,0");
    options.direction = glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
  }
  const std::string out =
      args.out.empty() ? std::filesystem::path(args.scene).stem().string() + ".painted.glb" : args.out;
  if (endingOf(out) != ".glb")
    return failUsage("a painting cannot go into '" + out + "'", "name it like painted.glb");
  OutputFiles files({args.scene});
  if (const Status status = files.add(out, "-o"); !status) return fail(status.error());
  // Colours of a look are drawn.
  std::optional<Look> look;
  std::unique_ptr<Renderer> renderer;
  if (!args.underLook && (!args.look.look.empty() || !args.look.settings.empty() || !args.device.empty()))
    return failUsage("a look counts for nothing without --under-look", "add that, or leave the look out");
  if (args.underLook) {
    Result<Look> loaded = args.look.load(args.scene, args.quiet);
    if (!loaded) return fail(loaded.error());
    look = std::move(loaded).value();
    RendererOptions how;
    how.device = args.device, how.cacheFolder = cacheFolder();
    Result<std::unique_ptr<Renderer>> made = Renderer::create(how);
    if (!made) return fail(made.error());
    renderer = std::move(made).value();
    options.renderer = renderer.get(), options.look = &*look;
  }
  constexpr int kSteps = 100;
  std::optional<Progress> progress;
  int done = 0;
  options.progress = [&](double part) {
    if (!progress) progress.emplace(kSteps, args.quiet);
    for (; done < int(part * kSteps); ++done) progress->done("painting");
    return true;
  };
  const Result<PaintReport> report = paintScene(args.scene, out, options);
  progress.reset();
  if (!report) return fail(report.error());
  if (args.quiet) return kDone;
  warn(report->warnings);
  std::puts(fmt::format("{}: {} strokes of {} points on {} mesh{}, {} splats", out, report->strokes,
                        report->points, report->meshes, report->meshes == 1 ? "" : "es", report->splats)
                .c_str());
  return kDone;
}

}  // namespace

void addPaint(CLI::App& program, int& exitCode) {
  auto args = std::make_shared<PaintArguments>();
  CLI::App* command = program.add_subcommand("paint", "Strokes for a mesh that has none");
  std::string styles;
  for (const PaintStyle& style : paintStyles())
    styles += fmt::format("{}{}: {}", styles.empty() ? "" : "; ", style.name, style.meaning);
  command->add_option("SCENE", args->scene, "A glTF 2.0 file (.gltf or .glb)")->required();
  command->add_option("-o", args->out, "Where it is written (default: the scene's name + .painted.glb)")
      ->type_name("OUT.glb");
  command->add_option("--style", args->options.style, "How strokes are laid. " + styles)
      ->type_name("NAME")
      ->capture_default_str();
  command->add_option("--splats", args->options.splats, "About how many splats in all, 1 to 4000000")
      ->capture_default_str();
  command->add_option(
      "--stroke", args->size,
      "Half the width of the largest strokes, in parts of the mesh's radius (default: the style's)");
  command->add_option("--height", args->height,
                      "How far from the surface the outermost strokes go, in parts of the mesh's radius "
                      "(default: the style's)");
  command
      ->add_option("--flow", args->flow,
                   "What strokes follow: where the surface bends least (curvature), or a direction")
      ->type_name("curvature|direction")
      ->capture_default_str();
  command
      ->add_option("--direction", args->direction,
                   "Where they go, or the side to which they go along the curvature (default: 0,-1,0)")
      ->type_name("X,Y,Z");
  command->add_option("--variation", args->options.variation, "Of colours, sizes and directions, 0 to 1")
      ->capture_default_str();
  command->add_flag("--under-look", args->underLook,
                    "Take colours from the picture under the look, light and shadow with them, and not from "
                    "the mesh's materials");
  command->add_option("--look", args->look.look, "With --under-look: as of `scumble render`");
  command->add_option("--set", args->look.settings, "With --under-look: any knob; repeatable")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command->add_option("--device", args->device, "With --under-look: which GPU draws")
      ->type_name("NAME|N|cpu");
  command->add_option("--nodes", args->options.nodes,
                      "Paint the meshes of these nodes alone (a name or pattern)");
  command->add_option("--seed", args->options.seed, "Another one gives other strokes")->capture_default_str();
  command->add_flag("--allow-outside", args->options.allowOutside,
                    "Let paths in the scene lead out of its folder");
  command->add_flag("--quiet", args->quiet, "No warnings and no progress");
  command->footer("Example: scumble paint cat.glb --style fur -o painted.glb && scumble render painted.glb");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
