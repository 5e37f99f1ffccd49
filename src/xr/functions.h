// OpenXR's functions that are used here.
#pragma once

#include <memory>

#include "scumble/result.h"
#include "xr/openxr.h"

namespace scumble::xr {

// Before there is an instance.
#define SCUMBLE_XR_GLOBAL_FUNCTIONS(F) F(EnumerateInstanceExtensionProperties) F(CreateInstance)

#define SCUMBLE_XR_FUNCTIONS(F)        \
  F(DestroyInstance)                   \
  F(GetInstanceProperties)             \
  F(PollEvent)                         \
  F(GetSystem)                         \
  F(GetSystemProperties)               \
  F(EnumerateViewConfigurations)       \
  F(EnumerateViewConfigurationViews)   \
  F(EnumerateEnvironmentBlendModes)    \
  F(CreateSession)                     \
  F(DestroySession)                    \
  F(BeginSession)                      \
  F(EndSession)                        \
  F(RequestExitSession)                \
  F(EnumerateReferenceSpaces)          \
  F(CreateReferenceSpace)              \
  F(DestroySpace)                      \
  F(EnumerateSwapchainFormats)         \
  F(CreateSwapchain)                   \
  F(DestroySwapchain)                  \
  F(EnumerateSwapchainImages)          \
  F(AcquireSwapchainImage)             \
  F(WaitSwapchainImage)                \
  F(ReleaseSwapchainImage)             \
  F(WaitFrame)                         \
  F(BeginFrame)                        \
  F(EndFrame)                          \
  F(LocateViews)                       \
  F(LocateSpace)                       \
  F(GetVulkanGraphicsRequirements2KHR) \
  F(CreateVulkanInstanceKHR)           \
  F(GetVulkanGraphicsDevice2KHR)       \
  F(CreateVulkanDeviceKHR)             \
  F(StringToPath)                      \
  F(CreateActionSet)                   \
  F(DestroyActionSet)                  \
  F(CreateAction)                      \
  F(CreateActionSpace)                 \
  F(SuggestInteractionProfileBindings) \
  F(AttachSessionActionSets)           \
  F(SyncActions)                       \
  F(GetActionStateBoolean)             \
  F(GetActionStateVector2f)

// Null where the runtime does not have their extension.
#define SCUMBLE_XR_OPTIONAL_FUNCTIONS(F) \
  F(EnumerateDisplayRefreshRatesFB)      \
  F(GetDisplayRefreshRateFB)             \
  F(RequestDisplayRefreshRateFB)

struct Functions {
#define SCUMBLE_XR_POINTER(name) PFN_xr##name name = nullptr;
  SCUMBLE_XR_GLOBAL_FUNCTIONS(SCUMBLE_XR_POINTER)
  SCUMBLE_XR_FUNCTIONS(SCUMBLE_XR_POINTER)
  SCUMBLE_XR_OPTIONAL_FUNCTIONS(SCUMBLE_XR_POINTER)
#undef SCUMBLE_XR_POINTER

  // From the loader, which stays open: runtimes have threads. Fails with noUsableGpu where it is not there.
  static Result<Functions> open();
  // Those of an instance. Throws XrFailure.
  void load(XrInstance instance);

 private:
  PFN_xrGetInstanceProcAddr find_ = nullptr;
};

}  // namespace scumble::xr
