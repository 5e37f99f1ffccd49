#include "renderer/shader_table.h"

#include <cstring>
#include <filesystem>

#include "base/file_bytes.h"

namespace scumble::renderer {

namespace {

constexpr uint32_t kSpirvMagic = 0x07230203;
constexpr size_t kHeaderWords = 5;

Error unusable(const std::string& file, std::string problem) {
  return {ErrorKind::unusableFile, file, 0, "", std::move(problem), "let glslc write it"};
}

}  // namespace

Result<gpu::ShaderReplacements> readShaders(const std::string& folder) {
  gpu::ShaderReplacements replacements;
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) return unusable(folder, "there is no such folder");
  for (const NamedShader& shader : shaderTable()) {
    const std::string file = (std::filesystem::path(folder) / (std::string(shader.name) + ".spv")).string();
    if (!std::filesystem::exists(file, error)) continue;
    FileBytes bytes;
    std::string problem;
    if (!bytes.open(file, problem, FileAccess::read)) return unusable(file, problem);
    const auto all = bytes.bytes();
    std::vector<uint32_t> words(all.size() / 4);
    if (!words.empty()) std::memcpy(words.data(), all.data(), 4 * words.size());
    if (all.size() % 4 != 0 || words.size() <= kHeaderWords || words[0] != kSpirvMagic)
      return unusable(file, "this is no SPIR-V");
    replacements.emplace(shader.words.data(), std::move(words));
  }
  return replacements;
}

}  // namespace scumble::renderer
