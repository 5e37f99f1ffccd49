// Devices as the public face describes them.
#pragma once

#include "gpu/device.h"
#include "scumble/renderer.h"

namespace scumble::renderer {

GpuInfo toPublic(const gpu::DeviceInfo& info);

}  // namespace scumble::renderer
