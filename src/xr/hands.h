// What hands do with a headset's controllers: OpenXR's actions, for whatever controllers there are.
#pragma once

#include <array>
#include <optional>

#include "xr/instance.h"
#include "xr/walk.h"

namespace scumble::xr {

constexpr size_t kHands = 2;  // the left one first

// What one does at a frame.
struct Hand {
  std::optional<Pose> aim;             // where it points from, along its -z, in the room; none: nobody knows
  bool points = false, grabs = false;  // as long as it is held
  glm::vec2 stick{0};                  // -1 to 1, to the right and ahead
};

// What they say at a frame.
struct HandsState {
  Steering steering;
  bool pauses = false, nextLook = false;  // pressed since the frame before
  std::array<Hand, kHands> hands;
};

class Hands {
 public:
  // Actions of a session, with what controllers of several makers are to do. Throws XrFailure, as all calls
  // here do.
  Hands(const Instance& instance, XrSession session);
  ~Hands();
  Hands(const Hands&) = delete;
  Hands& operator=(const Hands&) = delete;

  // At a moment, in a room. Nothing while the session has no focus: others get the hands then.
  HandsState follow(bool isFocused, XrSpace room, XrTime time);

 private:
  void begin();
  void end();
  XrAction create(XrActionType type, const char* name, const char* text, bool isOfEach = false) const;
  void suggest() const;
  XrPath path(const char* text) const;
  glm::vec2 stick(XrAction action) const;
  XrActionStateBoolean button(XrAction action, XrPath hand = XR_NULL_PATH) const;
  bool isPressedNow(XrAction action) const;
  std::optional<Pose> aimOf(size_t hand, XrSpace room, XrTime time) const;

  const Instance& instance_;
  const Functions& call_;
  XrSession session_;
  XrActionSet set_ = XR_NULL_HANDLE;
  XrAction walk_ = XR_NULL_HANDLE, turn_ = XR_NULL_HANDLE, pause_ = XR_NULL_HANDLE, look_ = XR_NULL_HANDLE;
  XrAction aim_ = XR_NULL_HANDLE, point_ = XR_NULL_HANDLE, grab_ = XR_NULL_HANDLE;  // of each hand
  std::array<XrPath, kHands> paths_{};
  std::array<XrSpace, kHands> aims_{};
};

}  // namespace scumble::xr
