// scumble bake: fin textures for a painting.
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
#include "scumble/bake.h"

namespace scumble::app {

namespace {

struct BakeArguments {
  std::string painting, out;
  std::vector<std::string> parts;
  BakeOptions options;
  bool points = false, quiet = false;
};

// "MATERIALS:offset=0.2;start=0.8;end=0.3;layers=4".
std::optional<BakePart> parsePart(const std::string& text) {
  const size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  BakePart part;
  part.materials = text.substr(0, colon);
  for (size_t at = colon + 1; at < text.size();) {
    const size_t end = std::min(text.find(';', at), text.size()), equals = text.find('=', at);
    if (equals == std::string::npos || equals >= end) return std::nullopt;
    const std::string name = text.substr(at, equals - at);
    const std::optional<std::vector<double>> value = parseNumbers(text.substr(equals + 1, end - equals - 1));
    if (!value || value->size() != 1) return std::nullopt;
    const float number = float(value->front());
    if (number < 0) return std::nullopt;
    if (name == "offset")
      part.offset = number;
    else if (name == "start")
      part.fadeStart = number;
    else if (name == "end")
      part.fadeEnd = number;
    else if (name == "layers" && number >= 1 && number <= 16 && number == float(int(number)))
      part.layers = int(number);
    else
      return std::nullopt;
    at = end + 1;
  }
  return part;
}

int runPoints(const BakeArguments& args, const std::string& out) {
  PointsOptions options;
  options.allowOutside = args.options.allowOutside;
  const Result<PointsReport> report = writePoints(args.painting, out, options);
  if (!report) return fail(report.error());
  if (args.quiet) return kDone;
  warn(report->warnings);
  std::puts(fmt::format("{}: {} points", out, report->points).c_str());
  return kDone;
}

int run(const BakeArguments& args) {
  BakeOptions options = args.options;
  for (const std::string& text : args.parts) {
    const std::optional<BakePart> part = parsePart(text);
    if (!part)
      return failUsage("--part '" + text + "' is none",
                       "write it like 'Tail*:offset=0.2;start=0.8;end=0.3;layers=2'");
    options.parts.push_back(*part);
  }
  const std::string out = args.out.empty() ? std::filesystem::path(args.painting).stem().string() +
                                                 (args.points ? ".points.glb" : ".fins.glb")
                                           : args.out;
  if (endingOf(out) != ".glb")
    return failUsage((args.points ? "points cannot go into '" : "fins cannot go into '") + out + "'",
                     args.points ? "name it like points.glb" : "name it like fins.glb");
  OutputFiles files(args.options.proxy.empty() ? std::vector{args.painting}
                                               : std::vector{args.painting, args.options.proxy});
  if (const Status status = files.add(out, "-o"); !status) return fail(status.error());
  if (args.points) return runPoints(args, out);
  constexpr int kSteps = 100;
  std::optional<Progress> progress;
  int done = 0;
  options.progress = [&](double part) {
    if (!progress) progress.emplace(kSteps, args.quiet);
    for (; done < int(part * kSteps); ++done) progress->done("baking");
    return true;
  };
  const Result<BakeReport> report = bakeFins(args.painting, out, options);
  progress.reset();
  if (!report) return fail(report.error());
  if (args.quiet) return kDone;
  warn(report->warnings);
  std::puts(
      fmt::format("{}: {} fins, {} triangles and a texture of {} x {} for {} splats on {} mesh{}{}", out,
                  report->fins, report->triangles, report->textureWidth, report->textureHeight,
                  report->splats, report->meshes, report->meshes == 1 ? "" : "es",
                  report->resumed > 0 ? fmt::format("; {} pieces were there already", report->resumed) : "")
          .c_str());
  return kDone;
}

}  // namespace

void addBake(CLI::App& program, int& exitCode) {
  auto args = std::make_shared<BakeArguments>();
  CLI::App* command =
      program.add_subcommand("bake", "Fin textures: a painting as a mesh that draws in real time");
  command
      ->add_option("PAINTING", args->painting,
                   "A glTF with strokes (scumble paint makes them), .tilt or .apa")
      ->required();
  command
      ->add_option("-o", args->out,
                   "Where it is written (default: the painting's name + .fins.glb, or .points.glb)")
      ->type_name("OUT.glb");
  command
      ->add_option(
          "--proxy", args->options.proxy,
          "A glTF around whose meshes the strokes lie (default: the painting's own meshes, or a hull)")
      ->type_name("MESH.glb");
  command
      ->add_option("--hull-cells", args->options.hullCells,
                   "Where a painting has no meshes: cells along the longest side of its hull, 8 to 256")
      ->capture_default_str();
  command
      ->add_option("--texture", args->options.textureSize,
                   "A side of each mesh's texture, at most: 64 to 8192 texels")
      ->capture_default_str();
  command
      ->add_option("--layers", args->options.layers,
                   "Shells of paint over the surface, 1 to 16: more for sparse, long strokes such as grass")
      ->capture_default_str();
  command
      ->add_option("--fade-start", args->options.fadeStart,
                   "Where fins begin to show, as 1 - |cosine| of how they face the viewer")
      ->capture_default_str();
  command->add_option("--fade-end", args->options.fadeEnd, "Where they are there in full; less than that")
      ->capture_default_str();
  command
      ->add_option(
          "--orders", args->options.orders,
          "Orders of triangles for engines that sort objects alone, by where the viewer is: 0, 6, 8 or 14")
      ->capture_default_str();
  command
      ->add_option("--part", args->parts,
                   "Other numbers for what is made of materials of this name or pattern; repeatable")
      ->type_name("MATERIALS:KEY=VALUE;...")
      ->allow_extra_args(false);
  CLI::Option* const points =
      command->add_flag("--points", args->points,
                        "Instead of fins, a cloud of points as viewers of KHR_gaussian_splatting show it");
  command->add_flag("--allow-outside", args->options.allowOutside,
                    "Let paths in the scene lead out of its folder");
  for (const char* fins : {"--proxy", "--hull-cells", "--texture", "--layers", "--fade-start", "--fade-end",
                           "--orders", "--part"})
    points->excludes(fins);
  command->add_flag("--quiet", args->quiet, "No warnings and no progress");
  command->footer("Example: scumble bake painted.glb -o fins.glb && scumble render fins.glb");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
