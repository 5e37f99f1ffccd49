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
          kInkNumbers = 6, kInkCommand = 7, kInkFrames = 8;
const int kInkBindings = 9;
// Set 2 of what draws them.
const int kInkLines = 0, kInkDepth = 1, kInkShadowed = 2;

const int kInkThreads = 32;  // a word of bits, one edge each
const int kInkWordsOfChunk = kEdgeChunk / kInkThreads;

SHARED_END
#endif
