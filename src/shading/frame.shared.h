// What every pass knows of a frame (descriptor set 0): the views, the light, the objects and the materials.
#ifndef SCUMBLE_FRAME_SHARED_H
#define SCUMBLE_FRAME_SHARED_H
#include "shared_types.h"

SHARED_BEGIN

const int kMaxViews = 2;  // that are drawn together

struct ViewUniforms {
  mat4 worldToClip;          // reversed depth: 1 at the near plane, 0 at infinity; y down
  mat4 worldToEye;           // eye space: x right, y up, -z forward
  mat4 previousWorldToClip;  // one frame (1 / fps) earlier
  // x, y: eye-space (x/-z, y/-z) = ndc * xy + zw, for any, also off-centre, projection (FORMULAS 4)
  vec4 ndcToEyeRay;
  vec4 depthToEye;     // metres along the axis = (x + y d) / (z + w d) for a depth-buffer value d
  vec3 upInEye;        // the world's up in eye space
  vec3 eye;            // world
  float orthographic;  // 1 for a parallel projection, else 0
  // Pixels by which what is endlessly far lies aside from where the view between the eyes has it: what lies
  // on the screen is looked up from there, so that eyes that look out of the middle see it in one direction.
  vec2 aside;
};

struct FrameUniforms {
  ViewUniforms views[kMaxViews];
  mat4 worldToCyclopean;      // to the clip space of one view between both eyes; in mono that of the view
  vec4 cyclopeanNdcToEyeRay;  // as ViewUniforms has it
  vec3 viewer;                // the middle of all eyes, world
  mat4 worldToLight;  // x, y in [-1, 1] over everything that casts shadows; z in [0, 1], growing away from
                      // the light
  vec3 toLight;       // unit, world
  uint lightCount;    // point and spot lights: all that the buffer holds, or none
  float time;         // seconds
  vec2 shadowCenter;  // light-space x, y near the viewer, where the shadow map is finest
  vec2 shadowScale;   // coordinates in the map = scale * sigmoid(t) + even * t + shift with
                      // t = strength * (p - center), which go from 0 to 1 for p from -1 to 1
  float shadowEven;
  vec2 shadowShift;
  float shadowWarp;        // strength of the sigmoid, above 0
  float shadowTexel;       // size of a shadow-map texel in unwarped light space
  vec3 lightToWorldScale;  // metres per unit of light-space x, y, z
  float pixelScale;        // pixels per knob pixel: knobHeight / 1080
  vec2 imageSize;          // pixels
  float knobHeight;    // pixels: the picture's height, or what stands for it where that is a part of a sphere
  mat3 eyeToSphere;    // there: turns directions to the sphere's axes (RenderOptions::sphere)
  float sceneRadius;   // metres
  vec3 sceneCenter;    // world
  vec3 positionShift;  // metres: what makes of the world that of whom positions are told to
};

// A point or spot light (KHR_lights_punctual), without shadows of its own.
struct PunctualLight {
  vec3 position;                // world
  float strength;               // light on a surface that faces it, at 1 m; 1 is full light
  vec3 direction;               // unit, world: where a spot shines
  float inverseRangeSquared;    // 1 / square metres; 0: it reaches everywhere
  float coneScale, coneOffset;  // cosine to the axis -> 0 at the outer cone and 1 at the inner one
};

// One drawn instance of a primitive.
struct ObjectData {
  mat4 model;   // object to world
  mat3 normal;  // inverse transpose of its linear part, up to a positive factor
  uint material;
  uint id;                // from 1; the `id` AOV
  uint influences;        // joints a vertex: 0 (rigid), 4 or 8
  uint firstJoint;        // in the joint matrices
  uint firstMorphWeight;  // in the morph weights
  uint kind, detail;      // what it is to the feature that it belongs to; 0 where it belongs to none
  vec2 patternShift;      // added to pattern coordinates
  uint mirrored;          // 1 where matrices turn triangles inside out
  uint wraps;  // whether pattern coordinates close on themselves after one unit: 1 along u, 2 along v
};

// A chunk of vertices for `deform`: up to kDeformChunk vertices of one object.
const int kDeformChunk = 256;
struct DeformChunk {
  uint object;
  uint restVertex;   // first vertex in the rest buffers
  uint finalVertex;  // first vertex in the final buffers
  uint count;
  uint skinVertex;   // first entry in the skin buffer
  uint morphVertex;  // first entry in the list of where vertices' displacements begin; kNoMorph: none move
};
const uint kNoMorph = 0xFFFFFFFFu;

// A vertex as deform reads and writes it; two streams, so that depth-only passes fetch 16 bytes.
struct VertexCore {
  vec3 position;
  uint normal;  // octahedral, 2 x snorm16
};
struct VertexFrame {
  vec3 dPdu;          // metres per unit of u
  uint smoothNormal;  // octahedral
  vec3 dPdv;
};
// Four influences of a vertex.
struct VertexSkin {
  uvec2 joints;  // 4 x 16 bits
  vec4 weights;
};
// What one morph target does to one vertex at weight 1.
struct MorphDisplacement {
  uint target;
  vec3 position, normal, smoothNormal, dPdu, dPdv;
};
// What few vertices have, and never deforms.
struct VertexTint {
  uint color;       // unorm8 RGBA, linear
  float warpScale;  // factor on the amount of the warp
};

// Square root of a colour as a polynomial of the square root (r, g, b) of another; terms in the order
// 1, r, g, b, rr, gg, bb, rg, gb, br.
const int kColorMapTerms = 10;
struct ColorMap {
  vec3 terms[kColorMapTerms];
};

// A material's facts; its knobs lie in the passes' own uniforms.
struct MaterialData {
  vec4 baseColor;
  vec3 emissive;
  float alphaCutoff;
  // Where neither texture nor vertex colours vary the colour: square roots of what the surface pass writes,
  // in light, and in shadow for faces that look down and up.
  vec3 constantLit, constantShadowedDown, constantShadowedUp;
  float constantLens;      // luminance of what it emits
  ColorMap lit, shadowed;  // from albedo to the colours in light and in shadow (docs/palette.md)
  vec3 shadowedColor;      // the material's own; used where hasShadowedColor is 1
  float hasShadowedColor;
  ColorMap ownShadowed;         // grades the material's own set of colours for shadow, where it has one
  vec3 baseUvRowU, baseUvRowV;  // KHR_texture_transform: u' = dot(row, (u, v, 1))
  vec3 emissiveUvRowU, emissiveUvRowV;
  uint baseUvSet, emissiveUvSet;
  float unlit;            // 1: always in full light
  float blacks;           // colours of less luminance are in the light what they are in shadow
  vec3 tintDown, tintUp;  // square roots of factors on colours in shadow, for faces that look down and up
  vec3 planeSky, planeTurned;  // the same on colours in light, for planes that face the sky, or turn away
  float matte;                 // 1: not seen itself; what is behind everything takes its shadows
};

SHARED_END
#endif
