// Dispatches of any number of workgroups.
#pragma once

#include <algorithm>

#include "gpu/vulkan.h"

namespace scumble::gpu {

// Along x as many as every device allows, then along y, so that there may be a few too many. A shader's own
// is gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x.
inline void dispatch(VkCommandBuffer commands, uint32_t groups) {
  constexpr uint32_t kMostX = 32768;
  const uint32_t x = std::min(groups, kMostX);
  if (x > 0) vkCmdDispatch(commands, x, (groups + x - 1) / x, 1);
}

}  // namespace scumble::gpu
