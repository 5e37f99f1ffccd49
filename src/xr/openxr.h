// OpenXR with Vulkan, its functions by their pointers: the loader is opened when somebody wants a headset.
#pragma once

#define XR_NO_PROTOTYPES
#define XR_USE_GRAPHICS_API_VULKAN
// What openxr_platform.h is about comes before it.
// clang-format off
#include <vulkan/vulkan.h>
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
// clang-format on

// Of XR_EXT_user_presence, which is younger than the headers of Debian 12.
inline constexpr char kUserPresenceExtension[] = "XR_EXT_user_presence";
inline constexpr auto kTypeUserPresenceChanged = XrStructureType(1000470000);
struct XrEventDataUserPresenceChanged {
  XrStructureType type;
  const void* next;
  XrSession session;
  XrBool32 isUserPresent;
};

// Of XR_EXT_frame_synthesis, likewise.
inline constexpr char kFrameSynthesisExtension[] = "XR_EXT_frame_synthesis";
inline constexpr auto kTypeFrameSynthesisInfo = XrStructureType(1000211000);
inline constexpr auto kTypeFrameSynthesisConfigView = XrStructureType(1000211001);
struct XrFrameSynthesisInfo {
  XrStructureType type;
  const void* next;
  XrFlags64 layerFlags;
  XrSwapchainSubImage motionVectorSubImage;
  XrVector4f motionVectorScale, motionVectorOffset;
  XrPosef appSpaceDeltaPose;
  XrSwapchainSubImage depthSubImage;
  float minDepth, maxDepth, nearZ, farZ;
};
struct XrFrameSynthesisConfigView {
  XrStructureType type;
  void* next;
  uint32_t recommendedMotionVectorImageRectWidth, recommendedMotionVectorImageRectHeight;
};
