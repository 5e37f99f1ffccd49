// What an ocean costs in each frame: its waves on the CPU, its vertices, and its painting, beside the whole
// frame and beside the same scene without it in the same run.
//
//   ocean_bench SCENE [--size 1280x720] [--samples 1|4] [--runs 15] [--device NAME] [--json FILE]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>

#include "report/report.h"
#include "scumble/renderer.h"

using namespace scumble;

namespace {

template <class T>
T take(Result<T> result) {
  return bench::take("ocean_bench", std::move(result));
}

// Milliseconds of a frame.
struct Cost {
  double cpu = 0, deform = 0, ocean = 0, frame = 0;  // `frame`: all passes on the GPU, without reading back
};

Cost costOf(const FrameStats& stats) {
  Cost cost;
  cost.cpu = stats.cpuMilliseconds;
  for (const PassTime& pass : stats.passes) {
    if (pass.name == "readback") continue;
    cost.frame += pass.milliseconds;
    if (pass.name == "deform") cost.deform += pass.milliseconds;
    if (pass.name == "ocean") cost.ocean += pass.milliseconds;
  }
  return cost;
}

}  // namespace

int main(int argc, char** argv) try {
  std::string file, size = "1280x720", json;
  RendererOptions rendererOptions;
  RenderOptions options;
  options.samples = 4;
  int runs = 15;
  CLI::App app("Milliseconds of an ocean in each frame, beside the same scene without it");
  app.add_option("scene", file, "a glTF file")->required();
  app.add_option("--size", size, "WxH")->capture_default_str();
  app.add_option("--samples", options.samples, "1 or 4")->capture_default_str();
  app.add_option("--runs", runs, "how many frames of each")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--device", rendererOptions.device, "part of a name, a number, or cpu");
  app.add_option("--json", json, "also write the numbers here");
  CLI11_PARSE(app, argc, argv);
  if (std::sscanf(size.c_str(), "%ux%u", &options.width, &options.height) != 2 || options.width == 0 ||
      options.height == 0) {
    std::fprintf(stderr, "ocean_bench: error: '%s' is no size\n", size.c_str());
    return 2;
  }

  const Scene scene = take(Scene::load(file));
  const float aspect = float(options.width) / float(options.height);
  const std::vector<View> views = take(makeViews(scene, {}, aspect));
  // One renderer each, so that both keep their images and pipelines while they take turns.
  struct Case {
    const char* mode;
    std::unique_ptr<Renderer> renderer{};
    Look look{};
    std::vector<Cost> costs{};
  } cases[] = {{"on"}, {"off"}};
  for (Case& one : cases) {
    one.renderer = take(Renderer::create(rendererOptions));
    for (const auto& [knob, value] : {std::pair("ocean.mode", one.mode), {"ground.mode", "off"}})
      if (const Status set = one.look.set(knob, value); !set) take(Result<int>(set.error()));
  }
  // The first turn compiles pipelines and is not counted.
  for (int run = 0; run <= runs; ++run)
    for (Case& one : cases) {
      const Frame frame = take(one.renderer->render(scene, one.look, run / 24.0, views, options));
      if (frame.stats.passes.empty()) {
        std::fprintf(stderr, "ocean_bench: error: this device has no timestamps\n");
        return 4;
      }
      if (run > 0) one.costs.push_back(costOf(frame.stats));
    }

  const GpuInfo gpu = cases[0].renderer->gpu();
  std::printf("%s, %ux%u, %u samples, medians of %d\n%-40s %10s %12s\n", gpu.name.c_str(), options.width,
              options.height, options.samples, runs, "", "ms", "of the frame");
  nlohmann::ordered_json report{
      {"device", gpu.name},       {"driver", gpu.driver},       {"scene", file}, {"width", options.width},
      {"height", options.height}, {"samples", options.samples}, {"runs", runs}};
  const auto row = [&](const char* name, auto&& of) {
    std::vector<double> times, ratios;
    for (size_t i = 0; i < size_t(runs); ++i) {
      const Cost &with = cases[0].costs[i], &without = cases[1].costs[i];
      times.push_back(of(with, without));
      ratios.push_back(times.back() / with.frame);
    }
    std::printf("%-40s %10.2f %11.2f%%\n", name, bench::median(times), 100 * bench::median(ratios));
    report["cases"].push_back(
        {{"name", name}, {"milliseconds", bench::median(times)}, {"ratio", bench::median(ratios)}});
  };
  const auto waves = [](const Cost& with, const Cost& without) { return with.cpu - without.cpu; };
  const auto vertices = [](const Cost& with, const Cost& without) { return with.deform - without.deform; };
  row("waves on the CPU", waves);
  row("its vertices, in deform", vertices);
  row("both", [&](const Cost& a, const Cost& b) { return waves(a, b) + vertices(a, b); });
  row("painting, the pass ocean", [](const Cost& with, const Cost&) { return with.ocean; });
  row("the frame", [](const Cost& with, const Cost&) { return with.frame; });
  row("the frame without an ocean", [](const Cost&, const Cost& without) { return without.frame; });
  return bench::give("ocean_bench", json, report);
} catch (const std::exception& error) {
  std::fprintf(stderr, "ocean_bench: error: %s\n", error.what());
  return 1;
}
