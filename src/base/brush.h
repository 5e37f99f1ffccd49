// A square board that repeats in both directions, and what a brush does to it: how maps of strokes are
// painted. All in integers and in samples; several samples make a texel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scumble::brush {

constexpr int kTexels = 256;  // an edge of the finished map
constexpr int kSamplesPerTexel = 3;
constexpr int kBoardSide = kTexels * kSamplesPerTexel;

using Board = std::vector<uint8_t>;  // kBoardSide x kBoardSide, row by row

// Where sample (x, y) lies in a board, wherever it is.
inline size_t boardIndex(int x, int y) {
  const auto wrap = [](int i) { return size_t((i % kBoardSide + kBoardSide) % kBoardSide); };
  return wrap(y) * kBoardSide + wrap(x);
}

// A lens that lies along u. Its edges are torn: each bristle begins and ends at a place of its own.
struct BrushMark {
  int x = 0, y = 0;  // centre
  int halfLength = 0, halfThickness = 0;
  int bow = 0;   // how far its ends lie below its middle; negative: above
  int rise = 0;  // how far its right end lies above its left one
  uint32_t seed = 0;
};

// A stroke, ready to be asked about many samples. `reach`: how many times further than its border one may
// ask.
class StrokeShape {
 public:
  explicit StrokeShape(const BrushMark& stroke, int reach = 1);

  // All samples inside of the border lie within these, and so do those that one may ask about.
  int halfWidth() const { return halfWidth_; }
  int halfHeight() const { return halfHeight_; }

  // How far a sample lies out: 0 in the middle, kBorder at the border. `dx`, `dy`: from the centre.
  static constexpr int kBorder = 256;
  int place(int dx, int dy) const {
    const int across = dy - spine_[size_t(dx + halfWidth_)];
    const int bristle = across + acrossMost_;
    const std::vector<int>& lags = dx > 0 ? tailLags_ : headLags_;
    return across_[size_t(bristle)] + along_[size_t((dx < 0 ? -dx : dx) + lags[size_t(bristle)])];
  }

 private:
  int halfWidth_ = 0, halfHeight_ = 0, acrossMost_ = 0;
  std::vector<int> spine_;                // of dx: how far below the centre
  std::vector<int> across_;               // of the distance from the spine: its part of the place
  std::vector<int> along_;                // of the distance along, bristle's lag added: its part of the place
  std::vector<int> headLags_, tailLags_;  // of the distance from the spine
};

struct BrushSize {
  int halfLength, halfThickness;
};

// Takes away what is smaller than the brush, a lens, at every threshold: first light things, then dark ones
// (morphological opening, then closing). Nothing, light or dark, is then smaller than the brush.
void simplify(Board& board, BrushSize brush);

// A texel is the mean of its samples.
std::vector<uint8_t> shrink(const Board& board);

}  // namespace scumble::brush
