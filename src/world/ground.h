// The ground that is laid under scenes which have none.
#pragma once

#include "scene/scene_data.h"

namespace scumble::world {

// Where it lies under a scene that takes up so much.
float groundHeight(const scene::Bounds& bounds);

// A disc of 40 scene radii, fine near the scene.
scene::Primitive makeGround(const scene::Bounds& bounds);

// The tones that it is painted in: its own, and two of strokes.
constexpr int kGroundTones = 3;
// Broad strokes of a tone from 1 on, a little above it and below the scene, around which they lie.
scene::Primitive makeGroundStrokes(const scene::Bounds& bounds, int tone);
// A tone, as roots of factors on the ground's own colour. `amount`, 0 to 1: how far it is from that.
glm::vec3 groundTone(int tone, float amount);

}  // namespace scumble::world
