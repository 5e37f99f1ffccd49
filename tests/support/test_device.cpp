#include "tests/support/test_device.h"

#include <stdexcept>

#include "gpu/device.h"

namespace scumble::test {

bool rastersFinely() {
  static const bool finely = [] {
    gpu::DeviceOptions options;
    options.choice = testDevice();
    const auto device = gpu::Device::create(options);
    if (!device) throw std::runtime_error(device.error().message());
    return (*device)->limits().subPixelPrecisionBits >= 8;
  }();
  return finely;
}

}  // namespace scumble::test
