// Knobs of limited palettes, and what follows from them.
#pragma once

#include <span>

#include "look/look_data.h"

namespace scumble::passes {

#define PARAMS_STRUCT LimitParams
#define PARAMS_FILE "passes/limit/limit.params"
#define PARAMS_PATH "limit"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// The choices of limit.palette.
enum LimitPalette : int { kLimitOff, kLimitLook, kFirstBuiltIn };

// The colours that a look limits the picture to, linear; empty: it does not.
std::vector<glm::vec3> paletteColors(const LimitParams& params);

// Writes them as shaders read them, to the end of `to`: OKLab with its L multiplied by the knob `lightness`,
// the last one repeated. Returns how many shaders look at: a multiple of four, 0 for none.
uint32_t writePalette(const LimitParams& params, std::span<glm::vec3> to);

// Whether marks decide between two of them.
bool limitsByMarks(const LimitParams& params);

// The palettes that are built in, from kFirstBuiltIn on: sRGB, 0xRRGGBB.
std::span<const uint32_t> builtInPalette(int palette);

}  // namespace scumble::passes
