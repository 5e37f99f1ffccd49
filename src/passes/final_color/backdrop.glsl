// The picture behind everything: where a pixel takes it from, its colour in light, and its colour in shadow.

// One of its texels a pixel, or the mean of the four that a pixel covers.
// `pixel`: what one covers of it there.
vec3 pictureAlone(vec2 uv, vec2 pixel) {
  vec2 apart = 0.25 * u.backdrop.minified * pixel;
  if ((kBackdrop & kBackdropMinified) == 0) {
    // At the very middle of a texel filters add what they round; a picture as large as the frame stays what it is.
    vec2 texel = uv * vec2(textureSize(backdrop, 0)), middle = floor(texel) + 0.5;
    if (all(lessThan(abs(texel - middle), vec2(1e-3)))) return texelFetch(backdrop, ivec2(middle), 0).rgb;
    return textureLod(backdrop, uv, 0.0).rgb;
  }
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i)
    sum += textureLod(backdrop, uv + apart * vec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1), 0.0).rgb;
  return 0.25 * sum;
}

// A Kuwahara filter (Papari et al. 2007) whose sectors are single samples of a coarser level: of eight areas around the
// pixel those with the least variance count, so that it becomes flat without losing its edges.
vec3 pictureSimplified(vec2 uv, vec2 pixel) {
  vec2 reach = 0.6 * u.backdrop.radius * pixel;
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < 8; ++i) {
    float angle = 0.7853982 * (float(i) + 0.5);
    vec4 area = textureLod(backdrop, uv + reach * vec2(cos(angle), sin(angle)), u.backdrop.sectorLevel);
    float luminance = dot(area.rgb, kLuminance);
    // Of what is dark, small differences count as much as an eye sees them.
    float variance = max(area.a - luminance * luminance, 0.0) / (luminance * luminance + 1e-3);
    float weight = 1.0 / (variance * variance + 1e-5);
    sum += weight * area.rgb;
    weights += weight;
  }
  return sum / weights;
}

// The nearest of steps, and the way to the next one in a twelfth of a step, so that edges are no stairs.
vec3 stepped(vec3 value, vec3 steps) {
  vec3 at = value * steps - 0.5, first = floor(at);
  return (first + smoothstep(0.46, 0.54, at - first) + 0.5) / steps;
}

// Few colours: so many steps of lightness, and steps of hue and chroma a quarter as wide.
vec3 pictureStepped(vec3 color) {
  vec3 lab = oklabFromLinear(clamp(color, 0.0, 1.0));
  const vec3 kGrey = vec3(0.0, 0.5, 0.5);  // a step's middle lies there
  vec3 steps = vec3(1.0, 4.0, 4.0) * u.backdrop.steps + 2.0 * kGrey;
  return clamp(linearFromOklab(stepped(lab + kGrey, steps) - kGrey), 0.0, 1.0);
}

// In the colours of a palette.
const int kColors = kMaxPaletteColors;
#define PALETTE u.backdrop.palette
#include "../../shading/nearest_color.glsl"
vec3 pictureLimited(vec3 color) {
  vec3 weights = vec3(u.backdrop.lightness, 1.0, 1.0), lab = weights * oklabFromLinear(clamp(color, 0.0, 1.0));
  vec3 limited = mix(lab, nearestColorSoftly(lab), u.backdrop.limited) / weights;
  return clamp(linearFromOklab(limited), 0.0, 1.0);
}

// The pixel's place in the picture. `torn`: where the warp fetches this pixel's colour from.
vec2 backdropPlace(ivec2 pixel, vec2 torn, int layer) {
  vec2 own = vec2(pixel) + 0.5;
  if ((kBackdrop & kBackdropTorn) != 0) {
    OnScreen on = onScreen(own, vec2(0.0), vec2(0.0), u.backdrop.tearSize, frame.eyeToSphere, layer);
    vec2 field = lookUp(tear, vec4(u.tearMean, 0.0, 0.0), on, 1.0, u.backdrop.tearShift).xy;
    return own + 2.0 * u.backdrop.tear * field;
  }
  if ((kBackdrop & kBackdropTornNear) == 0) return own;
  // Near what is drawn: not where the ground alone, which is not seen, would tear it.
  vec2 ndc = own / frame.imageSize * 2.0 - 1.0;
  vec4 toRay = VIEW_FIELD(ndcToEyeRay, layer);
  vec2 side = ndc * toRay.xy + toRay.zw;
  float parallel = VIEW_FIELD(orthographic, layer);
  vec3 up = VIEW_FIELD(upInEye, layer);
  float rise = dot(up, vec3(side * (1.0 - parallel), -1.0));
  float start = VIEW_FIELD(eye, layer).y + dot(up.xy, side * parallel);
  float ground = (u.backdrop.groundHeight - start) / rise;
  float surface = eyeDepth(texelFetch(inflated, ivec3(pixel, layer), 0).r, layer);
  return abs(surface - ground) < 0.01 * min(surface, 60000.0) ? own : torn;
}

