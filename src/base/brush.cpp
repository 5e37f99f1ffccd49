#include "base/brush.h"

#include <algorithm>
#include <cstdlib>

#include "base/tileable_noise.h"

namespace scumble::brush {

namespace {

constexpr int kBristle = 4;  // thickness, in samples

int floorDivide(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

// How far bristles begin or end away from the lens: most a little, some run dry early. Never negative.
int lagOf(const BrushMark& stroke, int bristle, bool tail) {
  const uint32_t h = hash(stroke.seed + hash(uint32_t(bristle) * 2 + tail));
  const int little = int(h % uint32_t(stroke.halfLength / 5 + 2));
  return (h >> 16) % 6 == 0 ? little + int((h >> 20) % uint32_t(stroke.halfLength / 3 + 1)) : little;
}

// Half the length of each row of a lens, from its upper tip to its middle.
std::vector<int> halfRowsOf(BrushSize brush) {
  std::vector<int> rows;
  const int tip = brush.halfThickness + 1;
  for (int fromTip = 1; fromTip <= tip; ++fromTip) {
    int reach = 0;
    while ((reach + 1) * (reach + 1) * tip <= brush.halfLength * brush.halfLength * fromTip) ++reach;
    rows.push_back(reach);
  }
  return rows;
}

// What `pick` chooses among all samples below the brush. Rows are first widened, then picked among: a sample
// costs as many steps as the brush is long and thick, not as many as it has samples.
template <typename Pick>
Board below(const Board& board, BrushSize brush, uint8_t start, Pick pick) {
  const std::vector<int> halfRows = halfRowsOf(brush);
  const auto margin = size_t(brush.halfLength);
  Board result(board.size(), start);
  std::vector<uint8_t> padded(kBoardSide + 2 * margin), wide(kBoardSide);
  for (int y = 0; y < kBoardSide; ++y) {
    const auto row = board.begin() + int64_t(boardIndex(0, y));
    std::copy(row, row + kBoardSide, padded.begin() + int64_t(margin));
    std::copy_n(row + kBoardSide - int64_t(margin), margin, padded.begin());
    std::copy_n(row, margin, padded.end() - int64_t(margin));
    std::copy(row, row + kBoardSide, wide.begin());
    size_t reach = 0;
    for (int dy = brush.halfThickness; dy >= 0; --dy) {
      const auto target = size_t(halfRows[size_t(brush.halfThickness - dy)]);
      for (; reach < target; ++reach) {
        const uint8_t *left = &padded[margin - reach - 1], *right = &padded[margin + reach + 1];
        for (size_t x = 0; x < kBoardSide; ++x) wide[x] = pick(wide[x], pick(left[x], right[x]));
      }
      for (const int to : {y - dy, y + dy}) {
        uint8_t* out = &result[boardIndex(0, to)];
        for (size_t x = 0; x < kBoardSide; ++x) out[x] = pick(out[x], wide[x]);
      }
    }
  }
  return result;
}

}  // namespace

StrokeShape::StrokeShape(const BrushMark& stroke, int reach) {
  const int length = stroke.halfLength, thickness = stroke.halfThickness;
  halfWidth_ = reach * length;
  int spineMost = 0;
  for (int dx = -halfWidth_; dx <= halfWidth_; ++dx) {
    const int within = std::clamp(dx, -length, length);
    const int spine = stroke.bow * within * within / (length * length) - stroke.rise * within / (2 * length);
    spine_.push_back(spine);
    spineMost = std::max(spineMost, std::abs(spine));
  }
  halfHeight_ = reach * thickness + spineMost;
  acrossMost_ = halfHeight_ + spineMost;
  for (int across = -acrossMost_; across <= acrossMost_; ++across) {
    across_.push_back(std::abs(across) * kBorder / thickness);
    const int bristle = floorDivide(across, kBristle);
    headLags_.push_back(lagOf(stroke, bristle, false));
    tailLags_.push_back(lagOf(stroke, bristle, true));
  }
  const int lagMost = std::max(*std::max_element(headLags_.begin(), headLags_.end()),
                               *std::max_element(tailLags_.begin(), tailLags_.end()));
  for (int along = 0; along <= halfWidth_ + lagMost; ++along)
    along_.push_back(along * along * kBorder / (length * length));
}

void simplify(Board& board, BrushSize brush) {
  const auto darkest = [](uint8_t a, uint8_t b) { return std::min(a, b); };
  const auto lightest = [](uint8_t a, uint8_t b) { return std::max(a, b); };
  board = below(board, brush, 255, darkest);
  board = below(board, brush, 0, lightest);
  board = below(board, brush, 0, lightest);
  board = below(board, brush, 255, darkest);
}

std::vector<uint8_t> shrink(const Board& board) {
  std::vector<uint8_t> texels;
  texels.reserve(kTexels * kTexels);
  constexpr uint32_t kSamples = kSamplesPerTexel * kSamplesPerTexel;
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) {
      uint32_t sum = 0;
      for (int i = 0; i < kSamplesPerTexel; ++i)
        for (int j = 0; j < kSamplesPerTexel; ++j)
          sum += board[boardIndex(x * kSamplesPerTexel + j, y * kSamplesPerTexel + i)];
      texels.push_back(uint8_t((sum + kSamples / 2) / kSamples));
    }
  return texels;
}

}  // namespace scumble::brush
