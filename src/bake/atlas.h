// Many tiles in one texture.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "bake/capture.h"
#include "base/pixels.h"

namespace scumble::bake {

// Tiles lie on a grid of so many texels, so that the first levels of mipmaps have no texel of two tiles.
constexpr uint32_t kAtlasGrid = 8;

struct Packing {
  std::vector<glm::uvec2> at;  // by tile: its upper left corner
  uint32_t width = 0, height = 0;
};

// Of rectangles (none of which may be wider than `width`), in rows by height; none where they are higher than
// `height` in all. Those without a size lie nowhere.
std::optional<Packing> pack(const std::vector<glm::uvec2>& sizes, uint32_t width, uint32_t height);

// Where nothing is painted, a texel has the colour of what is nearest to it in its tile, so that what is
// between texels has no fringe.
Pixels assemble(const Packing& packing, const std::vector<Tile>& tiles);

// A PNG.
std::vector<uint8_t> pngOf(const Pixels& pixels);

}  // namespace scumble::bake
