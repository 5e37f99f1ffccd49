#include "passes/colorize/strips.h"

#include <algorithm>
#include <cassert>

#include "passes/color/color_knobs.h"

namespace scumble::passes {

namespace {

// Marks the strips along one axis in which a box may be seen. `corners`: clip x or y, and w, of its corners.
// Between two lines of the picture, the planes through the eye and these lines bound what is seen; this holds
// for boxes around and behind the eye as well.
void markAlong(uint32_t pixels, uint32_t strip, const glm::dvec2 (&corners)[8], size_t bit,
               glm::uvec2* strips) {
  for (uint32_t i = 0; i * strip < pixels; ++i) {
    const double low = 2.0 * i * strip / pixels - 1,
                 high = 2.0 * std::min((i + 1) * strip, pixels) / pixels - 1;
    bool before = true, after = true;
    for (const glm::dvec2& c : corners) {
      before &= c.x - low * c.y < 0;
      after &= c.x - high * c.y > 0;
    }
    if (!before && !after) strips[i][int(bit / 32)] |= 1u << bit % 32;
  }
}

}  // namespace

uint32_t stripBits(uint32_t width, uint32_t height) {
  uint32_t bits = 4;
  while ((std::max(width, height) - 1) >> bits >= uint32_t(shared::kMaxStrips)) ++bits;
  return bits;
}

void markStrips(const std::vector<PlacedColorizer>& colorizers, const glm::dmat4& worldToClip, uint32_t width,
                uint32_t height, uint32_t view, shared::ColorizeUniforms& uniforms) {
  const uint32_t strip = 1u << stripBits(width, height);
  glm::uvec2 *columns = uniforms.columns + view * shared::kMaxStrips,
             *rows = uniforms.rows + view * shared::kMaxStrips;
  std::fill_n(columns, shared::kMaxStrips, glm::uvec2(0));
  std::fill_n(rows, shared::kMaxStrips, glm::uvec2(0));
  for (size_t c = 0; c < colorizers.size(); ++c) {
    if (!colorizers[c].bounded) {
      for (glm::uvec2* strips : {columns, rows})
        for (int i = 0; i < shared::kMaxStrips; ++i) strips[i][int(c / 32)] |= 1u << c % 32;
      continue;
    }
    glm::dvec2 across[8], down[8];
    bool isBehind = true;
    for (int i = 0; i < 8; ++i) {
      const glm::dvec4 clip = worldToClip * glm::dvec4(colorizers[c].corners[i], 1);
      across[i] = {clip.x, clip.w}, down[i] = {clip.y, clip.w};
      isBehind &= clip.w < 0;
    }
    if (isBehind) continue;
    markAlong(width, strip, across, c, columns);
    markAlong(height, strip, down, c, rows);
  }
}

uint32_t fillUniforms(const frame::FrameInput& input, uint32_t viewCount,
                      shared::ColorizeUniforms& uniforms) {
  const shared::FrameUniforms& frame = input.uniforms;
  const shared::SurfaceColors colors = surfaceColors(input, frame::Layer::first);
  uniforms.air = {colors.horizon, colors.air, colors.airStart, colors.airEnd};
  return fillUniforms(
      placeColorizers(input.look, input.scene.data(), input.scene.motion().worldAsDrawn(), frame), frame,
      viewCount, uint32_t(frame.imageSize.x), uint32_t(frame.imageSize.y), uniforms);
}

uint32_t fillUniforms(const std::vector<PlacedColorizer>& colorizers, const shared::FrameUniforms& frame,
                      uint32_t viewCount, uint32_t width, uint32_t height,
                      shared::ColorizeUniforms& uniforms) {
  assert(colorizers.size() <= size_t(shared::kMaxColorizers));
  uint32_t features = 0;
  for (size_t i = 0; i < colorizers.size(); ++i) {
    features |= uint32_t(colorizers[i].features);
    uniforms.list[i] = colorizers[i].data;
  }
  uniforms.stripBits = int(stripBits(width, height));
  for (uint32_t v = 0; v < viewCount; ++v) {
    const shared::ViewUniforms& view = frame.views[v];
    uniforms.sights[v] = sightLines(view);
    if (view.orthographic != 0) features |= uint32_t(shared::kHasParallel);
    markStrips(colorizers, glm::dmat4(view.worldToClip), width, height, v, uniforms);
  }
  return features;
}

}  // namespace scumble::passes
