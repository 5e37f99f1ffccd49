// Strokes over one mesh.
#pragma once

#include "paint/look_colors.h"
#include "paint/stroke_styles.h"
#include "scene/painting.h"
#include "scumble/paint.h"

namespace scumble::paint {

// Metres of mesh space, and splats, for one mesh.
struct MeshPaint {
  const StrokeStyle* style = nullptr;
  float size = 0, height = 0;
  size_t splats = 0;
  PaintFlow flow = PaintFlow::curvature;
  glm::vec3 towards{0, -1, 0};  // mesh space
  float variation = 0;
  uint32_t seed = 0;
  float begin = 0;  // seconds: when the first stroke is painted
  // Where there are colours of a look, the mesh as it was drawn; else null.
  const LookColors* colors = nullptr;
  const PosedMesh* posed = nullptr;
};

// Empty where the mesh has no triangles with an area.
scene::Painting strokesOver(const scene::SceneData& scene, const scene::Mesh& mesh, const MeshPaint& paint);

// Of a mesh at rest, in its own space, square metres.
double areaOf(const scene::Mesh& mesh);

}  // namespace scumble::paint
