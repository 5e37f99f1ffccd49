#include "frame/slots.h"

#include <array>

namespace scumble::frame {

const SlotInfo& slotInfo(Slot slot) {
  constexpr VkFormat kByte = VK_FORMAT_R8G8B8A8_UNORM, kSrgb = VK_FORMAT_R8G8B8A8_SRGB;
  constexpr VkFormat kHalf = VK_FORMAT_R16G16B16A16_SFLOAT, kFloat = VK_FORMAT_R32G32B32A32_SFLOAT;
  constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;
  static constexpr std::array<SlotInfo, size_t(Slot::count)> kInfos{{
      {"shadow-map", kDepth, Rate::once, false, 1},
      {"warp", kHalf, Rate::perView, false, 4},
      {"shadow", kByte, Rate::perView, true, 4},
      {"lit", kByte, Rate::perView, true, 4},
      {"shadowed", kByte, Rate::perView, true, 4},
      {"depth-buffer", kDepth, Rate::perView, true, 1, false},
      {"ocean-lit", kHalf, Rate::perView, false, 3, false},
      {"ocean-shadowed", kHalf, Rate::perView, false, 3, false},
      {"blur", kHalf, Rate::perView, false, 4},
      {"final-shadow", kByte, Rate::perView, false, 4},
      {"color", kHalf, Rate::perView, false, 4},
      {"colorize", kHalf, Rate::perView, false, 4},
      {"limit", kHalf, Rate::perView, false, 4},
      {"behind-shadow", kByte, Rate::perView, false, 4, false},
      {"behind-lit", kByte, Rate::perView, false, 4, false},
      {"behind-shadowed", kByte, Rate::perView, false, 4, false},
      {"behind-depth", kDepth, Rate::perView, false, 1, false},
      {"behind-colorize", kHalf, Rate::perView, false, 4, false},
      {"behind", kHalf, Rate::perView, false, 4, false},
      {"behind-limit", kHalf, Rate::perView, false, 4, false},
      {"final-color", kHalf, Rate::perView, false, 4},
      {"depth", kFloat, Rate::perView, false, 1},
      {"position", kFloat, Rate::perView, false, 3},
      {"normal", kFloat, Rate::perView, false, 3},
      {"uv", kFloat, Rate::perView, false, 2},
      {"uv-gradient", kFloat, Rate::perView, false, 4},
      {"metatexture", kFloat, Rate::perView, false, 4},
      {"motion", kFloat, Rate::perView, false, 2},
      {"id", kFloat, Rate::perView, false, 1},
      {"cryptomatte", kFloat, Rate::perView, false, 4},
      {"matte-rest", kFloat, Rate::perView, false, 4, false},
      {"plain", kSrgb, Rate::perView, true, 4, false},
  }};
  return kInfos[size_t(slot)];
}

}  // namespace scumble::frame
