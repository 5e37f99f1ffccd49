// What measures full-screen passes beside each other in one run: options, device, timestamps, table and JSON.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "frame/pass.h"

namespace scumble::bench {

struct FullScreenCase {
  std::string name;
  // Binds its pipeline and sets, and draws three vertices.
  std::function<void(VkCommandBuffer)> draw;
  std::vector<double> milliseconds{};  // of each run
  double first = 0;                    // milliseconds of the first turn, which compiles
};

class FullScreen {
 public:
  // Reads --size, --runs, --device and --json, and opens the device. Ends the process where that cannot be
  // (2: usage, 4: no device with timestamps).
  FullScreen(const std::string& program, const std::string& description, int argc, char** argv);

  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  gpu::Device& device() { return *device_; }
  // What the cases draw to.
  static constexpr VkFormat kFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
  gpu::Pipeline pipeline(gpu::Shader fragment, std::vector<uint32_t> constants,
                         std::vector<VkDescriptorSetLayout> sets);

  // All cases take turns, so that what else the machine does falls on all of them. Prints the medians, and
  // the medians of the ratios to cases[yardstick]; returns the program's exit code.
  int run(std::vector<FullScreenCase> cases, size_t yardstick);

 private:
  double milliseconds(const FullScreenCase& one, const gpu::Image& target, VkQueryPool queries);

  std::string program_, json_;
  int runs_ = 31;
  uint32_t width_ = 0, height_ = 0;
  std::unique_ptr<gpu::Device> device_;
};

}  // namespace scumble::bench
