#include "xr/failure.h"

#include <openxr/openxr_reflection.h>

namespace scumble::xr {

namespace {

std::string nameOf(XrResult result) {
  switch (result) {
#define SCUMBLE_XR_NAME(name, value) \
  case name:                         \
    return #name;
    XR_LIST_ENUM_XrResult(SCUMBLE_XR_NAME)
#undef SCUMBLE_XR_NAME
  }
  return "XrResult " + std::to_string(int(result));
}

}  // namespace

XrFailure::XrFailure(const char* call, XrResult result)
    : std::runtime_error(std::string(call) + ": " + nameOf(result)), result_(result) {}

XrResult must(XrResult result, const char* call) {
  if (XR_FAILED(result)) throw XrFailure(call, result);
  return result;
}

Error errorOf(const XrFailure& failure) {
  const auto error = [&](const std::string& problem, const std::string& advice) {
    return Error{ErrorKind::noUsableGpu, "", 0, "", problem + " (" + failure.what() + ")", advice};
  };
  switch (failure.result()) {
    case XR_ERROR_RUNTIME_UNAVAILABLE:
    case XR_ERROR_FILE_ACCESS_ERROR:
    case XR_ERROR_FILE_CONTENTS_INVALID:
      return error("no OpenXR runtime is there",
                   "start the headset's runtime, or name its manifest in XR_RUNTIME_JSON");
    case XR_ERROR_FORM_FACTOR_UNAVAILABLE:
    case XR_ERROR_FORM_FACTOR_UNSUPPORTED:
      return error("the runtime has no headset", "plug it in and switch it on");
    case XR_ERROR_INSTANCE_LOST:
      return error("the runtime has ended", "start it again");
    case XR_ERROR_INITIALIZATION_FAILED:
    case XR_ERROR_LIMIT_REACHED:
      return error("the runtime cannot start", "see whether another program has the headset");
    case XR_ERROR_API_LAYER_NOT_PRESENT:
      return error("a layer of OpenXR that is asked for is not there", "see XR_ENABLE_API_LAYERS");
    default:
      return error("the headset's runtime has failed", "start it again");
  }
}

}  // namespace scumble::xr
