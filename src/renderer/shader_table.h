// All shaders of the library by their names, and others in their place.
#pragma once

#include <span>
#include <string>

#include "gpu/device.h"

namespace scumble::renderer {

struct NamedShader {
  const char* name;  // of its source's file, with '_' for dots: "blur_image_frag"
  std::span<const uint32_t> words;
};

// Defined by the build, which knows them.
std::span<const NamedShader> shaderTable();

// Of the files NAME.spv in a folder those that are the name of a shader. Fails with unusableFile where the
// folder cannot be read, or such a file is no SPIR-V.
Result<gpu::ShaderReplacements> readShaders(const std::string& folder);

}  // namespace scumble::renderer
