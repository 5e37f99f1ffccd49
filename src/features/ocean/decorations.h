// Wakes, ripples and splashes (paper 000, section 6.2): those that a look declares, and where they are on the
// water at a moment. What they look like there: features/ocean/water.glsl.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "features/ocean/floating.h"
#include "features/ocean/ocean.shared.h"
#include "features/ocean/ocean_travel.h"
#include "look/look_data.h"
#include "scene/animation.h"

namespace scumble::ocean {

#define PARAMS_STRUCT DecorationParams
#define PARAMS_FILE "features/ocean/decoration.params"
#define PARAMS_PATH "water"
#define PARAMS_TARGETS look::kDecorations
#include "look/define_params.h"

struct Decoration {
  DecorationParams params;
  std::optional<size_t> node;  // what makes it; none: a place of the scene
  bool isThere = true;         // else the scene has no such node
};

// Those that the look declares, in its order; then the wakes of what rides the waves, where the look declares
// none for it. kMaxDecorations at most.
std::vector<Decoration> decorationsOf(const scene::SceneData& scene, const look::LookData& look,
                                      std::span<const FloatingNode> floating);

// Its positions and triangles, in the coordinates that decorationPlace (features/ocean/water.glsl) lays on
// the water.
scene::Primitive makeDecorationMesh(int kind);

// One for each; without points where it draws nothing. A pure function of its arguments: a wake lies along
// the way that its maker has come, which is asked of the clips, and of the travelled way, at times past.
// Before a clip that begins anew elsewhere, it is taken to have come straight on.
std::vector<shared::WaterDecoration> placeDecorations(const std::vector<Decoration>& decorations,
                                                      const scene::SceneData& scene,
                                                      std::span<const scene::PlayedClip> clips, double time,
                                                      const glm::vec3& origin, const Travelled& travelled);

// How high one may stand above the waves, and sink below them, metres.
float decorationHeight(const shared::WaterDecoration& decoration);

}  // namespace scumble::ocean
