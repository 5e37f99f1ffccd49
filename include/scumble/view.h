// Views: from where a frame is seen. Mono is one view, a headset is two; both go through the same code.
// Functions here keep nothing between calls; several threads may call them at once.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/look.h"
#include "scumble/scene.h"

namespace scumble {

// One eye. Matrices are column-major, for column vectors. Renderers refuse those of other conventions
// (ErrorKind::usage).
struct View {
  // Eye space: x right, y up, looking along -z; metres. Its last row is 0, 0, 0, 1, and it can be inverted.
  // World coordinates are relative to `origin`.
  glm::mat4 worldToEye{1.0f};
  // Eye to clip space in Vulkan's convention: y down, depth reversed (1 at the near plane, 0 far away). May
  // be off-centre. There is no default: the identity is refused.
  glm::mat4 eyeToClip{1.0f};
  // The scene's node that the view hangs on: where a feature (the sea) moves that, the view goes with it, and
  // worldToEye is from where it is without them. -1: none.
  int node = -1;
  // Of what its node does it goes up, down, along and around the vertical, and does not tilt: for headsets,
  // whose wearers know where down is.
  bool isLevel = false;
  // Pixels, 1 to 16384; 0, 0: as RenderOptions says for all.
  glm::uvec2 size{0, 0};
  // Whose eye it is: what decides where marks lie, and where shadows are finest, is found once for all views
  // of a rig, from their middle, so that a spectator with a rig of its own changes nothing for the eyes.
  int rig = 0;
  // Origin of the coordinates that worldToEye takes, in the world, metres. For an eye far from (0, 0, 0) it
  // lies near the eye: a million metres out single precision has steps of 6 cm. makeViews takes
  // Scene::origin(), which suits every view of that scene.
  glm::dvec3 origin{0.0};
};

// A view's matrix from world to eye space in double precision, without an origin of its own.
SCUMBLE_API glm::dmat4 worldToEyeOf(const View& view);

// Sets worldToEye and origin from such a matrix. The origin lies near the eye where that is more than 500 m
// from (0, 0, 0), and is (0, 0, 0) elsewhere.
SCUMBLE_API void setWorldToEye(View& view, const glm::dmat4& worldToEye);

// Depth-reversed projections of that convention. Angles in radians, distances in metres.
SCUMBLE_API glm::mat4 perspectiveProjection(float verticalFov, float aspect,
                                            float near);  // infinite far plane
SCUMBLE_API glm::mat4 orthographicProjection(float halfHeight, float aspect, float near, float far);

// Which way a view looks along the ground: radians about the vertical, 0 along -z, growing to the left. Of
// one that looks straight up or down, what is up in its picture lies that way.
SCUMBLE_API float headingOf(const View& view);

// Where the camera stands, as the caller says it. The first that is given counts: eye and target, turntable,
// orbit, camera; then the look's camera (its knobs `camera`, of which any may have a track); then the scene's
// first camera, and else a framing of everything: two thirds of the frame's height or width.
struct Viewpoint {
  std::string camera;  // name or number of a scene's camera; empty: the first
  // Nodes by name ("boat/Deck" of a world) or pattern: they and what hangs below them are what is framed and
  // gone around, instead of everything but SceneSummary::surroundings. Counts before cameras of look and
  // scene.
  std::string frame = {};
  bool orbit = false;  // around the scene's centre
  // Degrees: azimuth 0 looks at the scene's front (+Z), growing to its left (+X), up to a hundred turns;
  // elevation -90 to 90.
  float azimuth = 0, elevation = 0;
  // In radii of what is framed, above 0 up to a million; default: all of it in the frame.
  std::optional<float> distance;
  // Goes once around in so many seconds, above 0, the azimuth growing: around what the look's camera looks at
  // (the scene's centre where it says nothing), from the orbit above where that is given, else from that of
  // the look. Where neither has a distance, everything is in the frame all the way.
  std::optional<double> turntable;
  std::optional<glm::dvec3> eye, target;  // metres of the world, up to 1e15 as all of a scene
  // Degrees, clockwise as seen by the viewer, up to a hundred turns; default: the look's.
  std::optional<float> roll;
  std::optional<float> verticalFov;  // degrees, 0.1 to 177; default: the look's, the scene's camera's, 34
};

enum class Stereo { mono, stereo };

// One view, or the left and the right one (ipd metres apart, parallel axes), at a time in seconds: a pure
// function of what it is given. A camera of the scene goes where the clips that the look plays take it, held
// by nothing, and names its node, so that it rides the sea where that does. The look's camera and a
// turntable go with the node that they look at as clips take it, and the sea does not shake them. Orbits and
// framings see what the scene takes up while the clips play. `ipd` is 0 to a million. Fails with
// ErrorKind::usage for an unknown camera or node, numbers out of range, and a viewpoint that sees nothing
// (eye on the target, nodes without meshes).
SCUMBLE_API Result<std::vector<View>> makeViews(const Scene& scene, const Viewpoint& viewpoint, float aspect,
                                                Stereo stereo = Stereo::mono, float ipd = 0.063f,
                                                const Look& look = Look(), double time = 0);

// Where each node of a scene is at a time in seconds, by its number: from its own space to the world, as the
// clips that the look plays take it; held by nothing, and without what features (the sea) do to it.
SCUMBLE_API std::vector<glm::dmat4> nodesToWorld(const Scene& scene, const Look& look, double time);

// Whether views may be others at other times. Where not, one call of makeViews serves a whole film.
SCUMBLE_API bool viewsMove(const Scene& scene, const Viewpoint& viewpoint, const Look& look);

}  // namespace scumble
