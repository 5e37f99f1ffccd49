// What each file of this folder adds to the module.
#pragma once

#include <pybind11/pybind11.h>

#include "calls.h"
#include "scumble/renderer.h"

namespace scumble_python {

using SingleRenderer = Single<scumble::Renderer>;

void addPictures(pybind11::module_& module);
void addLook(pybind11::module_& module);
void addScene(pybind11::module_& module);
void addEditor(pybind11::module_& module);
void addViews(pybind11::module_& module);
void addRenderer(pybind11::module_& module);
void addMeasure(pybind11::module_& module);

}  // namespace scumble_python
