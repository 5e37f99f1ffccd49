// The module `scumble._scumble`: what scumble/__init__.py is made of. Its functions are described in
// scumble/_scumble.pyi.
#include "bindings.h"
#include "calls.h"
#include "scumble/version.h"

PYBIND11_MODULE(_scumble, module) {
  using namespace scumble_python;
  module.attr("__version__") = SCUMBLE_VERSION_STRING;
  Running::addTo(module);
  addPictures(module);
  addLook(module);
  addScene(module);
  addEditor(module);
  addViews(module);
  addRenderer(module);
  addMeasure(module);
}
