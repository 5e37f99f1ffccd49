// Scenes: glTF 2.0 files in memory, checked, with everything that the renderer draws from.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/progress.h"
#include "scumble/result.h"

namespace scumble {

namespace scene {
struct SceneData;
}

// What the patterns that tear edges and mark the change of light follow over a surface.
enum class PatternCoordinates : uint8_t {
  automatic,  // the file's texture coordinates, unless they are an atlas of pieces or very uneven
              // (docs/scene.md)
  file,       // the file's texture coordinates, wherever they map a surface at all
  own,        // coordinates made from the shape, which know no seams
};

struct SceneOptions {
  int scene = -1;             // which of the file's scenes; -1: its default one
  bool allowOutside = false;  // whether URIs may lead out of the scene's folder upwards
  PatternCoordinates patternCoordinates = PatternCoordinates::automatic;
  int threads = 0;         // for decoding; 0: as many as the machine has
  Progress progress = {};  // of load() and loadFromMemory(); of a world, file by file
  // False: files are copied to memory as they are opened. Those that are mapped must stay as long as they are
  // while they are read, since bytes that are cut off then end the program (SIGBUS); of copies it is an
  // error.
  bool mapsFiles = true;
  // False: vertices, but for those of skinned and morphed meshes, are dropped from memory as they reach the
  // device of the renderer that draws the scene first with a look without tracks. Meanwhile no other thread
  // may use the scene, nor one that shares its meshes. From then on that renderer alone draws it, where look
  // and options agree about ground, features, clips, settings of nodes, who casts shadows and
  // light.shadowWarp; what else needs the vertices (other frames, prepare(), scenes that share its meshes)
  // ends in ErrorKind::usage. After a frame that failed the scene may have to be loaded again.
  bool keepsVertices = true;
};

// What loading took, in milliseconds of wall clock.
struct SceneTimings {
  double read = 0, parse = 0, geometry = 0, images = 0;
};

// What is in a file, for people and scripts.
struct SceneSummary {
  struct Clip {
    std::string name;
    double duration = 0;  // seconds
  };
  size_t meshes = 0, primitives = 0, triangles = 0, vertices = 0, nodes = 0, materials = 0, images = 0,
         skins = 0, morphTargets = 0;
  size_t ownPatterns = 0;            // primitives whose patterns do not follow the file's coordinates
  size_t strokes = 0, points = 0;    // of paintings in space
  std::vector<std::string> brushes;  // theirs, as the files call them
  std::vector<std::string> cameras, lights, materialNames;
  std::vector<std::string> nodeNames;  // of those that have one, in the file's order
  std::vector<Clip> clips;
  std::vector<std::string> extensionsUsed, extensionsNotSupported;
  double min[3] = {0, 0, 0}, max[3] = {0, 0, 0};  // world bounds, metres
  // Nodes that do not decide the framing: low, and far larger than all that stands on them (docs/stage.md).
  // Those without a name by their number.
  std::vector<std::string> surroundings;
};

struct PlacedScene;

// An immutable scene (but SceneOptions::keepsVertices); copies are cheap and share the data. May be used from
// several threads.
class SCUMBLE_API Scene {
 public:
  // Reads .gltf or .glb, or a world: a .json that lists such files with their places (docs/scene.md). Fails
  // with ErrorKind::unusableFile, and with usage for options out of range.
  static Result<Scene> load(const std::string& path, const SceneOptions& options = {});

  // The same from a glTF or GLB in memory; URIs are resolved relative to `folder`. With an empty `folder` no
  // file is ever opened: the scene must hold everything itself. `name` is what messages call it.
  static Result<Scene> loadFromMemory(const void* bytes, size_t size, const std::string& name,
                                      const std::string& folder, const SceneOptions& options = {});

  // Several scenes in one world, in the given order; cameras of the first come first.
  static Scene combine(const std::vector<Scene>& scenes);

  // The same, each at its place: its roots hang below a new node of its name, and that below the node that it
  // stands on. So it rides with that, whatever moves it. A scene that stands in the list more than once
  // shares meshes, materials and images. Fails with ErrorKind::usage for numbers that place nothing, nodes
  // that are not there or are several scenes', and scenes that stand on each other in a circle.
  static Result<Scene> place(const std::vector<PlacedScene>& scenes);

  bool empty() const { return !data_; }  // true of a Scene that was not loaded

  SceneSummary summary() const;

  // Origin of the scene's coordinates in the world, metres. The renderer measures from there, along the
  // world's axes, so that single precision suffices however far out the scene stands. It is (0, 0, 0) where
  // the middle of what is drawn lies within 500 m and within 50 of its radii of that; else the nearest point
  // of a grid of whole kilometres, or of a finer grid for scenes smaller than a metre. Patterns fixed in the
  // world are anchored there. See View::origin and RenderOptions::positionsFrom.
  glm::dvec3 origin() const;

  // Files beside its own that the scene names, whether or not they are there, and of several in one world (a
  // file's that lists them, too) their own: who writes files spares these.
  const std::vector<std::string>& files() const;
  const std::vector<std::string>& warnings() const;  // what was ignored or replaced, each once
  const SceneTimings& timings() const;

  // The data behind it, for the library's own rooms; not of an empty one.
  const scene::SceneData& data() const { return *data_; }

 private:
  friend class SceneEditor;
  friend struct RendererAccess;
  std::shared_ptr<const scene::SceneData> data_;
  SceneTimings timings_;
};

// A scene and its place in a world.
struct PlacedScene {
  Scene scene;
  // How others call it, and the name of the node that carries it; empty: its file's, without folder and
  // ending. Of scenes of one name the second is called "NAME-2", and so on.
  std::string name = {};
  // Where its origin lies: in the world, or from the origin of the node that it stands on, along the axes of
  // the scene which that belongs to, as they are at rest. Metres, each within +-1e7.
  glm::dvec3 at{0.0};
  glm::vec3 turn{0.0f};  // degrees about x, then y, then z
  float scale = 1;       // above 0
  // A node of another one of the scenes, "boat/Deck" to say of which, or one of those by its name; empty: it
  // stands in the world.
  std::string on = {};
};

}  // namespace scumble
