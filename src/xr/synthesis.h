// Frames that the runtime makes between ours: it is told where everything was a frame before, and how far
// away it is (XR_EXT_frame_synthesis, or XR_FB_space_warp), so that half the rate looks whole.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "xr/eye_images.h"
#include "xr/instance.h"
#include "xr/place.h"

namespace scumble::xr {

// What a runtime is told of a frame beside its images.
struct SynthesisMoment {
  Pose room;  // where the room is now, as it was to be seen from the room of the frame before, metres
  bool isCut = false;   // what is seen has nothing to do with the frame before
  float nearPlane = 0;  // metres of the room
};

class Synthesis {
 public:
  // Null where the runtime cannot do it, or has no such images. `size`: as the runtime recommends. Throws
  // XrFailure where the session is lost.
  static std::unique_ptr<Synthesis> create(const Instance& instance, XrSession session, glm::uvec2 size,
                                           const std::vector<int64_t>& formats);

  glm::uvec2 size() const { return motion_.size(); }  // pixels of an eye's motion
  // Images for motion and depth of the views `firstView` and the one after it, which see what both eyes see.
  std::vector<VulkanTarget> acquire(size_t firstView);
  void release();
  // To be chained behind an eye's view of the frame, whose last structure `next` was; valid until the next
  // call for that eye.
  const void* chained(size_t eye, const SynthesisMoment& moment, const void* next);

 private:
  enum class Kind { ext, fb };
  Synthesis(const Instance& instance, XrSession session, glm::uvec2 size);

  const Kind kind_;
  // Which way y goes. XR_FB_space_warp takes it upwards, as OpenGL has it; XR_EXT_frame_synthesis says
  // Vulkan's way, and runtimes that have both extensions go the other one's.
  const bool isUpwards_;
  const bool canSkip_;  // it can be told that a frame is like none before
  EyeImages motion_, depth_;
  std::array<XrFrameSynthesisInfo, kEyes> ext_;
  std::array<XrCompositionLayerSpaceWarpInfoFB, kEyes> fb_;
};

}  // namespace scumble::xr
