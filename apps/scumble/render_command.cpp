// scumble render: one image, a range of frames, or a film.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "frame_loop.h"
#include "frame_writer.h"
#include "interruption.h"
#include "json_option.h"
#include "progress.h"
#include "render_arguments.h"
#include "report.h"

namespace scumble::app {

namespace {

using Clock = std::chrono::steady_clock;
double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

constexpr unsigned kMostWriters = 4;  // beyond them disks are slower than encoders

nlohmann::json statsJson(const FrameStats& stats) {
  nlohmann::json passes = nlohmann::json::array();
  for (const PassTime& pass : stats.passes)
    passes.push_back({{"name", pass.name},
                      {"milliseconds", pass.milliseconds},
                      {"bytesRead", pass.bytesRead},
                      {"fetches", pass.fetches},
                      {"bytesWritten", pass.bytesWritten}});
  return {{"passes", passes},
          {"gpuMilliseconds", stats.gpuMilliseconds},
          {"cpuMilliseconds", stats.cpuMilliseconds},
          {"readbackMilliseconds", stats.readbackMilliseconds},
          {"uploadMilliseconds", stats.uploadMilliseconds},
          {"setupMilliseconds", stats.setupMilliseconds},
          {"pipelines", stats.pipelines},
          {"triangles", stats.triangles},
          {"drawCalls", stats.drawCalls},
          {"deviceBytes", stats.deviceBytes},
          {"imageBytes", stats.imageBytes},
          {"imageBytesUnshared", stats.imageBytesUnshared},
          {"uploadedBytes", stats.uploadedBytes}};
}

int nameMissing(const RenderPlan& plan) {
  if (plan.times().empty()) return kDone;
  return fail({ErrorKind::unusableFile, plan.output.path, 0, "",
               plan.isPicture ? "it is not there, whole"
                              : std::to_string(plan.numbers.size()) +
                                    (plan.numbers.size() == 1 ? " frame is" : " frames are") +
                                    " not there, whole: " + rangesOf(plan.numbers),
               "draw them with --resume in place of --missing"});
}

// `renderer`: null where nothing was drawn.
Status writeStats(const RenderPlan& plan, const Renderer* renderer, const nlohmann::json& times,
                  nlohmann::json frames) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const SceneTimings& import = plan.scene.timings();
  nlohmann::json report{{"size", {plan.options.width, plan.options.height}},
                        {"samples", plan.options.samples},
                        {"views", plan.output.viewCount()},
                        {"import",
                         {{"read", import.read},
                          {"parse", import.parse},
                          {"geometry", import.geometry},
                          {"images", import.images}}},
                        {"peakResidentBytes", uint64_t(usage.ru_maxrss) * 1024},
                        {"frames", std::move(frames)}};
  report.update(times);
  if (renderer) report["device"] = renderer->gpu().name, report["driver"] = renderer->gpu().driver;
  return writeText(plan.args.stats, textOf(report));
}

int run(const RenderArguments& args) {
  const auto start = Clock::now();
  nlohmann::json steps = nlohmann::json::object();
  auto lapStart = start;
  const auto lap = [&](const char* name) {
    steps[name] = millisecondsSince(lapStart);
    lapStart = Clock::now();
  };
  Result<RenderPlan> plan = planRender(args);
  if (!plan) return fail(plan.error());
  if (args.missing) return nameMissing(*plan);
  lap("sceneMilliseconds");
  const OutputPlan& output = plan->output;
  const size_t asked = plan->numbers.size();
  std::optional<FilmOutput> film;
  if (plan->isFilm()) {
    Result<FilmOutput> created = FilmOutput::create(output, args.resume, asked);
    if (!created) return fail(created.error());
    film = std::move(created).value();
    plan->numbers.erase(plan->numbers.begin(), plan->numbers.begin() + std::ptrdiff_t(film->frames()));
    if (plan->numbers.empty() && !args.quiet)
      std::fprintf(stderr, "scumble: %s has all of its %zu frames\n", output.path.c_str(), asked);
  }
  const std::vector<double> times = plan->times();
  std::unique_ptr<Renderer> renderer;
  // What is there already needs no device.
  if (!times.empty()) {
    Result<std::unique_ptr<Renderer>> created = rendererFor(*plan);
    if (!created) return fail(created.error());
    renderer = std::move(created).value();
  }
  lap("deviceMilliseconds");

  // Draw, and write beside it: pictures on several threads, a film in order.
  Progress progress(int(times.size()), args.quiet);
  const int writers = film ? 1 : int(std::clamp(std::thread::hardware_concurrency() / 2, 1u, kMostWriters));
  FrameWriter writer(
      writers,
      [&](const Frame& frame, int number) {
        const std::optional<int> which = plan->isPicture ? std::nullopt : std::optional(number);
        return film ? film->add(frame, number) : output.write(frame, output.framePath(which), number);
      },
      [&](int number) { progress.done("frame " + std::to_string(number)); });
  nlohmann::json frames = nlohmann::json::array();
  // Pictures are whole as they are; a film is one file, which is to be played as far as it goes.
  std::optional<Interruption> interruption;
  if (film) interruption.emplace();
  Status status = drawFrames(
      *plan, *renderer, times, progress,
      [&](size_t i, Frame frame) {
        for (const Drawing& drawing : frame.drawings)
          if (drawing.leftOut > 0)
            warn(
                {std::to_string(drawing.leftOut) + " lines are left out of the drawing: there are too many"});
        frames.push_back(statsJson(frame.stats));
        return writer.add(plan->isPicture ? 0 : plan->numbers[i], std::move(frame));
      },
      [&] { return film && Interruption::came(); });
  // What has been drawn is kept, whatever came after it.
  if (const Status written = writer.finish(); status && !written) status = written;
  const bool isCut = film && Interruption::came() && frames.size() < times.size();
  if (isCut && film->frames() == 0) {
    std::fprintf(stderr, "scumble: ended by %s before the first frame\n", Interruption::name());
    return Interruption::exitCode();
  }
  if (status && film) status = film->finish();
  if (!status) return fail(status.error());
  if (isCut)
    std::fprintf(stderr, "scumble: ended by %s: %s holds %zu of %zu frames\n", Interruption::name(),
                 output.path.c_str(), film->frames(), asked);
  const double rendering = millisecondsSince(lapStart);

  if (!args.stats.empty())
    if (const Status written = writeStats(*plan, renderer.get(),
                                          {{"steps", steps},
                                           {"renderMilliseconds", rendering},
                                           {"writeMilliseconds", writer.milliseconds()},
                                           {"totalMilliseconds", millisecondsSince(start)}},
                                          std::move(frames));
        !written)
      return fail(written.error());
  if (!args.graph.empty() && renderer)
    if (const Status written = writeText(args.graph, renderer->graph()); !written)
      return fail(written.error());
  return isCut ? Interruption::exitCode() : kDone;
}

}  // namespace

void addRender(CLI::App& program, int& exitCode) {
  auto args = std::make_shared<RenderArguments>();
  CLI::App* command = program.add_subcommand("render", "Render one image, a range of frames, or a film");
  args->addTo(*command);
  args->addCallTo(*command);
  command->footer("Example: scumble render boat.glb -o boat.png --orbit 30,15 --set shadow.threshold=0.4");
  command->callback([args, &exitCode] { exitCode = run(*args); });
}

}  // namespace scumble::app
