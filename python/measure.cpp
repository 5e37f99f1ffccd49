// Coherence and steadiness in numbers.
#include "scumble/measure.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "viewpoint.h"

using namespace scumble;
using namespace pybind11::literals;

namespace scumble_python {
namespace {

py::dict toPython(const PerField& both) {
  return py::dict("vectors"_a = both.vectors, "marks"_a = both.marks);
}

py::dict toPython(const ModeMeasurements& mode) {
  py::list zoom;
  for (const ZoomPoint& point : mode.zoom)
    zoom.append(py::dict("zoom"_a = point.zoom, "frequency"_a = toPython(point.frequency),
                         "contrast"_a = toPython(point.contrast)));
  return py::dict(
      "temporal"_a =
          py::dict("dolly"_a = toPython(mode.temporal.dolly), "orbit"_a = toPython(mode.temporal.orbit),
                   "roll"_a = toPython(mode.temporal.roll), "object"_a = toPython(mode.temporal.object),
                   "mean"_a = toPython(mode.temporal.mean())),
      "zoom"_a = zoom, "frequency_drift"_a = toPython(mode.frequencyDrift),
      "contrast_deviation"_a = toPython(mode.contrastDeviation),
      "contrast_error"_a = toPython(mode.contrastError), "flatness"_a = toPython(mode.flatness),
      "stereo"_a = py::dict("warp"_a = toPython(mode.stereo.warp), "final_shadow"_a = mode.stereo.finalShadow,
                            "color"_a = mode.stereo.color, "final_color"_a = mode.stereo.finalColor,
                            "marks_in_conflict"_a = mode.stereo.marksInConflict,
                            "picture_in_conflict"_a = mode.stereo.pictureInConflict),
      "marks"_a = py::dict("born"_a = mode.marks.born, "died"_a = mode.marks.died));
}

py::dict toPython(const Measurements& measurements) {
  py::dict modes, targets;
  for (const ModeMeasurements& mode : measurements.modes) modes[py::str(mode.mode)] = toPython(mode);
  for (const MeasureTarget& target : measurements.targets)
    targets[py::str(target.name)] = py::dict("meaning"_a = target.meaning, "value"_a = target.value,
                                             "limit"_a = target.limit, "kept"_a = target.isKept());
  return py::dict("modes"_a = modes, "example_frequency"_a = toPython(measurements.exampleFrequency),
                  "visible"_a = measurements.visible, "tiles"_a = measurements.tiles,
                  "ipd"_a = measurements.ipd, "targets"_a = targets);
}

py::dict toPython(const LineSteadiness& lines) {
  return py::dict("method"_a = lines.method, "drawn"_a = lines.drawn, "changes"_a = lines.changes,
                  "flickers"_a = lines.flickers);
}

py::dict toPython(const StepMeasurements& step) {
  return py::dict("hold"_a = step.hold, "stands"_a = step.stands, "jump"_a = step.jump,
                  "far_jump"_a = step.farJump, "jump_degrees"_a = step.jumpDegrees,
                  "far_jump_degrees"_a = step.farJumpDegrees, "moving"_a = step.moving,
                  "changes"_a = step.changes);
}

MeasureOptions toMeasureOptions(const py::dict& viewpoint, std::pair<uint32_t, uint32_t> size,
                                uint32_t samples, uint32_t seed, std::optional<float> ipd) {
  return {.width = size.first,
          .height = size.second,
          .samples = samples,
          .seed = seed,
          .viewpoint = toViewpoint(viewpoint),
          .ipd = ipd};
}

std::function<bool(int, int)> inSteps(const Progress& progress) {
  return [&progress](int done, int total) { return progress(double(done) / total); };
}

}  // namespace

void addMeasure(py::module_& module) {
  module.def(
      "_measure",
      [](SingleRenderer& single, const Scene& scene, const Look& look, const py::dict& viewpoint,
         std::pair<uint32_t, uint32_t> size, uint32_t samples, uint32_t seed, std::optional<float> ipd,
         const py::object& progress) {
        MeasureOptions options = toMeasureOptions(viewpoint, size, samples, seed, ipd);
        const auto renderer = single.turn();
        return toPython(runLong(progress, [&, scene, look](const Progress& part) {
          options.progress = inSteps(part);
          return measure(*renderer, scene, look, options);
        }));
      },
      "renderer"_a, "scene"_a, "look"_a, "viewpoint"_a, "size"_a, "samples"_a, "seed"_a, "ipd"_a,
      "progress"_a);
  module.def(
      "_measure_lines",
      [](SingleRenderer& single, const Scene& scene, const Look& look, const std::string& aov,
         const py::dict& viewpoint, std::pair<uint32_t, uint32_t> size, uint32_t samples, uint32_t seed,
         const py::object& progress) {
        MeasureOptions options = toMeasureOptions(viewpoint, size, samples, seed, {});
        const auto renderer = single.turn();
        const LineMeasurements measured = runLong(progress, [&, scene, look](const Progress& part) {
          options.progress = inSteps(part);
          return measureLines(*renderer, scene, look, aov, options);
        });
        py::dict result = toPython(measured.lines);
        result["views"] = measured.views;
        return result;
      },
      "renderer"_a, "scene"_a, "look"_a, "aov"_a, "viewpoint"_a, "size"_a, "samples"_a, "seed"_a,
      "progress"_a);
  module.def(
      "_measure_steps",
      [](SingleRenderer& single, const Scene& scene, const Look& look, const std::vector<int>& holds,
         const py::dict& viewpoint, std::pair<uint32_t, uint32_t> size, uint32_t samples, uint32_t seed,
         const py::object& progress) {
        MeasureOptions options = toMeasureOptions(viewpoint, size, samples, seed, {});
        const auto renderer = single.turn();
        py::list all;
        for (const StepMeasurements& step : runLong(progress, [&, scene, look](const Progress& part) {
               options.progress = inSteps(part);
               return measureSteps(*renderer, scene, look, holds, options);
             }))
          all.append(toPython(step));
        return all;
      },
      "renderer"_a, "scene"_a, "look"_a, "holds"_a, "viewpoint"_a, "size"_a, "samples"_a, "seed"_a,
      "progress"_a);
  module.def(
      "_steadiness",
      [](const std::string& method, const std::vector<py::object>& drawings, double degreesAStep) {
        std::vector<Image> images;
        for (const py::object& drawing : drawings) images.push_back(toImage(drawing, "a drawing"));
        return toPython(
            runLong(py::none(), [&](const Progress&) { return steadinessOf(method, images, degreesAStep); }));
      },
      "method"_a, "drawings"_a, "degrees_a_step"_a);
}

}  // namespace scumble_python
