// Frames.
#include "scumble/renderer.h"

#include <pybind11/stl.h>

#include <memory>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "scumble/panorama.h"

using namespace scumble;
using namespace pybind11::literals;

namespace scumble_python {
namespace {

// The picture's name among AOVs: the library's is empty.
constexpr const char* kPicture = "picture";

// A picture behind everything, that is uploaded once as long as it is the same object.
struct Background {
  std::shared_ptr<const Image> image;
};

RenderOptions toOptions(const py::dict& settings) {
  RenderOptions options;
  for (const auto& [key, value] : settings) {
    const std::string name = py::str(key);
    if (name == "size") {
      std::tie(options.width, options.height) =
          as<std::pair<uint32_t, uint32_t>>(value, name, "(width, height), whole numbers from 1 on");
    } else if (name == "samples") {
      options.samples = as<uint32_t>(value, name);
    } else if (name == "seed") {
      options.seed = as<uint32_t>(value, name);
    } else if (name == "aovs") {
      if (py::isinstance<py::str>(value)) refuse(value, name, "a list of names");
      options.aovs = as<std::vector<std::string>>(value, name, "a list of names");
    } else if (name == "dtypes") {
      for (const auto& [layer, dtype] : as<py::dict>(value, name, "a dict of dtypes by names")) {
        const auto aov = as<std::string>(layer, "a name among dtypes");
        const auto format =
            PixelFormat(wordOf(dtype, "the dtype of " + aov, {"float32", "float16", "uint8"}));
        if (format == PixelFormat::half && Renderer::needsFloat(aov))
          raiseUsage("the numbers of " + aov + " do not fit into float16", "leave it out of dtypes");
        options.formats[aov == kPicture ? "" : aov] = format;
      }
    } else if (name == "drawing") {
      options.drawing = as<bool>(value, name);
    } else if (name == "transparent") {
      options.transparent = as<bool>(value, name);
    } else if (name == "background") {
      options.background = value.cast<const Background&>().image;
    } else if (name == "previous_views") {
      options.previousViews = value.cast<std::vector<View>>();
    } else if (name == "previous_time") {
      options.previousTime = as<double>(value, name);
    } else {
      raiseUsage("a frame has no '" + name + "'");
    }
  }
  return options;
}

py::dict toPython(const FrameStats& stats) {
  py::dict passes;
  for (const PassTime& pass : stats.passes) passes[py::str(pass.name)] = pass.milliseconds;
  return py::dict("gpu_ms"_a = stats.gpuMilliseconds, "cpu_ms"_a = stats.cpuMilliseconds,
                  "readback_ms"_a = stats.readbackMilliseconds, "upload_ms"_a = stats.uploadMilliseconds,
                  "setup_ms"_a = stats.setupMilliseconds, "pipelines"_a = stats.pipelines,
                  "written_primitives"_a = stats.writtenPrimitives,
                  "written_textures"_a = stats.writtenTextures,
                  "written_materials"_a = stats.writtenMaterials, "uploaded_bytes"_a = stats.uploadedBytes,
                  "triangles"_a = stats.triangles, "draw_calls"_a = stats.drawCalls,
                  "device_bytes"_a = stats.deviceBytes, "passes_ms"_a = passes);
}

// What scumble._renderer makes a Frame of: arrays by name, their channels by name, names of those that are
// colours, objects, materials, drawings, and what it took.
py::tuple toPython(Frame frame) {
  py::dict arrays, channels;
  py::list colors;
  for (Frame::Layer& layer : frame.layers) {
    const py::str name(layer.name.empty() ? kPicture : layer.name);
    channels[name] = py::tuple(py::cast(layer.views.front().channels));
    if (layer.views.front().isColor) colors.append(name);
    arrays[name] = toArray(std::move(layer.views));
  }
  return py::make_tuple(arrays, channels, colors, frame.objects, frame.materials, frame.drawings,
                        toPython(frame.stats));
}

}  // namespace

void addRenderer(py::module_& module) {
  module.def(
      "_devices",
      [](const std::string& choice, const std::string& cacheFolder) {
        py::list all;
        for (const GpuInfo& gpu : valueOf(withoutGil([&] { return listGpus(choice, cacheFolder); })))
          all.append(py::dict("name"_a = gpu.name, "driver"_a = gpu.driver, "api_version"_a = gpu.apiVersion,
                              "cpu"_a = gpu.isCpu, "unusable_because"_a = gpu.unusableBecause,
                              "would_be_used"_a = gpu.wouldBeUsed, "workarounds"_a = gpu.workarounds));
        return all;
      },
      "choice"_a, "cache"_a);
  module.def("aovs", &Renderer::aovNames, "Names of everything that render() gives beside the picture.");
  module.def("_played_seconds", &playedSeconds, "scene"_a, "look"_a);
  module.attr("_MAX_BEGUN") = Renderer::kMaxBegun;

  py::class_<Background>(module, "_Background")
      .def(py::init([](const py::object& pixels) {
             return Background{std::make_shared<Image>(toLinearImage(pixels, "the background"))};
           }),
           "pixels"_a);

  py::class_<SingleRenderer>(module, "_Renderer")
      .def(py::init([](const std::string& device, const std::string& cache, bool validation) {
             const RendererOptions options{.device = device, .validation = validation, .cacheFolder = cache};
             return std::make_unique<SingleRenderer>(
                 runLong(py::none(), [&](const Progress&) { return Renderer::create(options); }));
           }),
           "device"_a, "cache"_a, "validation"_a)
      .def(
          "render",
          [](SingleRenderer& single, const Scene& scene, const Look& look, double time,
             const std::vector<View>& views, const py::dict& settings, const py::object& progress) {
            RenderOptions options = toOptions(settings);
            const auto renderer = single.turn();
            return toPython(runLong(progress, [&, scene, look](const Progress& part) {
              options.progress = part;
              return renderer->render(scene, look, time, views, options);
            }));
          },
          "scene"_a, "look"_a, "time"_a, "views"_a, "settings"_a, "progress"_a)
      .def(
          "begin",
          [](SingleRenderer& single, const Scene& scene, const Look& look, double time,
             const std::vector<View>& views, const py::dict& settings) {
            RenderOptions options = toOptions(settings);
            const auto renderer = single.turn();
            runLong(py::none(), [&, scene, look](const Progress& part) {
              options.progress = part;
              return renderer->begin(scene, look, time, views, options);
            });
          },
          "scene"_a, "look"_a, "time"_a, "views"_a, "settings"_a)
      .def("finish",
           [](SingleRenderer& single) {
             const auto renderer = single.turn();
             return toPython(runLong(py::none(), [&](const Progress&) { return renderer->finish(); }));
           })
      .def(
          "prepare",
          [](SingleRenderer& single, const Scene& scene, const Look& look, const std::vector<View>& views,
             const py::dict& settings, const py::object& progress) {
            RenderOptions options = toOptions(settings);
            const auto renderer = single.turn();
            runLong(progress, [&, scene, look](const Progress& part) {
              options.progress = part;
              return renderer->prepare(scene, look, views, options);
            });
          },
          "scene"_a, "look"_a, "views"_a, "settings"_a, "progress"_a)
      .def(
          "panorama",
          [](SingleRenderer& single, const Scene& scene, const Look& look, double time, const View& from,
             const py::object& kind, float ipd, float knobHeight, float strip, const py::dict& settings,
             const py::object& progress) {
            const Panorama panorama{.kind = PanoramaKind(wordOf(kind, "kind", {"vr180", "ods", "mono360"})),
                                    .ipd = ipd,
                                    .knobHeight = knobHeight,
                                    .strip = strip};
            RenderOptions options = toOptions(settings);
            const auto renderer = single.turn();
            return toPython(runLong(progress, [&, scene, look](const Progress& part) {
              options.progress = part;
              return renderPanorama(*renderer, scene, look, time, from, panorama, options);
            }));
          },
          "scene"_a, "look"_a, "time"_a, "view"_a, "kind"_a, "ipd"_a, "knob_height"_a, "strip"_a,
          "settings"_a, "progress"_a)
      .def_property_readonly("frames_begun",
                             [](SingleRenderer& single) { return single.turn()->framesBegun(); })
      .def("graph", [](SingleRenderer& single) { return single.turn()->graph(); })
      .def_property_readonly("device", [](SingleRenderer& single) { return single.turn()->gpu().name; })
      .def_property_readonly("validation_messages",
                             [](SingleRenderer& single) { return single.turn()->validationMessages(); });
}

}  // namespace scumble_python
