// Coherence in numbers: how well a texture that is attached to a scene's surfaces keeps both to them and to
// the screen. docs/measure.md tells how each number is found and what it cannot tell.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/renderer.h"

namespace scumble {

struct MeasureOptions {
  uint32_t width = 960, height = 540;  // pixels, 16 to 4096
  uint32_t samples = 1;                // 1 or 4
  uint32_t seed = 0;                   // the first of those that are used
  Viewpoint viewpoint;                 // the framing that everything starts from
  std::optional<float> ipd;            // metres; default: 1/40 of the distance to the scene's centre
  // Called after each of `total` steps, on the calling thread; where it returns false, measure() fails with
  // ErrorKind::cancelled.
  std::function<bool(int done, int total)> progress;
};

// A number for each of the two fields on the surface: the vectors that tear edges, and the breakup marks.
struct PerField {
  double vectors = 0, marks = 0;
};

// How far a field is from having moved with the surface: the rms difference between a frame and the one
// before, carried along by the exact motion, over sqrt(2) standard deviations. 0: it sticks; 1: nothing is
// left of it.
struct TemporalError {
  PerField dolly, orbit, roll, object;
  SCUMBLE_API PerField mean() const;
};

// What stands on the screen when the picture is magnified.
struct ZoomPoint {
  double zoom = 1;     // 1: the framing
  PerField frequency;  // dominant, cycles a pixel, at most about 1/4; 0: coarser than the region shows
  PerField contrast;   // standard deviation relative to the flat example's
};

// The left picture carried into the right one by exact depth: rms differences, where both eyes see the same.
struct StereoDifference {
  PerField warp;           // over sqrt(2) standard deviations, as TemporalError
  double finalShadow = 0;  // of 1; so are the colours, linear, over three channels
  double color = 0, finalColor = 0;
  // Conflicts in depth: parts of the picture, of those with something to see, that fit another distance than
  // the surface's better than that, by more than a pixel of disparity; 0 to 1. Of the breakup marks, and of
  // the picture's luminance.
  double marksInConflict = 0, pictureInConflict = 0;
};

// What becomes of breakup marks while the picture is magnified to twice its size, from several zooms on.
// Marks are what is a quarter of a deviation above the flat example's mean, over 12 pixels or more; one is
// there if any of its middle is.
struct MarkLives {
  double born = 0;  // share of those there afterwards that were not there before
  double died = 0;  // share of those there before that are not there afterwards
};

// One way to put the texture on the surface.
struct ModeMeasurements {
  std::string mode;  // metatexture, object, screen or fractal: a value of warp.metatexture.mode
  TemporalError temporal;
  std::vector<ZoomPoint> zoom;  // 1/8 to 8 in half octaves
  PerField frequencyDrift;      // octaves from the lowest to the highest frequency of the zoom
  PerField contrastDeviation;   // greatest distance of the contrast from its mean, relative to that mean
  PerField contrastError;       // greatest distance of the contrast from the flat example's
  PerField flatness;            // average co-occurrence error at zoom 1: 0 as the flat example, 1 different
  StereoDifference stereo;
  MarkLives marks;
};

// What was promised of the vectors, and what was found.
struct MeasureTarget {
  std::string name, meaning;
  double value = 0, limit = 0;  // it is kept where value <= limit
  bool isKept() const { return value <= limit; }
};

struct Measurements {
  std::vector<ModeMeasurements> modes;  // metatexture first
  PerField exampleFrequency;            // of the flat example, cycles a pixel
  double visible = 0;                   // part of the framing that the scene covers
  double tiles = 0;  // copies a unit of uv that MetaTexture lays at zoom 1, on the average over what is seen
  double ipd = 0;    // metres
  std::vector<MeasureTarget> targets;
};

// Measures MetaTexture and its three rivals (ordinary mapping, screen space, summed octaves) in one scene, as
// `look` sets them; the rivals as their authors have them (docs/measure.md). Of the look, these are set
// otherwise: no ground, and for the fields warp.inflation 0, warp.distance 0 and warp.amount 64. What
// features draw is not measured, nor is what is not torn at all. Renders some 500 frames. The same call gives
// the same numbers.
//
// Uses the renderer as a call of render() does: from one thread at a time.
//
// Fails with usage for options out of range and where too little of the scene can be followed, and as
// Renderer::render.
SCUMBLE_API Result<Measurements> measure(Renderer& renderer, const Scene& scene, const Look& look,
                                         const MeasureOptions& options = {});

// How steady a drawing's lines are while one walks around the scene: kLineFrames pictures, an eighth of a
// degree apart. How much of a pixel is drawn on is from 0 to 1.
constexpr int kLineFrames = 41;
constexpr double kLineStep = 0.125;  // degrees
struct LineSteadiness {
  std::string method;   // who drew
  double drawn = 0;     // what is drawn on in a picture, pixels
  double changes = 0;   // by how much pixels change in a degree, of that; that lines move is most of it
  double flickers = 0;  // the same of what lines that move do not explain: see steadinessOf()
};
struct LineMeasurements {
  LineSteadiness lines;
  std::vector<View> views;  // that they were drawn from, so that other programs can do the same
};

// Of the lines that an AOV has in its channel A, along the orbit, from the framing on; without ground. Uses
// the renderer as a call of render() does. Fails as measure(), and with usage where it has no such channel,
// or nothing is drawn.
SCUMBLE_API Result<LineMeasurements> measureLines(Renderer& renderer, const Scene& scene, const Look& look,
                                                  const std::string& aov, const MeasureOptions& options = {});

// The same of pictures that anybody drew: dark lines, on the light that most of a picture has; what is drawn
// is what is missing of that light. A pixel flickers where, from one picture to the next, half of it is drawn
// on that was not, or is no longer, and no pixel within two of it was or is: so far lines may move, and at
// kLineStep they move less within some 900 pixels of the axis. Fails with usage for fewer than two, such as
// are not of one size, and such without lines.
SCUMBLE_API Result<LineSteadiness> steadinessOf(const std::string& method, const std::vector<Image>& drawings,
                                                double degreesAStep = kLineStep);

// Motion as a viewer sees it of poses that stand: on ones, twos, threes ... of the grid of 24 frames a
// second.
constexpr double kStepSeconds = 1;  // of the scene's clips, from time 0 on
struct StepMeasurements {
  int hold = 1;       // frames at 24 a second that a pose stands
  double stands = 0;  // seconds
  // How far what moves goes from one pose to the next: the mean, and what a twentieth of it goes beyond;
  // pixels, and degrees of what is seen in the picture's middle.
  double jump = 0, farJump = 0, jumpDegrees = 0, farJumpDegrees = 0;
  double moving = 0;   // part of the picture that moves from one pose to the next
  double changes = 0;  // by how much the picture's pixels change in a second, of 1
};

// One for each of `holds`, each as `animation.hold` of the look, with line boil on the same steps: what a
// look says of nodes and materials by name wins. The camera stands. Uses the renderer as a call of render()
// does. Fails as measure(), and with usage for holds below 1 or above 24, and where nothing moves.
SCUMBLE_API Result<std::vector<StepMeasurements>> measureSteps(Renderer& renderer, const Scene& scene,
                                                               const Look& look,
                                                               const std::vector<int>& holds,
                                                               const MeasureOptions& options = {});

}  // namespace scumble
