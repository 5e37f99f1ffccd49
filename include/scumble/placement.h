// Where in the world that lies which a look places, for programs that show and move it by hand. Clips are
// taken into account as the look plays them, held by nothing (as in makeViews); what a feature moves (a sea
// that rocks a boat) is not. Times are in seconds. Functions here keep nothing between calls; several threads
// may call them at once.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "scumble/export.h"
#include "scumble/look.h"
#include "scumble/result.h"
#include "scumble/scene.h"

namespace scumble {

// From the space of a node, by its name ("Deck", "boat/Deck" of a world), to the world; the identity for an
// empty name. What a look hangs on nodes (`colorizers.NAME.volume.center`) is in this space. Fails with
// ErrorKind::usage where the scene has no such node, or is empty.
SCUMBLE_API Result<glm::dmat4> nodeToWorld(const Scene& scene, const std::string& node,
                                           const Look& look = Look(), double time = 0);

// From the space in which `camera.shift` is to the world: that of the node `camera.target`, or, where that is
// empty or not there, the world's axes from the centre of what the scene takes up. Fails with
// ErrorKind::usage where the scene is empty.
SCUMBLE_API Result<glm::dmat4> cameraShiftToWorld(const Scene& scene, const Look& look, double time = 0);

// Of unit length, towards the key light. Fails with ErrorKind::usage where the scene is empty.
SCUMBLE_API Result<glm::vec3> towardsKeyLight(const Scene& scene, const Look& look, double time = 0);

// The values of `light.azimuth` and `light.elevation` (degrees) with which the key light comes from a
// direction, where `light.source` is "look". Directions below the lowest elevation count as that. Fails with
// ErrorKind::usage where the scene is empty, or the direction is none.
SCUMBLE_API Result<glm::vec2> keyLightAngles(const Scene& scene, const glm::vec3& towardsLight);

}  // namespace scumble
