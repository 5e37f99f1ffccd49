// What hands point with: a thin ray and a dot at its end, which the runtime draws over the frame, so that
// frames know nothing of them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "xr/instance.h"
#include "xr/upload.h"

namespace scumble::xr {

struct Ray {
  glm::vec3 from{0}, to{0};  // in the room, metres
};

class Pointer {
 public:
  // In a format that frames are shown in. Throws XrFailure, as all calls here do.
  Pointer(const Instance& instance, XrSession session, const VulkanDevice& device, VkFormat format);

  // For somebody whose head is there, in the room that the space is of.
  void addLayers(const Ray& ray, const glm::vec3& head, XrSpace space,
                 std::vector<XrCompositionLayerQuad>& layers) const;

 private:
  StillPicture picture_;
};

}  // namespace scumble::xr
