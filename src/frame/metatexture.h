// MetaTexture as passes use it: the knobs of each use, and what the shaders read instead of knobs.
#pragma once

#include "frame/pass.h"
#include "shading/surface_tangents.shared.h"
#include "world/example_textures.h"

namespace scumble::frame {

#define METATEXTURE_SIZE 256.0
#define METATEXTURE_SKEW 2     // exact
#define METATEXTURE_EXAMPLE 0  // torn
#define PARAMS_STRUCT WarpMetaTextureParams
#define PARAMS_FILE "shading/metatexture.params"
#define PARAMS_PATH "warp.metatexture"
#define PARAMS_TARGETS kScene | kMaterials
#include "look/define_params.h"
#undef METATEXTURE_EXAMPLE

#define METATEXTURE_EXAMPLE 0  // torn
#define PARAMS_STRUCT BreakupMetaTextureParams
#define PARAMS_FILE "shading/metatexture.params"
#define PARAMS_PATH "breakup.metatexture"
#define PARAMS_TARGETS kScene | kMaterials
#include "look/define_params.h"
#undef METATEXTURE_EXAMPLE

#define METATEXTURE_EXAMPLE 2  // paper
#define PARAMS_STRUCT TextureMetaTextureParams
#define PARAMS_FILE "shading/metatexture.params"
#define PARAMS_PATH "texture.metatexture"
#define PARAMS_TARGETS kScene | kMaterials
#include "look/define_params.h"
#undef METATEXTURE_EXAMPLE

#undef METATEXTURE_SIZE
#undef METATEXTURE_SKEW

// Mirrors MetaTexture in shading/metatexture.glsl.
struct MetaTextureUniforms {
  glm::vec4 mean;
  glm::vec2 size, shift;
  float base, levelRotation, blend, skip, lod, skewLevels, tiles;
  uint32_t features;
};
static_assert(sizeof(MetaTextureUniforms) == 64, "scalar layout, as the shaders read it");

// What shading/metatexture.glsl says of each field, the word of features apart.
struct MetaTexture {
  glm::vec4 mean{0.5f};
  glm::vec2 size{256.0f}, shift{0.0f};
  float base = 2, levelRotation = 0, blend = 1, skip = 0, lod = 0, skewLevels = 4, tiles = 1;
  int mode = 0, skew = 0, orient = 0, contrast = 0, wrapping = 1, nested = 0;
  bool operator==(const MetaTexture&) const = default;

  // A shader for which this is a specialisation constant has no branches by uniforms: such branches would be
  // executed both ways, or, where a driver makes a shader of its own for each value, fill the memory.
  uint32_t features() const {
    return uint32_t(mode | skew << 2 | contrast << 4 | (orient != 0) << 6 | (wrapping != 0) << 7 |
                    (skip > 0) << 8 | (levelRotation != 0) << 9 | (base != 2) << 10 | (nested != 0) << 11);
  }
  MetaTextureUniforms uniforms() const {
    return {mean, size, shift, base, levelRotation, blend, skip, lod, skewLevels, tiles, features()};
  }
};

enum MetaTextureContrast : int32_t { kContrastOff, kContrastVariance, kContrastHistogram };

// A use, ready for the shaders, and its textures.
struct MetaTextureUse {
  MetaTexture meta;
  const ExampleTexture* example = nullptr;
  bool operator==(const MetaTextureUse&) const = default;
  // What the shader samples as the example: itself, or its Gaussian twin.
  const gpu::Image& image() const {
    return meta.contrast == kContrastHistogram ? example->gaussian : example->image;
  }
  // The way back from the twin; any image where nothing reads it.
  const gpu::Image& inverse() const { return example->inverse.handle() ? example->inverse : example->image; }
  // MetaTexture and screen space read one mip level; the other modes need them all.
  gpu::SamplerDesc sampler() const {
    gpu::SamplerDesc desc = ExampleTextures::kSampler;
    if (meta.mode == 0 || meta.mode == 2) desc.onlyLevel = meta.lod;
    return desc;
  }
};

// `channels`: which of the example's channels are read (1 for R, 2 for G, ...); they decide what contrast
// `auto` means. `pixelScale`: as in FrameUniforms; `shift`: of every copy.
MetaTextureUse metaTextureUse(const WarpMetaTextureParams& params, uint32_t channels,
                              const look::LookData& look, ExampleTextures& examples, float pixelScale,
                              const glm::vec2& shift);

// By the seed, in copies of a texture, from 0 to 1; none for seed 0.
glm::vec2 patternShift(uint32_t seed);

// All blocks of MetaTexture knobs have the same rows.
template <class Params>
WarpMetaTextureParams sameRows(const Params& params) {
  static_assert(sizeof(Params) == sizeof(WarpMetaTextureParams));
  WarpMetaTextureParams result;
  std::memcpy(static_cast<void*>(&result), &params, sizeof(result));
  return result;
}

// Which view's screen, and which gradients, a use counts by (shading/surface_tangents.shared.h).
// Where both eyes stand in one place, each is the view between them.
uint32_t tangentOptions(const WarpMetaTextureParams& params, const shared::FrameUniforms& frame);

}  // namespace scumble::frame
