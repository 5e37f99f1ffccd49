#include "world/look_textures.h"

#include <algorithm>

#include "base/mipmaps.h"

namespace scumble::world {

SetTexture LookTextures::get(const look::LookData& look, look::Picture picture) {
  constexpr gpu::SamplerDesc kSampler{VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT,
                                      VK_SAMPLER_ADDRESS_MODE_REPEAT, true};
  const look::LookPicture& wanted = *look.pictures[size_t(-1 - picture.index)];
  const auto found = std::find_if(known_.begin(), known_.end(),
                                  [&](const Known& known) { return known.contents == wanted.contents; });
  if (found != known_.end()) return {found->image.view(), kSampler};
  const Pixels& pixels = wanted.pixels;
  const auto smaller = makeMipmaps(pixels.rgba, pixels.width, pixels.height);
  std::vector<std::span<const std::byte>> levels{std::as_bytes(std::span(pixels.rgba))};
  for (const auto& level : smaller) levels.push_back(std::as_bytes(std::span(level)));
  gpu::Uploader uploader(device_);
  known_.push_back(
      {wanted.contents, uploader.texture(levels, VK_FORMAT_R8G8B8A8_SRGB, pixels.width, pixels.height)});
  uploader.flush();
  return {known_.back().image.view(), kSampler};
}

}  // namespace scumble::world
