// The commands that only tell: info, looks, params, schema, devices.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "json_option.h"
#include "options.h"
#include "output_files.h"
#include "report.h"
#include "xr/show.h"

namespace scumble::app {

namespace {

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "-" : text;
}

// The first of many names.
std::string shortened(std::vector<std::string> names) {
  constexpr size_t kMost = 60;
  const size_t more = names.size() - std::min(names.size(), kMost);
  if (more > 0) names.resize(kMost);
  return joined(names) + (more > 0 ? fmt::format(" and {} more (--json has them all)", more) : "");
}

// How many there are, whether or not they have names, and the names of those that do.
std::string counted(std::vector<std::string> names) {
  const size_t all = names.size();
  std::erase(names, "");
  if (all == 0) return "0";
  const std::string unnamed = names.size() < all ? fmt::format("{} unnamed", all - names.size()) : "";
  if (names.empty()) return fmt::format("{}: {}", all, unnamed);
  return fmt::format("{}: {}{}{}", all, shortened(names), unnamed.empty() ? "" : ", ", unnamed);
}

nlohmann::json reportOf(const Scene& scene) {
  const SceneSummary s = scene.summary();
  nlohmann::json clips = nlohmann::json::array();
  for (const auto& clip : s.clips) clips.push_back({{"name", clip.name}, {"duration", clip.duration}});
  return {{"meshes", s.meshes},
          {"primitives", s.primitives},
          {"ownPatterns", s.ownPatterns},
          {"triangles", s.triangles},
          {"vertices", s.vertices},
          {"strokes", s.strokes},
          {"points", s.points},
          {"brushes", s.brushes},
          {"nodes", s.nodes},
          {"nodeNames", s.nodeNames},
          {"materials", s.materialNames},
          {"images", s.images},
          {"skins", s.skins},
          {"morphTargets", s.morphTargets},
          {"clips", clips},
          {"cameras", s.cameras},
          {"lights", s.lights},
          {"extensionsUsed", s.extensionsUsed},
          {"extensionsNotSupported", s.extensionsNotSupported},
          {"bounds", {{"min", s.min}, {"max", s.max}}},
          {"surroundings", s.surroundings},
          {"warnings", scene.warnings()}};
}

int info(const SceneArguments& args, const JsonOption& json) {
  OutputFiles files(args.files);
  if (const Status status = files.add(json.file(), "--json"); !status) return fail(status.error());
  const Result<Scene> scene = args.load(json.isPrinted());
  if (!scene) return fail(scene.error());
  if (const Status status = files.addInputs(scene->files()); !status) return fail(status.error());
  if (const Status status = json.give(reportOf(*scene)); !status) return fail(status.error());
  if (json.isPrinted()) return kDone;
  const SceneSummary s = scene->summary();
  print(fmt::format("meshes      {} ({} primitives, {} triangles, {} vertices)\n", s.meshes, s.primitives,
                    s.triangles, s.vertices));
  print(fmt::format("nodes       {}: {}\nmaterials   {}\nimages      {}\nskins       {}\nmorphs      {}\n",
                    s.nodes, shortened(s.nodeNames), counted(s.materialNames), s.images, s.skins,
                    s.morphTargets));
  if (s.strokes > 0)
    print(
        fmt::format("strokes     {} ({} points; brushes: {})\n", s.strokes, s.points, shortened(s.brushes)));
  std::vector<std::string> clips;
  for (const auto& clip : s.clips) clips.push_back(fmt::format("{} ({:.2f} s)", clip.name, clip.duration));
  print(fmt::format("clips       {}\ncameras     {}\nlights      {}\n", counted(clips), counted(s.cameras),
                    counted(s.lights)));
  print(fmt::format("extensions  {}\n", joined(s.extensionsUsed)));
  if (!s.extensionsNotSupported.empty())
    print(fmt::format("not supported: {}\n", joined(s.extensionsNotSupported)));
  // Six digits, and millimetres however far out the scene stands.
  const auto metres = [](const double(&place)[3]) {
    std::string text;
    for (const double number : place)
      text += (text.empty() ? "" : " ") + (std::abs(number) < 1000
                                               ? fmt::format("{:g}", number)
                                               : fmt::format("{}", std::round(1000 * number) / 1000));
    return text;
  };
  print(fmt::format("bounds      {} to {} metres\n", metres(s.min), metres(s.max)));
  if (s.ownPatterns > 0)
    print(
        fmt::format("patterns    {} of {} primitives have coordinates of their own (--pattern-coordinates)\n",
                    s.ownPatterns, s.primitives));
  if (!s.surroundings.empty())
    print(fmt::format("not framed  {}: far larger than what stands on it (--frame NODE chooses)\n",
                      shortened(s.surroundings)));
  return kDone;
}

// Where else than at its own path a block of knobs may stand in a look.
std::string placesOf(const Knob& knob, const std::string& block) {
  std::string places;
  bool isForScene = false;
  for (const std::string& target : knob.targets) {
    if (target == "scene")
      isForScene = true;
    else
      places += (places.empty() ? "" : ", ") + target + ".PATTERN." + block;
  }
  return places.empty() ? "" : (isForScene ? "  (also " : "  (only ") + places + ")";
}

int params(const std::string& prefix) {
  bool any = false;
  std::string block;
  for (const Knob& knob : Look::knobs()) {
    if (knob.path.compare(0, prefix.size(), prefix) != 0) continue;
    any = true;
    const std::string own = knob.path.substr(0, knob.path.rfind('.'));
    if (own != block) {
      print(fmt::format("{}{}{}\n", block.empty() ? "" : "\n", own, placesOf(knob, own)));
      block = own;
    }
    const bool ranged = knob.type == "number" || knob.type == "integer";
    const std::string range = ranged ? fmt::format("{} .. {} {}", knob.min, knob.max, knob.unit)
                              : knob.type == "choice" ? knob.unit
                              : knob.type == "toggle" ? "true|false"
                              : knob.type == "vector"
                                  ? fmt::format("each {} .. {} {}", knob.min.substr(0, knob.min.find(',')),
                                                knob.max.substr(0, knob.max.find(',')), knob.unit)
                              : knob.type == "name"    ? knob.unit
                              : knob.type == "picture" ? knob.unit + ", or a picture's file"
                                                       : "#RRGGBB";
    print(fmt::format("  {:<24} {:<12} {}\n      {}\n", knob.path.substr(own.size() + 1), knob.defaultValue,
                      range, knob.meaning));
  }
  if (!any)
    return failUsage("no knob's path begins with '" + prefix + "'", "`scumble params` lists them all");
  return kDone;
}

int devices() {
  const Result<std::vector<GpuInfo>> gpus = listGpus("", cacheFolder());
  if (!gpus) return fail(gpus.error());
  bool any = false;
  for (size_t i = 0; i < gpus->size(); ++i) {
    const GpuInfo& gpu = (*gpus)[i];
    print(fmt::format("{} {} {}  Vulkan {}  {}{}\n", gpu.wouldBeUsed ? "*" : " ", i, gpu.name, gpu.apiVersion,
                      gpu.driver,
                      gpu.unusableBecause.empty() ? "" : "  cannot be used: " + gpu.unusableBecause));
    for (const std::string& workaround : gpu.workarounds) print(fmt::format("      {}\n", workaround));
    any |= gpu.wouldBeUsed;
  }
  // Runtimes are other people's programs: what is known is told before.
  std::fflush(stdout);
  const auto headset = xr::Headset::find();
  if (headset && !(*headset)->lack())
    print(fmt::format("headset: {}, on {}\n", (*headset)->name(), (*headset)->runtime()));
  else if (headset)
    print(fmt::format("headset: none, on {}: {}\n", (*headset)->runtime(), (*headset)->lack()->problem));
  else
    print(fmt::format("headset: none: {}\n", headset.error().problem));
  if (!any)
    return fail(Error{ErrorKind::noUsableGpu, "", 0, "", "no usable Vulkan 1.3 device was found",
                      "the package mesa-vulkan-drivers has a driver that runs on any CPU"});
  return kDone;
}

}  // namespace

