#include "features/ink/over/over_lines.h"

#include <algorithm>
#include <cmath>

#include "features/ink/ink.shared.h"
#include "features/ink/ink_knobs.h"
#include "passes/final_shadow/final_shadow_knobs.h"

namespace scumble::ink {

std::array<OverLine, shared::kInkOverKinds> overLines(const look::LookData& look) {
  const InkParams params = look.get<InkParams>();
  const glm::vec3 color = look.get<LineParams>().color.linear;
  std::array<OverLine, shared::kInkOverKinds> lines;
  const auto add = [&]<class Params>(int kind) {
    const Params of = look.get<Params>();
    lines[size_t(kind)] = {of.shown && of.width > 0, of.width * 0.25f * (params.least + params.greatest),
                           glm::sqrt(glm::mix(color, of.color.linear, of.colorAmount))};
  };
  add.template operator()<ShadowShapeParams>(shared::kInkOverShadows);
  add.template operator()<LightStepParams>(shared::kInkOverSteps);
  add.template operator()<ObjectBorderParams>(shared::kInkOverObjects);
  add.template operator()<IntersectionParams>(shared::kInkOverIntersections);
  add.template operator()<CutOutParams>(shared::kInkOverCutOuts);
  if (look.get<passes::FinalShadowParams>().steps < 2) lines[shared::kInkOverSteps].isShown = false;
  return lines;
}

FoundLines foundLines(const frame::FrameInput& input, bool hasPieces) {
  const float pixelsOfOne =
      0.5f * input.uniforms.imageSize.y / std::abs(input.uniforms.views[0].ndcToEyeRay.y);
  const float scale = pixelsOfUnit(input.look, pixelsOfOne, input.uniforms.pixelScale);
  const InkParams params = input.knobs.scene<InkParams>();
  FoundLines found;
  found.inMetres = params.unit == shared::kInkMetres;
  found.uniforms.warp = params.warp;
  found.uniforms.least = params.breaks ? shared::kInkOverThinnest : 0;
  found.uniforms.steps = float(input.knobs.scene<passes::FinalShadowParams>().steps);
  const auto lines = overLines(input.look);
  for (size_t kind = 0; kind < lines.size(); ++kind) {
    found.uniforms.kinds[kind] = {scale * lines[kind].radius, lines[kind].color};
    found.lines |= uint32_t(lines[kind].isShown) << kind;
  }
  // Only as far as the widest line needs; in metres that depends on the distance.
  float widest = 0;
  for (int kind = shared::kInkOverObjects; kind < shared::kInkOverKinds; ++kind)
    if ((found.lines & 1u << kind) != 0)
      widest = std::max(
          widest,
          found.inMetres ? 1e9f : std::max(found.uniforms.kinds[kind].radius, found.uniforms.least) + 0.5f);
  const uint32_t reach = hasPieces ? uint32_t(std::min(std::ceil(widest), float(shared::kInkOverReach))) : 0;
  found.lines |= reach << shared::kInkOverKinds;
  return found;
}

uint32_t fetchesOfFoundLines(bool hasShadows, bool hasPieces) {
  constexpr uint32_t kSquare = 2 * shared::kInkOverReach + 1;
  return (hasShadows ? 2 * 9 * 5u : 0) + (hasPieces ? 1 + 12 + kSquare * kSquare : 0);
}

float pixelsOfUnit(const look::LookData& look, float pixelsOfOne, float pixelScale) {
  const int unit = look.get<InkParams>().unit;
  return unit == shared::kInkMetres    ? pixelsOfOne
         : unit == shared::kInkDegrees ? glm::radians(1.0f) * pixelsOfOne
                                       : pixelScale;
}

}  // namespace scumble::ink
