#include "features/ocean/paint/ocean_maps.h"

#include <algorithm>
#include <array>

#include "features/ocean/waves/maps.h"

namespace scumble::ocean {

const gpu::Image& OceanMaps::find(const look::LookData& look, look::Picture picture, bool isSky) {
  const int builtIn = std::max(picture.index, -1);
  const uint64_t contents = builtIn >= 0 ? 0 : look.pictures[size_t(-1 - picture.index)]->contents;
  for (const Known& known : known_)
    if (known.builtIn == builtIn && known.contents == contents && (builtIn < 0 || known.isSky == isSky))
      return known.image;
  // In the order of the knobs' rows.
  using enum ocean::Mood;
  constexpr std::array kRows{evening, calmMorning, openSea, storm};
  const Pixels pixels = builtIn < 0 ? look.pictures[size_t(-1 - picture.index)]->pixels
                        : isSky     ? ocean::sky(kRows[size_t(builtIn)])
                                    : ocean::bathic(kRows[size_t(builtIn)]);
  gpu::Uploader uploader(device_);
  const std::span<const std::byte> level = std::as_bytes(std::span(pixels.rgba));
  known_.push_back({builtIn, isSky, contents,
                    uploader.texture({&level, 1}, VK_FORMAT_R8G8B8A8_SRGB, pixels.width, pixels.height)});
  uploader.flush();
  return known_.back().image;
}

}  // namespace scumble::ocean
