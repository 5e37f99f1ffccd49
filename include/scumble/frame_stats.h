// What a frame took, as a value of its own. Times are in milliseconds; those of the GPU are its own, from
// timestamps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scumble {

struct PassTime {
  std::string name;
  double milliseconds = 0;  // on the GPU
  // Of the frame's images that it reads and writes, each once and as a whole: what goes to and from memory
  // where caches hold what is near, and no tile is left out. Vertices and textures are not counted.
  uint64_t bytesRead = 0, bytesWritten = 0;
  // Texels that image passes take where they do all that they can, which on tiles is seldom; a filter takes
  // four.
  uint64_t fetches = 0;
};

struct FrameStats {
  std::vector<PassTime> passes;  // in order; empty where the device has no timestamps
  double gpuMilliseconds = 0;    // first to last timestamp
  double cpuMilliseconds = 0;    // poses, uniforms, passes' updates, recording; beside the GPU's work
  double readbackMilliseconds = 0;
  double uploadMilliseconds = 0;  // building the scene's GPU data; next to 0 once it is there
  double setupMilliseconds = 0;   // images and pipelines; next to 0 once they are there
  // That were compiled for this frame: 0 once they are there, see Renderer::prepare().
  uint32_t pipelines = 0;
  // What of the scene was written to the device for this frame, since it was not there or is another one now:
  // parts of meshes, textures, materials' links to textures. Without changes of the scene 0 once they are
  // there, whatever moves.
  uint32_t writtenPrimitives = 0, writtenTextures = 0, writtenMaterials = 0;
  // What the scene has to draw, whether a view sees it or not; the device is told in fewer calls.
  uint64_t triangles = 0, drawCalls = 0;
  uint64_t deviceBytes = 0, uploadedBytes = 0;
  // Of the frame's own images, those that live at different times in the same memory; and what they would
  // take without that.
  uint64_t imageBytes = 0, imageBytesUnshared = 0;
};

}  // namespace scumble
