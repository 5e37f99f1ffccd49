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
std::string aovOf(const std::string& name) {
  return name == kPicture ? "" : name;
}

PixelFormat formatOf(const std::string& dtype) {
  if (dtype == "float32") return PixelFormat::float32;
  if (dtype == "float16") return PixelFormat::half;
  if (dtype == "uint8") return PixelFormat::srgb8;
  raiseUsage("pictures do not come as '" + dtype + "'", "say float32, float16 or uint8");
}

RenderOptions toOptions(const py::dict& settings) {
  RenderOptions options;
  for (const auto& [key, value] : settings) {
    const std::string name = py::str(key);
    if (name == "size") {
      std::tie(options.width, options.height) = value.cast<std::pair<uint32_t, uint32_t>>();
    } else if (name == "samples") {
      options.samples = value.cast<uint32_t>();
    } else if (name == "seed") {
      options.seed = value.cast<uint32_t>();
    } else if (name == "aovs") {
      options.aovs = value.cast<std::vector<std::string>>();
    } else if (name == "dtypes") {
      for (const auto& [layer, dtype] : value.cast<std::map<std::string, std::string>>())
        options.formats[aovOf(layer)] = formatOf(dtype);
    } else if (name == "drawing") {
      options.drawing = value.cast<bool>();
    } else if (name == "transparent") {
      options.transparent = value.cast<bool>();
    } else if (name == "background") {
      if (!value.is_none())
        options.background =
            std::make_shared<Image>(toLinearImage(value.cast<py::array>(), "the background"));
    } else if (name == "previous_views") {
      options.previousViews = value.cast<std::vector<View>>();
    } else if (name == "previous_time") {
      if (!value.is_none()) options.previousTime = value.cast<double>();
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

Panorama toPanorama(const std::string& kind, float ipd, float knobHeight, float strip) {
  Panorama panorama{.ipd = ipd, .knobHeight = knobHeight, .strip = strip};
  if (kind == "vr180")
    panorama.kind = PanoramaKind::vr180;
  else if (kind == "ods")
    panorama.kind = PanoramaKind::ods;
  else if (kind == "mono360")
    panorama.kind = PanoramaKind::mono360;
  else
    raiseUsage("there is no panorama '" + kind + "'", "say vr180, ods or mono360");
  return panorama;
}

}  // namespace

void addRenderer(py::module_& module) {
  module.def(
      "_devices",
      [](const std::string& choice, const std::string& cacheFolder) {
        Result<std::vector<GpuInfo>> found = [&] {
          const py::gil_scoped_release released;
          return listGpus(choice, cacheFolder);
        }();
        py::list all;
        for (const GpuInfo& gpu : valueOf(std::move(found)))
          all.append(py::dict("name"_a = gpu.name, "driver"_a = gpu.driver, "api_version"_a = gpu.apiVersion,
                              "cpu"_a = gpu.isCpu, "unusable_because"_a = gpu.unusableBecause,
                              "would_be_used"_a = gpu.wouldBeUsed, "workarounds"_a = gpu.workarounds));
        return all;
      },
      "choice"_a, "cache"_a);
  module.def("aovs", &Renderer::aovNames, "Names of everything that render() gives beside the picture.");
  module.def("played_seconds", &playedSeconds, "scene"_a, "look"_a = Look(),
             "Seconds after which every clip that a look plays has played once; 0 where none does.");
  module.attr("_MAX_BEGUN") = Renderer::kMaxBegun;

  py::class_<Renderer>(module, "_Renderer")
      .def(py::init([](const std::string& device, const std::string& cache, bool validation) {
             const RendererOptions options{.device = device, .validation = validation, .cacheFolder = cache};
             return runLong(py::none(), [&](const Progress&) { return Renderer::create(options); });
           }),
           "device"_a, "cache"_a, "validation"_a)
      .def(
          "render",
          [](Renderer& renderer, const Scene& scene, const Look& look, double time,
             const std::vector<View>& views, const py::dict& settings, const py::object& progress) {
            RenderOptions options = toOptions(settings);
            return toPython(runLong(progress, [&, scene, look](const Progress& part) {
              options.progress = part;
              return renderer.render(scene, look, time, views, options);
            }));
          },
          "scene"_a, "look"_a, "time"_a, "views"_a, "settings"_a, "progress"_a)
      .def(
          "begin",
          [](Renderer& renderer, const Scene& scene, const Look& look, double time,
             const std::vector<View>& views, const py::dict& settings) {
            RenderOptions options = toOptions(settings);
            runLong(py::none(), [&, scene, look](const Progress& part) {
              options.progress = part;
              return renderer.begin(scene, look, time, views, options);
            });
          },
          "scene"_a, "look"_a, "time"_a, "views"_a, "settings"_a)
      .def("finish",
           [](Renderer& renderer) {
             return toPython(runLong(py::none(), [&](const Progress&) { return renderer.finish(); }));
           })
      .def_property_readonly("frames_begun", &Renderer::framesBegun)
      .def(
          "prepare",
          [](Renderer& renderer, const Scene& scene, const Look& look, const std::vector<View>& views,
             const py::dict& settings, const py::object& progress) {
            RenderOptions options = toOptions(settings);
            runLong(progress, [&, scene, look](const Progress& part) {
              options.progress = part;
              return renderer.prepare(scene, look, views, options);
            });
          },
          "scene"_a, "look"_a, "views"_a, "settings"_a, "progress"_a)
      .def(
          "panorama",
          [](Renderer& renderer, const Scene& scene, const Look& look, double time, const View& from,
             const std::string& kind, float ipd, float knobHeight, float strip, const py::dict& settings,
             const py::object& progress) {
            const Panorama panorama = toPanorama(kind, ipd, knobHeight, strip);
            RenderOptions options = toOptions(settings);
            options.width = options.height * aspectOf(panorama.kind);
            return toPython(runLong(progress, [&, scene, look](const Progress& part) {
              options.progress = part;
              return renderPanorama(renderer, scene, look, time, from, panorama, options);
            }));
          },
          "scene"_a, "look"_a, "time"_a, "view"_a, "kind"_a, "ipd"_a, "knob_height"_a, "strip"_a,
          "settings"_a, "progress"_a)
      .def("graph", &Renderer::graph)
      .def_property_readonly("device", [](const Renderer& renderer) { return renderer.gpu().name; })
      .def_property_readonly("validation_messages", &Renderer::validationMessages);
}

}  // namespace scumble_python
