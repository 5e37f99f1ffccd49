// Calls of OpenXR that fail. Thrown inside of this room; its face gives errors.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "scumble/result.h"
#include "xr/openxr.h"

namespace scumble::xr {

class XrFailure : public std::runtime_error {
 public:
  XrFailure(const char* call, XrResult result);
  XrResult result() const { return result_; }
  // The session, or the runtime, is gone: nothing else can be tried.
  bool isLoss() const { return result_ == XR_ERROR_INSTANCE_LOST || result_ == XR_ERROR_SESSION_LOST; }

 private:
  XrResult result_;
};

// Throws where it has failed; gives what it succeeded with (XR_TIMEOUT_EXPIRED and the like).
XrResult must(XrResult result, const char* call);

// What somebody can do about it.
Error errorOf(const XrFailure& failure);

// How OpenXR lists: how many there are, then the things themselves.
template <class T, class List>
std::vector<T> listed(const char* call, const List& list, const T& blank = {}) {
  uint32_t count = 0;
  must(list(0, &count, static_cast<T*>(nullptr)), call);
  std::vector<T> all(count, blank);
  if (count > 0) must(list(count, &count, all.data()), call);
  all.resize(count, blank);
  return all;
}

}  // namespace scumble::xr
