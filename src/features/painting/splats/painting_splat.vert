#version 460
// A square around a splat that faces the viewer and lies along its stroke; around a Gaussian a rectangle along the ellipse
// that it is from there.
#extension GL_GOOGLE_include_directive : require
#include "../strokes.glsl"
#include "../../../shading/color_map.glsl"
#include "../../../shading/light_space.glsl"
#include "../../../shading/view_index.glsl"

layout(set = 1, binding = kPaintingPlaced, scalar) readonly buffer Placed { PlacedPoint placed[]; };
layout(set = 1, binding = kPaintingOrder, scalar) readonly buffer Order { uint order[]; };
layout(set = 1, binding = kPaintingKeys, scalar) readonly buffer Keys { uint keys[]; };
layout(set = 2, binding = kPaintingShadowMap) uniform sampler2DArrayShadow shadowMap;

layout(constant_id = kPassId) const bool kTakesLight = false;

layout(location = 0) out vec2 outPlace;       // within the splat, in radii: along the stroke, and across
layout(location = 1) flat out vec4 outColor;  // square root; A: opacity
layout(location = 2) flat out vec4 outStroke;  // from its beginning, and to its end, radii; radius, pixels; a chance
layout(location = 3) flat out vec2 outDepth;   // eye depth; metres that it may lie behind what is seen
layout(location = 4) flat out int outBrush;

// As a surface there has it: Lambert times cast shadow, steepened around the terminator.
float lightAt(vec3 position, vec3 normal, float radius) {
  float lambert = dot(normal, frame.toLight);
  vec3 p = (frame.worldToLight * vec4(position, 1.0)).xyz;
  vec2 texel = frame.shadowTexel * frame.lightToWorldScale.xy / lightSpaceMagnification(sigmoidArgument(p.xy));
  float coarse = max(texel.x, texel.y);
  p += mat3(frame.worldToLight) * normal * (2.5 * coarse + radius);
  float reaches = texture(shadowMap, vec4(shadowMapUv(sigmoidArgument(p.xy)), 0.0,
                                          min(p.z - 0.5 * coarse / frame.lightToWorldScale.z, 1.0)));
  return clamp(0.5 + (lambert - u.terminator) * u.terminatorSharpness, 0.0, 1.0) * reaches;
}

