#ifndef SCUMBLE_INK_SHARED_H
#define SCUMBLE_INK_SHARED_H
#include "edges.shared.h"

SHARED_BEGIN

// Kinds of lines, from the one that counts most where an edge is of several.
const int kInkNone = -1, kInkSilhouette = 0, kInkBoundary = 1, kInkMaterial = 2, kInkCrease = 3,
          kInkColor = 4;
const int kInkKinds = 5;
const int kInkTurned = 16;  // a bit beside the kind: its surface is seen from behind, where it is not drawn

struct InkKind {
  float width;  // a factor
  vec3 color;   // square root
  float colorAmount;
};

// Choices of ink.params, which are bits of a specialisation constant (ink_choices.glsl): what a uniform
// decides CPU drivers compile anew for each of its values.
const int kInkUnitBit = 0, kInkWeightsBit = 2, kInkPlacementBit = 4, kInkCyclopeanBit = 5, kInkKindsBit = 6,
          kInkDoubledBit = 16, kInkTextureBit = 17, kInkLampsBit = 19, kInkBreaksBit = 20, kInkHiddenBit = 21,
          kInkCoversBit = 22;
const int kInkPixels = 0, kInkMetres = 1, kInkDegrees = 2;
const int kInkByEdge = 0, kInkByVertex = 1, kInkByTangent = 2, kInkHybrid = 3;
const int kInkExterior = 0, kInkCentred = 1;
const int kInkPlain = 0, kInkBrush = 1, kInkPencil = 2, kInkBallpoint = 3;

// Of a material's lines.
struct InkLine {
  float width;  // a factor
  vec3 color;   // square root
  float ownColor;
  uint isSingle;  // 1: back faces are not seen
  // The outline that the file gives it: its width, and in which unit (kInkPixels: in pictures' heights).
  uint hasOutline, outlineUnit;
  float outlineWidth;
  vec3 outlineColor;  // square root
  float outlineLight;
};

// Where edges and vertices lie, which may be more than a device binds at once (gpu::Buffer::address).
struct InkAddresses {
  uvec2 edges, rings;            // DrawnEdge, EdgeRing of the same ones
  uvec2 vertices, frames, rest;  // VertexCore, VertexFrame of final ones; VertexCore of those at rest
};

struct InkUniforms {
  InkAddresses addresses;
  float least, greatest;
  vec4 keyLight;  // stage::keyLight()
  float offset;   // pixels
  float overlap;  // how far outlines that lie outside of their form reach into it, pixels
  float doubled;  // pixels
  float doubledWidth;
  float cosSmooth;
  float cosCrease, cosCreaseFull;  // where a crease begins to be a line, and where it has its width
  float fade;                      // widths
  float sinFadeAngle;
  float outer;                 // a factor
  float texture, textureSize;  // how much of it; pixels of one period
  float hidden, hiddenDash;    // of lines that something hides: factor on the width; pixels of one dash
  vec2 depthAt;                // where in a pixel its depth is that of what is seen there
  InkKind kinds[kInkKinds];
};

// Set 1 of what finds lines and what draws them.
const int kInkBlock = 0, kInkChunks = 1, kInkWords = 2, kInkSums = 3, kInkNumbers = 4, kInkCommand = 5,
          kInkLines = 6, kInkRecords = 7, kInkBounds = 8;
const int kInkBindings = 9;
// Set 2 of what draws them. (What comes before that looks at no image: llvmpipe would compile it anew in each
// frame.)
const int kInkDepth = 0, kInkShadowed = 1, kInkNearest = 2;  // the last one: of lines that cover others

// What draws lines, as VkDrawIndirectCommand has it, and what makes their records, as
// VkDispatchIndirectCommand has it.
struct InkCommand {
  uint vertexCount, instanceCount, firstVertex, firstInstance;
  uint groupsX, groupsY, groupsZ;
};

// A line in a view.
struct LineRecord {
  vec4 spine;    // both ends of the edge, pixels
  vec4 shift;    // where lines move that lie beside it, for each pixel; at both ends
  vec4 radii;    // at both ends, pixels; depth-buffer values there
  vec4 color;    // square root; how much is the surface's own, or, below 0, is multiplied by that
  vec3 outward;  // unit, on the screen; 1: an outline
  // Change of inkLinear() by a pixel to the right, and by one down, of the edge's surface before it (against
  // `outward`; x, y), and beyond it.
  vec4 slopes;
  // Of outlines: how much the form turns away behind it, from 0 to 1; what part of its width it has in any
  // case, as the inner line that it is besides.
  vec2 turn;
  vec2 reach;  // from where to where along it, 0 to 1, an outline is drawn
  vec2 caps;   // how far it goes on beyond both ends, for each pixel of its width
  int kind;    // kInkNone: it is not drawn
  uint seen;   // parts of it beside a surface, as EdgeRing has them
};
const int kInkRoom = 65536;  // for records of a view

// Lines of a view for the CPU, as an image of 32-bit floats: line n takes kLineTexels texels, one below the
// other, in column n % kLineTableWidth. Below all of them is a row that says what they are drawn with.
//   0, 1: spine, shift, as LineRecord has them    2: radii, metres along the view axis at both ends
//   3: color    4: outward; 1 + kind, so that 0 is no line    5: turn, reach    6: lower and upper half of
//   seen    7: slopes
const int kLineTexels = 8, kLineTableWidth = 4096, kLineTableRows = 64;
const int kLineTableRoom = kLineTableWidth * kLineTableRows;
// Of that row: how many lines there are, also beyond the room; pixels of one knob pixel, scene's radius,
// whether the view is a parallel projection.
// Then: metres that a pixel covers at one metre; fade, outer, overlap, as InkUniforms has them.
// Then: offset, doubled (pixels; 0: there is no second line), doubledWidth, placement.

// Set 2 of what makes it.
const int kLineTableImage = 0;

const int kInkThreads = 32;  // a word of bits, one edge each
const int kInkWordsOfChunk = kEdgeChunk / kInkThreads;

SHARED_END
#endif
