// Wakes, ripples and splashes (paper 000, section 6.2): those that a look declares, and where they are on the
// water at a moment. What they look like there: shading/water.glsl.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "look/look_data.h"
#include "scene/animation.h"
#include "shading/ocean.shared.h"

namespace scumble::frame {

#define PARAMS_STRUCT DecorationParams
#define PARAMS_FILE "frame/decoration.params"
#define PARAMS_PATH "water"
#define PARAMS_TARGETS look::kDecorations
#include "look/define_params.h"

struct Decoration {
  DecorationParams params;
  std::optional<size_t> node;  // what makes it; none: a place of the scene
  bool isThere = true;         // else the scene has no such node
};

// Those that the look declares, in its order; then the wakes of what rides the waves, where the look declares
// none for it. kMaxDecorations at most. `ocean`: the ocean's own node; -1: none.
std::vector<Decoration> decorationsOf(const scene::SceneData& scene, const look::LookData& look, int ocean);

// Its mesh, in the coordinates that decorationPlace (shading/water.glsl) lays on the water.
struct DecorationMesh {
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> indices;
};
DecorationMesh makeDecorationMesh(int kind);

// Metres that the scene has travelled over the water by a time, along x and z.
using Travelled = std::function<glm::dvec2(double)>;

// One for each; without points where it draws nothing. A pure function of its arguments: a wake lies along
// the way that its maker has come, which is asked of the clips, and of the travelled way, at times past.
// Before a clip that begins
// anew elsewhere, it is taken to have come straight on.
std::vector<shared::WaterDecoration> placeDecorations(const std::vector<Decoration>& decorations,
                                                      const scene::SceneData& scene,
                                                      std::span<const scene::PlayedClip> clips, double time,
                                                      const glm::vec3& origin, const Travelled& travelled);

// How high one may stand above the waves, and sink below them, metres.
float decorationHeight(const shared::WaterDecoration& decoration);

}  // namespace scumble::frame
