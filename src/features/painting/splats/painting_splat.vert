#version 460
// A square around a splat that faces the viewer and lies along its stroke.
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
  float reach = drawn + 1.0;
  if (any(lessThan(at, vec2(-reach))) || any(greaterThan(at, frame.imageSize + reach))) return;
  vec4 ahead = VIEW_FIELD(worldToClip, view) * vec4(position + along * radius, 1.0);
  vec2 direction = (ahead.xy / max(ahead.w, 1e-6) + 1.0) * 0.5 * frame.imageSize - at;
  float size = length(direction);
  direction = size > 1e-4 ? direction / size : vec2(1.0, 0.0);

  Sight sight = sightOf(position, along);
  float fade = fadeOf(splat, radius, metresOfPixel(sight.away, 0), sight.sine);
  StrokePoint a = points[splat.point], b = points[next];
  vec4 color = mix(unpackUnorm4x8(a.color), unpackUnorm4x8(b.color), splat.toNext);
  float apart = splatsApart(u.spacing, metresOfPixel(sight.away, 0), radius);
  outBrush = int(a.flags >> 8 & 255u);
  color.a = splatOpacity(outBrush, color.a * u.opacity, apart) * fade * thin;
  uint chance = a.flags >> 16;
  color.rgb *= 1.0 + u.variation * (float(chance & 255u) / 255.0 - 0.5);

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
  outPlace = vec2(isAhead ? 1.0 : -1.0, isUp ? 1.0 : -1.0) * (reach / drawn);
  vec2 place = at + drawn * (direction * outPlace.x + vec2(-direction.y, direction.x) * outPlace.y);
  gl_Position = vec4(place / (0.5 * frame.imageSize) - 1.0, 0.5, 1.0);
}
