// A session with a headset: when it wants frames, from where they are seen, and the images that they go into.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "xr/eye_images.h"
#include "xr/hands.h"
#include "xr/instance.h"
#include "xr/place.h"
#include "xr/pointer.h"
#include "xr/synthesis.h"
#include "xr/vignette.h"

namespace scumble::xr {

struct SessionOptions {
  bool isStanding = false;    // places are from the floor's middle; else from where the head was first
  float refreshRate = 0;      // frames a second that are wished for; 0: as the runtime has it
  bool hasVignette = true;    // end() may darken what lies around
  bool hasSynthesis = false;  // it is told what frame synthesis takes, where it can do that
};

struct Eye {
  Pose pose;  // in the room
  XrFovf angles{};
};

// A frame that was begun.
struct Moment {
  XrTime display = 0;         // when it will be seen, on the runtime's clock, nanoseconds
  double period = 0;          // to the next one, milliseconds; 0: the runtime does not tell
  bool shouldRender = false;  // else nobody sees it
  bool isPlaced = false;      // where the eyes are is known
  // The left and the right one; of headsets with four views those two again, as insets of them: the middle of
  // what they see, finer. None where it is not known.
  std::vector<Eye> eyes;
};

// What there is of a frame that was drawn.
struct DrawnEyes {
  std::vector<glm::uvec2>
      sizes;            // of each pair of eyes, pixels, from the upper left corner of what was acquired
  float nearPlane = 0;  // metres of the room: where the depth buffer is 1; it is 0 endlessly far away
  std::optional<SynthesisMoment> synthesis;  // images for it were acquired
  float darkness = 0;                        // as Vignette::layer has it
  std::vector<Ray> rays;                     // over what was drawn
};

// What has happened since the last look.
constexpr XrTime kNever = std::numeric_limits<XrTime>::max();
struct News {
  XrTime recentredAt = kNever;  // from frames on that are seen then, the room's origin is another
};

class Session {
 public:
  // On the device that Instance::vulkan() has made. Throws XrFailure, as all calls here do.
  Session(const Instance& instance, const VulkanDevice& device, const SessionOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Follows what the runtime says, begins and ends the session as it wants.
  News follow();
  bool isRunning() const { return isRunning_; }  // frames are begun and ended
  bool isFocused() const { return state_ == XR_SESSION_STATE_FOCUSED; }
  bool isWorn() const { return isWorn_; }  // as far as the runtime tells
  bool isOver() const { return isOver_; }  // the runtime, or requestEnd(), has ended it
  bool isLost() const { return isLost_; }  // another one may be made
  // Asks for its end, which comes by follow().
  void requestEnd();

  // Waits for the runtime's pace, and begins a frame, which is ended in any case.
  Moment begin();
  // The eyes at that moment, as the runtime knows by now.
  bool locate(Moment& moment) const;
  // What hands say, once a frame.
  HandsState hands(const Moment& moment) { return hands_->follow(isFocused(), space_, moment.display); }
  // Images to draw into: of each eye, as targets of the first views; and their depth, where the runtime takes
  // that. With `synthesis`: motion and depth of the two views behind them as well. They are taken until
  // end().
  std::vector<VulkanTarget> acquire(bool synthesis);
  // Gives the images back outside of a frame.
  void release();
  // `drawn`: what was acquired is shown as seen from the moment's eyes; else nothing is.
  void end(const Moment& moment, const std::optional<DrawnEyes>& drawn);

  // Of the eyes of each pair, pixels, at most: of both eyes, and of their insets.
  std::vector<glm::uvec2> sizes() const;

  // Of an eye's motion for frame synthesis; none: there is none.
  glm::uvec2 motionSize() const { return synthesis_ ? synthesis_->size() : glm::uvec2(0); }
  float refreshRate() const { return refreshRate_; }  // frames a second; 0: the runtime does not tell

 private:
  void createSpace(bool isStanding);
  void chooseViews();
  void createImages(bool hasSynthesis);
  glm::uvec2 recommendedMotionSize() const;
  void chooseRefreshRate(float wished);
  void destroy();

  const Instance& instance_;
  const Functions& call_;
  XrSession session_ = XR_NULL_HANDLE;
  XrSpace space_ = XR_NULL_HANDLE;
  XrReferenceSpaceType spaceType_ = XR_REFERENCE_SPACE_TYPE_LOCAL;
  XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
  XrEnvironmentBlendMode blend_ = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  XrViewConfigurationType views_ = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  struct Pair {
    std::unique_ptr<EyeImages> pictures, depths;  // depths: null where the runtime does not take them
  };
  std::vector<Pair> pairs_;
  std::unique_ptr<Synthesis> synthesis_;  // null: likewise, or not wished
  std::unique_ptr<Hands> hands_;
  std::unique_ptr<Vignette> vignette_;
  std::unique_ptr<Pointer> pointer_;
  float refreshRate_ = 0;
  XrTime display_ = 0;  // of the frame that was begun
  bool isRunning_ = false, isWorn_ = true, isOver_ = false, isLost_ = false, isBegun_ = false;
};

}  // namespace scumble::xr
