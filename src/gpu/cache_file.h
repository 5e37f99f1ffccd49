// What was found out about a driver, on disk: its compiled pipelines, and how it draws views. Such a file
// only saves time: whatever is wrong with it, or with the place where it would be, counts as having none.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace scumble::gpu {

// One file for each kind and driver build: a driver refuses foreign data, the name only keeps them apart.
std::string cacheFile(const std::string& folder, const std::string& kind,
                      const VkPhysicalDeviceProperties& properties);

// What writeCache has written, to the byte; empty otherwise. Drivers may trust what they are given.
std::vector<char> readCache(const std::string& file);

// Makes the folder where it is missing. Only an ordinary file is ever replaced. False where it cannot be
// written.
bool writeCache(const std::string& file, const std::vector<char>& data);

}  // namespace scumble::gpu
