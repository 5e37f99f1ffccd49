#include "measure/mark_lives.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace scumble::measuring {

namespace {

constexpr size_t kSpeck = 12;  // smaller ones come and go with the grid of pixels

bool isMark(const Field& field, size_t pixel, float level) {
  return field.valid[pixel] && *field.at(pixel) > level;
}

// A mark's pixels.
using Pixels = std::vector<size_t>;

// Marks that are whole: those at the border of what counts go on beyond it.
std::vector<Pixels> wholeMarks(const Field& field, float level) {
  const int w = field.width, h = field.height;
  std::vector<Pixels> marks;
  std::vector<uint8_t> isSeen(field.pixelCount(), 0);
  for (size_t first = 0; first < field.pixelCount(); ++first) {
    if (isSeen[first] || !isMark(field, first, level)) continue;
    Pixels mark{first};
    isSeen[first] = 1;
    bool isWhole = true;
    for (size_t i = 0; i < mark.size(); ++i) {
      const int x = int(mark[i] % size_t(w)), y = int(mark[i] / size_t(w));
      for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
        const int nx = x + dx, ny = y + dy;
        const size_t next = size_t(ny) * size_t(w) + size_t(nx);
        if (nx < 0 || ny < 0 || nx >= w || ny >= h || !field.isPair(mark[i], next))
          isWhole = false;
        else if (!isSeen[next] && isMark(field, next, level))
          isSeen[next] = 1, mark.push_back(next);
      }
    }
    if (isWhole && mark.size() >= kSpeck) marks.push_back(std::move(mark));
  }
  return marks;
}

// The pixel of a mark that is nearest to its middle.
glm::dvec2 heartOf(const Pixels& mark, int width) {
  const auto placeOf = [&](size_t pixel) {
    return glm::dvec2(double(pixel % size_t(width)), double(pixel / size_t(width))) + 0.5;
  };
  glm::dvec2 middle(0.0);
  for (const size_t pixel : mark) middle += placeOf(pixel) / double(mark.size());
  glm::dvec2 heart = placeOf(mark[0]);
  for (const size_t pixel : mark)
    if (glm::distance(placeOf(pixel), middle) < glm::distance(heart, middle)) heart = placeOf(pixel);
  return heart;
}

// How many marks `here` are none of them `there`, and how many there are of those that would be seen there.
// `zoom`: of what is there.
struct Missing {
  size_t marks = 0, missing = 0;
};
Missing missing(const Field& here, const Field& there, double zoom, const glm::vec2& centre, float level) {
  const glm::dvec2 size(here.width, here.height), fixed = (glm::dvec2(centre) + 1.0) * 0.5 * size;
  Missing found;
  for (const Pixels& mark : wholeMarks(here, level)) {
    const glm::dvec2 heart = fixed + (heartOf(mark, here.width) - fixed) * zoom;
    // A quarter as far as a disc of its area reaches.
    const double reach = std::max(0.25 * std::sqrt(double(mark.size()) / 3.14159265), 0.8);
    bool isSeen = true, isThere = false;
    for (int y = int(std::floor(heart.y - reach)); y <= int(std::floor(heart.y + reach)); ++y)
      for (int x = int(std::floor(heart.x - reach)); x <= int(std::floor(heart.x + reach)); ++x) {
        if (glm::distance(glm::dvec2(x, y) + 0.5, heart) > reach) continue;
        const size_t pixel = size_t(y) * size_t(there.width) + size_t(x);
        if (x < 0 || y < 0 || x >= there.width || y >= there.height || !there.valid[pixel])
          isSeen = false;
        else
          isThere |= isMark(there, pixel, level);
      }
    found.marks += isSeen;
    found.missing += isSeen && !isThere;
  }
  return found;
}

}  // namespace

MarkCount countMarks(const Field& before, const Field& after, double zoom, const glm::vec2& centre,
                     float level) {
  const Missing died = missing(before, after, zoom, centre, level),
                born = missing(after, before, 1 / zoom, centre, level);
  return {died.marks, died.missing, born.marks, born.missing};
}

}  // namespace scumble::measuring
