// What hands do with a headset's controllers: OpenXR's actions, for whatever controllers there are.
#pragma once

#include <array>
#include <optional>

#include "xr/instance.h"
#include "xr/walk.h"

namespace scumble::xr {

// What they say at a frame.
struct HandsState {
  Steering steering;
  bool pauses = false, nextLook = false;  // pressed since the frame before
};

class Hands {
 public:
  // Actions of a session, with what controllers of several makers are to do. Throws XrFailure, as all calls
  // here do.
  Hands(const Instance& instance, XrSession session);
  ~Hands();
  Hands(const Hands&) = delete;
  Hands& operator=(const Hands&) = delete;

  // Nothing while the session has no focus: others get the hands then.
  HandsState follow(bool isFocused);

 private:
  XrAction create(XrActionType type, const char* name, const char* text) const;
  void suggest() const;
  XrPath path(const char* text) const;
  glm::vec2 stick(XrAction action) const;
  bool isPressedNow(XrAction action) const;

  const Instance& instance_;
  const Functions& call_;
  XrSession session_;
  XrActionSet set_ = XR_NULL_HANDLE;
  XrAction walk_ = XR_NULL_HANDLE, turn_ = XR_NULL_HANDLE, pause_ = XR_NULL_HANDLE, look_ = XR_NULL_HANDLE;
};

}  // namespace scumble::xr
