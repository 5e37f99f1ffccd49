// Looks and knobs.
#include "scumble/look.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "scumble/check.h"

using namespace scumble;
using namespace pybind11::literals;

namespace scumble_python {
namespace {

py::object toPython(const KnobValue& value) {
  if (const glm::vec3* color = std::get_if<glm::vec3>(&value))
    return py::make_tuple(color->r, color->g, color->b);
  return std::visit(
      [](const auto& held) -> py::object {
        if constexpr (std::is_same_v<std::decay_t<decltype(held)>, glm::vec3>)
          return py::none();
        else
          return py::cast(held);
      },
      value);
}

// numpy's numbers are numbers as well, and so are arrays of one.
KnobValue toKnobValue(py::object value, const std::string& path) {
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::hasattr(value, "size") && py::hasattr(value, "item") &&
      py::object(value.attr("size")).equal(py::int_(1)))
    value = value.attr("item")();
  if (PyBool_Check(value.ptr())) return value.cast<bool>();
  if (py::isinstance<py::int_>(value)) {
    const double number = py::float_(value);
    if (std::abs(number) > 2147483647.0) return number;
    return int(number);
  }
  if (py::isinstance<py::float_>(value)) return value.cast<double>();
  const bool isList = py::isinstance<py::sequence>(value) && !py::isinstance<py::bytes>(value);
  if (isList || py::isinstance<py::array>(value)) return toVec3(value, "the value of " + path);
  refuse(value, "a knob", "a number, True or False, a text or three numbers");
}

KnobTrack toTrack(const py::iterable& keys, const py::object& interpolation, bool repeat,
                  const std::string& path) {
  KnobTrack track{.repeat = repeat};
  track.interpolation =
      Interpolation(wordOf(interpolation, "interpolation", {"step", "linear", "cubic", "ease"}));
  for (const py::handle key : keys) {
    if (!py::isinstance<py::sequence>(key) || py::len(key) != 2)
      raiseUsage("a key is no pair", "give (seconds, value)");
    const py::sequence pair = py::reinterpret_borrow<py::sequence>(key);
    track.keys.push_back({as<double>(pair[0], "the time of a key"), toKnobValue(pair[1], path)});
  }
  return track;
}

py::dict toPython(const Knob& knob) {
  return py::dict("path"_a = knob.path, "type"_a = knob.type, "default"_a = knob.defaultValue,
                  "min"_a = knob.min, "max"_a = knob.max, "unit"_a = knob.unit, "meaning"_a = knob.meaning,
                  "targets"_a = knob.targets);
}

}  // namespace

void addLook(py::module_& module) {
  py::class_<Look>(
      module, "Look",
      "Art direction: values of knobs. Look() has all defaults; Look('ink') is one that ships (looks()), "
      "and\n"
      "Look('mine.json') a file. look['shadow.threshold'] = 0.4 sets a knob, also of one material\n"
      "('materials.Sail*.warp.amount') or node; del takes it back.")
      .def(py::init<>())
      .def(py::init([](const Path& nameOrFile) { return valueOf(Look::load(nameOrFile.string())); }),
           "name_or_file"_a)
      .def_static(
          "from_json",
          [](const std::string& text, const Path& file) {
            return valueOf(Look::fromJson(text, file.string()));
          },
          "text"_a, "file"_a = "look.json",
          "A look from the text of a look's file. file: what messages call it, and beside what its pictures "
          "lie.")
      .def(
          "copy", [](const Look& look) { return look; }, "Another one of the same settings.")
      .def("__copy__", [](const Look& look) { return look; })
      .def(
          "__deepcopy__", [](const Look& look, const py::dict&) { return look; }, "memo"_a)
      .def(
          "set",
          [](Look& look, const std::string& path, const py::object& value) {
            done(look.set(path, toKnobValue(value, path)));
          },
          "path"_a, "value"_a,
          "Sets a knob: a number, a bool, three numbers (a linear colour, a vector) or a text as `scumble "
          "--set`\ntakes it ('#EADFC8').")
      .def(
          "__setitem__",
          [](Look& look, const std::string& path, const py::object& value) {
            done(look.set(path, toKnobValue(value, path)));
          },
          "path"_a, "value"_a)
      .def(
          "set_track",
          [](Look& look, const std::string& path, const py::iterable& keys, const py::object& interpolation,
             bool repeat) { done(look.set(path, toTrack(keys, interpolation, repeat, path))); },
          "path"_a, "keys"_a, "interpolation"_a = "linear", "repeat"_a = false,
          "Lets a knob change with time. keys: (seconds, value), ...; interpolation: step, linear, cubic or "
          "ease.")
      .def(
          "unset", [](Look& look, const std::string& path) { done(look.unset(path)); }, "path"_a,
          "Takes back what was set by this very path.")
      .def(
          "__delitem__", [](Look& look, const std::string& path) { done(look.unset(path)); }, "path"_a)
      .def(
          "get",
          [](const Look& look, const std::string& path, double time) {
            return toPython(valueOf(look.get(path, time)));
          },
          "path"_a, "time"_a = 0.0, "A knob's value at a time in seconds. Colours are three linear numbers.")
      .def(
          "__getitem__",
          [](const Look& look, const std::string& path) { return toPython(valueOf(look.get(path))); },
          "path"_a)
      .def(
          "__contains__",
          [](const Look& look, const py::object& path) {
            return py::isinstance<py::str>(path) && look.get(path.cast<std::string>()).ok();
          },
          "path"_a, "Whether there is such a knob.")
      .def_property_readonly("animated", &Look::animated, "Paths of settings that change with time.")
      .def_property_readonly("last_key_time", &Look::lastKeyTime, "Seconds of the last key of all tracks.")
      .def_property_readonly("description", &Look::description, "What its file says it is.")
      .def_property_readonly("files", &Look::files, "Files that it was read from.")
      .def_property_readonly(
          "warnings", [](const Look& look) { return look.warnings(); },
          "What its file says to no effect, each a line.")
      .def(
          "check",
          [](const Look& look, const Scene& scene, bool isForScene) {
            std::vector<std::string> lines;
            for (const Finding& finding : check(scene, look, isForScene))
              lines.push_back(finding.setting + ": " + finding.problem);
            return lines;
          },
          "scene"_a, "for_scene"_a = false,
          "What it says to no effect in a scene, each a line. for_scene: its file is meant for this one "
          "scene.")
      .def("__repr__", [](const Look& look) {
        return "<scumble.Look" + (look.description().empty() ? "" : ": " + look.description()) + ">";
      });

  module.attr("Look").attr("__iter__") = py::none();  // it has no keys to go through
  module.def(
      "looks",
      [] {
        py::dict all;
        for (const ShippedLook& look : Look::shipped()) all[py::str(look.name)] = look.description;
        return all;
      },
      "The looks that ship: their descriptions by name.");
  module.def(
      "knobs",
      [](const std::string& prefix) {
        std::vector<py::dict> all;
        for (const Knob& knob : Look::knobs())
          if (knob.path.starts_with(prefix)) all.push_back(toPython(knob));
        return all;
      },
      "prefix"_a = "",
      "The knobs whose paths begin so, each a dict of texts: path, type, default, min, max, unit, meaning, "
      "targets.");
  module.def("look_schema", &Look::jsonSchema, "The JSON schema of looks' files, as text.");
}

}  // namespace scumble_python
