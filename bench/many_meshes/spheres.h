// Smooth balls, which need fewer triangles the smaller they are seen.
#pragma once

#include <cstddef>

#include "mesh_kit/document.h"

namespace spheres {

// So many different balls in rows, with about so many triangles in all; seen by the default view.
meshkit::Document makeSpheres(size_t triangles, size_t meshes);

}  // namespace spheres
