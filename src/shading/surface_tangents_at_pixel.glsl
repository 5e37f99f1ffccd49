// The fragment half of surface_tangents.glsl.
#ifndef SCUMBLE_SURFACE_TANGENTS_AT_PIXEL_GLSL
#define SCUMBLE_SURFACE_TANGENTS_AT_PIXEL_GLSL
#include "surface_tangents.glsl"

// Outside of branches. `point`: interpolated pointInTangentView; uv: for fragment gradients.
void surfaceTangents(int options, vec3 tangentU, vec3 tangentV, vec3 point, vec2 uv, int view,
                     out vec2 dSdu, out vec2 dSdv) {
  bool other = kViewCount > 1 && (options & kCyclopean) != 0;
  vec2 at = other ? point.xy / point.z : gl_FragCoord.xy - 0.5 * frame.imageSize;
  float nearness = other ? 1.0 / point.z : gl_FragCoord.w;
  vec2 uvByX = dFdx(uv), uvByY = dFdy(uv), atByX = dFdx(at), atByY = dFdy(at);
  dSdu = (tangentU.xy - at * tangentU.z) * nearness;
  dSdv = (tangentV.xy - at * tangentV.z) * nearness;
  if ((options & kFragmentGradients) != 0) {
    vec2 ownU, ownV;
    metaTextureFromDerivatives(uvByX, uvByY, ownU, ownV);
    dSdu = other ? atByX * ownU.x + atByY * ownU.y : ownU;
    dSdv = other ? atByX * ownV.x + atByY * ownV.y : ownV;
  }
  if ((options & (kRadial | kByAngle)) != 0) {
    vec4 toRay = other ? frame.cyclopeanNdcToEyeRay : VIEW_FIELD(ndcToEyeRay, view);
    vec2 ray = at / (0.5 * frame.imageSize) * toRay.xy + toRay.zw;
    if ((options & kByAngle) != 0) {
      // An angle covers 1 / cos as much of the plane across the way from its middle, and 1 / cos^2 along it.
      vec2 along = ray * vec2(1.0, sign(toRay.x * toRay.y));
      float far = sqrt(1.0 + dot(along, along)), less = 1.0 / (far * far * (1.0 + far));
      dSdu = dSdu / far - along * (dot(along, dSdu) * less);
      dSdv = dSdv / far - along * (dot(along, dSdv) * less);
      return;
    }
    // A scale that is divided by alpha is one that gradients times alpha choose, or tangents divided by it.
    float part = (options & kRadialInPart) != 0 ? radialPart(frame.cyclopeanNdcToEyeRay) : 1.0;
    float alpha = 1.0 + part * dot(ray, ray) * (1.0 - VIEW_FIELD(orthographic, view));
    dSdu /= alpha;
    dSdv /= alpha;
  }
}
#endif
