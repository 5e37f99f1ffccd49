// Fin textures: a painting in space as a mesh with textures, which draws in real time anywhere (paper 003;
// docs/fins.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scumble/export.h"
#include "scumble/progress.h"
#include "scumble/result.h"

namespace scumble {

// How fins of a part of the proxy are made, where it is otherwise than for the rest.
struct BakePart {
  std::string materials;  // names of materials, with * and ?: what is made of them
  // How far fins reach from the surface, metres in the mesh's own space; above 0, and no farther than the
  // mesh is large. 0: as far as its strokes do.
  float offset = 0;
  // Fins fade by 1 - |n . v|, n being the normal of a fin and v the way to the viewer, both of unit length:
  // they begin to show at `fadeStart` and are there in full at `fadeEnd`, which is the smaller one; 0 to 1.
  // Below 0: BakeOptions'.
  float fadeStart = -1, fadeEnd = -1;
  int layers = 0;  // 0: BakeOptions'
};

struct BakeOptions {
  // A glTF around whose meshes the strokes lie, in one world: instead of the painting's own. Empty: those
  // that have both strokes and triangles; where none has, a hull of the strokes that is made for them.
  std::string proxy;
  // How many cells of a grid lie along the longest side of such a hull, 8 to 256: finer ones part strokes
  // that lie closer.
  uint32_t hullCells = 40;
  uint32_t textureSize = 2048;  // a side of each mesh's texture, at most: 64 to 8192
  float fadeStart = 0.5f, fadeEnd = 0.2f;
  // Shells of paint over the surface, 1 to 16: one lies on it, more stand where strokes are sparse and long.
  int layers = 1;
  std::vector<BakePart> parts;  // the last one that matches counts
  // For engines that sort objects and not triangles: orders of each mesh's triangles for viewers in so many
  // directions, 0, 6, 8 or 14, as index lists that its extras name (docs/fins.md).
  int orders = 14;
  // As the knobs `painting.*` of these names have them when the painting itself is drawn, and within their
  // ranges.
  float spacing = 0.3f, streaks = 0.7f, dryEnds = 2.0f, variation = 0.12f, order = 0.5f;
  bool allowOutside = false;  // SceneOptions has it
  int threads = 0;            // 0: as many as the machine has
  // What is done is kept in OUT.part, from which another call with the same inputs and options goes on.
  Progress progress = {};
};

struct BakeReport {
  size_t meshes = 0, splats = 0, fins = 0, triangles = 0;  // triangles: of fins and coats
  size_t resumed = 0;                                      // pieces that an earlier call had made
  uint32_t textureWidth = 0, textureHeight = 0;            // of the largest texture
  std::vector<std::string> warnings;
};

// Reads a glTF with strokes on its meshes and writes it with fins instead of them, as one .glb that needs no
// other file. The same inputs and options give the same bytes. Fails with ErrorKind::usage for options out of
// range, with unusableFile, with cancelled, and with outputNotWritten; the output appears whole or not at
// all.
SCUMBLE_API Result<BakeReport> bakeFins(const std::string& painting, const std::string& out,
                                        const BakeOptions& options = {});

struct PointsOptions {
  bool allowOutside = false;  // SceneOptions has it
  int threads = 0;            // 0: as many as the machine has
};

struct PointsReport {
  size_t points = 0;
  std::vector<std::string> warnings;
};

// Writes a painting's splats as Gaussians, which viewers of KHR_gaussian_splatting show and others as points:
// one .glb with what the painting has of meshes, without its strokes, all as it stands at rest. Of splats
// there remain place, direction, size, colour and opacity (docs/fins.md says what is lost). Fails as bakeFins
// does.
SCUMBLE_API Result<PointsReport> writePoints(const std::string& painting, const std::string& out,
                                             const PointsOptions& options = {});

}  // namespace scumble
