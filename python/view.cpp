// From where a frame is seen.
#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "viewpoint.h"

using namespace scumble;
using namespace pybind11::literals;

namespace scumble_python {
Viewpoint toViewpoint(const py::dict& settings) {
  Viewpoint viewpoint;
  for (const auto& [key, value] : settings) {
    const std::string name = py::str(key);
    if (value.is_none()) continue;
    if (name == "camera") {
      viewpoint.camera = py::str(value);
    } else if (name == "frame") {
      viewpoint.frame = as<std::string>(value, name);
    } else if (name == "orbit") {
      const auto angles =
          as<std::vector<float>>(value, name, "(azimuth, elevation) or (azimuth, elevation, distance)");
      if (angles.size() != 2 && angles.size() != 3)
        raiseUsage("orbit has " + std::to_string(angles.size()) + " numbers",
                   "give (azimuth, elevation) or (azimuth, elevation, distance)");
      viewpoint.orbit = true, viewpoint.azimuth = angles[0], viewpoint.elevation = angles[1];
      if (angles.size() == 3) viewpoint.distance = angles[2];
    } else if (name == "turntable") {
      viewpoint.turntable = as<double>(value, name);
    } else if (name == "eye") {
      viewpoint.eye = toVec3(value, name);
    } else if (name == "target") {
      viewpoint.target = toVec3(value, name);
    } else if (name == "roll") {
      viewpoint.roll = as<float>(value, name);
    } else if (name == "fov") {
      viewpoint.verticalFov = as<float>(value, name);
    } else {
      raiseUsage("a viewpoint has no '" + name + "'",
                 "it has camera, frame, orbit, turntable, eye, target, roll and fov");
    }
  }
  return viewpoint;
}

void addViews(py::module_& module) {
  py::class_<View>(
      module, "View",
      "One eye. world_to_eye: 4 by 4; eye space has x right, y up and looks along -z; metres. eye_to_clip: 4 "
      "by 4, in Vulkan's\n"
      "convention with depth reversed (perspective() makes one). node: the scene's node that it hangs on, or "
      "-1; level: it does\n"
      "not tilt with that; size: (width, height), or (0, 0) for the frame's; rig: whose eye it is.")
      .def(py::init([](const py::object& worldToEye, const py::object& eyeToClip, int node, bool isLevel,
                       std::pair<uint32_t, uint32_t> size, int rig) {
             View view{{}, toMatrix(eyeToClip, "eye_to_clip"), node, isLevel, {size.first, size.second}, rig};
             setWorldToEye(view, toMatrix(worldToEye, "world_to_eye"));
             return view;
           }),
           "world_to_eye"_a, "eye_to_clip"_a, py::kw_only(), "node"_a = -1, "level"_a = false,
           "size"_a = std::pair<uint32_t, uint32_t>(0, 0), "rig"_a = 0)
      .def_property_readonly("world_to_eye", [](const View& view) { return toArray(worldToEyeOf(view)); })
      .def_property_readonly("eye_to_clip", [](const View& view) { return toArray(view.eyeToClip); })
      .def_readonly("node", &View::node)
      .def_readonly("level", &View::isLevel)
      .def_property_readonly("size",
                             [](const View& view) { return py::make_tuple(view.size.x, view.size.y); })
      .def_readonly("rig", &View::rig)
      .def("__copy__", [](const View& view) { return view; })
      .def(
          "__deepcopy__", [](const View& view, const py::dict&) { return view; }, "memo"_a)
      .def("__repr__", [](const View& view) {
        const glm::dvec3 eye(glm::inverse(worldToEyeOf(view))[3]);
        return "<scumble.View from " + std::to_string(eye.x) + ", " + std::to_string(eye.y) + ", " +
               std::to_string(eye.z) + ">";
      });

  module.def(
      "perspective",
      [](float fov, float aspect, float near) {
        if (!(fov > 0 && fov < 3.1415926f)) raiseUsage("fov is out of range", "it is in radians, below pi");
        if (!(aspect > 0) || !(near > 0)) raiseUsage("aspect and near are above 0");
        return toArray(perspectiveProjection(fov, aspect, near));
      },
      "fov"_a, "aspect"_a, "near"_a = 0.1f,
      "A projection for View without a far plane: fov is vertical, radians; near in metres.");
  module.def(
      "orthographic",
      [](float halfHeight, float aspect, float near, float far) {
        if (!(halfHeight > 0) || !(aspect > 0) || !(near < far))
          raiseUsage("half_height and aspect are above 0, and near is less than far");
        return toArray(orthographicProjection(halfHeight, aspect, near, far));
      },
      "half_height"_a, "aspect"_a, "near"_a, "far"_a, "A parallel projection for View; metres.");
  module.def(
      "_views",
      [](const Scene& scene, const py::dict& viewpoint, float aspect, bool stereo, float ipd,
         const Look& look, double time) {
        return valueOf(makeViews(scene, toViewpoint(viewpoint), aspect,
                                 stereo ? Stereo::stereo : Stereo::mono, ipd, look, time));
      },
      "scene"_a, "viewpoint"_a, "aspect"_a, "stereo"_a, "ipd"_a, "look"_a, "time"_a);
  module.def(
      "_nodes_to_world",
      [](const Scene& scene, const Look& look, double time) {
        const std::vector<glm::dmat4> matrices = nodesToWorld(scene, look, time);
        py::array_t<double> all({matrices.size(), size_t(4), size_t(4)});
        for (size_t i = 0; i < matrices.size(); ++i) all[py::int_(i)] = toArray(matrices[i]);
        return all;
      },
      "scene"_a, "look"_a, "time"_a);
}

}  // namespace scumble_python
