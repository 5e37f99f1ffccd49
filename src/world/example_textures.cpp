#include "world/example_textures.h"

#include <algorithm>
#include <cmath>

#include "base/mipmaps.h"

namespace scumble::world {

namespace {

gpu::Image upload(gpu::Uploader& uploader, const Pixels& pixels) {
  const auto smaller = makeValueMipmaps(pixels.rgba, pixels.width, pixels.height);
  std::vector<std::span<const std::byte>> levels{std::as_bytes(std::span(pixels.rgba))};
  for (const auto& level : smaller) levels.push_back(std::as_bytes(std::span(level)));
  return uploader.texture(levels, VK_FORMAT_R8G8B8A8_UNORM, pixels.width, pixels.height);
}

Pixels pixelsOf(const look::LookData& look, look::Picture picture) {
  return picture.index >= 0 ? builtInExample(picture.index)
                            : look.pictures[size_t(-1 - picture.index)]->pixels;
}

}  // namespace

ExampleTexture& ExampleTextures::find(const look::LookData& look, look::Picture picture) {
  const int builtIn = std::max(picture.index, -1);
  const uint64_t contents = builtIn >= 0 ? 0 : look.pictures[size_t(-1 - picture.index)]->contents;
  for (Known& known : known_)
    if (known.builtIn == builtIn && known.contents == contents) return known.texture;

  const Pixels pixels = pixelsOf(look, picture);
  ExampleTexture texture;
  texture.width = pixels.width, texture.height = pixels.height;
  texture.statistics = measure(pixels);
  for (size_t i = 3; i < pixels.rgba.size() && !texture.isClear; i += 4)
    texture.isClear = pixels.rgba[i] < 255;
  gpu::Uploader uploader(device_);
  texture.image = upload(uploader, pixels);
  uploader.flush();
  known_.push_back({builtIn, contents, std::move(texture)});
  return known_.back().texture;
}

const ExampleTexture& ExampleTextures::getWithTwin(const look::LookData& look, look::Picture picture) {
  ExampleTexture& texture = find(look, picture);
  if (texture.gaussian.handle()) return texture;
  const GaussianTwin twin = gaussianTwin(pixelsOf(look, picture));
  texture.gaussianStatistics = measure(twin.pixels);
  gpu::Uploader uploader(device_);
  texture.gaussian = upload(uploader, twin.pixels);
  const std::span<const std::byte> row = std::as_bytes(std::span(twin.inverse));
  texture.inverse = uploader.texture({&row, 1}, VK_FORMAT_R8G8B8A8_UNORM, 256, 1);
  uploader.flush();
  return texture;
}

}  // namespace scumble::world