void addDescriptions(CLI::App& program, int& exitCode) {
  struct Arguments {
    SceneArguments scene;
    JsonOption json;
    std::string prefix;
  };
  auto args = std::make_shared<Arguments>();

  CLI::App* infoCommand = program.add_subcommand("info", "What is in a file");
  args->scene.addTo(*infoCommand);
  args->json.addTo(*infoCommand);
  infoCommand->footer("Example: scumble info boat.glb --json");
  infoCommand->callback([args, &exitCode] { exitCode = info(args->scene, args->json); });

  CLI::App* looksCommand = program.add_subcommand("looks", "The looks that ship");
  looksCommand->footer("Example: scumble looks");
  looksCommand->callback([&exitCode] {
    for (const ShippedLook& look : Look::shipped())
      print(fmt::format("{:<16} {}\n", look.name, look.description));
    exitCode = kDone;
  });

  CLI::App* paramsCommand = program.add_subcommand("params", "Every knob: default, range, unit and meaning");
  paramsCommand->add_option("PATH", args->prefix, "Only knobs whose path begins with this");
  paramsCommand->footer("Example: scumble params shadow");
  paramsCommand->callback([args, &exitCode] { exitCode = params(args->prefix); });

  CLI::App* schemaCommand = program.add_subcommand("schema", "The look file's JSON schema");
  schemaCommand->footer("Example: scumble schema > look.schema.json");
  schemaCommand->callback([&exitCode] {
    print(Look::jsonSchema() + "\n");
    exitCode = kDone;
  });

  CLI::App* devicesCommand =
      program.add_subcommand("devices", "The GPUs found, which one would be used, and the headset");
  devicesCommand->footer("Example: scumble devices");
  devicesCommand->callback([&exitCode] { exitCode = devices(); });
}

}  // namespace scumble::app
