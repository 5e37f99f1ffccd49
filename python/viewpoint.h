// Where the camera stands, as Python says it.
#pragma once

#include <pybind11/pybind11.h>

#include "scumble/view.h"

namespace scumble_python {

// A dict of camera, frame, orbit, turntable, eye, target, roll and fov; what is None or not there is not
// said.
scumble::Viewpoint toViewpoint(const pybind11::dict& settings);

}  // namespace scumble_python
