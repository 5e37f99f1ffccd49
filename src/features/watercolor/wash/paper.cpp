#include "features/watercolor/wash/paper.h"

#include <algorithm>
#include <cmath>

#include "features/watercolor/watercolor_knobs.h"
#include "stage/light.h"

namespace scumble::watercolor {

using namespace frame;

namespace {

enum PaperMotion : uint32_t { kWithScreen, kWithTurn, kWithSubject };

// Where the paper's origin lies in a view, pixels: a function of the view alone.
glm::vec2 paperPlace(const FrameInput& input, uint32_t view, uint32_t motion) {
  const shared::FrameUniforms& frame = input.uniforms;
  const shared::ViewUniforms& v = frame.views[view];
  if (motion == kWithTurn) {
    // As far as a thing without end would move when the camera turns.
    const glm::vec3 ahead = -glm::vec3(v.worldToEye[0][2], v.worldToEye[1][2], v.worldToEye[2][2]);
    const float pixelsOfRadian = 0.5f * frame.imageSize.y / std::abs(v.ndcToEyeRay.y);
    return pixelsOfRadian *
           glm::vec2(std::atan2(-ahead.x, -ahead.z), std::asin(glm::clamp(ahead.y, -1.0f, 1.0f)));
  }
  if (motion == kWithSubject) {
    // In both eyes by the view between them: the paper is as far away as the picture's plane.
    const glm::vec4 clip = frame.worldToCyclopean * glm::vec4(frame.sceneCenter, 1);
    if (clip.w > 0) return glm::vec2(clip) / clip.w * 0.5f * frame.imageSize;
  }
  return glm::vec2(0);
}

// Where on the picture the light lies that falls on the paper (section 4.2), so that both come from one side:
// in -1 to 1 over the picture, not farther off than `range` times that, and `depth` in front of it. For all
// eyes as the view between them has it, since paper lies in one direction for them. What is behind the viewer
// lies on its side of the picture.
glm::vec3 paperLight(const FrameInput& input, float depth, float range) {
  const shared::FrameUniforms& frame = input.uniforms;
  const glm::vec4 light = keyLight(input.scene.data(), input.knobs.scene<LightParams>(),
                                   input.scene.motion().world(), input.scene.motion().shown());
  const bool isParallel = frame.views[0].orthographic > 0;
  const glm::vec4 clip = frame.worldToCyclopean * light;
  // A light at this part of its distance before the eye, or nearer, is beside it.
  constexpr float kBeside = 0.2f;
  const float distance = light.w > 0 ? glm::distance(glm::vec3(light), frame.viewer) : 1;
  glm::vec2 side = glm::vec2(clip) / std::max(isParallel ? 1 : std::abs(clip.w), kBeside * distance);
  if (isParallel && light.w == 0) {
    // It lies endlessly far to the side: as much of that as the depth has.
    const glm::vec3 inEye = glm::mat3(frame.views[0].worldToEye) * glm::vec3(light);
    side = depth * glm::vec2(inEye.x, -inEye.y) / std::max(std::abs(inEye.z), kBeside);
  }
  return {glm::clamp(side, -range, range), depth};
}

// So far apart are the heights that a slope is taken from: pixels at 1080 lines, so that pictures of all
// sizes have the same slopes.
constexpr float kSlopeStep = 1.25f;

}  // namespace

shared::WashUniforms paperUniforms(const FrameInput& input, const Configuration& configuration) {
  const WatercolorParams p = input.knobs.scene<WatercolorParams>();
  const float scale = input.uniforms.pixelScale;
  shared::WashUniforms u{};
  u.paperSize = p.paperSize * scale;
  u.slopeStep = kSlopeStep * scale;
  // A sphere ends nowhere.
  u.margin = configuration.onSphere ? 0 : p.margin;
  // Around whoever looks, or around the world.
  u.eyeToPaper = p.paperMotion == kWithTurn ? glm::transpose(glm::mat3(input.uniforms.views[0].worldToEye))
                                            : input.uniforms.eyeToSphere;
  for (uint32_t view = 0; view < configuration.viewCount; ++view)
    if (!configuration.onSphere) u.paperAt[view] = paperPlace(input, view, uint32_t(p.paperMotion));
  u.paperLight = paperLight(input, p.lightDepth, p.lightRange);
  return u;
}

gpu::SamplerDesc paperSampler(const ExampleTexture& texture, float size) {
  const float level = std::round(std::log2(float(texture.width) / std::max(size, 1.0f)));
  gpu::SamplerDesc sampler = kBroadSampler;
  sampler.onlyLevel = std::clamp(level, 0.0f, 8.0f);
  return sampler;
}

}  // namespace scumble::watercolor
