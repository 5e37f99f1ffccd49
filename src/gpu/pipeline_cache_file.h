// Compiled pipelines on disk. Such a file only saves time: whatever is wrong with it, or with the place where
// it would be, counts as having none, in silence.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace scumble::gpu {

// One file a driver build: a driver refuses foreign data, the name only keeps them apart.
std::string pipelineCacheFile(const std::string& folder, const VkPhysicalDeviceProperties& properties);

// What writePipelineCache has written, to the byte; empty otherwise. Drivers may trust what they are given.
std::vector<char> readPipelineCache(const std::string& file);

// Makes the folder where it is missing. Only an ordinary file is ever replaced, and nothing is written where
// `data` holds no pipelines, as that of Mesa's CPU driver does.
void writePipelineCache(const std::string& file, const std::vector<char>& data);

}  // namespace scumble::gpu
