// scumble measure: coherence in numbers, for MetaTexture and its rivals.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "chart.h"
#include "commands.h"
#include "json_option.h"
#include "options.h"
#include "output_files.h"
#include "outputs.h"
#include "progress.h"
#include "report.h"
#include "scumble/measure.h"

namespace scumble::app {

namespace {

struct MeasureArguments {
  SceneArguments scene;
  LookArguments look;
  PictureArguments picture;
  std::optional<float> ipd;
  std::string plot;
  std::string lines;                  // an AOV
  std::vector<std::string> drawings;  // NAME=FILE.####.png
  std::vector<int> steps;             // frames that poses stand
  JsonOption json;
  bool quiet = false;
};

// One row of the table a number, one column a mode.
using MeasureOf = std::function<double(const ModeMeasurements&)>;
using FieldNumberOf = std::function<PerField(const ModeMeasurements&)>;
struct FieldRow {
  const char* name;
  FieldNumberOf of;
};
const FieldRow kFieldRows[] = {
    {"warp error, dolly", [](const ModeMeasurements& m) { return m.temporal.dolly; }},
    {"warp error, orbit", [](const ModeMeasurements& m) { return m.temporal.orbit; }},
    {"warp error, roll", [](const ModeMeasurements& m) { return m.temporal.roll; }},
    {"warp error, moving object", [](const ModeMeasurements& m) { return m.temporal.object; }},
    {"warp error, mean", [](const ModeMeasurements& m) { return m.temporal.mean(); }},
    {"frequency drift, octaves", [](const ModeMeasurements& m) { return m.frequencyDrift; }},
    {"contrast, from its mean", [](const ModeMeasurements& m) { return m.contrastDeviation; }},
    {"contrast, from the example's", [](const ModeMeasurements& m) { return m.contrastError; }},
    {"flatness error", [](const ModeMeasurements& m) { return m.flatness; }},
    {"stereo difference", [](const ModeMeasurements& m) { return m.stereo.warp; }},
};

void printRow(const std::string& name, const Measurements& measured, const MeasureOf& numberOf,
              const char* format = "{:14.3f}", const std::string& last = "") {
  std::string line = fmt::format("  {:29}", name);
  for (const ModeMeasurements& mode : measured.modes)
    line += fmt::format(fmt::runtime(format), numberOf(mode));
  std::puts((last.empty() ? line : line + "  " + last).c_str());
}

void printHead(const std::string& name, const Measurements& measured, const std::string& last = "") {
  std::string line = fmt::format("\n{:31}", name);
  for (const ModeMeasurements& mode : measured.modes) line += fmt::format("{:>14}", mode.mode);
  std::puts((last.empty() ? line : line + "  " + last).c_str());
}

std::string zoomText(double zoom) {
  return zoom < 1 ? fmt::format("1/{:.3g}", 1 / zoom) : fmt::format("{:.3g}", zoom);
}

void printTable(const Measurements& measured, const std::string& heading) {
  std::puts(heading.c_str());
  const std::pair<const char*, double PerField::*> fields[] = {{"warp vectors", &PerField::vectors},
                                                               {"breakup marks", &PerField::marks}};
  // Of each of these numbers less is better; who has the least stands behind them.
  for (const auto& [name, member] : fields) {
    printHead(name, measured, "best");
    for (const FieldRow& row : kFieldRows) {
      const auto numberOf = [&, number = member](const ModeMeasurements& m) { return row.of(m).*number; };
      const auto best =
          std::min_element(measured.modes.begin(), measured.modes.end(),
                           [&](const auto& a, const auto& b) { return numberOf(a) < numberOf(b); });
      printRow(row.name, measured, numberOf, "{:14.3f}", best->mode);
    }
  }
  printHead("breakup marks, in an octave", measured);
  printRow("born", measured, [](const ModeMeasurements& m) { return m.marks.born; });
  printRow("died", measured, [](const ModeMeasurements& m) { return m.marks.died; });
  printHead("pictures, rms in stereo", measured);
  printRow(
      "final-shadow", measured, [](const ModeMeasurements& m) { return m.stereo.finalShadow; }, "{:14.4f}");
  printRow(
      "color", measured, [](const ModeMeasurements& m) { return m.stereo.color; }, "{:14.4f}");
  printRow(
      "final-color", measured, [](const ModeMeasurements& m) { return m.stereo.finalColor; }, "{:14.4f}");
  printHead("in conflict in depth", measured);
  printRow("breakup marks", measured, [](const ModeMeasurements& m) { return m.stereo.marksInConflict; });
  printRow("final-color", measured, [](const ModeMeasurements& m) { return m.stereo.pictureInConflict; });
  printHead("zoom: cycles a pixel", measured);
  const std::vector<ZoomPoint>& zoom = measured.modes[0].zoom;
  for (size_t i = 0; i < zoom.size(); ++i)
    printRow(
        zoomText(zoom[i].zoom), measured,
        [i](const ModeMeasurements& m) { return m.zoom[i].frequency.vectors; }, "{:14.4f}");
  printHead("zoom: contrast", measured);
  for (size_t i = 0; i < zoom.size(); ++i)
    printRow(zoomText(zoom[i].zoom), measured,
             [i](const ModeMeasurements& m) { return m.zoom[i].contrast.vectors; });
  std::puts("\ntargets");
  for (const MeasureTarget& target : measured.targets)
    std::puts(fmt::format("  {:7} {:60} {:6.3f} (at most {:.3f})", target.isKept() ? "kept" : "missed",
                          target.meaning, target.value, target.limit)
                  .c_str());
}

nlohmann::json toJson(const PerField& number) {
  return {{"vectors", number.vectors}, {"marks", number.marks}};
}

nlohmann::json toJson(const ModeMeasurements& mode) {
  nlohmann::json zoom = nlohmann::json::array();
  for (const ZoomPoint& point : mode.zoom)
    zoom.push_back(
        {{"zoom", point.zoom}, {"frequency", toJson(point.frequency)}, {"contrast", toJson(point.contrast)}});
  const TemporalError& t = mode.temporal;
  return {{"temporal",
           {{"dolly", toJson(t.dolly)},
            {"orbit", toJson(t.orbit)},
            {"roll", toJson(t.roll)},
            {"object", toJson(t.object)},
            {"mean", toJson(t.mean())}}},
          {"zoom", zoom},
          {"frequencyDrift", toJson(mode.frequencyDrift)},
          {"contrastDeviation", toJson(mode.contrastDeviation)},
          {"contrastError", toJson(mode.contrastError)},
          {"flatness", toJson(mode.flatness)},
          {"marks", {{"born", mode.marks.born}, {"died", mode.marks.died}}},
          {"stereo",
           {{"warp", toJson(mode.stereo.warp)},
            {"final-shadow", mode.stereo.finalShadow},
            {"color", mode.stereo.color},
            {"final-color", mode.stereo.finalColor},
            {"in-conflict",
             {{"marks", mode.stereo.marksInConflict}, {"final-color", mode.stereo.pictureInConflict}}}}}};
}

MeasureOptions withProgress(MeasureOptions options, std::optional<Progress>& progress, bool quiet) {
  options.progress = [&progress, quiet](int, int total) {
    if (!progress) progress.emplace(total, quiet);
    progress->done("measuring");
    return true;
  };
  return options;
}

// A drawing by somebody else: its pictures, from number 0 on.
Result<LineSteadiness> steadinessOfFiles(const std::string& given) {
  const size_t equals = given.find('=');
  if (equals == 0 || equals == std::string::npos || given.find('#', equals) == std::string::npos)
    return usage("--drawing " + given + " names no pictures", "write it like pencil=pencil.####.png");
  std::vector<Image> drawings;
  for (int i = 0; i < kLineFrames; ++i) {
    Result<Image> picture = readPicture(numbered(given.substr(equals + 1), i));
    if (!picture) return picture.error();
    drawings.push_back(std::move(picture).value());
  }
  return steadinessOf(given.substr(0, equals), drawings);
}

nlohmann::json toJson(const glm::mat4& matrix) {
  nlohmann::json numbers = nlohmann::json::array();
  for (int i = 0; i < 16; ++i) numbers.push_back(matrix[i / 4][i % 4]);
  return numbers;
}

int runLines(const MeasureArguments& args, Renderer& renderer, const Scene& scene, const Look& look,
             const MeasureOptions& options, const std::string& heading) {
  std::vector<LineSteadiness> others;
  for (const std::string& drawing : args.drawings) {
    Result<LineSteadiness> of = steadinessOfFiles(drawing);
    if (!of) return fail(of.error());
    others.push_back(std::move(of).value());
  }
  std::optional<Progress> progress;
  Result<LineMeasurements> measured =
      measureLines(renderer, scene, look, args.lines, withProgress(options, progress, args.quiet));
  progress.reset();
  if (!measured) return fail(measured.error());
  std::vector<LineSteadiness> methods{measured->lines};
  methods.insert(methods.end(), others.begin(), others.end());
  if (!args.json.isPrinted()) {
    std::puts(heading.c_str());
    std::puts(fmt::format("\n{:16}{:>14}{:>18}{:>18}", "lines", "drawn, pixels", "change a degree",
                          "flicker a degree")
                  .c_str());
    for (const LineSteadiness& of : methods)
      std::puts(fmt::format("  {:14}{:14.0f}{:18.3f}{:18.5f}", of.method, of.drawn, of.changes, of.flickers)
                    .c_str());
  }
  nlohmann::json lines = nlohmann::json::object(), views = nlohmann::json::array();
  for (const LineSteadiness& of : methods)
    lines[of.method] = {{"drawn", of.drawn}, {"changes", of.changes}, {"flickers", of.flickers}};
  // As a camera of glTF has them: columns, y up, along -z.
  for (const View& view : measured->views)
    views.push_back(
        {{"eyeToWorld", toJson(glm::inverse(view.worldToEye))}, {"eyeToClip", toJson(view.eyeToClip)}});
  const Status given = args.json.give({{"scene", args.scene.files},
                                       {"device", renderer.gpu().name},
                                       {"size", {options.width, options.height}},
                                       {"samples", options.samples},
                                       {"lines", lines},
                                       {"views", views}});
  return given ? int(kDone) : fail(given.error());
}

int runSteps(const MeasureArguments& args, Renderer& renderer, const Scene& scene, const Look& look,
             const MeasureOptions& options, const std::string& heading) {
  std::optional<Progress> progress;
  const Result<std::vector<StepMeasurements>> measured =
      measureSteps(renderer, scene, look, args.steps, withProgress(options, progress, args.quiet));
  progress.reset();
  if (!measured) return fail(measured.error());
  if (!args.json.isPrinted()) {
    std::puts(heading.c_str());
    std::puts(fmt::format("\n{:>6}{:>14}{:>12}{:>14}{:>14}{:>16}{:>18}", "stands", "a second", "ms",
                          "jump, pixels", "far, pixels", "jump, degrees", "change a second")
                  .c_str());
    for (const StepMeasurements& of : *measured)
      std::puts(fmt::format("{:6}{:14.1f}{:12.1f}{:14.2f}{:14.2f}{:16.3f}{:18.4f}", of.hold, 1 / of.stands,
                            1000 * of.stands, of.jump, of.farJump, of.jumpDegrees, of.changes)
                    .c_str());
  }
  nlohmann::json steps = nlohmann::json::array();
  for (const StepMeasurements& of : *measured)
    steps.push_back({{"hold", of.hold},
                     {"stands", of.stands},
                     {"jump", of.jump},
                     {"farJump", of.farJump},
                     {"jumpDegrees", of.jumpDegrees},
                     {"farJumpDegrees", of.farJumpDegrees},
                     {"moving", of.moving},
                     {"changes", of.changes}});
  const Status given = args.json.give({{"scene", args.scene.files},
                                       {"device", renderer.gpu().name},
                                       {"size", {options.width, options.height}},
                                       {"samples", options.samples},
                                       {"steps", steps}});
  return given ? int(kDone) : fail(given.error());
}

int run(const MeasureArguments& args) {
  // Check everything that can be checked before anything is drawn.
  const Result<RenderOptions> picture = args.picture.renderOptions();
  if (!picture) return fail(picture.error());
  const Result<Viewpoint> viewpoint = args.picture.viewpoint();
  if (!viewpoint) return fail(viewpoint.error());
  std::vector<std::string> inputs = args.scene.files;
  inputs.push_back(args.look.lookFor(args.scene.files[0]));
  if (!args.plot.empty() && endingOf(args.plot) != ".png")
    return failUsage("a chart cannot go into '" + args.plot + "'", "name it like chart.png");
  if (!args.lines.empty() && (!args.plot.empty() || args.ipd))
    return failUsage("--lines goes with neither --plot nor --ipd", "give one of them");
  if (!args.steps.empty() && (!args.lines.empty() || !args.plot.empty() || args.ipd))
    return failUsage("--steps goes with none of --lines, --plot and --ipd", "give one of them");
  if (args.lines.empty() && !args.drawings.empty())
    return failUsage("--drawing goes with --lines", "give both");
  OutputFiles files(inputs);
  for (const auto& [file, option] : {std::pair{args.plot, "--plot"}, {args.json.file(), "--json"}})
    if (const Status status = files.add(file, option); !status) return fail(status.error());
  // Look and scene.
  Result<Look> look = args.look.load(args.scene.files[0], args.quiet);
  if (!look) return fail(look.error());
  const Result<Scene> scene = args.scene.load(args.quiet);
  if (!scene) return fail(scene.error());
  for (const std::vector<std::string>& read : {look->files(), scene->files()})
    if (const Status status = files.addInputs(read); !status) return fail(status.error());
  look = args.look.withClip(*look, *scene);
  if (!look) return fail(look.error());
  if (!args.quiet) {
    args.look.warnOfIdle(*look, *scene, args.scene.files[0]);
    args.picture.warnOfIdle();
  }
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(args.picture.rendererOptions());
  if (!renderer) return fail(renderer.error());

  // Measure.
  MeasureOptions options;
  options.width = picture->width, options.height = picture->height;
  options.samples = picture->samples;
  options.seed = picture->seed;
  options.viewpoint = *viewpoint;
  options.ipd = args.ipd;
  std::string names;
  for (const std::string& file : args.scene.files)
    names += (names.empty() ? "" : ", ") + std::filesystem::path(file).filename().string();
  if (!args.steps.empty())
    return runSteps(
        args, **renderer, *scene, *look, options,
        fmt::format("{}, {} x {}, {:g} s of its clips", names, options.width, options.height, kStepSeconds));
  if (!args.lines.empty())
    return runLines(args, **renderer, *scene, *look, options,
                    fmt::format("{}, {} x {}, {} sample{}, {} pictures {} degrees apart", names,
                                options.width, options.height, options.samples,
                                options.samples == 1 ? "" : "s", kLineFrames, kLineStep));
  std::optional<Progress> progress;
  const Result<Measurements> measured =
      measure(**renderer, *scene, *look, withProgress(options, progress, args.quiet));
  progress.reset();
  if (!measured) return fail(measured.error());
  if ((*renderer)->validationMessages() > 0)
    return fail(
        Error{ErrorKind::internal, "", 0, "", "the validation layers found mistakes", "please report them"});

  // Chart, table and JSON.
  const std::string conditions =
      fmt::format("{} x {}, {} sample{}, the scene covers {:.0f} % of the picture, eyes {:.3g} m apart",
                  options.width, options.height, options.samples, options.samples == 1 ? "" : "s",
                  100 * measured->visible, measured->ipd);
  if (!args.plot.empty())
    if (const Status status = writeChart(args.plot, *measured, "Coherence: " + names, conditions); !status)
      return fail(status.error());
  if (!args.json.isPrinted()) printTable(*measured, names + ", " + conditions);
  nlohmann::json modes = nlohmann::json::object(), targets = nlohmann::json::array();
  for (const ModeMeasurements& mode : measured->modes) modes[mode.mode] = toJson(mode);
  for (const MeasureTarget& target : measured->targets)
    targets.push_back({{"name", target.name},
                       {"meaning", target.meaning},
                       {"value", target.value},
                       {"limit", target.limit},
                       {"kept", target.isKept()}});
  const nlohmann::json report{{"scene", args.scene.files},
                              {"device", (*renderer)->gpu().name},
                              {"size", {options.width, options.height}},
                              {"samples", options.samples},
                              {"seed", options.seed},
                              {"visible", measured->visible},
                              {"tiles", measured->tiles},
                              {"ipd", measured->ipd},
                              {"exampleFrequency", toJson(measured->exampleFrequency)},
                              {"modes", modes},
                              {"targets", targets}};
  if (const Status status = args.json.give(report); !status) return fail(status.error());
  return kDone;
}

}  // namespace

void addMeasure(CLI::App& program, int& exitCode) {
  auto args = std::make_shared<MeasureArguments>();
  args->picture.size = "960x540";
  args->picture.samples = 1;
  CLI::App* command =
      program.add_subcommand("measure", "Coherence in numbers: temporal, scale, flatness, stereo");
  args->scene.addTo(*command);
  args->look.addTo(*command);
  args->picture.addTo(*command);
  command->add_option(
      "--ipd", args->ipd,
      "Distance between the eyes, metres (default: 1/40 of the distance to the scene's centre)");
  args->json.addTo(*command);
  command
      ->add_option("--lines", args->lines,
                   "Measure instead how steady the lines of this AOV are along an orbit of 5 degrees")
      ->type_name("AOV");
  command
      ->add_option("--drawing", args->drawings,
                   "With --lines: drawings by another program of the same orbit, "
                   "NAME=FILE.####.png from 0000 on; repeatable (--json has the cameras)")
      ->type_name("NAME=FILE")
      ->allow_extra_args(false);
  command
      ->add_option("--steps", args->steps,
                   "Measure instead how far poses jump that stand for so many frames at 24 a second: 1,2,3,4")
      ->type_name("FRAMES")
      ->delimiter(',');
  command->add_option("--plot", args->plot, "Also draw a chart")->type_name("FILE.png");
  command->add_flag("--quiet", args->quiet, "No warnings and no progress");
  command->footer("Example: scumble measure boat.glb --plot boat.png");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
