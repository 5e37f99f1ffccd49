// What lies on the screen and is alike all over it: the grain of paper, what tears a picture behind everything. In a part
// of a sphere (RenderOptions::sphere) it lies on that sphere, as wide by its angle as it is on the screen: on the six
// sides of a cube, measured by angles, which run into each other at the cube's edges, so that it has neither seams nor
// poles. For image steps.
#ifndef SCUMBLE_ON_SCREEN_GLSL
#define SCUMBLE_ON_SCREEN_GLSL
#include "frame.glsl"

layout(constant_id = 4) const bool kOnSphere = false;  // image steps alone have this one

// Where an eye looks through a place on its picture, in eye space; unit.
vec3 lookThrough(vec2 place, int layer) {
  vec4 toRay = VIEW_FIELD(ndcToEyeRay, layer);
  return normalize(vec3((place / frame.imageSize * 2.0 - 1.0) * toRay.xy + toRay.zw, -1.0));
}

// Where a repeated texture is looked up for a place: in copies; on a sphere on three sides, by their shares.
struct OnScreen {
  vec2 at[3];
  vec3 share;
};

// `place`: pixels; `origin`, `size`: of a copy, pixels; `toSphere`: turns directions of eye space to the sphere that it
// lies on.
OnScreen onScreen(vec2 place, vec2 beside, vec2 origin, vec2 size, mat3 toSphere, int layer) {
  OnScreen on;
  on.share = vec3(1.0, 0.0, 0.0);
  on.at[0] = (place - VIEW_FIELD(aside, layer) - origin) / size + beside / size;
  on.at[1] = on.at[2] = vec2(0.0);
  if (!kOnSphere) return on;
  vec3 d = toSphere * lookThrough(place + beside, layer), far = abs(d);
  // Sides take turns between 34 and 56 degrees from their middles. Where two are mixed, their squares add up to one, so
  // that the grain keeps its contrast.
  on.share = max(far - 0.55, 0.0);
  on.share *= inversesqrt(max(dot(on.share, on.share), 1e-12));
  vec2 copies = 0.5 * frame.imageSize.y / (abs(VIEW_FIELD(ndcToEyeRay, layer).y) * size);  // in a radian
  vec3 opposite = 0.5 * vec3(lessThan(d, vec3(0.0)));
  on.at[0] = copies * atan(d.zy, far.xx) + opposite.x;
  on.at[1] = copies * atan(d.xz, far.yy) + opposite.y + vec2(0.37, 0.11);
  on.at[2] = copies * atan(d.xy, far.zz) + opposite.z + vec2(0.71, 0.59);
  return on;
}

// A texture of which a copy is `factor` times as small, and lies elsewhere by `shift`; as far as it is from its mean.
vec4 lookUp(sampler2D repeated, vec4 mean, OnScreen on, float factor, vec2 shift) {
  if (!kOnSphere) return texture(repeated, factor * on.at[0] + shift) - mean;
  // No differences between pixels: they jump from side to side.
  vec4 value = on.share.x * (textureLod(repeated, factor * on.at[0] + shift, 0.0) - mean);
  value += on.share.y * (textureLod(repeated, factor * on.at[1] + shift, 0.0) - mean);
  return value + on.share.z * (textureLod(repeated, factor * on.at[2] + shift, 0.0) - mean);
}
#endif
