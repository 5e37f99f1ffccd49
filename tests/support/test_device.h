// The device that tests draw on.
#pragma once

#include <cstdlib>
#include <string>

namespace scumble::test {

// What RendererOptions::device and DeviceOptions::choice are in tests: $SCUMBLE_TEST_DEVICE, or the best
// device.
inline std::string testDevice() {
  const char* device = std::getenv("SCUMBLE_TEST_DEVICE");
  return device ? device : "";
}

// Whether the device places vertices as finely as the tests' tolerances ask for: to 1/256 of a pixel, as CPU
// and desktop drivers do but for SwiftShader (1/16, the least that Vulkan allows).
bool rastersFinely();

// For tests that compare with rays or points at a tolerance that a coarser device cannot hold.
#define NEEDS_FINE_RASTER()              \
  if (!::scumble::test::rastersFinely()) \
  GTEST_SKIP() << "this device places vertices to less than 1/256 of a pixel"

}  // namespace scumble::test