// Ellipse of a Gaussian on the screen: two standard deviations along both axes, pixels, and the direction of the first.
// `spread`: growth of its area by the low-pass filter that keeps it from being thinner than a pixel.
struct Ellipse {
  vec2 sizes, direction;
  float spread;
};
Ellipse ellipseOf(PlacedPoint place, uint shape, vec4 clip, int view) {
  vec3 third = decodeNormal(unpackSnorm2x16(place.normal)), first = place.tangent;
  first = normalize(first - third * dot(first, third) + vec3(1e-12, 0.0, 0.0));
  mat3 axes = mat3(first, cross(third, first), third);
  vec3 reach = 0.5 * place.radius * unpackUnorm4x8(shape).xyz;  // standard deviations, metres
  // Covariance on the screen, square pixels, by the derivative of the projection at its middle.
  float xx = 0.0, xy = 0.0, yy = 0.0;
  for (int i = 0; i < 3; ++i) {
    vec4 along = VIEW_FIELD(worldToClip, view) * vec4(axes[i] * reach[i], 0.0);
    vec2 step = (along.xy - clip.xy / clip.w * along.w) / clip.w * 0.5 * frame.imageSize;
    xx += step.x * step.x, xy += step.x * step.y, yy += step.y * step.y;
  }
  const float kPixel = 0.09;  // the square of 0.3 pixels
  float area = max(xx * yy - xy * xy, 0.0);
  xx += kPixel, yy += kPixel;
  float wide = xx * yy - xy * xy, middle = 0.5 * (xx + yy), apart = sqrt(max(middle * middle - wide, 0.0));
  Ellipse ellipse;
  ellipse.sizes = 2.0 * sqrt(max(vec2(middle + apart, middle - apart), vec2(kPixel)));
  vec2 direction = abs(xy) > 1e-9 ? vec2(xy, middle + apart - xx) : (xx >= yy ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
  ellipse.direction = normalize(direction);
  ellipse.spread = sqrt(wide / max(area, 1e-12 * wide));
  return ellipse;
}

void main() {
  gl_Position = vec4(2.0, 2.0, 0.0, 1.0);  // outside
  outPlace = vec2(0.0);
  outColor = outStroke = vec4(0.0);
  outDepth = vec2(0.0);
  outBrush = 0;
  uint number = uint(gl_VertexIndex) / 6u;
  int corner = int(uint(gl_VertexIndex) % 6u), view = viewIndex();
  if (keys[number] == 0xFFFFFFFFu) return;
  Splat splat = splats[order[number]];
  uint next = splat.point + (splat.toNext > 0.0 ? 1u : 0u);
  PlacedPoint from = placed[splat.point], to = placed[next];
  vec3 position = mix(from.position, to.position, splat.toNext), along = mix(from.tangent, to.tangent, splat.toNext);
  float radius = mix(from.radius, to.radius, splat.toNext);
  vec4 clip = VIEW_FIELD(worldToClip, view) * vec4(position, 1.0);
  // Before the near plane, behind the viewer, or beyond what is drawn.
  if (clip.w <= 1e-6 || clip.z > clip.w || clip.z < 0.0) return;
  vec2 at = (clip.xy / clip.w + 1.0) * 0.5 * frame.imageSize;
  float depth = eyeDepth(clip.z / clip.w, view);
  float pixels = radius / metresOfPixel(depth, view);
  // What is less than a pixel wide is lighter instead.
  float drawn = max(pixels, 0.5), thin = pixels / drawn;
  StrokePoint a = points[splat.point], b = points[next];
  outBrush = int(a.flags >> 8 & 255u);
  bool isGaussian = outBrush == kGaussian;
  vec2 sizes = vec2(drawn), direction = vec2(0.0);
  float reach = drawn + 1.0;
  if (isGaussian) {
    const float kReach = 1.66;  // radii: where what is there is less than a code
    Ellipse ellipse = ellipseOf(from, a.shape, clip, view);
    sizes = ellipse.sizes, direction = ellipse.direction;
    thin = 1.0 / ellipse.spread;
    reach = kReach * sizes.x;
  }
  if (any(lessThan(at, vec2(-reach))) || any(greaterThan(at, frame.imageSize + reach))) return;
  if (!isGaussian) {
    vec4 ahead = VIEW_FIELD(worldToClip, view) * vec4(position + along * radius, 1.0);
    direction = (ahead.xy / max(ahead.w, 1e-6) + 1.0) * 0.5 * frame.imageSize - at;
    float size = length(direction);
    direction = size > 1e-4 ? direction / size : vec2(1.0, 0.0);
  }

  Sight sight = sightOf(position, along);
  float fade = fadeOf(splat, radius, metresOfPixel(sight.away, 0), sight.sine);
  vec4 color = mix(unpackUnorm4x8(a.color), unpackUnorm4x8(b.color), splat.toNext);
  float apart = splatsApart(u.spacing, metresOfPixel(sight.away, 0), radius);
  color.a = splatOpacity(outBrush, color.a * u.opacity, apart) * fade * thin;
  uint chance = a.flags >> 16;
  // Strokes differ from each other; Gaussians are each a part of something.
  if (!isGaussian) color.rgb *= 1.0 + u.variation * (float(chance & 255u) / 255.0 - 0.5);

  if (kTakesLight) {
    vec3 normal = normalize(mix(decodeNormal(unpackSnorm2x16(from.normal)), decodeNormal(unpackSnorm2x16(to.normal)),
                                splat.toNext));
    if (a.vertices.x == kUnbound && dot(normal, sight.way) < 0.0) normal = -normal;
    vec3 lit = applyColorMap(u.lit, color.rgb);
    vec3 shadowed = applyColorMap(u.shadowed, color.rgb) * mix(u.tintDown, u.tintUp, 0.5 + 0.5 * normal.y);
    color.rgb = mix(color.rgb, mix(shadowed, lit, lightAt(position, normal, radius)), u.light);
  }
  outColor = vec4(min(color.rgb, vec3(1.0)), color.a);
  float fromStart = mix(a.along, b.along, splat.toNext);
  outStroke = vec4(fromStart, a.whole - fromStart, drawn, float(chance) / 65536.0);
  outDepth = vec2(depth, u.sunken * radius);

  bool isAhead = corner == 1 || corner == 2 || corner == 4, isUp = corner == 2 || corner == 4 || corner == 5;
  outPlace = vec2(isAhead ? 1.0 : -1.0, isUp ? 1.0 : -1.0) * (reach / sizes.x);
  vec2 place = at + sizes.x * direction * outPlace.x + sizes.y * vec2(-direction.y, direction.x) * outPlace.y;
  gl_Position = vec4(place / (0.5 * frame.imageSize) - 1.0, 0.5, 1.0);
}