// How much of the pixel is the picture in the shadow on the ground, where the ground is all that is there. The slots'
// texels around a place, mixed as the colour is.
float matteShadow(vec2 at, int layer) {
  vec2 corner = floor(at - 0.5), f = at - 0.5 - corner;
  vec3 middle = vec3((corner + 1.0) / frame.imageSize, layer);
  vec4 part = max(textureGather(finalShadow, middle, 3) - textureGather(lit, middle, 3), 0.0);
  part *= 1.0 - textureGather(finalShadow, middle, 0);
  vec2 rows = mix(part.wx, part.zy, f.x);
  return mix(rows.x, rows.y, f.y);
}

float matteShadowBehind(ivec2 pixel, int layer) {
  vec4 shadow = texelFetch(behindShadow, ivec3(pixel, layer), 0);
  return max(shadow.a - texelFetch(behindLit, ivec3(pixel, layer), 0).a, 0.0) * (1.0 - shadow.r);
}

// Lays a premultiplied colour over the picture, `matte` of which is in shadow. It is endlessly far away.
vec4 overBackdrop(vec4 color, float matte, float distance, vec2 at, int layer) {
  vec2 uv = ((at - VIEW_FIELD(aside, layer)) / frame.imageSize - 0.5) * u.backdrop.scale + 0.5;
  vec2 pixel = u.backdrop.scale / frame.imageSize;
  if (kOnSphere) {
    // All around: longitudes and latitudes.
    vec3 towards = frame.eyeToSphere * lookThrough(at, layer);
    uv = vec2(0.5 + atan(towards.x, -towards.z) * 0.15915494, 0.5 - asin(clamp(towards.y, -1.0, 1.0)) * 0.31830989);
    // Towards the poles there is more of a row in a pixel.
    pixel.x *= min(inversesqrt(max(1.0 - towards.y * towards.y, 1e-6)), 0.25 / pixel.x);
  }
  vec3 own;
  if ((kBackdrop & kBackdropSimplified) != 0)
    own = pictureSimplified(uv, pixel);
  else
    own = pictureAlone(uv, pixel);
  if ((kBackdrop & kBackdropMixed) != 0) own = mix(pictureAlone(uv, pixel), own, u.backdrop.radius);
  if ((kBackdrop & kBackdropStepped) != 0) own = pictureStepped(own);
  vec3 inLight = own;
  float open = 1.0 - color.a;
  matte = min(matte * (1.0 - smoothstep(u.backdrop.matteNear, u.backdrop.matteFar, distance)), open);
  vec3 root = sqrt(clamp(own, 0.0, 1.0));
  if ((kBackdrop & kBackdropStyled) != 0) {
    vec3 styled = applyColorMap(u.backdrop.lit, root);
    inLight = mix(own, styled * styled, u.backdrop.style);
  }
  vec3 shown = inLight * (open - matte);
  if (matte > 0.0) {
    vec3 plain = applyColorMap(u.backdrop.shadowed, root), styled = applyColorMap(u.backdrop.litShadowed, root);
    vec3 dark = mix(plain * plain, styled * styled, u.backdrop.style) * u.backdrop.shadowTint;
    // The polynomial makes the very darkest colours lighter than they are.
    dark *= min(1.0, 0.75 * dot(inLight, kLuminance) / max(dot(dark, kLuminance), 1e-4));
    shown += dark * matte;
  }
  if ((kBackdrop & kBackdropLimited) != 0) shown = open * pictureLimited(shown / max(open, 1e-4));
  color.rgb += shown;
  return vec4(color.rgb, 1.0);
}
