// scumble bench: milliseconds of each pass, beside the yardstick (the scene once, plain) in the same run.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "json_option.h"
#include "options.h"
#include "output_files.h"
#include "report.h"
#include "scumble/yardstick.h"
#include "xr/show.h"

namespace scumble::app {

namespace {

struct BenchArguments {
  SceneArguments scene;
  LookArguments look;
  PictureArguments picture;
  JsonOption json;
  int runs = 9;
  double time = 0;  // seconds
  bool moving = false, xr = false;
  double bandwidth = 1000;  // of the GPU that is planned for, gigabytes a second
};

constexpr double kFramesASecond = 24;  // of what moves

// Of all turns. The first one is not counted; where frames move it is the frame before the first that is.
std::vector<double> timesOf(const BenchArguments& args) {
  std::vector<double> times;
  for (int turn = 0; turn <= args.runs; ++turn)
    times.push_back(args.moving ? args.time + (turn - 1) / kFramesASecond : args.time);
  return times;
}

Result<std::vector<View>> viewsAt(const BenchArguments& args, const Scene& scene, const Look& look,
                                  double time) {
  if (!args.xr) return args.picture.views(scene, look, time);
  const Result<Viewpoint> viewpoint = args.picture.viewpoint();
  return viewpoint ? xr::usualEyes(scene, look, *viewpoint, time) : viewpoint.error();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

int run(const BenchArguments& args) {
  // Check everything that can be checked before anything is drawn.
  if (args.runs < 1 || args.runs > 1000) return failUsage("--runs is out of range", "use 1 to 1000");
  if (!(args.bandwidth >= 1 && args.bandwidth <= 1e6))
    return failUsage("--bandwidth is out of range", "use 1 to 1000000 gigabytes a second");
  const std::vector<double> times = timesOf(args);
  if (!(std::abs(times.front()) < Renderer::kMaxTime && std::abs(times.back()) < Renderer::kMaxTime))
    return failUsage("--time is out of range", "use a time within a million seconds");
  std::vector<std::string> inputs = args.scene.files;
  inputs.push_back(args.look.lookFor(args.scene.files[0]));
  OutputFiles files(inputs);
  if (const Status status = files.add(args.json.file(), "--json"); !status) return fail(status.error());
  Result<RenderOptions> options = args.picture.renderOptions();
  if (!options) return fail(options.error());
  Result<Look> look = args.look.load(args.scene.files[0], false);
  if (!look) return fail(look.error());
  const Result<Scene> scene = args.scene.load(false);
  if (!scene) return fail(scene.error());
  for (const std::vector<std::string>& read : {look->files(), scene->files()})
    if (const Status status = files.addInputs(read); !status) return fail(status.error());
  look = args.look.withClip(*look, *scene);
  if (!look) return fail(look.error());
  const Result<std::vector<View>> still = viewsAt(args, *scene, *look, args.time);
  if (!still) return fail(still.error());
  if (args.xr) options.value().width = still->front().size.x, options.value().height = still->front().size.y;
  const bool viewsGo = args.moving && viewsMove(*scene, args.picture.viewpoint().value(), *look);
  args.look.warnOfIdle(*look, *scene, args.scene.files[0]);
  args.picture.warnOfIdle();
  // One renderer each, so that both keep their images and pipelines while they take turns.
  Result<std::unique_ptr<Renderer>> painter = Renderer::create(args.picture.rendererOptions());
  if (!painter) return fail(painter.error());
  Result<std::unique_ptr<Renderer>> yardstick = Renderer::create(args.picture.rendererOptions());
  if (!yardstick) return fail(yardstick.error());

  // Paint and yardstick in turns.
  std::vector<double> frame, plainFrame, ratios, cpu;
  std::map<std::string, std::vector<double>> passes;
  std::map<std::string, PassTime> traffic;  // of the last frame: its images are those of all
  uint64_t bytes = 0, fetches = 0;
  std::vector<std::string> order;
  uint64_t triangles = 0, drawCalls = 0;
  // The first turn compiles pipelines and is not counted.
  for (int i = 0; i <= args.runs; ++i) {
    const double time = times[size_t(i)];
    const Result<std::vector<View>> views = viewsGo ? viewsAt(args, *scene, *look, time) : still;
    if (!views) return fail(views.error());
    const Result<Frame> painted = (*painter)->render(*scene, *look, time, *views, *options);
    if (!painted) return fail(painted.error());
    const Result<Frame> drawn = renderYardstick(**yardstick, *scene, *look, time, *views, *options);
    if (!drawn) return fail(drawn.error());
    if ((*painter)->validationMessages() + (*yardstick)->validationMessages() > 0)
      return fail(Error{ErrorKind::internal, "", 0, "", "the validation layers found mistakes",
                        "please report them"});
    if (painted->stats.passes.empty())
      return fail(Error{ErrorKind::noUsableGpu, "", 0, "", "this device has no timestamps",
                        "choose another --device"});
    if (i == 0) continue;
    // The yardstick is its draw alone: deform is the painter's own work.
    double once = 0, all = 0;
    bytes = fetches = 0;
    for (const PassTime& pass : drawn->stats.passes)
      if (pass.name == "plain") once = pass.milliseconds;
    for (const PassTime& pass : painted->stats.passes) {
      if (pass.name == "readback") continue;
      if (!passes.count(pass.name)) order.push_back(pass.name);
      passes[pass.name].push_back(pass.milliseconds);
      traffic[pass.name] = pass;
      bytes += pass.bytesRead + pass.bytesWritten;
      fetches += pass.fetches;
      all += pass.milliseconds;
    }
    frame.push_back(all);
    cpu.push_back(painted->stats.cpuMilliseconds);
    plainFrame.push_back(once);
    ratios.push_back(all / once);
    triangles = painted->stats.triangles, drawCalls = painted->stats.drawCalls;
  }

  // Medians and spreads, as JSON and as text.
  nlohmann::json passReport = nlohmann::json::array();
  for (const std::string& name : order)
    passReport.push_back({{"name", name},
                          {"milliseconds", median(passes[name])},
                          {"fetches", traffic[name].fetches},
                          {"bytesRead", traffic[name].bytesRead},
                          {"bytesWritten", traffic[name].bytesWritten}});
  const double pixels = double(options->width) * options->height * double(still->size());
  const double planned = double(bytes) / (args.bandwidth * 1e6);
  // One time where nothing moves.
  const std::vector<double> counted(times.begin() + 1, args.moving ? times.end() : times.begin() + 2);
  const auto spread = [](const std::vector<double>& values) {
    return nlohmann::json{{"median", median(values)},
                          {"least", *std::min_element(values.begin(), values.end())},
                          {"most", *std::max_element(values.begin(), values.end())}};
  };
  const nlohmann::json report{{"device", (*painter)->gpu().name},
                              {"driver", (*painter)->gpu().driver},
                              {"scene", args.scene.files},
                              {"size", {options->width, options->height}},
                              {"samples", options->samples},
                              {"views", still->size()},
                              {"mode", args.moving ? "moving" : "still"},
                              {"times", counted},
                              {"triangles", triangles},
                              {"runs", args.runs},
                              {"passes", passReport},
                              {"frameMilliseconds", median(frame)},
                              {"cpuMilliseconds", median(cpu)},
                              {"drawCalls", drawCalls},
                              {"yardstickMilliseconds", median(plainFrame)},
                              {"ratio", median(ratios)},
                              {"imageBytes", bytes},
                              {"fetches", fetches},
                              {"bandwidth", args.bandwidth},
                              {"plannedMilliseconds", planned},
                              {"spread",
                               {{"frameMilliseconds", spread(frame)},
                                {"yardstickMilliseconds", spread(plainFrame)},
                                {"ratio", spread(ratios)}}}};
  if (!args.json.isPrinted()) {
    const auto print = [](const std::string& line) { std::puts(line.c_str()); };
    print(fmt::format("{}, {}", (*painter)->gpu().name, (*painter)->gpu().driver));
    print(fmt::format("{} x {}, {} samples, {} views, {} triangles, medians of {}", options->width,
                      options->height, options->samples, still->size(), triangles, args.runs));
    print(args.moving ? fmt::format("moving: from {:g} s to {:g} s", counted.front(), counted.back())
                      : fmt::format("still: at {:g} s", args.time));
    for (const std::string& name : order)
      print(fmt::format("  {:<14} {:9.2f} ms {:8.1f} bytes a pixel read {:8.1f} written {:8.1f} fetches",
                        name, median(passes[name]), double(traffic[name].bytesRead) / pixels,
                        double(traffic[name].bytesWritten) / pixels, double(traffic[name].fetches) / pixels));
    print(fmt::format("  {:<14} {:9.2f} ms", "frame", median(frame)));
    print(fmt::format("  {:<14} {:9.2f} ms", "yardstick", median(plainFrame)));
    print(fmt::format("  {:<14} {:9.2f}", "ratio", median(ratios)));
    print(fmt::format("  {:<14} {:9.2f} ms beside it; {} draws", "CPU", median(cpu), drawCalls));
    print(
        fmt::format("  {:<14} {:9.1f} bytes a pixel: {:.3f} ms at {:g} GB/s, without vertices and textures; "
                    "{:.1f} fetches",
                    "images", double(bytes) / pixels, planned, args.bandwidth, double(fetches) / pixels));
  }
  if (const Status status = args.json.give(report); !status) return fail(status.error());
  return kDone;
}

}  // namespace

void addBench(CLI::App& program, int& exitCode) {
  auto args = std::make_shared<BenchArguments>();
  CLI::App* command = program.add_subcommand("bench", "Milliseconds of each pass, and the yardstick");
  args->scene.addTo(*command);
  args->look.addTo(*command);
  args->picture.addTo(*command);
  args->picture.addStereoTo(*command);
  command
      ->add_flag("--xr", args->xr,
                 "Two eyes of a headset at the camera, 2064x2208 each, instead of --size and --stereo")
      ->excludes("--size", "--stereo", "--ipd", "--fov", "--roll");
  command->add_option("--runs", args->runs, "Frames to take the median of")->capture_default_str();
  command->add_option("--time", args->time, "Seconds; with --moving those of the first frame")
      ->capture_default_str();
  command->add_flag(
      "--moving", args->moving,
      "Each frame is a twenty-fourth of a second later, as in films, so that what moves is posed "
      "anew (default: all frames are at one time)");
  command
      ->add_option(
          "--bandwidth", args->bandwidth,
          "Gigabytes a second of a GPU to plan for: what a frame's images take to be read and written")
      ->capture_default_str();
  args->json.addTo(*command);
  command->footer("Example: scumble bench boat.glb --samples 1 --json boat.json");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
