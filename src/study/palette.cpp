#include "study/palette.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "scumble/study.h"

namespace scumble::study {

namespace {

constexpr size_t kMostColors = 16;
constexpr double kLeastShare = 0.002;

// Pixels of one small cube of OKLab.
struct Bin {
  glm::dvec3 lab{0};  // mean
  double count = 0;
};

std::vector<Bin> binsOf(const LabPicture& picture, const std::vector<bool>& isEven) {
  constexpr double kSide = 0.01;
  std::map<uint64_t, Bin> bins;
  for (size_t i = 0; i < isEven.size(); ++i) {
    if (!isEven[i]) continue;
    const glm::dvec3 color = picture.at(i);
    const glm::uvec3 cube = glm::floor((color + glm::dvec3(0, 1, 1)) / kSide);
    Bin& bin = bins[uint64_t(cube.x) << 40 | uint64_t(cube.y) << 20 | cube.z];
    bin.lab += color, bin.count += 1;
  }
  std::vector<Bin> all;
  for (const auto& [cube, bin] : bins) all.push_back({bin.lab / bin.count, bin.count});
  return all;
}

size_t nearest(const std::vector<LabColor>& colors, const glm::dvec3& lab) {
  size_t best = 0;
  for (size_t k = 1; k < colors.size(); ++k)
    if (glm::distance(colors[k].lab, lab) < glm::distance(colors[best].lab, lab)) best = k;
  return best;
}

// Means of what is nearest to each, again and again; those with nothing are left out.
void settle(std::vector<LabColor>& colors, const std::vector<Bin>& bins) {
  for (int round = 0; round < 24; ++round) {
    std::vector<LabColor> means(colors.size());
    for (const Bin& bin : bins) {
      LabColor& mean = means[nearest(colors, bin.lab)];
      mean.lab += bin.lab * bin.count, mean.share += bin.count;
    }
    double moved = 0;
    std::vector<LabColor> kept;
    for (size_t k = 0; k < means.size(); ++k) {
      if (means[k].share == 0) continue;
      kept.push_back({means[k].lab / means[k].share, means[k].share});
      moved = std::max(moved, glm::distance(kept.back().lab, colors[k].lab));
    }
    colors = kept;
    if (moved < 1e-4) return;
  }
}

// The two that are nearest to each other become one, as long as they are too near.
bool mergeNearest(std::vector<LabColor>& colors) {
  size_t one = 0, other = 0;
  double least = kNearColors;
  for (size_t i = 0; i < colors.size(); ++i)
    for (size_t k = i + 1; k < colors.size(); ++k)
      if (const double apart = glm::distance(colors[i].lab, colors[k].lab); apart < least)
        least = apart, one = i, other = k;
  if (one == other) return false;
  LabColor& kept = colors[one];
  const LabColor& gone = colors[other];
  const double both = kept.share + gone.share;
  kept.lab = (kept.lab * kept.share + gone.lab * gone.share) / both;
  kept.share = both;
  colors.erase(colors.begin() + std::ptrdiff_t(other));
  return true;
}

}  // namespace

Palette paletteOf(const LabPicture& picture, const std::vector<bool>& isEven) {
  const std::vector<Bin> bins = binsOf(picture, isEven);
  Palette palette;
  std::vector<LabColor>& colors = palette.colors;
  if (bins.empty()) return palette;
  double all = 0;
  for (const Bin& bin : bins) all += bin.count;
  const auto most = std::max_element(bins.begin(), bins.end(),
                                     [](const Bin& a, const Bin& b) { return a.count < b.count; });
  colors.push_back({most->lab, most->count});
  while (colors.size() < kMostColors) {
    const Bin* farthest = nullptr;
    double most2 = 0;
    for (const Bin& bin : bins) {
      const double apart = glm::distance(colors[nearest(colors, bin.lab)].lab, bin.lab);
      if (apart < kNearColors || bin.count * apart * apart <= most2) continue;
      most2 = bin.count * apart * apart, farthest = &bin;
    }
    if (!farthest) break;
    colors.push_back({farthest->lab, farthest->count});
    settle(colors, bins);
  }
  settle(colors, bins);
  while (mergeNearest(colors)) settle(colors, bins);
  std::erase_if(colors, [&](const LabColor& color) { return color.share < kLeastShare * all; });
  double near = 0;
  for (LabColor& color : colors) color.share = 0;
  for (const Bin& bin : bins) {
    LabColor& color = colors[nearest(colors, bin.lab)];
    color.share += bin.count / all;
    if (glm::distance(color.lab, bin.lab) < kNearColors) near += bin.count;
  }
  std::sort(colors.begin(), colors.end(),
            [](const LabColor& a, const LabColor& b) { return a.share > b.share; });
  palette.fewness = near / all;
  return palette;
}

}  // namespace scumble::study
