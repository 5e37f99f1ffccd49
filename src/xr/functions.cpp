#include "xr/functions.h"

#include <dlfcn.h>

#include <cstdlib>

#include "xr/failure.h"

namespace scumble::xr {

Result<Functions> Functions::open() {
  // What it has to say is told by errors, in a line.
  setenv("XR_LOADER_DEBUG", "none", 0);
  void* const library = dlopen("libopenxr_loader.so.1", RTLD_NOW | RTLD_LOCAL);
  Functions functions;
  if (library)
    functions.find_ = reinterpret_cast<PFN_xrGetInstanceProcAddr>(dlsym(library, "xrGetInstanceProcAddr"));
  if (!functions.find_)
    return Error{ErrorKind::noUsableGpu,
                 "",
                 0,
                 "",
                 "OpenXR's loader (libopenxr_loader.so.1) is not installed",
                 "install the package libopenxr-loader1, and the runtime of a headset"};
#define SCUMBLE_XR_FIND(name) \
  functions.find_(XR_NULL_HANDLE, "xr" #name, reinterpret_cast<PFN_xrVoidFunction*>(&functions.name));
  SCUMBLE_XR_GLOBAL_FUNCTIONS(SCUMBLE_XR_FIND)
#undef SCUMBLE_XR_FIND
  if (!functions.EnumerateInstanceExtensionProperties || !functions.CreateInstance)
    return Error{ErrorKind::noUsableGpu, "", 0, "", "OpenXR's loader is broken", "install it again"};
  return functions;
}

void Functions::load(XrInstance instance) {
#define SCUMBLE_XR_FIND(name)                                                                        \
  must(find_(instance, "xr" #name, reinterpret_cast<PFN_xrVoidFunction*>(&this->name)), "xr" #name); \
  if (!this->name) throw XrFailure("xr" #name, XR_ERROR_FUNCTION_UNSUPPORTED);
  SCUMBLE_XR_FUNCTIONS(SCUMBLE_XR_FIND)
#undef SCUMBLE_XR_FIND
#define SCUMBLE_XR_FIND(name)                                                                     \
  if (XR_FAILED(find_(instance, "xr" #name, reinterpret_cast<PFN_xrVoidFunction*>(&this->name)))) \
    this->name = nullptr;
  SCUMBLE_XR_OPTIONAL_FUNCTIONS(SCUMBLE_XR_FIND)
#undef SCUMBLE_XR_FIND
}

}  // namespace scumble::xr
