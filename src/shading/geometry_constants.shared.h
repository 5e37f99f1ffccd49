// What pipelines of geometry steps are specialised to, each by a constant of its own (constant_id).
#ifndef SCUMBLE_GEOMETRY_CONSTANTS_SHARED_H
#define SCUMBLE_GEOMETRY_CONSTANTS_SHARED_H
#include "shared_types.h"

SHARED_BEGIN
const int kAlphaModeId = 0;  // 0 opaque, 1 masked, 2 blended, kCut
const int kVariedId = 1;     // vertex colours or textures vary the material's colour
const int kTexturedId = 2;   // the scene's textures are read
const int kViewCountId = 3;  // views that are drawn together; image steps have it as well
const int kPassId = 4;       // the pass's own
const int kColorSetsId = 5;  // sets of colours that the material has: 1 for light, 2 for shadow
const int kFeaturesId = 6;   // MetaTexture.features of what is laid on the material
const int kTangentsId = 7;   // how that counts: surface_tangents.shared.h
const int kMaterialId = 8;   // the pass's own of the material
const int kGroupId = 9;      // of blended surfaces: which are drawn; -1: all are
const int kSlotsId = 10;     // of blended surfaces: textures that there are
const int kFadesId = 11;     // of blended surfaces: some of them fade
const int kGeometryConstants = 12;

const int kCut = 3;  // opaque, with holes where volumes cut it (cutouts.glsl)
SHARED_END
#endif
