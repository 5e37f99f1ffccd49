// What all that places splats reads (set 1).
#include "../../shading/distance_key.glsl"
#include "../../shading/frame.glsl"
#include "../../shading/way_to_viewer.glsl"
#include "painting.shared.h"

layout(set = 1, binding = kPaintingBlock, scalar) uniform Block { PaintingUniforms u; };
layout(set = 1, binding = kPaintingPoints, scalar) readonly buffer Points { StrokePoint points[]; };
layout(set = 1, binding = kPaintingSplats, scalar) readonly buffer Splats { Splat splats[]; };

// How much a splat counts, from the middle between the eyes, so that both have the same.
float fadeOf(Splat splat, float radius, float metresOfOnePixel, float sine) {
  // What carries it is not seen where it has shrunk to a point.
  return radius <= 0.0 ? 0.0 : splatFade(splatsApart(u.spacing, metresOfOnePixel, radius), sine, splat.spacing);
}

// How a place on a stroke is seen from the middle between the eyes: the way there, unit length; how far it is, metres; and
// the sine of the angle between stroke and line of sight.
struct Sight {
  vec3 way;
  float away, sine;
};
Sight sightOf(vec3 position, vec3 along) {
  vec3 toViewer = wayToViewer(position);
  Sight sight;
  sight.away = length(toViewer);
  sight.way = toViewer / max(sight.away, 1e-30);
  sight.sine = length(cross(sight.way, along)) * inversesqrt(max(dot(along, along), 1e-12));
  return sight;
}
