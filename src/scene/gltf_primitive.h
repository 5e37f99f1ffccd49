// One primitive of a glTF mesh, read but not yet prepared.
#pragma once

#include "scene/gltf_import.h"

namespace scumble::scene {

// Without triangles when there is nothing in it to draw; a warning then says why.
Primitive readPrimitive(const GltfImport& import, const JsonView& json, ImportWarnings& warnings);

}  // namespace scumble::scene
