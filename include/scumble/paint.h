// Strokes for meshes that have none: a painted copy of a glTF (docs/paintings.md).
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/progress.h"
#include "scumble/result.h"

namespace scumble {

class Look;
class Renderer;

// A way of laying strokes.
struct PaintStyle {
  std::string name, meaning;
};
SCUMBLE_API std::vector<PaintStyle> paintStyles();

// What strokes follow over a surface.
enum class PaintFlow : uint8_t {
  curvature,  // where it bends least: along limbs, around nothing
  direction,  // PaintOptions::direction, laid onto it
};

struct PaintOptions {
  std::string style = "coverage";  // one of paintStyles()
  size_t splats = 100000;          // about so many, in all; 1 to 4 million
  // Half the width of the largest strokes, in parts of a mesh's radius; 0.001 to 1. 0: as the style has it.
  float size = 0;
  // How far from the surface the outermost strokes go, the same; 0 to 10. Below 0: as the style has it.
  float height = -1;
  PaintFlow flow = PaintFlow::curvature;
  // World, not zero: where strokes go, or the side to which they go along the curvature.
  glm::vec3 direction{0, -1, 0};
  float variation = 0.5f;  // of colours, sizes and directions: 0 to 1
  uint32_t seed = 0;
  // Where both are there, colours are those that this look gives to the scene at rest, drawn from all around;
  // else those of the surface's materials.
  Renderer* renderer = nullptr;
  const Look* look = nullptr;
  std::string nodes;          // names of nodes, with * and ?: their meshes alone; empty: all
  bool allowOutside = false;  // SceneOptions has it
  Progress progress = {};
};

struct PaintReport {
  size_t meshes = 0, strokes = 0, points = 0, splats = 0;
  std::vector<std::string> warnings;
};

// Reads a glTF, and writes it with strokes on its meshes as one .glb that needs no other file. Strokes that
// it has already stay, and lie below. The same options give the same bytes. Fails with ErrorKind::usage for
// options out of range, with unusableFile, and with outputNotWritten; the output appears whole or not at all.
SCUMBLE_API Result<PaintReport> paintScene(const std::string& scene, const std::string& out,
                                           const PaintOptions& options = {});

}  // namespace scumble
