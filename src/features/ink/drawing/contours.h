// Lines that follow from a picture: where a number passes a level, and where pixels of different kinds meet.
#pragma once

#include <functional>
#include <optional>

#include "features/ink/drawing/chains.h"

namespace scumble::ink {

// Links, and how many nodes they have.
struct Contours {
  std::vector<Link> links;
  uint32_t nodeCount = 0;
};

// Where `value`, which pixels have in their middles and which is linear between them, passes `level`. Nothing
// lies beside pixels that have none.
Contours levelContours(uint32_t width, uint32_t height,
                       const std::function<std::optional<float>(uint32_t x, uint32_t y)>& value, float level);

// The edges of pixels between neighbours for which `isBorder` holds.
using IsBorder = std::function<bool(uint32_t x, uint32_t y, uint32_t otherX, uint32_t otherY)>;
Contours borderContours(uint32_t width, uint32_t height, const IsBorder& isBorder);

}  // namespace scumble::ink
