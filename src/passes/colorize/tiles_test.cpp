// Tiles: a tile lists every colorizer of which any of its pixels' rays meets the box, jobs cover every tile
// once, and none leaves out what a tile lists.
#include "passes/colorize/tiles.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace scumble::passes {
namespace {

class TilesTest : public ::testing::Test {
 protected:
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::mt19937 random_{5};
};

// Boxes before, around and behind the eye, among them some whose corners lie on both sides of its plane.
TEST_F(TilesTest, noRayMeetsWhatItsTileLeavesOut) {
  const TileGrid grid(900, 500);
  glm::dmat4 toClip(0.0);
  toClip[0][0] = 1.2, toClip[1][1] = -2.0, toClip[2][0] = 0.2, toClip[2][3] = -1, toClip[3][2] = 0.01;
  const glm::dmat4 fromClip = glm::inverse(toClip);
  size_t met = 0, left = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<PlacedColorizer> list(20);
    std::vector<glm::dmat4> toUnit;
    for (PlacedColorizer& one : list) {
      glm::dmat4 placed = glm::translate(glm::dmat4(1.0), {number(-4, 4), number(-3, 3), number(-8, 3)});
      placed = glm::rotate(placed, number(-3, 3), {0.5, 0.7, 0.1});
      placed = glm::scale(placed, {number(0.05, 2), number(0.05, 2), number(0.05, 2)});
      toUnit.push_back(glm::inverse(placed));
      one.bounded = true;
      for (int i = 0; i < 8; ++i)
        one.corners[i] = glm::dvec3(placed * glm::dvec4(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1, 1));
    }
    const std::vector<uint64_t> masks = tileMasks(grid, list, toClip);
    for (int k = 0; k < 2000; ++k) {
      const glm::dvec2 pixel(number(0, grid.width), number(0, grid.height));
      const glm::dvec2 ndc = pixel / glm::dvec2(grid.width, grid.height) * 2.0 - 1.0;
      const glm::dvec4 far = fromClip * glm::dvec4(ndc, 0.001, 1);
      const glm::dvec3 ray = glm::normalize(glm::dvec3(far) / far.w);
      const uint64_t mask = masks[size_t(pixel.y / grid.tile) * grid.columns + size_t(pixel.x / grid.tile)];
      for (size_t c = 0; c < list.size(); ++c) {
        // Slabs.
        const glm::dvec3 eye(toUnit[c][3]), along = glm::dmat3(toUnit[c]) * ray;
        const glm::dvec3 a = (-1.0 - eye) / along, b = (1.0 - eye) / along;
        const glm::dvec3 enter = glm::min(a, b), leave = glm::max(a, b);
        const bool meets = std::max({enter.x, enter.y, enter.z, 0.0}) < std::min({leave.x, leave.y, leave.z});
        const bool lists = mask >> c & 1;
        ASSERT_TRUE(!meets || lists);
        met += meets, left += !lists;
      }
    }
  }
  EXPECT_GT(met, 10000u);
  EXPECT_GT(left, 1000000u);
}

TEST_F(TilesTest, jobsCoverEveryTileOnceAndListAllOfIt) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {64u, 65u}, {1280u, 720u}, {16384u, 3000u}})
    for (const int distinct : {1, 5, 200}) {
      const TileGrid grid(width, height);
      EXPECT_LE(grid.columns, 32u);
      std::vector<std::vector<uint64_t>> masks(2, std::vector<uint64_t>(grid.count()));
      for (std::vector<uint64_t>& view : masks)
        for (uint64_t& mask : view) mask = uint64_t(number(0, distinct)) * 0x9E3779B97F4A7C15u;
      const std::vector<ColorizeJob> jobs = planJobs(grid, masks);
      EXPECT_LE(jobs.size(), size_t(kMaxColorizeJobs));
      std::vector<std::vector<int>> covered(2, std::vector<int>(grid.count()));
      uint64_t pixels = 0;
      for (const ColorizeJob& job : jobs)
        for (const auto& [view, rectangle] : job.areas) {
          const auto& [offset, extent] = rectangle;
          pixels += uint64_t(extent.width) * extent.height;
          for (uint32_t y = uint32_t(offset.y); y < uint32_t(offset.y) + extent.height; y += grid.tile)
            for (uint32_t x = uint32_t(offset.x); x < uint32_t(offset.x) + extent.width; x += grid.tile) {
              const size_t tile = size_t(y / grid.tile) * grid.columns + x / grid.tile;
              ++covered[view][tile];
              EXPECT_EQ(masks[view][tile] & ~job.mask, 0u);
            }
        }
      EXPECT_EQ(pixels, uint64_t(2) * width * height);
      for (const std::vector<int>& view : covered)
        for (const int times : view) EXPECT_EQ(times, 1);
    }
}

TEST_F(TilesTest, listsAreFilledUpWithWhatDoesNothing) {
  std::vector<PlacedColorizer> list(64);
  for (size_t i = 0; i < list.size(); ++i) list[i].data.density = float(i + 1);
  for (const uint64_t mask : {uint64_t(0), uint64_t(1) << 63, uint64_t(0b11111), ~uint64_t(0)}) {
    shared::ColorizeUniforms uniforms{};
    const uint32_t count = listFor(mask, list, uniforms);
    uint32_t filled = 0;
    for (uint32_t i = 0; i < 64; ++i)
      if (mask >> i & 1) {
        EXPECT_EQ(uniforms.list[filled++].density, float(i + 1));
      }
    EXPECT_GE(count, filled);
    for (uint32_t i = filled; i < count; ++i) EXPECT_EQ(uniforms.list[i].density, 0);
  }
}

}  // namespace
}  // namespace scumble::passes
