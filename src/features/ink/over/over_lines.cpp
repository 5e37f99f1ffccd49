#include "features/ink/over/over_lines.h"

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

float pixelsOfUnit(const look::LookData& look, float pixelsOfOne, float pixelScale) {
  const int unit = look.get<InkParams>().unit;
  return unit == shared::kInkMetres    ? pixelsOfOne
         : unit == shared::kInkDegrees ? glm::radians(1.0f) * pixelsOfOne
                                       : pixelScale;
}

}  // namespace scumble::ink
