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

PatternCoordinates patternsOf(const std::string& word) {
  if (word == "automatic") return PatternCoordinates::automatic;
  if (word == "file") return PatternCoordinates::file;
  if (word == "own") return PatternCoordinates::own;
  raiseUsage("there are no patterns '" + word + "'", "say automatic, file or own");
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
      .def(py::init([](const Path& path, int scene, const std::string& patterns, bool allowOutside,
                       const py::object& progress) {
             SceneOptions options{
                 .scene = scene, .allowOutside = allowOutside, .patternCoordinates = patternsOf(patterns)};
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
          [](const py::bytes& bytes, const std::string& name, const Path& folder) {
            const std::string_view view = bytes;
            return runLong(py::none(), [&](const Progress& part) {
              return Scene::loadFromMemory(view.data(), view.size(), name, folder.string(),
                                           {.progress = part});
            });
          },
          "bytes"_a, py::kw_only(), "name"_a = "scene", "folder"_a = "",
          "A glTF or GLB in memory. folder: where its files lie; without one it must hold everything itself.")
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
                  place.scene = value.cast<Scene>();
                else if (name == "name")
                  place.name = value.cast<std::string>();
                else if (name == "at")
                  place.at = toVec3(value, "at");
                else if (name == "turn")
                  place.turn = toVec3(value, "turn");
                else if (name == "scale")
                  place.scale = value.cast<float>();
                else if (name == "on")
                  place.on = value.cast<std::string>();
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
