// Darkness around what is looked at while hands move somebody: what passes by at the edges is what makes
// sick. The runtime draws it over the frame, as a picture that goes with the head, so that frames know
// nothing of it.
#pragma once

#include <optional>

#include "scumble/vulkan.h"
#include "xr/instance.h"
#include "xr/upload.h"

namespace scumble::xr {

// How dark it is at an angle from where the head looks, by its tangent; `strength` as Vignette::layer has it.
float darknessAt(float tangent, float strength);

class Vignette {
 public:
  // In a format that frames are shown in. Throws XrFailure, as all calls here do.
  Vignette(const Instance& instance, XrSession session, const VulkanDevice& device, VkFormat format);
  ~Vignette();
  Vignette(const Vignette&) = delete;
  Vignette& operator=(const Vignette&) = delete;

  // Over a frame. At 1 what lies within 25 degrees is free, and all black from 45 on; towards 0 it opens, and
  // at 0 there is none.
  std::optional<XrCompositionLayerQuad> layer(float strength) const;

 private:
  const Functions& call_;
  StillPicture picture_;
  XrSpace head_ = XR_NULL_HANDLE;
};

}  // namespace scumble::xr
