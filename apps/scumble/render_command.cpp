// scumble render: one image, or a range of frames.
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "options.h"
#include "outputs.h"
#include "progress.h"
#include "report.h"

namespace scumble::app {

namespace {

using Clock = std::chrono::steady_clock;
double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct RenderArguments {
  SceneArguments scene;
  LookArguments look;
  PictureArguments picture;
  std::string output, frames, background, stats;
  std::vector<std::string> aovs;
  double time = 0, fps = 24;
  bool quiet = false, resume = false;
};

constexpr int kMostFrame = 10'000'000;

// "3..17"; nothing when it is not of that form.
std::optional<std::pair<int, int>> parseFrames(const std::string& text) {
  char* end = nullptr;
  const long long first = std::strtoll(text.c_str(), &end, 10);
  if (end == text.c_str() || std::strncmp(end, "..", 2) != 0) return std::nullopt;
  const char* second = end + 2;
  const long long last = std::strtoll(second, &end, 10);
  if (end == second || *end || last < first || first < -kMostFrame || last > kMostFrame) return std::nullopt;
  return std::pair{int(first), int(last)};
}

nlohmann::json statsJson(const FrameStats& stats) {
  nlohmann::json passes = nlohmann::json::array();
  for (const PassTime& pass : stats.passes)
    passes.push_back({{"name", pass.name}, {"milliseconds", pass.milliseconds}});
  return {{"passes", passes},
          {"gpuMilliseconds", stats.gpuMilliseconds},
          {"cpuMilliseconds", stats.cpuMilliseconds},
          {"readbackMilliseconds", stats.readbackMilliseconds},
          {"uploadMilliseconds", stats.uploadMilliseconds},
          {"setupMilliseconds", stats.setupMilliseconds},
          {"triangles", stats.triangles},
          {"drawCalls", stats.drawCalls},
          {"deviceBytes", stats.deviceBytes},
          {"uploadedBytes", stats.uploadedBytes}};
}

int run(const RenderArguments& args) {
  const auto start = Clock::now();
  nlohmann::json steps = nlohmann::json::object();
  auto lapStart = start;
  const auto lap = [&](const char* name) {
    steps[name] = millisecondsSince(lapStart);
    lapStart = Clock::now();
  };

  // Check everything that can be checked before anything is drawn.
  Result<RenderOptions> options = args.picture.renderOptions();
  if (!options) return fail(options.error());
  std::vector<std::string> inputs = args.scene.files;
  if (!args.look.look.empty()) inputs.push_back(args.look.look);
  const Result<OutputPlan> output =
      OutputPlan::make(args.output, args.scene.files[0], args.picture.stereo, !args.frames.empty(), inputs);
  if (!output) return fail(output.error());
  std::vector<std::string> statsInputs = inputs;
  statsInputs.push_back(output->path);
  if (const Status status = checkWritable(args.stats, statsInputs); !status) return fail(status.error());
  std::optional<std::pair<int, int>> frames;
  if (!args.frames.empty() && !(frames = parseFrames(args.frames)))
    return failUsage("--frames " + args.frames + " is no range",
                     "write it like 0..23, with numbers up to 10000000");
  if (frames && frames->first != frames->second && !output->isSequence())
    return failUsage("several frames cannot go into one '" + output->path + "'",
                     "name it like picture.####.png");
  if (!std::isfinite(args.time) || !(args.fps > 0) || !std::isfinite(args.fps))
    return failUsage("--time or --fps is out of range", "time is in seconds, fps above 0");
  for (const std::string& name : args.aovs) {
    if (name == "all") {
      for (const std::string& every : Renderer::aovNames()) options->aovs.push_back(every);
    } else if (!name.empty()) {
      options->aovs.push_back(name);
    }
  }
  LookArguments lookArguments = args.look;
  if (!args.background.empty()) {
    if (args.background == "transparent") {
      options->transparent = true;
    } else if (args.background[0] == '#') {
      for (const char* knob : {"background.horizon=", "background.zenith=", "ground.tint="})
        lookArguments.settings.push_back(knob + args.background);
      lookArguments.settings.push_back("background.mode=look");
    } else {
      return failUsage("'" + args.background + "' is no background", "use #RRGGBB or transparent");
    }
  }
  const Result<Look> look = lookArguments.load(args.scene.files[0]);
  if (!look) return fail(look.error());
  const Result<Scene> scene = args.scene.load(args.quiet);
  if (!scene) return fail(scene.error());
  const Result<std::vector<View>> views = args.picture.views(*scene);
  if (!views) return fail(views.error());
  lap("sceneMilliseconds");
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(args.picture.rendererOptions());
  if (!renderer) return fail(renderer.error());
  lap("deviceMilliseconds");

  nlohmann::json frameStats = nlohmann::json::array();
  const int first = frames ? frames->first : 0, last = frames ? frames->second : 0;
  double rendering = 0, writing = 0;
  Progress progress(last - first + 1, args.quiet);
  for (int number = first; number <= last; ++number) {
    const std::string path = output->framePath(frames ? std::optional(number) : std::nullopt);
    if (args.resume && output->isThere(path, views->size())) {
      progress.done("frame " + std::to_string(number));
      continue;
    }
    const double time = frames ? number / args.fps : args.time;
    lapStart = Clock::now();
    const Result<Frame> frame = (*renderer)->render(*scene, *look, time, *views, *options);
    if (!frame) return fail(frame.error());
    if (args.picture.validate && (*renderer)->validationMessages() > 0)
      return fail(Error{ErrorKind::internal, "", 0, "", "the validation layers found mistakes",
                        "please report them"});
    rendering += millisecondsSince(lapStart);
    lapStart = Clock::now();
    if (const Status status = output->write(*frame, path); !status) return fail(status.error());
    writing += millisecondsSince(lapStart);
    frameStats.push_back(statsJson(frame->stats));
    progress.done("frame " + std::to_string(number));
  }

  if (!args.stats.empty()) {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const SceneTimings& import = scene->timings();
    const nlohmann::json report{{"device", (*renderer)->gpu().name},
                                {"driver", (*renderer)->gpu().driver},
                                {"size", {options->width, options->height}},
                                {"samples", options->samples},
                                {"views", views->size()},
                                {"import",
                                 {{"read", import.read},
                                  {"parse", import.parse},
                                  {"geometry", import.geometry},
                                  {"images", import.images}}},
                                {"steps", steps},
                                {"renderMilliseconds", rendering},
                                {"writeMilliseconds", writing},
                                {"totalMilliseconds", millisecondsSince(start)},
                                {"peakResidentBytes", uint64_t(usage.ru_maxrss) * 1024},
                                {"frames", frameStats}};
    if (const Status status = writeText(args.stats, report.dump(2) + "\n"); !status)
      return fail(status.error());
  }
  return kDone;
}

}  // namespace

void addRender(CLI::App& program, int& exitCode) {
  auto args = std::make_shared<RenderArguments>();
  CLI::App* command = program.add_subcommand("render", "Render one image, or a range of frames");
  args->scene.addTo(*command);
  command->add_option(
      "-o,--output", args->output,
      "The picture: .png (8 bit sRGB) or .exr (linear float, both eyes as views); name.####.png for a "
      "sequence (default: the scene's name + .png in the current folder)");
  args->look.addTo(*command);
  args->picture.addTo(*command);
  args->picture.addStereoTo(*command);
  command->add_option("--time", args->time, "Seconds")->capture_default_str();
  command->add_option("--frames", args->frames, "A range of frames; frame n is at n / fps seconds")
      ->type_name("A..B");
  command->add_option("--fps", args->fps, "Frames a second")->capture_default_str();
  command->add_flag("--resume", args->resume, "Leave out frames whose file is there already");
  std::string names;
  for (const std::string& name : Renderer::aovNames()) names += (names.empty() ? "" : ", ") + name;
  command
      ->add_option("--aov", args->aovs,
                   "Also write a pass's output, into the EXR as layers or beside a PNG as NAME.AOV.exr: all, "
                   "or some of " +
                       names)
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--background", args->background, "What is behind everything: #RRGGBB or transparent");
  command->add_option("--stats", args->stats, "Write JSON with milliseconds of each pass, counts and memory")
      ->type_name("FILE");
  command->add_flag("--quiet", args->quiet, "No warnings and no progress");
  command->footer("Example: scumble render boat.glb -o boat.png --orbit 30,15 --set shadow.threshold=0.4");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
