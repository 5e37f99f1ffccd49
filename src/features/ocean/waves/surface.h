// Where the water's mesh is: what floats on it asks here.
//
// The mesh joins the displaced points of a WaveField; tiles follow each other without end. Each cell between
// points (i, j) and (i+1, j+1) is two triangles that share the diagonal between these two:
// (i, j), (i, j+1), (i+1, j+1) and (i, j), (i+1, j+1), (i+1, j), counter-clockwise seen from above.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "features/ocean/waves/waves.h"

namespace scumble::ocean {

struct SurfacePoint {
  float height = 0;           // metres, of y
  glm::vec3 normal{0, 1, 0};  // of the triangle, of length 1, never downwards
};

// The mesh above or below (x, z), which are metres in the world and finite: exactly on its triangle. Where
// the mesh is folded, its highest sheet. Takes the longer the farther points have moved, beside a cell's
// size.
SurfacePoint surfaceAt(const WaveField& field, double x, double z);

// The height of surfaceAt.
float heightAt(const WaveField& field, double x, double z);

struct Floating {
  float height = 0;            // metres, at the boat's middle
  glm::quat tilt{1, 0, 0, 0};  // turns the world's axes: an upright boat's up becomes the water's normal
};

// How a rigid boat lies on the water: on the plane that is nearest, by least squares, to the heights over its
// footprint of `length` x `beam` metres around (x, z). `heading`: degrees, where the bow points to: 0 is +x,
// 90 is +z. The tilted bow still points there, seen from above. Along an edge of 0 metres it does not tilt.
Floating floatingAt(const WaveField& field, double x, double z, double length, double beam, double heading);

}  // namespace scumble::ocean
