#version 460
// Points of strokes, at rest or carried by a surface, become places in the world.
#extension GL_GOOGLE_include_directive : require
#include "../strokes.glsl"

layout(local_size_x = kPaintingThreads) in;
layout(set = 1, binding = kPaintingMatrices, scalar) readonly buffer Matrices { mat4 matrices[]; };
layout(set = 1, binding = kPaintingPlaced, scalar) writeonly buffer Placed { PlacedPoint placed[]; };
layout(set = 1, binding = kPaintingVertices, scalar) readonly buffer Vertices { VertexCore vertices[]; };
layout(push_constant, scalar) uniform Push { uint count; };

// The frame of the triangle that carries a point: its columns are unit vectors, the last one the surface's normal.
mat3 frameOf(StrokePoint point, out vec3 foot, out float scale) {
  VertexCore a = vertices[point.vertices.x], b = vertices[point.vertices.y], c = vertices[point.vertices.z];
  vec3 weights = vec3(1.0 - point.at.x - point.at.y, point.at);
  foot = weights.x * a.position + weights.y * b.position + weights.z * c.position;
  vec3 normal = weights.x * decodeNormal(unpackSnorm2x16(a.normal)) + weights.y * decodeNormal(unpackSnorm2x16(b.normal)) +
                weights.z * decodeNormal(unpackSnorm2x16(c.normal));
  vec3 face = cross(b.position - a.position, c.position - a.position);
  normal = dot(normal, normal) > 1e-12 ? normalize(normal) : face * inversesqrt(max(dot(face, face), 1e-30));
  vec3 edge = b.position - a.position;
  edge -= normal * dot(normal, edge);
  edge *= inversesqrt(max(dot(edge, edge), 1e-30));
  float size = sqrt(length(face));
  scale = size > 0.0 ? clamp(size / max(point.size, 1e-20), 1e-3, 1e3) : 0.0;
  float hand = dot(face, normal) < 0.0 ? -1.0 : 1.0;  // mirrored triangles mirror what they carry
  return mat3(edge, hand * cross(normal, edge), normal);
}

struct Place {
  vec3 position, normal, axis;
  float scale;
};
Place placeOf(uint i) {
  StrokePoint point = points[i];
  vec3 normal = decodeNormal(unpackSnorm2x16(point.normal)), axis = decodeNormal(unpackSnorm2x16(point.axis));
  Place place;
  if (point.vertices.x == kUnbound) {
    mat4 matrix = matrices[point.object];
    place.position = (matrix * vec4(point.position, 1.0)).xyz;
    mat3 linear = mat3(matrix);
    place.scale = pow(abs(determinant(linear)), 1.0 / 3.0);
    // As if it only turned: a brush's own direction does not bend with what it paints.
    place.normal = linear * normal;
    place.axis = linear * axis;
  } else {
    vec3 foot;
    mat3 axes = frameOf(point, foot, place.scale);
    place.position = foot + place.scale * (axes * point.position);
    place.normal = axes * normal;
    place.axis = axes * axis;
  }
  return place;
}

void main() {
  uint i = (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * kPaintingThreads + gl_LocalInvocationID.x;
  if (i >= count) return;
  Place here = placeOf(i);
  uint flags = points[i].flags;
  vec3 before = (flags & kFirstOfStroke) != 0u ? here.position : placeOf(i - 1u).position;
  vec3 after = (flags & kLastOfStroke) != 0u ? here.position : placeOf(i + 1u).position;
  vec3 tangent = int(flags >> 8 & 255u) == kGaussian ? here.axis : after - before;
  float size = dot(tangent, tangent);
  placed[i] = PlacedPoint(here.position, points[i].radius * here.scale * u.width,
                          size > 1e-30 ? tangent * inversesqrt(size) : vec3(1.0, 0.0, 0.0),
                          encodeNormal(dot(here.normal, here.normal) > 1e-30 ? here.normal : vec3(0.0, 0.0, 1.0)));
}
