// An image pass: one function of a pixel and a layer, run as a full-screen fragment shader or as a compute
// shader, whichever the configuration says (CPU drivers are faster with the first, some servers' GPUs with
// the second).
#pragma once

#include <map>

#include "frame/pass.h"

namespace scumble::frame {

struct ImageShader {
  gpu::Shader fragment, compute;
};

class ImageStep {
 public:
  struct Input {
    gpu::Handle image;
    bool linear = false;  // sampled between texels; else texelFetch only (of multisampled images: by sample)
  };
  // A texture that is none of the frame's images; bound after the inputs.
  struct Texture {
    const gpu::Image* image = nullptr;
    gpu::SamplerDesc sampler{};
  };
  // One run of the shader over the whole picture. Most steps have one job; where several share the pixels
  // among them, the shader has SHADES_SOME (src/shading/image_pass.glsl).
  struct Job {
    std::vector<uint32_t> constants;  // specialisation constants 0 to 2
    std::vector<Texture> textures;    // as many as were declared
  };
  // `outputs`: one image, or two of one size for shaders with SHADES_TWO; gives what they hold then.
  // `uniformBytes`: size of the step's uniform block (set 1, binding 0) for each job; 0 where the shader has
  // none.
  std::vector<gpu::Handle> declare(FrameBuilder& frame, const std::string& name, ImageShader shader,
                                   std::vector<Input> inputs, std::vector<gpu::Handle> outputs,
                                   uint64_t uniformBytes, std::vector<uint32_t> constants = {},
                                   uint32_t textureCount = 0, uint32_t maxJobs = 1);
  // Steps without textures have their one job from here on; others need setJobs before their first frame.
  void create(FrameBuilder& frame);
  void bind(const gpu::GraphResources& resources);
  void setJobs(const std::vector<Job>& jobs);
  template <class T>
  void update(const T& uniforms, size_t job = 0) {
    std::memcpy(uniforms_.mapped + job * uniformStride_, &uniforms, sizeof(T));
  }

 private:
  const gpu::Pipeline& pipelineFor(const std::vector<uint32_t>& constants);
  void record(VkCommandBuffer commands) const;

  ImageShader shader_;
  std::vector<Input> inputs_;
  std::vector<uint32_t> constants_;
  std::vector<gpu::Handle> outputs_;
  UniformSlice uniforms_;
  uint64_t uniformStride_ = 0;
  uint32_t textureCount_ = 0, maxJobs_ = 1;
  bool compute_ = false;
  Configuration configuration_;
  FrameBuilder* frame_ = nullptr;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout inputLayout_, outputLayout_;
  gpu::DescriptorSets inputSets_, outputSet_;
  std::map<std::vector<uint32_t>, gpu::Pipeline> pipelines_;
  std::vector<const gpu::Pipeline*> jobs_;
};

}  // namespace scumble::frame
