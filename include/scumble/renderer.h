// The renderer: a frame is a pure function of scene, look, time and views. The same call gives the same
// bytes.
//
// Functions here that take no renderer may be called from several threads at once.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scumble/drawing.h"
#include "scumble/export.h"
#include "scumble/frame_stats.h"
#include "scumble/image.h"
#include "scumble/log.h"
#include "scumble/look.h"
#include "scumble/progress.h"
#include "scumble/result.h"
#include "scumble/scene.h"
#include "scumble/view.h"

namespace scumble {

namespace renderer {
class PassList;
}

struct GpuInfo {
  std::string name, driver, apiVersion;
  bool isCpu = false;
  std::string unusableBecause;  // empty when scumble can use it
  bool wouldBeUsed = false;
  // What the device gets wrong or lacks, and what is done instead, a sentence each; found by drawing
  // (docs/gpu.md). From listGpus() alone.
  std::vector<std::string> workarounds;
};

// Every Vulkan device found, and which one the given choice (as in RendererOptions::device) means. Tries out
// each usable one, which takes up to a second where `cacheFolder` (as in RendererOptions) holds no answers
// yet.
SCUMBLE_API Result<std::vector<GpuInfo>> listGpus(const std::string& choice = "",
                                                  const std::string& cacheFolder = "");

enum class ImagePassKind { automatic, fragment, compute };

struct RendererOptions {
  std::string
      device;  // part of a name, a number of listGpus(), "cpu", "gpu" (any other), or empty: the best one
  bool validation = false;  // Vulkan validation layers; messages go to `log` and are counted
  std::string cacheFolder;  // compiled pipelines are kept here between runs; empty: nowhere
  ImagePassKind imagePasses = ImagePassKind::automatic;  // how image passes run; automatic measures nothing,
                                                         // it chooses by the kind of device (docs/gpu.md)
  // Bytes of device memory up to which scenes that were drawn stay on the device, ready to be drawn again
  // beside others; the one drawn last always does, and so do those whose vertices are nowhere else
  // (SceneOptions::keepsVertices).
  uint64_t sceneBudget = uint64_t(1) << 29;
  // Empty: messages of the validation layers go to stderr, and others nowhere.
  Log log;
  // For who works on shaders: SPIR-V files NAME.spv in this folder take the place of the library's own
  // shaders of those names, which are those in a build's generated/shaders. Empty: none do. What is in them
  // is checked by nobody but the validation layers; a folder or file that is none is ErrorKind::unusableFile.
  std::string shaderFolder;
  // Changes which passes draw the picture, for passes that live outside of the library
  // (src/renderer/pass_list.h, which is not installed); called once.
  std::function<void(renderer::PassList&)> arrangePasses;
};

// Views as a part of one picture all around: renderPanorama() (scumble/panorama.h) draws all of them, and
// puts them together.
struct SpherePart {
  // Turns directions of all the views' eye space into the sphere's: x right, y up, -z ahead.
  glm::mat3 eyeToSphere{1.0f};
  // Radians that stand for the picture's height where knobs count by that ("px at 1080 lines"); 0.001 to 100.
  float knobHeight = 1.5707964f;
};

struct RenderOptions {
  uint32_t width = 1280, height = 720;  // pixels, 1 to 16384
  uint32_t samples = 4;                 // 1 or 4
  std::vector<std::string> aovs;        // names of Renderer::aovNames()
  // As what the picture (named "") and AOVs come back; those that are not named, as 32-bit floats. Codes are
  // for colours only: the picture, and AOVs of which Image::isColor.
  std::map<std::string, PixelFormat> formats;
  // The lines of the look as strokes as well (Frame::drawings). Fails with usage for a look that draws none.
  bool drawing = false;
  bool transparent = false;  // leave the background out: alpha 0 where nothing is
  // What is behind everything, instead of the sky: a picture with channels R, G, B or R, G, B, A (put over
  // black), of any size up to 16384 a side, or what the device allows. It is scaled to cover the frame, with
  // its middle in the middle and its aspect kept; two views see the same, as if it were infinitely far. The
  // ground, where there is one, is then seen only by the shadows on it. Nothing is uploaded for a picture
  // that is the same object as in the frame before: do not change one that was given. Ignored where
  // `transparent`.
  std::shared_ptr<const Image> background;
  uint32_t seed = 0;
  // The views, the time (seconds) and the scene one frame earlier, for the motion AOV; empty: the same as
  // now. The scene is an earlier one of the same SceneEditor, with as many nodes; vertices at rest are taken
  // from the present one.
  std::vector<View> previousViews;
  std::optional<double> previousTime;
  Scene previousScene;
  // While the scene goes to the device and pipelines are compiled, which is most of a first frame, and until
  // the frame is sent; prepare() tells of all its frames. Cancelled, the frame is not drawn.
  Progress progress;
  // Each view is a part of a sphere: sizes are angles, of straight ahead; patterns on surfaces are as large
  // by their angle as elsewhere; and what lies on the screen (paper, what tears a background) lies on the
  // sphere instead. A background goes all around: left to right once around, with its middle ahead, top to
  // bottom from straight up to straight down. What a look does at the edges of its picture is left out.
  std::optional<SpherePart> sphere;
  // Origin of the AOV `position` in the world, metres. Far from (0, 0, 0) single precision rounds world
  // positions to centimetres; with Scene::origin() they stay exact.
  glm::dvec3 positionsFrom{0.0};
  // Late latch: called when the frame is recorded, just before it is sent, with its views, whose poses and
  // projections may be changed there. What decides where marks lie, which transparent surfaces are left out
  // because no view sees them, and their order stay as the first ones have it, so that it is for the last
  // milliseconds of a head's way. Views that cannot be drawn from change nothing.
  std::function<void(std::vector<View>&)> latch;
};

// A finished frame: for each view the picture and the AOVs that were asked for.
struct Frame {
  struct Layer {
    std::string name;          // empty for the picture itself, else the AOV's name
    std::vector<Image> views;  // one a view; shadow-map has one for all
  };
  std::vector<Layer> layers;
  // What the numbers of objects mean in the AOVs `id` and `cryptomatte`, where one of them was asked for:
  // number n is entry n - 1. One entry a node (its number, "node 12", where it has no name; empty where it
  // shows nothing), then "Ground" and the materials of features, empty where none is drawn.
  std::vector<std::string> objects;
  // What the numbers of materials mean in the AOV `id`, likewise: their names, as looks set knobs for them.
  std::vector<std::string> materials;
  std::vector<Drawing> drawings;  // one a view, where RenderOptions::drawing
  FrameStats stats;
};

// Seconds after which every clip that a look plays has played once; 0 where none does.
SCUMBLE_API double playedSeconds(const Scene& scene, const Look& look);

// How far Renderer::prepare goes: each does what those before it do, and takes longer (docs/embedding.md).
enum class Rehearsal {
  tracks,  // whatever time it is: tracks are followed along their keys
  knobs,   // whichever one knob is changed, of the whole scene or of one material or node
  pairs    // whichever two knobs of the whole scene are changed; on a renderer that has drawn nothing yet,
           // since those to be paired are known by what they compile
};

// One thread at a time uses a renderer: a call of another one meanwhile fails with usage and changes nothing,
// and nobody destroys a renderer while a call is under way. Renderers of their own are independent.
class SCUMBLE_API Renderer {
 public:
  static constexpr int kMaxViews = 6;
  static constexpr double kMaxTime = 1e6;  // seconds, either way: a float still tells hundredths apart

