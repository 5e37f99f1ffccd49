#include "bake/atlas.h"

#include <png.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <numeric>
#include <stdexcept>

namespace scumble::bake {

namespace {

uint32_t onGrid(uint32_t texels) {
  return (texels + kAtlasGrid - 1) / kAtlasGrid * kAtlasGrid;
}

// Colours spread into what is empty, from texel to texel beside it, row by row and back.
void spreadColors(Tile& tile) {
  std::vector<uint8_t> known(size_t(tile.width) * tile.height);
  for (size_t i = 0; i < known.size(); ++i) known[i] = tile.rgba[4 * i + 3] > 0;
  const auto take = [&](size_t to, size_t from) {
    if (known[to] || !known[from]) return;
    std::memcpy(&tile.rgba[4 * to], &tile.rgba[4 * from], 3);
    known[to] = 1;
  };
  const size_t w = tile.width, h = tile.height;
  for (size_t y = 0; y < h; ++y) {
    for (size_t x = 1; x < w; ++x) take(y * w + x, y * w + x - 1);
    for (size_t x = w - 1; x-- > 0;) take(y * w + x, y * w + x + 1);
  }
  for (size_t y = 1; y < h; ++y)
    for (size_t x = 0; x < w; ++x) take(y * w + x, (y - 1) * w + x);
  for (size_t y = h - 1; y-- > 0;)
    for (size_t x = 0; x < w; ++x) take(y * w + x, (y + 1) * w + x);
}

}  // namespace

std::optional<Packing> pack(const std::vector<glm::uvec2>& sizes, uint32_t width, uint32_t height) {
  Packing packing;
  packing.at.resize(sizes.size());
  std::vector<size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return sizes[a].y > sizes[b].y; });
  uint32_t x = 0, y = 0, row = 0;
  for (const size_t i : order) {
    const glm::uvec2 size(onGrid(sizes[i].x), onGrid(sizes[i].y));
    if (size.x == 0 || size.y == 0) continue;
    if (size.x > width) return std::nullopt;
    if (x + size.x > width) y += row, x = 0, row = 0;
    row = std::max(row, size.y);
    if (y + row > height) return std::nullopt;
    packing.at[i] = {x, y};
    x += size.x;
    packing.width = std::max(packing.width, x);
  }
  packing.height = y + row;
  return packing;
}

Pixels assemble(const Packing& packing, const std::vector<Tile>& tiles) {
  Pixels pixels{packing.width, packing.height, {}};
  pixels.rgba.resize(size_t(pixels.width) * pixels.height * 4);
  for (size_t i = 0; i < tiles.size(); ++i) {
    if (tiles[i].width == 0) continue;
    Tile tile = tiles[i];
    spreadColors(tile);
    // Up to the grid its border goes on.
    for (uint32_t y = 0; y < onGrid(tile.height); ++y)
      for (uint32_t x = 0; x < onGrid(tile.width); ++x) {
        const size_t from = size_t(std::min(y, tile.height - 1)) * tile.width + std::min(x, tile.width - 1);
        const size_t to = size_t(packing.at[i].y + y) * pixels.width + packing.at[i].x + x;
        std::memcpy(&pixels.rgba[4 * to], &tile.rgba[4 * from], 4);
      }
  }
  return pixels;
}

std::vector<uint8_t> pngOf(const Pixels& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = pixels.width, image.height = pixels.height;
  image.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = 0;
  const auto write = [&](void* to) {
    if (!png_image_write_to_memory(&image, to, &size, 0, pixels.rgba.data(), 0, nullptr))
      throw std::runtime_error(std::string("the texture cannot be written: ") + image.message);
  };
  write(nullptr);
  std::vector<uint8_t> bytes(size);
  write(bytes.data());
  bytes.resize(size);
  return bytes;
}

}  // namespace scumble::bake
