// Slots: the images that passes exchange and that can be saved as AOVs. A pass names a slot, never another
// pass.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace scumble::frame {

enum class Slot : uint8_t {
  shadowMap,  // depth from the light in sigmoid-warped light space
  warp,       // R, G: warp vector in pixels (x right, y down); B: breakup marks; A: eye depth of the inflated
              // surface, or 0
  shadow,     // R: Lambert x cast shadow; G: lens; B: breakup, where it may act; A: coverage
  lit,        // square root of the linear colour in full light; A: coverage
  shadowed,   // the same in shadow. Square roots need no more than 8 bits, and cost drivers less than sRGB
  depth,      // depth buffer of the surface pass
  oceanLit,   // square root of the ocean's colour in light; once a pixel, wherever it is first or not
  oceanShadowed,
  blur,         // R, G, A: the shadow channels, blurred, at a quarter of the size; B: eye depth
  finalShadow,  // R: light after threshold and inner glow; G: lens; B: the glow's part of it; A: coverage
  color,        // lit and shadowed mixed, over the background
  colorize,     // the same after the look's colorizers; only where it has any, or when asked for
  limit,        // those in the colours of a palette; only where the look limits them, or when asked for
  // What lies behind the first surface of each pixel, one sample a pixel; drawn for layered ripple only.
  behindShadow,
  behindLit,
  behindShadowed,
  behindDepth,
  behindColorize,
  behind,       // its colour
  behindLimit,  // the same in the colours of a palette
  finalColor,   // warped, with bloom: the picture
  // Facts, drawn only when asked for.
  factDepth,
  position,
  normal,
  uv,
  uvGradient,
  metatexture,
  motion,
  id,
  // Mattes of objects by their coverage of the picture, drawn only when asked for: object's number and
  // coverage of two ranks each, the greatest coverage first. One AOV.
  matte,
  matteRest,
  plain,  // the yardstick's picture
  count
};

enum class Rate : uint8_t { once, perView };

struct SlotInfo {
  const char* name;
  VkFormat format;
  Rate rate;
  bool multisampled;  // drawn with the frame's samples and resolved
  uint8_t channels;   // how many of the format's channels mean something, from R on
  bool isAov = true;  // whether it can be saved, under its name
};

const SlotInfo& slotInfo(Slot slot);

}  // namespace scumble::frame
