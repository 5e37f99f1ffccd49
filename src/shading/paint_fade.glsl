// How much of a fin shows (paper 003, section 3.3; FORMULAS 18).
#ifndef SCUMBLE_PAINT_FADE_GLSL
#define SCUMBLE_PAINT_FADE_GLSL
#include "frame.glsl"
#include "way_to_viewer.glsl"

// The more it faces the viewer, the more there is. `fade`: where it begins to show and where all of it does; what does not
// fade has numbers that give 1.
float paintFade(vec2 fade, vec3 position, vec3 normal) {
  vec3 toViewer = wayToViewer(position);
  float faces = abs(dot(normal, toViewer)) * inversesqrt(max(dot(normal, normal) * dot(toViewer, toViewer), 1e-30));
  float t = clamp((1.0 - faces - fade.x) / (fade.y - fade.x), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Whether all eyes are behind a triangle.
bool isTurnedAway(vec3 positions[3], bool isMirrored) {
  vec3 front = cross(positions[1] - positions[0], positions[2] - positions[0]) * (isMirrored ? -1.0 : 1.0);
  float most = -1.0;
  for (int v = 0; v < kViewCount; ++v) {
    mat4 toEyeSpace = VIEW_FIELD(worldToEye, v);
    vec3 along = vec3(toEyeSpace[0][2], toEyeSpace[1][2], toEyeSpace[2][2]);
    most = max(most, dot(front, mix(VIEW_FIELD(eye, v) - positions[0], along, VIEW_FIELD(orthographic, v))));
  }
  return most < 0.0;
}

// Whether nothing of a triangle shows, whatever its normals are between its corners. The cosine of a mean of vectors is at
// most that of any two of them, divided by how short such means may be.
bool isFadedAway(float start, vec3 positions[3], vec3 normals[3]) {
  vec3 ways[3];
  for (int i = 0; i < 3; ++i) ways[i] = normalize(wayToViewer(positions[i]));
  float most = 0.0, normalsAlike = 1.0, waysAlike = 1.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      most = max(most, abs(dot(normals[i], ways[j])));
      normalsAlike = min(normalsAlike, dot(normals[i], normals[j]));
      waysAlike = min(waysAlike, dot(ways[i], ways[j]));
    }
  float shortest = sqrt(max(1.0 + 2.0 * normalsAlike, 0.0) * max(1.0 + 2.0 * waysAlike, 0.0)) / 3.0;
  return most < (1.0 - start) * shortest;
}
#endif
