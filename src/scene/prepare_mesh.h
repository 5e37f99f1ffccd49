// From the triangles of a file to what the renderer draws: whole, with unit normals, normals shared across
// seams, texture coordinates and their tangent vectors.
//
// The steps, in order:
//   cleanPrimitive      on every primitive (independent of each other)
//   weldSmoothNormals   on every mesh
//   finishPrimitive     on every primitive
#pragma once

#include <functional>
#include <string>

#include "scene/import_warnings.h"
#include "scene/scene_data.h"
#include "scumble/scene.h"

namespace scumble::scene {

// Beyond this a coordinate counts as not finite: a light year is 1e16 metres, and squares still fit a float.
constexpr float kMaxCoordinate = 1e15f;
bool isDrawable(const glm::vec3& p);
bool isDrawable(const glm::dmat4& m);

// Drops triangles that cannot be drawn and vertices that nothing uses; makes flat normals where there are
// none and mends broken ones. Leaves in smoothNormals the sum of the faces around every position, weighted by
// their angles, not yet of unit length.
void cleanPrimitive(Primitive& primitive, const std::string& path, ImportWarnings& warnings);

// Adds up the sums of primitives that meet at the same positions, so that a seam between two materials does
// not open either.
void weldSmoothNormals(Mesh& mesh);

// The box around points; all of them must be finite.
Bounds boxOf(const std::vector<glm::vec3>& points);

// Half the diagonal of the mesh's box.
float boundingRadius(const Mesh& mesh);

// What targets do to normals, smooth normals and tangents; `makeTangents` sets those of a primitive whose
// positions are displaced.
void finishMorphTargets(Primitive& primitive, const std::function<void(Primitive&)>& makeTangents);

// Unit smooth normals; uv0 where there is none (one unit of uv is `radius` metres); patternUv where patterns
// do not follow uv0; dPdu and dPdv; all that morph targets displace; the extent.
//
// `before`: what it takes the place of. If that has the same triangles and coordinates of a file, patterns
// lie as they did there: on what a program bends from frame to frame they would jump else.
void finishPrimitive(Primitive& primitive, float radius,
                     PatternCoordinates which = PatternCoordinates::automatic,
                     const Primitive* before = nullptr);

// Keeps the given vertices only, in this order, in all arrays but the indices.
void gatherVertices(Primitive& primitive, const std::vector<uint32_t>& source);

}  // namespace scumble::scene
