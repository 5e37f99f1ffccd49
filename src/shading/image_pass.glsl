// An image pass is one function, vec4 shade(ivec2 pixel, int layer). This wrapper makes it a full-screen fragment
// shader or, with SCUMBLE_COMPUTE defined, a compute shader; the build compiles both. A pass that writes another format
// than rgba16f defines OUTPUT_FORMAT; one whose jobs share the pixels among them defines SHADES_SOME and
// bool shades(ivec2 pixel, int layer); one that writes two images defines SHADES_TWO, and instead of shade()
// void shadeTwo(ivec2 pixel, int layer, out vec4 first, out vec4 second). One that runs on some tiles (tiles.shared.h)
// defines SHADES_TILES.
#ifndef SHADES_SOME
bool shades(ivec2 pixel, int layer) { return true; }
#endif

#ifdef SCUMBLE_COMPUTE

#ifndef OUTPUT_FORMAT
#define OUTPUT_FORMAT rgba16f
#endif
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 2, binding = 0, OUTPUT_FORMAT) writeonly uniform image2DArray outputImage;
#ifdef SHADES_TWO
layout(set = 2, binding = 1, OUTPUT_FORMAT) writeonly uniform image2DArray secondImage;
#endif
#ifdef SHADES_TILES
#include "tiles.glsl"
layout(set = 3, binding = 0) uniform sampler2DArray tiles;
#endif

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  int layer = int(gl_GlobalInvocationID.z);
#ifdef SHADES_TILES
  ivec2 tile = min(ivec2(vec2(pixel) * rule.pixels) / kTileSize, textureSize(tiles, 0).xy - 1);
  if (!runsOn(texelFetch(tiles, ivec3(tile, layer), 0))) return;
#endif
  // What lies beyond the picture's edge works along, since pixels may need each other.
  bool isInside = all(lessThan(pixel, imageSize(outputImage).xy));
  pixel = min(pixel, imageSize(outputImage).xy - 1);
  if (!shades(pixel, layer)) return;
#ifdef SHADES_TWO
  vec4 first, second;
  shadeTwo(pixel, layer, first, second);
  if (isInside) {
    imageStore(outputImage, ivec3(pixel, layer), first);
    imageStore(secondImage, ivec3(pixel, layer), second);
  }
#else
  vec4 result = shade(pixel, layer);
  if (isInside) imageStore(outputImage, ivec3(pixel, layer), result);
#endif
}

#else

#include "view_index.glsl"
layout(location = 0) out vec4 outputColor;
#ifdef SHADES_TWO
layout(location = 1) out vec4 secondColor;
#endif
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int layer = viewIndex();
  if (!shades(pixel, layer)) discard;
#ifdef SHADES_TWO
  shadeTwo(pixel, layer, outputColor, secondColor);
#else
  outputColor = shade(pixel, layer);
#endif
}

#endif
