// An image pass: one function of a pixel and a layer, run as a full-screen fragment shader or as a compute
// shader, whichever the configuration says (CPU drivers are faster with the first, some servers' GPUs with
// the second).
#pragma once

#include "frame/pass.h"

namespace scumble::frame {

struct ImageShader {
  gpu::Shader fragment, compute;
};

class ImageStep {
 public:
  struct Input {
    gpu::ResourceId image;
    bool linear = false;  // sampled between texels; else texelFetch only
  };
  // A texture of the pass's own; bound after the inputs.
  struct Texture {
    const gpu::Image* image;
    gpu::SamplerDesc sampler;
  };
  // `uniformBytes`: size of the step's uniform block (set 1, binding 0); 0 where the shader has none.
  // `constants`: specialisation constants 0 to 2.
  void declare(FrameBuilder& frame, const std::string& name, ImageShader shader, std::vector<Input> inputs,
               gpu::ResourceId output, uint64_t uniformBytes, std::vector<Texture> textures = {},
               std::vector<uint32_t> constants = {});
  void create(FrameBuilder& frame, const FrameResources& resources);
  template <class T>
  void update(const T& uniforms) {
    uniforms_.write(uniforms);
  }

 private:
  void record(VkCommandBuffer commands) const;

  ImageShader shader_;
  std::vector<Input> inputs_;
  std::vector<Texture> textures_;
  std::vector<uint32_t> constants_;
  gpu::ResourceId output_ = 0;
  UniformSlice uniforms_;
  bool compute_ = false;
  Configuration configuration_;
  const FrameResources* resources_ = nullptr;
  gpu::SetLayout inputLayout_, outputLayout_;
  gpu::DescriptorSets inputSet_, outputSet_;
  gpu::Pipeline pipeline_;
};

}  // namespace scumble::frame
