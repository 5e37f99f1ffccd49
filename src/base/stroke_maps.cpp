#include "base/stroke_maps.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/brush.h"
#include "base/tileable_noise.h"

namespace scumble {

using namespace brush;

namespace {

class Dice {
 public:
  explicit Dice(uint32_t seed) : state_(hash(seed)) {}
  // Both ends included.
  int between(int least, int most) { return least + int(hash(state_++) % uint32_t(most - least + 1)); }

 private:
  uint32_t state_;
};

// Places that keep away from each other: the additive sequence of the plastic number (Roberts' R2), in 2^-32
// of the board.
class SpreadPlaces {
 public:
  explicit SpreadPlaces(uint32_t seed) : x_(hash(seed)), y_(hash(seed + 1)) {}
  std::pair<int, int> next() {
    x_ += 3242174889u, y_ += 2447445414u;
    return {int(uint64_t(x_) * kBoardSide >> 32), int(uint64_t(y_) * kBoardSide >> 32)};
  }

 private:
  uint32_t x_, y_;
};

// Tells each sample that lies within `reach` borders of the stroke: its index in the board, and its place.
template <typename Each>
void forSamplesIn(const BrushMark& stroke, int reach, Each each) {
  const StrokeShape shape(stroke, reach);
  for (int dy = -shape.halfHeight(); dy <= shape.halfHeight(); ++dy) {
    const size_t row = boardIndex(0, stroke.y + dy);
    int x = int(boardIndex(stroke.x - shape.halfWidth(), 0));
    for (int dx = -shape.halfWidth(); dx <= shape.halfWidth(); ++dx) {
      if (const int place = shape.place(dx, dy); place <= reach * StrokeShape::kBorder)
        each(row + size_t(x), place);
      if (++x == kBoardSide) x = 0;
    }
  }
}

BrushMark strokeAt(std::pair<int, int> place, int halfLength, int halfThickness, Dice& dice) {
  BrushMark stroke;
  stroke.x = place.first, stroke.y = place.second;
  stroke.halfLength = halfLength, stroke.halfThickness = halfThickness;
  stroke.bow = dice.between(-halfThickness / 2, halfThickness / 2);
  stroke.rise = dice.between(-halfThickness / 2, halfThickness / 2);
  stroke.seed = uint32_t(dice.between(0, 1 << 30));
  return stroke;
}

constexpr int kTones = 5;

// Lays stroke over stroke, each one or two tones from what it is laid on: of these the rarest so far, so that
// all tones have about equal parts.
Board strokesOfTheSea(uint32_t seed) {
  struct Size {
    int count, leastLength, mostLength, leastThickness, mostThickness;  // halves, in texels
  };
  // The broad ones cover the board; of the others there are so few that most of it stays flat.
  constexpr Size kSizes[] = {{110, 46, 96, 7, 12}, {24, 26, 46, 4, 6}, {12, 14, 24, 3, 4}};

  Board board(size_t(kBoardSide) * kBoardSide, kTones / 2);
  std::array<int, kTones> areas{};
  areas[kTones / 2] = kBoardSide * kBoardSide;
  Dice dice(seed);
  SpreadPlaces places(seed);
  for (const Size& size : kSizes)
    for (int i = 0; i < size.count; ++i) {
      const int length = dice.between(size.leastLength, size.mostLength) * kSamplesPerTexel;
      const int thickness =
          dice.between(size.leastThickness * kSamplesPerTexel, size.mostThickness * kSamplesPerTexel);
      const BrushMark stroke = strokeAt(places.next(), length, thickness, dice);
      const int under = board[boardIndex(stroke.x, stroke.y)];
      int tone = under > 0 ? under - 1 : under + 1;
      for (const int other : {under - 2, under + 1, under + 2})
        if (other >= 0 && other < kTones && areas[size_t(other)] < areas[size_t(tone)]) tone = other;
      forSamplesIn(stroke, 1, [&](size_t at, int) {
        --areas[board[at]], ++areas[size_t(tone)];
        board[at] = uint8_t(tone);
      });
    }
  simplify(board, {12, 3});
  return board;
}

// Gives each value the middle of the rank that its samples have: the histogram becomes even, and the mean one
// half. 0 and 255 stay free, so that thresholds there take nothing and everything.
void rank(Board& board) {
  std::array<uint64_t, 256> counts{};
  for (const uint8_t value : board) ++counts[value];
  std::array<uint8_t, 256> ranks{};
  uint64_t before = 0;
  for (size_t value = 0; value < 256; ++value) {
    const uint64_t twice = 2 * before + counts[value];
    ranks[value] = uint8_t(std::clamp<uint64_t>((255 * twice + board.size()) / (2 * board.size()), 1, 254));
    before += counts[value];
  }
  for (uint8_t& value : board) value = ranks[value];
}

// Holes in the foam: one lens in each cell of a grid, anywhere in it, odd rows shifted. The value is how far
// the nearest one lies, as StrokeShape::place.
constexpr int kHoleReach = 3;
std::vector<int> farFromHoles(uint32_t seed) {
  constexpr int kColumns = 8, kRows = 26;
  constexpr int kWidth = kBoardSide / kColumns;
  std::vector<int> far(size_t(kBoardSide) * kBoardSide, kHoleReach * StrokeShape::kBorder);
  Dice dice(seed);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column) {
      const int top = row * kBoardSide / kRows, bottom = (row + 1) * kBoardSide / kRows;
      const int left = column * kWidth + (row % 2) * kWidth / 2;
      const std::pair<int, int> place{dice.between(left, left + kWidth - 1), dice.between(top, bottom - 1)};
      const int length = dice.between(27, 96);
      const BrushMark hole = strokeAt(place, length, length * dice.between(18, 32) / 100, dice);
      forSamplesIn(hole, kHoleReach, [&](size_t at, int distance) { far[at] = std::min(far[at], distance); });
    }
  return far;
}

// Streaks that the wind draws: 256 in the middle of one, 0 outside of all.
std::vector<int> streaks(uint32_t seed) {
  std::vector<int> strength(size_t(kBoardSide) * kBoardSide, 0);
  Dice dice(seed);
  SpreadPlaces places(seed);
  for (int i = 0; i < 26; ++i) {
    const int length = dice.between(36, 76) * kSamplesPerTexel;
    const BrushMark streak = strokeAt(places.next(), length, length * dice.between(14, 26) / 100, dice);
    const int most = dice.between(120, 256);
    forSamplesIn(streak, 1, [&](size_t at, int place) {
      strength[at] = std::max(strength[at], (StrokeShape::kBorder - place) * most / StrokeShape::kBorder);
    });
  }
  return strength;
}

Pixels pixelsOf(const std::vector<uint8_t>& red, const std::vector<uint8_t>& green,
                const std::vector<uint8_t>& blue) {
  Pixels pixels{kTexels, kTexels, {}};
  pixels.rgba.reserve(4 * red.size());
  for (size_t i = 0; i < red.size(); ++i)
    pixels.rgba.insert(pixels.rgba.end(), {red[i], green[i], blue[i], 255});
  return pixels;
}

}  // namespace

Pixels seaStrokes() {
  std::array<std::vector<uint8_t>, 3> channels;
  for (uint32_t c = 0; c < 3; ++c) {
    Board board = strokesOfTheSea(101 + 7919 * c);
    rank(board);
    channels[c] = shrink(board);
  }
  return pixelsOf(channels[0], channels[1], channels[2]);
}

Pixels foamStrokes() {
  const std::vector<int> far = farFromHoles(11), strength = streaks(5);
  std::vector<int> thin(far.size());
  for (size_t i = 0; i < far.size(); ++i) thin[i] = -far[i] - strength[i] * 3 / 2;
  const auto [least, most] = std::minmax_element(thin.begin(), thin.end());
  Board board(thin.size());
  for (size_t i = 0; i < thin.size(); ++i)
    board[i] = uint8_t((thin[i] - *least) * 255 / std::max(1, *most - *least));
  simplify(board, {12, 4});
  rank(board);
  const std::vector<uint8_t> values = shrink(board);
  return pixelsOf(values, values, values);
}

}  // namespace scumble
