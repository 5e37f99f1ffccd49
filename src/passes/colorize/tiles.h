// Which colorizers which parts of the picture see: square tiles, gathered in a few jobs, each with one list
// of colorizers and the rectangles that it has to be run on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frame/image_step.h"
#include "passes/colorize/colorizers.h"

namespace scumble::passes {

constexpr uint32_t kMaxColorizeJobs = 16;

struct TileGrid {
  uint32_t width, height;  // pixels
  uint32_t tile;           // pixels a side, a multiple of 64
  uint32_t columns, rows;
  TileGrid(uint32_t width_, uint32_t height_);
  size_t count() const { return size_t(columns) * rows; }
};

// For each tile a bit for each colorizer of which it may see anything.
std::vector<uint64_t> tileMasks(const TileGrid& grid, const std::vector<PlacedColorizer>& colorizers,
                                const glm::dmat4& worldToClip);

struct ColorizeJob {
  uint64_t mask;
  std::vector<frame::ImageStep::Area> areas;
};

// `masks`: those of each view. Tiles whose masks are rare share a job that runs a few colorizers more than
// they see; these change nothing there.
std::vector<ColorizeJob> planJobs(const TileGrid& grid, std::span<const std::vector<uint64_t>> masks);

// Fills a job's list of colorizers, and says for how many the shader is to be compiled: a few numbers only,
// since each is a pipeline of its own. What is more than the mask has does nothing.
uint32_t listFor(uint64_t mask, const std::vector<PlacedColorizer>& colorizers,
                 shared::ColorizeUniforms& uniforms);

}  // namespace scumble::passes
