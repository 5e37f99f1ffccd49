// The lines that ink finds in the picture, as a look has them.
#pragma once

#include <array>

#include "features/ink/over/ink_over.shared.h"
#include "frame/pass.h"
#include "look/look_data.h"

namespace scumble::ink {

struct OverLine {
  bool isShown = false;
  float radius = 0;       // in the unit of ink.unit
  glm::vec3 color{0.0f};  // square root
};

// By kind, kInkOverShadows ...
std::array<OverLine, shared::kInkOverKinds> overLines(const look::LookData& look);

// Inputs by which shaders find them.
struct FoundLines {
  shared::InkOverUniforms uniforms;
  bool inMetres = false;
  uint32_t lines = 0;  // kLines of ink_found.glsl
};
// `hasPieces`: borders of pieces are among them.
FoundLines foundLines(const frame::FrameInput& input, bool hasPieces);
// Texels that these take for a pixel, at most.
uint32_t fetchesOfFoundLines(bool hasShadows, bool hasPieces);

// Pixels of one of ink.unit; where that is metres, at a metre's distance. `pixelsOfOne`: what a metre covers
// there; `pixelScale`: pixels of a knob pixel.
float pixelsOfUnit(const look::LookData& look, float pixelsOfOne, float pixelScale);

}  // namespace scumble::ink
