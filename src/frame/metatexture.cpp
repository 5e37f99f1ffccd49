#include "frame/metatexture.h"

#include <algorithm>
#include <cmath>

#include "base/tileable_noise.h"

namespace scumble::frame {

namespace {

bool isGaussianEnough(const Statistics& statistics, uint32_t channels) {
  for (int c = 0; c < 4; ++c)
    if ((channels >> c & 1) && statistics.distanceToGaussian[c] > kGaussianEnough) return false;
  return true;
}

}  // namespace

MetaTextureUse metaTextureUse(const WarpMetaTextureParams& params, uint32_t channels,
                              const look::LookData& look, ExampleTextures& examples, float pixelScale,
                              const glm::vec2& shift) {
  const ExampleTexture* example = &examples.get(look, params.example);
  MetaTexture m;
  m.contrast = params.contrast - 1;
  if (m.contrast < 0)
    m.contrast = isGaussianEnough(example->statistics, channels) ? kContrastVariance : kContrastHistogram;
  if (m.contrast == kContrastHistogram) example = &examples.getWithTwin(look, params.example);
  m.mode = params.mode;
  // Rivals are what they are elsewhere: their scales know no skew.
  m.skew = m.mode == 0 ? int(params.skew) : 0;
  m.orient = m.mode == 0 ? int(params.orient) : 0;
  m.nested = m.mode == 0 ? int(params.nested) : 0;
  m.mean = (m.contrast == kContrastHistogram ? example->gaussianStatistics : example->statistics).mean;
  const float width = params.size * pixelScale;
  m.size = {width, width * float(example->height) / float(example->width)};
  m.shift = shift;
  m.base = params.base;
  m.levelRotation = glm::radians(params.levelRotation);
  m.blend = params.blend;
  m.skip = params.skip;
  // Copies stand at up to the ratio of two scales around their size, most of them near it; a whole level
  // costs one bilinear sample where a fraction costs two.
  m.lod = std::max(0.0f, std::floor(std::log2(float(example->width) / width) + 0.4f));
  m.skewLevels = float(params.skewLevels);
  m.tiles = params.tiles;
  return {m, example};
}

glm::vec2 patternShift(uint32_t seed) {
  return seed == 0 ? glm::vec2(0.0f)
                   : glm::vec2(float(hash(seed) & 0xFFFF), float(hash(seed + 1) & 0xFFFF)) / 65536.0f;
}

namespace {

enum Radial : uint8_t { kRadialOff, kRadialOn, kRadialAuto };

uint32_t radialOptions(int radial, const shared::FrameUniforms& frame) {
  if (radial == kRadialOff) return 0;
  if (radial == kRadialOn) return shared::kRadial;
  const float part = frame.views[0].orthographic > 0 ? 0 : shared::radialPart(frame.cyclopeanNdcToEyeRay);
  return part <= 0 ? 0 : part < 1 ? shared::kRadial | shared::kRadialInPart : shared::kRadial;
}

}  // namespace

uint32_t tangentOptions(const WarpMetaTextureParams& params, const shared::FrameUniforms& frame) {
  const bool isBetween = frame.worldToCyclopean != frame.views[0].worldToClip ||
                         frame.worldToCyclopean != frame.views[1].worldToClip;
  return (params.gradients == 1 ? shared::kFragmentGradients : 0) |
         (params.cyclopean && isBetween ? shared::kCyclopean : 0) | radialOptions(int(params.radial), frame) |
         (frame.eyeToSphere != glm::mat3(0.0f) ? shared::kByAngle : 0);
}

}  // namespace scumble::frame
