#ifndef SCUMBLE_INK_SHARED_H
#define SCUMBLE_INK_SHARED_H
#include "edges.shared.h"

SHARED_BEGIN

// Kinds of lines, from the one that counts most where an edge is of several.
const int kInkNone = -1, kInkSilhouette = 0, kInkBoundary = 1, kInkMaterial = 2, kInkCrease = 3,
          kInkColor = 4;
const int kInkKinds = 5;

struct InkKind {
  uint shown;
  float width;  // a factor
  vec3 color;   // square root
  float colorAmount;
};

// Choices of ink.params.
const int kInkPixels = 0, kInkMetres = 1, kInkDegrees = 2;
const int kInkByEdge = 0, kInkByVertex = 1, kInkByTangent = 2, kInkHybrid = 3;
const int kInkExterior = 0, kInkCentred = 1;

// Of a material's lines.
struct InkLine {
  float width;  // a factor
  vec3 color;   // square root
  float ownColor;
  uint isSingle;  // 1: back faces are not seen
};

struct InkUniforms {
  // Where each view is seen from: xyz - w * p points from p to there. Both the same where one view between
  // them decides.
  vec4 eyes[2];
  int eyeCount;  // that differ
  float least, greatest;
  int unit, weights, placement;
  float offset;  // pixels
  float cosSmooth, cosCrease;
  float fade;   // widths
  float outer;  // a factor
  InkKind kinds[kInkKinds];
};

// Set 1 of what finds lines and what draws them.
const int kInkBlock = 0, kInkEdges = 1, kInkChunks = 2, kInkVertices = 3, kInkWords = 4, kInkSums = 5,
          kInkNumbers = 6, kInkCommand = 7, kInkFrames = 8, kInkLines = 9, kInkRecords = 10, kInkDepth = 11;
const int kInkBindings = 12;
// Set 2 of what draws them.
const int kInkShadowed = 0;

// What draws lines, as VkDrawIndirectCommand has it, and what makes their records, as
// VkDispatchIndirectCommand has it.
struct InkCommand {
  uint vertexCount, instanceCount, firstVertex, firstInstance;
  uint groupsX, groupsY, groupsZ;
};

// A line in a view.
struct LineRecord {
  vec4 spine;     // both ends of the edge, pixels
  vec4 shift;     // where lines move that lie beside it, for each pixel; at both ends
  vec4 radii;     // at both ends, pixels; depth-buffer values there
  vec4 color;     // square root; how much is the surface's own
  vec3 outward;   // unit, on the screen; 1: an outline
  vec2 caps;      // how far it goes on beyond both ends, for each pixel of its width
  vec2 fullness;  // factors on radii at both ends; below 0: each pixel finds its own
  uint isDrawn;
};
const int kInkRoom = 65536;  // for records of a view

const int kInkThreads = 32;  // a word of bits, one edge each
const int kInkWordsOfChunk = kEdgeChunk / kInkThreads;

SHARED_END
#endif
