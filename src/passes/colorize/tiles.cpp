#include "passes/colorize/tiles.h"

#include <algorithm>
#include <bit>
#include <map>

namespace scumble::passes {

namespace {

// Tiles along one axis that a box may be seen in. `corners`: clip x or y, and w, of its corners. Between two
// lines of the picture, the planes through the eye and these lines bound what is seen; this holds for boxes
// around and behind the eye as well.
std::vector<bool> seenAlong(uint32_t tiles, uint32_t tile, uint32_t pixels, const glm::dvec2 (&corners)[8]) {
  std::vector<bool> seen(tiles);
  for (uint32_t i = 0; i < tiles; ++i) {
    const double low = 2.0 * i * tile / pixels - 1,
                 high = 2.0 * std::min((i + 1) * tile, pixels) / pixels - 1;
    bool before = true, after = true;
    for (const glm::dvec2& c : corners) {
      before &= c.x - low * c.y < 0;
      after &= c.x - high * c.y > 0;
    }
    seen[i] = !before && !after;
  }
  return seen;
}

struct Group {
  uint64_t mask;
  size_t tiles;
  size_t cost() const { return tiles * size_t(std::popcount(mask)); }
};

// From each mask there is to one of at most kMaxColorizeJobs that hold all of its bits.
std::map<uint64_t, uint64_t> gathered(const std::map<uint64_t, size_t>& counts) {
  std::vector<Group> groups;
  for (const auto& [mask, count] : counts) groups.push_back({mask, count});
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.tiles > b.tiles; });
  std::vector<Group> kept(groups.begin(),
                          groups.begin() + long(std::min<size_t>(groups.size(), kMaxColorizeJobs)));
  std::map<uint64_t, size_t> jobOf;
  for (size_t i = 0; i < kept.size(); ++i) jobOf[kept[i].mask] = i;
  for (size_t i = kept.size(); i < groups.size(); ++i) {
    const auto joined = [&](const Group& job) {
      return Group{job.mask | groups[i].mask, job.tiles + groups[i].tiles};
    };
    const auto best = std::min_element(kept.begin(), kept.end(), [&](const Group& a, const Group& b) {
      return joined(a).cost() - a.cost() < joined(b).cost() - b.cost();
    });
    *best = joined(*best);
    jobOf[groups[i].mask] = size_t(best - kept.begin());
  }
  std::map<uint64_t, uint64_t> result;
  for (const auto& [mask, job] : jobOf) result[mask] = kept[job].mask;
  return result;
}

}  // namespace

TileGrid::TileGrid(uint32_t width_, uint32_t height_) : width(width_), height(height_) {
  // Tiles of CPU drivers have 64 pixels a side. Of larger ones there are at most 32 in a row.
  tile = std::max(1u, (std::max(width, height) + 2047) / 2048) * 64;
  columns = (width + tile - 1) / tile, rows = (height + tile - 1) / tile;
}

std::vector<uint64_t> tileMasks(const TileGrid& grid, const std::vector<PlacedColorizer>& colorizers,
                                const glm::dmat4& worldToClip) {
  std::vector<uint64_t> masks(grid.count(), 0);
  for (size_t c = 0; c < colorizers.size(); ++c) {
    const uint64_t bit = uint64_t(1) << c;
    if (!colorizers[c].bounded) {
      for (uint64_t& mask : masks) mask |= bit;
      continue;
    }
    glm::dvec2 across[8], down[8];
    bool isBehind = true;
    for (int i = 0; i < 8; ++i) {
      const glm::dvec4 clip = worldToClip * glm::dvec4(colorizers[c].corners[i], 1);
      across[i] = {clip.x, clip.w}, down[i] = {clip.y, clip.w};
      isBehind &= clip.w < 0;
    }
    if (isBehind) continue;
    const std::vector<bool> columns = seenAlong(grid.columns, grid.tile, grid.width, across);
    const std::vector<bool> rows = seenAlong(grid.rows, grid.tile, grid.height, down);
    for (uint32_t y = 0; y < grid.rows; ++y)
      for (uint32_t x = 0; x < grid.columns; ++x)
        if (rows[y] && columns[x]) masks[size_t(y) * grid.columns + x] |= bit;
  }
  return masks;
}

std::vector<ColorizeJob> planJobs(const TileGrid& grid, std::span<const std::vector<uint64_t>> masks) {
  std::map<uint64_t, size_t> counts;
  for (const std::vector<uint64_t>& view : masks)
    for (const uint64_t mask : view) ++counts[mask];
  const std::map<uint64_t, uint64_t> jobMasks = gathered(counts);

  std::map<uint64_t, ColorizeJob> jobs;
  for (uint32_t view = 0; view < masks.size(); ++view) {
    const auto maskAt = [&](uint32_t x, uint32_t y) {
      return jobMasks.at(masks[view][size_t(y) * grid.columns + x]);
    };
    // Runs of tiles in a row, and equal runs below each other as one rectangle.
    std::vector<bool> done(grid.count());
    for (uint32_t y = 0; y < grid.rows; ++y)
      for (uint32_t x = 0; x < grid.columns;) {
        const uint64_t mask = maskAt(x, y);
        uint32_t right = x + 1, bottom = y + 1;
        if (!done[size_t(y) * grid.columns + x]) {
          const auto isFree = [&](uint32_t i, uint32_t j) {
            return maskAt(i, j) == mask && !done[size_t(j) * grid.columns + i];
          };
          while (right < grid.columns && isFree(right, y)) ++right;
          const auto rowIsFree = [&](uint32_t j) {
            for (uint32_t i = x; i < right; ++i)
              if (!isFree(i, j)) return false;
            return true;
          };
          while (bottom < grid.rows && rowIsFree(bottom)) ++bottom;
          for (uint32_t j = y; j < bottom; ++j)
            for (uint32_t i = x; i < right; ++i) done[size_t(j) * grid.columns + i] = true;
          const uint32_t left = x * grid.tile, top = y * grid.tile;
          ColorizeJob& job = jobs[mask];
          job.mask = mask;
          job.areas.push_back({view,
                               {{int32_t(left), int32_t(top)},
                                {std::min(right * grid.tile, grid.width) - left,
                                 std::min(bottom * grid.tile, grid.height) - top}}});
        }
        x = right;
      }
  }
  std::vector<ColorizeJob> list;
  for (auto& [mask, job] : jobs) list.push_back(std::move(job));
  return list;
}

uint32_t listFor(uint64_t mask, const std::vector<PlacedColorizer>& colorizers,
                 shared::ColorizeUniforms& uniforms) {
  const uint32_t count = uint32_t(std::popcount(mask));
  if (count == 0) return 0;
  uniforms.once = 1;
  uint32_t rounded = shared::kMaxColorizers;
  for (const uint32_t step : {48u, 32u, 24u, 16u, 12u, 8u, 6u, 4u, 3u, 2u, 1u})
    if (count <= step) rounded = step;
  for (uint32_t i = 0; i < count; ++i, mask &= mask - 1)
    uniforms.list[i] = colorizers[size_t(std::countr_zero(mask))].data;
  // One that can be computed.
  for (uint32_t i = count; i < rounded; ++i)
    uniforms.list[i] = uniforms.list[0], uniforms.list[i].density = 0;
  return rounded;
}

}  // namespace scumble::passes
