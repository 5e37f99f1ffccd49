#include "stereo_layout.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report.h"

namespace scumble::app {

namespace {

constexpr double kTurnsPerSecond = 8;  // slow enough to be seen, fast enough to make depth of it

template <class Picture>
Picture crossed(const Picture& left, const Picture& right) {
  return sideBySide(right, left);
}

constexpr StereoLayout kLayouts[] = {
    {"side-by-side", 2, 1, FilmLayout::sideBySide, false, false, sideBySide, sideBySide, sideBySide},
    {"over-under", 1, 2, FilmLayout::overUnder, false, false, overUnder, overUnder, overUnder},
    {"crossed", 2, 1, FilmLayout::mono, false, false, crossed<Image>, crossed<Drawing>, crossed<Image>},
    {"anaglyph", 1, 1, FilmLayout::mono, false, false, anaglyph, nullptr, sideBySide},
    {"wiggle", 1, 1, FilmLayout::mono, false, true},
    {"separate", 1, 1, FilmLayout::mono, true}};

}  // namespace

Result<const StereoLayout*> stereoLayoutOf(const std::string& name) {
  if (name.empty()) return nullptr;
  std::vector<std::string> names;
  for (const StereoLayout& layout : kLayouts) {
    if (name == layout.name) return &layout;
    names.emplace_back(layout.name);
  }
  return usage("'" + name + "' is no stereo layout", suggestion(name, names, "use " + stereoLayoutNames()));
}

std::string stereoLayoutNames() {
  std::string names;
  for (const StereoLayout& layout : kLayouts)
    names += (names.empty()                       ? ""
              : &layout + 1 == std::end(kLayouts) ? " or "
                                                  : ", ") +
             std::string(layout.name);
  return names;
}

int framesInTurn(double fps) {
  return std::max(1, int(std::lround(fps / kTurnsPerSecond)));
}

size_t eyeInTurn(int frame, double fps) {
  const int turn = int(std::floor(double(frame) / framesInTurn(fps)));
  return turn % 2 == 0 ? 0 : 1;
}

}  // namespace scumble::app
