// Scenes from files.
#include "scumble/scene.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"

using namespace scumble;
using namespace pybind11::literals;

namespace scumble_python {
namespace {

SceneOptions toSceneOptions(int scene, const py::object& patterns, bool allowOutside) {
  return {
      .scene = scene,
      .allowOutside = allowOutside,
      .patternCoordinates = PatternCoordinates(wordOf(patterns, "patterns", {"automatic", "file", "own"}))};
}

py::dict summaryOf(const Scene& scene) {
  const SceneSummary summary = scene.summary();
  py::dict clips;
  for (const SceneSummary::Clip& clip : summary.clips) clips[py::str(clip.name)] = clip.duration;
  return py::dict(
      "meshes"_a = summary.meshes, "primitives"_a = summary.primitives, "triangles"_a = summary.triangles,
      "vertices"_a = summary.vertices, "nodes"_a = summary.nodes, "materials"_a = summary.materialNames,
      "node_names"_a = summary.nodeNames, "images"_a = summary.images, "skins"_a = summary.skins,
      "morph_targets"_a = summary.morphTargets, "strokes"_a = summary.strokes, "points"_a = summary.points,
      "brushes"_a = summary.brushes, "cameras"_a = summary.cameras, "lights"_a = summary.lights,
      "clips"_a = clips, "min"_a = py::make_tuple(summary.min[0], summary.min[1], summary.min[2]),
      "max"_a = py::make_tuple(summary.max[0], summary.max[1], summary.max[2]),
      "surroundings"_a = summary.surroundings, "extensions_used"_a = summary.extensionsUsed,
      "extensions_not_supported"_a = summary.extensionsNotSupported);
}

}  // namespace

void addScene(py::module_& module) {
  py::class_<Scene>(module, "Scene", "A scene in memory. It never changes; SceneEditor makes others of it.")
      .def(py::init([](const Path& path, int scene, const py::object& patterns, bool allowOutside,
                       const py::object& progress) {
             SceneOptions options = toSceneOptions(scene, patterns, allowOutside);
             return runLong(progress, [&](const Progress& part) {
               options.progress = part;
               return Scene::load(path.string(), options);
             });
           }),
           "path"_a, py::kw_only(), "scene"_a = -1, "patterns"_a = "automatic", "allow_outside"_a = false,
           "progress"_a = py::none(),
           "Reads a .gltf or .glb, a painting (.tilt) or a world (.json). scene: which of the file's; "
           "patterns: automatic, file or\n"
           "own coordinates; allow_outside: its URIs may lead out of its folder; progress: called with the "
           "part that is done.")
      .def_static(
          "from_bytes",
          [](const py::buffer& bytes, const std::string& name, const Path& folder, int scene,
             const py::object& patterns, bool allowOutside, const py::object& progress) {
            const py::buffer_info info = bytes.request();
            SceneOptions options = toSceneOptions(scene, patterns, allowOutside);
            return runLong(progress, [&](const Progress& part) {
              options.progress = part;
              return Scene::loadFromMemory(info.ptr, size_t(info.size * info.itemsize), name, folder.string(),
                                           options);
            });
          },
          "bytes"_a, py::kw_only(), "name"_a = "scene", "folder"_a = "", "scene"_a = -1,
          "patterns"_a = "automatic", "allow_outside"_a = false, "progress"_a = py::none(),
          "A glTF or GLB in memory, bytes or another buffer. folder: where its files lie; without one it "
          "must "
          "hold everything itself.")
      .def_static(
          "combine", [](const std::vector<Scene>& scenes) { return Scene::combine(scenes); }, "scenes"_a,
          "Several scenes in one world.")
      .def_static(
          "place",
          [](const std::vector<py::dict>& scenes) {
            std::vector<PlacedScene> placed;
            for (const py::dict& one : scenes) {
              PlacedScene place;
              for (const auto& [key, value] : one) {
                const std::string name = py::str(key);
                if (name == "scene")
                  place.scene = as<Scene>(value, name, "a Scene");
                else if (name == "name")
                  place.name = as<std::string>(value, name);
                else if (name == "at")
                  place.at = toVec3(value, "at");
                else if (name == "turn")
                  place.turn = toVec3(value, "turn");
                else if (name == "scale")
                  place.scale = as<float>(value, name);
                else if (name == "on")
                  place.on = as<std::string>(value, name);
                else
                  raiseUsage("a place has no '" + name + "'", "it has scene, name, at, turn, scale and on");
              }
              if (place.scene.empty())
                raiseUsage("a place without a scene", "give {'scene': scene, 'at': (x, y, z)}");
              placed.push_back(std::move(place));
            }
            return valueOf(Scene::place(placed));
          },
          "scenes"_a,
          "Several scenes, each at its place: dicts of scene, name, at (metres), turn (degrees about x, y, "
          "z), scale and on\n"
          "(the node that it stands on, such as 'boat/Deck').")
      .def("summary", &summaryOf, "What is in it: counts, names, clips with their seconds, bounds (metres).")
      .def_property_readonly(
          "warnings", [](const Scene& scene) { return scene.warnings(); },
          "What was ignored or replaced, each a line.")
      .def_property_readonly(
          "files", [](const Scene& scene) { return scene.files(); }, "Files that it names beside its own.")
      .def("__repr__", [](const Scene& scene) {
        const SceneSummary summary = scene.summary();
        return "<scumble.Scene: " + std::to_string(summary.triangles) + " triangles, " +
               std::to_string(summary.nodes) + " nodes, " + std::to_string(summary.materials) + " materials>";
      });
}

}  // namespace scumble_python