  static Result<std::unique_ptr<Renderer>> create(const RendererOptions& options = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Renders one frame: `time` in seconds (below kMaxTime), one view, two (left, right) or up to kMaxViews,
  // each of its own size where it has one. Clips play as the look says. Uploads the scene at its first use.
  // Fails with usage for options out of range, noUsableGpu when the device is lost or out of memory.
  Result<Frame> render(const Scene& scene, const Look& look, double time, const std::vector<View>& views,
                       const RenderOptions& options);

  // Uploads a scene, makes images, and compiles the pipelines that frames with these views and options need,
  // so that none is compiled while they run (FrameStats::pipelines), as far as they are rehearsed. For other
  // sizes, numbers of views, samples and AOVs call it for each; images of the last call's size stay. Fails as
  // render() does.
  Status prepare(const Scene& scene, const Look& look, const std::vector<View>& views,
                 const RenderOptions& options, Rehearsal extent = Rehearsal::tracks);

  // The same in two halves, for films: begin() returns while the device still draws, finish() waits for the
  // oldest frame that was begun and gives it. With kMaxBegun frames begun the device always has work. After a
  // failure of either with noUsableGpu or internal, no frame is under way any more.
  static constexpr int kMaxBegun = 3;
  Status begin(const Scene& scene, const Look& look, double time, const std::vector<View>& views,
               const RenderOptions& options);
  Result<Frame> finish();
  size_t framesBegun() const;  // and not finished: up to kMaxBegun

  // Names of everything that can be saved beside the picture; whether what one holds (metres, positions,
  // numbers of objects) needs 32 bits; and whether it has a size of its own, and one image for all views. The
  // picture's own name is empty.
  static std::vector<std::string> aovNames();
  static bool needsFloat(const std::string& aov);
  static bool hasSizeOfItsOwn(const std::string& aov);

  // The steps of the frame that was begun last, with what each reads and writes, for Graphviz (`dot -Tsvg`);
  // what its passes offer and nobody has asked for is grey. Empty before the first frame.
  std::string graph() const;

  GpuInfo gpu() const;
  int validationMessages() const;  // since the start

 private:
  friend struct RendererAccess;
  Renderer();
  class SCUMBLE_HIDDEN Turn;
  struct SCUMBLE_HIDDEN Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scumble
