// One primitive of a glTF mesh, read but not yet prepared.
#pragma once

#include "gltf/import.h"

namespace scumble::gltf {

using namespace scene;

// Without triangles when there is nothing in it to draw; a warning then says why.
Primitive readPrimitive(const Import& import, const JsonView& json, ImportWarnings& warnings);

}  // namespace scumble::gltf
