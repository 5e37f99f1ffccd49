// Pictures all around, to stand inside of: for headsets, domes and players that turn with the head.
//
// A picture's columns are longitudes and its rows latitudes, evenly: the middle lies ahead of the camera,
// level, however that is pitched and rolled; top and bottom are straight up and down. It is drawn as many
// small frames with perspective (RenderOptions::sphere), which overlap, and mixed from those. With two eyes
// each looks from its own place for each longitude, as far apart as eyes are and square to it
// (omnidirectional stereo), so that there is depth whichever way the head turns. Towards straight up and down
// the eyes draw together, from 40 degrees on until they are one at 85: there is no left and right overhead.
#pragma once

#include <vector>

#include "scumble/renderer.h"

namespace scumble {

enum class PanoramaKind {
  vr180,   // two eyes, the half that lies ahead: 180 by 180 degrees
  ods,     // two eyes, all around: 360 by 180 degrees
  mono360  // one eye, all around
};

struct Panorama {
  PanoramaKind kind = PanoramaKind::vr180;
  float ipd = 0.063f;  // metres between the eyes, 0 to a million
  // Degrees that stand for a picture's height where knobs count by that ("px at 1080 lines"): 1 to 180. Knobs
  // that are pixels become angles so.
  float knobHeight = 90;
  // Degrees of longitude for which an eye keeps its place, at 45 degrees of latitude; more where a step to
  // the next place shows less. 0.5 to 15; half of it takes twice as many frames. The steps are as large as
  // ipd is: where that is large beside how far things are, edges have steps unless strips are narrow.
  float strip = 6;
};

constexpr int eyesOf(PanoramaKind kind) {
  return kind == PanoramaKind::mono360 ? 1 : 2;
}
// Of a picture of one eye: width / height.
constexpr uint32_t aspectOf(PanoramaKind kind) {
  return kind == PanoramaKind::vr180 ? 1 : 2;
}
// Degrees of longitude.
constexpr float longitudesOf(PanoramaKind kind) {
  return kind == PanoramaKind::vr180 ? 180.0f : 360.0f;
}

// How a panorama of a height is drawn: frames with perspective.
struct PanoramaPlan {
  size_t frames = 0;    // with both eyes in each
  uint64_t pixels = 0;  // of all of them
};
// Fails as renderPanorama().
SCUMBLE_API Result<PanoramaPlan> planPanorama(const Panorama& panorama, const RenderOptions& options);

// One panorama, like Renderer::render: with a view for each eye, of options.width by options.height each,
// which have the aspect that its kind asks for; 16 to 16384 / aspectOf(kind) high. `from` is the camera;
// where it hangs on a node, that takes it along, level. Its near plane counts, its field of view does not.
// options.previousViews has one view, `from` a frame earlier, or none; `latch`, `drawing` and `sphere` must
// be empty.
//
// What is a colour is filtered; other AOVs are those of the nearest frame. `depth` is the distance from the
// eye; `motion`, `warp` and `uv-gradient` are by the panorama's own pixels. The same call gives the same
// bytes. Frame::stats are of all its frames together. It takes 16 bytes for each pixel of each layer and eye.
//
// No frame of the renderer may be under way (usage). Fails as Renderer::render does, and with usage for what
// is out of range or does not fit.
SCUMBLE_API Result<Frame> renderPanorama(Renderer& renderer, const Scene& scene, const Look& look,
                                         double time, const View& from, const Panorama& panorama,
                                         const RenderOptions& options);

}  // namespace scumble
