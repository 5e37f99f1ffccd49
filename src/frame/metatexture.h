// MetaTexture as passes use it: the knobs of each use, and what the shaders read instead of knobs.
#pragma once

#include "frame/example_textures.h"
#include "frame/pass.h"

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
#define METATEXTURE_SIZE 850.0  // broad strokes
#define METATEXTURE_SKEW 0      // that lie along the horizon in all of the picture
#define METATEXTURE_EXAMPLE 3   // sea
#define PARAMS_STRUCT OceanMetaTextureParams
#define PARAMS_FILE "shading/metatexture.params"
#define PARAMS_PATH "ocean.metatexture"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"
#undef METATEXTURE_EXAMPLE
#undef METATEXTURE_SKEW
#undef METATEXTURE_SIZE

// Mirrors MetaTexture in shading/metatexture.glsl, which says what each field is.
struct MetaTexture {
  glm::vec4 mean{0.5f};
  glm::vec2 size{256.0f}, shift{0.0f};
  float base = 2, levelRotation = 0, blend = 1, skip = 0, lod = 0, skewLevels = 4, tiles = 1;
  int32_t mode = 0, skew = 0, orient = 0, contrast = 0, wrapping = 1;
  bool operator==(const MetaTexture&) const = default;
  // Whether a shader needs more than the plain method at ratio 2 (metaTexturePlain in
  // shading/metatexture.glsl).
  bool isUnusual() const { return mode != 0 || orient != 0 || base != 2 || levelRotation != 0; }
};
static_assert(sizeof(MetaTexture) == 80, "scalar layout, as the shaders read it");

enum MetaTextureContrast : int32_t { kContrastOff, kContrastVariance, kContrastHistogram };

// A use, ready for the shaders. `channels`: which of the example's channels are read (1 for R, 2 for G, ...);
// they decide what contrast `auto` means.
MetaTexture metaTexture(const WarpMetaTextureParams& params, const ExampleTexture& example, uint32_t channels,
                        float pixelScale, const glm::vec2& shift);

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

// Mirrors SurfaceTangents in shading/surface_tangents.glsl: which view's screen, and which gradients, a use
// counts by.
struct TangentOptions {
  uint32_t fragmentGradients = 0, cyclopean = 1, radial = 0;
};
TangentOptions tangentOptions(const WarpMetaTextureParams& params);

}  // namespace scumble::frame
