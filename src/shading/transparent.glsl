// Instead of material.glsl, where blended surfaces of all materials are drawn at once: what elsewhere changes between
// draws is looked up by the vertex's part. Includers set materialIndex first.
#ifndef SCUMBLE_TRANSPARENT_GLSL
#define SCUMBLE_TRANSPARENT_GLSL
#include "paint_fade.glsl"
#include "transparent.shared.h"

layout(set = 1, binding = 0, scalar) readonly buffer MaterialRows { TransparentMaterial materialRows[]; };
layout(set = 1, binding = 1, scalar) readonly buffer PartRows { TransparentPart parts[]; };
layout(constant_id = kGroupId) const int kGroup = -1;  // which is drawn; -1: there is but one
layout(constant_id = kSlotsId) const int kSlots = 0;  // textures that the group has

layout(constant_id = kFadesId) const bool kFades = false;  // some materials are fins

const vec4 kNowhere = vec4(0.0, 0.0, 2.0, 1.0);  // outside of what is drawn

// Of TransparentPart.known.
uint materialOf(uint known) { return known >> 2; }
bool isVariedPart(uint known) { return (known & 2u) != 0; }

// Whether a vertex is of the group that is drawn.
bool isOfGroup(uint known) { return kGroup < 0 || materialRows[materialOf(known)].group == kGroup; }

uint materialIndex;
#define material materialRows[materialIndex].data

// Whether the front of the surface is seen; where its back is and has none, there is nothing.
bool seesFront(uint known, bool isFrontFacing) { return isFrontFacing != ((known & 1u) != 0); }
bool isCulled(bool seesFront) { return !seesFront && materialRows[materialIndex].single != 0; }

#ifdef TRANSPARENT_TEXTURES
layout(set = 1, binding = 2) uniform sampler2D slot0;
layout(set = 1, binding = 3) uniform sampler2D slot1;
layout(set = 1, binding = 4) uniform sampler2D slot2;
layout(set = 1, binding = 5) uniform sampler2D slot3;
layout(set = 1, binding = 6) uniform sampler2D slot4;
layout(set = 1, binding = 7) uniform sampler2D slot5;
layout(set = 1, binding = 8) uniform sampler2D slot6;
layout(set = 1, binding = 9) uniform sampler2D slot7;
layout(set = 1, binding = 10) uniform sampler2D slot8;
layout(set = 1, binding = 11) uniform sampler2D slot9;
layout(set = 1, binding = 12) uniform sampler2D slot10;
layout(set = 1, binding = 13) uniform sampler2D slot11;

// Those of four slots at a place, white where there is none. All pixels of a quad want the same ones, so that mip levels
// find their neighbours within the branches.
struct SlotValues {
  vec4 values[4];
};
SlotValues sampleSlots(ivec4 slots, vec2 uv, float bias) {
  SlotValues all = SlotValues(vec4[](vec4(1.0), vec4(1.0), vec4(1.0), vec4(1.0)));
#define SCUMBLE_SLOT(index, slot)                              \
  if (kSlots > index && any(equal(slots, ivec4(index)))) { \
    vec4 value = texture(slot, uv, bias); \
    if (slots.x == index) all.values[0] = value;               \
    if (slots.y == index) all.values[1] = value;               \
    if (slots.z == index) all.values[2] = value;               \
    if (slots.w == index) all.values[3] = value;               \
  }
  SCUMBLE_SLOT(0, slot0) SCUMBLE_SLOT(1, slot1) SCUMBLE_SLOT(2, slot2) SCUMBLE_SLOT(3, slot3)
  SCUMBLE_SLOT(4, slot4) SCUMBLE_SLOT(5, slot5) SCUMBLE_SLOT(6, slot6) SCUMBLE_SLOT(7, slot7)
  SCUMBLE_SLOT(8, slot8) SCUMBLE_SLOT(9, slot9) SCUMBLE_SLOT(10, slot10) SCUMBLE_SLOT(11, slot11)
#undef SCUMBLE_SLOT
  return all;
}
#endif
#endif
