#include "renderer/gpu_list.h"

namespace scumble {

namespace renderer {

GpuInfo toPublic(const gpu::DeviceInfo& info) {
  GpuInfo result;
  result.name = info.name;
  result.driver = info.driver;
  result.apiVersion = std::to_string(VK_API_VERSION_MAJOR(info.apiVersion)) + "." +
                      std::to_string(VK_API_VERSION_MINOR(info.apiVersion)) + "." +
                      std::to_string(VK_API_VERSION_PATCH(info.apiVersion));
  result.isCpu = info.isCpu;
  result.unusableBecause = info.unusableBecause;
  return result;
}

}  // namespace renderer

using renderer::toPublic;

namespace {

// Sentences on what the device does not do as it should.
std::vector<std::string> workaroundsFor(gpu::Device& device) {
  std::vector<std::string> sentences;
  for (const uint32_t samples : {1u, 4u}) {
    if (samples == 4 && !device.supports4Samples()) {
      sentences.push_back("it has no 4 samples a pixel: use --samples 1");
      continue;
    }
    const std::string text = gpu::aboutViewDrawing(samples, device.viewDrawing(samples));
    if (!text.empty()) sentences.push_back(text);
  }
  return sentences;
}

}  // namespace

Result<std::vector<GpuInfo>> listGpus(const std::string& choice, const std::string& cacheFolder) {
  const Result<std::vector<gpu::DeviceInfo>> devices = gpu::listDevices();
  if (!devices) return devices.error();
  std::vector<GpuInfo> gpus;
  for (const gpu::DeviceInfo& device : *devices) gpus.push_back(toPublic(device));
  const Result<size_t> chosen = gpu::chooseDevice(*devices, choice);
  if (chosen) gpus[*chosen].wouldBeUsed = true;
  if (!chosen && !choice.empty()) return chosen.error();
  for (size_t i = 0; i < gpus.size(); ++i) {
    if (!gpus[i].unusableBecause.empty()) continue;
    gpu::DeviceOptions options;
    options.choice = std::to_string(i);
    options.cacheFolder = cacheFolder;
    const Result<std::unique_ptr<gpu::Device>> device = gpu::Device::create(options);
    if (!device) {
      gpus[i].unusableBecause = device.error().problem;
      continue;
    }
    try {
      gpus[i].workarounds = workaroundsFor(**device);
    } catch (const gpu::VulkanError& error) {
      gpus[i].unusableBecause = error.message();
    }
  }
  return gpus;
}

}  // namespace scumble
