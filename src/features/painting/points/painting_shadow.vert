#version 460
// The shadow of a stroke, from one point to the next: a rectangle that faces the light, with room for round ends.
#extension GL_GOOGLE_include_directive : require
#include "../strokes.glsl"
#include "../../../shading/light_space.glsl"

layout(set = 1, binding = kPaintingPlaced, scalar) readonly buffer Placed { PlacedPoint placed[]; };

layout(location = 0) out vec2 outPlace;      // along the stroke from its first point, and across it; metres
layout(location = 1) flat out vec3 outForm;  // its length, and the radii at both ends; metres

// Thinner paint lets light through, as brushes do that do not cover.
const float kLeastOpacity = 0.5;

void main() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside
  outPlace = vec2(0.0);
  outForm = vec3(0.0);
  uint i = uint(gl_VertexIndex) / 6u;
  int corner = int(uint(gl_VertexIndex) % 6u);
  StrokePoint point = points[i];
  bool isLast = (point.flags & kLastOfStroke) != 0u;
  // The end of a stroke is that of the part before it.
  bool isSingle = isLast && (point.flags & kFirstOfStroke) != 0u;
  PlacedPoint a = placed[i], b = placed[isLast ? i : i + 1u];
  float opacity = unpackUnorm4x8(point.color).a * u.opacity;
  int brush = int(point.flags >> 8 & 255u);
  bool isThere = (!isLast || isSingle) && point.time <= u.until && opacity >= kLeastOpacity &&
                 (brush == kPlain || brush == kBristles || brush == kGaussian) && max(a.radius, b.radius) > 0.0;
  if (!isThere) return;
  vec3 toLight = frame.toLight;
  vec3 right = normalize(cross(abs(toLight.y) > 0.99 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), toLight));
  vec3 above = cross(toLight, right);
  vec3 way = b.position - a.position;
  vec2 along = vec2(dot(way, right), dot(way, above));
  float size = length(along);
  along = size > 1e-12 ? along / size : vec2(1.0, 0.0);
  bool isEnd = corner == 1 || corner == 2 || corner == 4, isUp = corner == 2 || corner == 4 || corner == 5;
  float radius = max(a.radius, b.radius);
  outForm = vec3(size, a.radius, b.radius);
  outPlace = vec2(isEnd ? size + radius : -radius, isUp ? radius : -radius);
  vec2 beside = (outPlace.x - (isEnd ? size : 0.0)) * along + outPlace.y * vec2(-along.y, along.x);
  // Moved back by the depth of the paint, so that the surface below is not in its shadow.
  vec3 p = (isEnd ? b.position : a.position) + beside.x * right + beside.y * above - radius * toLight;
  vec3 light = (frame.worldToLight * vec4(p, 1.0)).xyz;
  gl_Position = vec4(shadowMapUv(sigmoidArgument(light.xy)) * 2.0 - 1.0, clamp(light.z, 0.0, 1.0), 1.0);
}
