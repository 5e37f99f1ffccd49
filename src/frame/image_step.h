// An image pass: one function of a pixel and a layer, run as a full-screen fragment shader or as a compute
// shader, whichever the configuration says (CPU drivers are faster with the first, some servers' GPUs with
// the second).
#pragma once

#include <map>

#include "frame/pass.h"
#include "frame/tile_flags.h"

namespace scumble::frame {

struct ImageShader {
  gpu::Shader fragment, compute;
};

// What a step reads and writes. Bindings are those of set 1, by the names that the pass's shared header gives
// them; 0 is the uniform block.
struct ImageStepDesc {
  struct Input {
    uint32_t binding;
    gpu::Handle image;
    bool linear = false;  // sampled between texels; else texelFetch only (of multisampled images: by sample)
  };
  std::string name;
  ImageShader shader;
  std::vector<Input> inputs;
  std::vector<uint32_t> textures;    // bindings of what is none of the frame's images
  gpu::Handle tiles{};               // flags (shading/tiles.shared.h), for shaders with SHADES_TILES
  std::vector<gpu::Handle> outputs;  // one image, or two of one size for shaders with SHADES_TWO
  // Texels that one of the output takes in the dearest job, with the usual knobs; a filter takes four.
  uint32_t fetches = 0;
  uint64_t uniformBytes = 0;        // of the block for each job; 0 where the shader has none
  std::vector<uint32_t> constants;  // specialisation constants 0 to 2 of a step without jobs of its own
  uint32_t maxJobs = 1;
};

class ImageStep {
 public:
  // A texture that is none of the frame's images.
  struct Texture {
    uint32_t binding;
    const gpu::Image* image = nullptr;
    gpu::SamplerDesc sampler{};
  };
  // One run of the shader over the picture, or some of its tiles. Most steps have one job; where several
  // share the pixels of a tile among them, the shader has SHADES_SOME (src/shading/image_pass.glsl). A tile
  // on which none runs keeps whatever lay in that memory.
  struct Job {
    std::vector<uint32_t> constants;  // specialisation constants 0 to 2
    std::vector<Texture> textures;    // all that were declared
    TileChoice where{};               // it runs
  };
  // Gives what the outputs hold then.
  std::vector<gpu::Handle> declare(FrameBuilder& frame, ImageStepDesc desc);
  // Steps without textures have their one job from here on; others need setJobs before their first frame.
  void create(FrameBuilder& frame);
  void bind(const gpu::GraphResources& resources);
  void setJobs(const std::vector<Job>& jobs);
  template <class T>
  void update(const T& uniforms, size_t job = 0) {
    std::memcpy(uniforms_.mapped + job * uniformStride_, &uniforms, sizeof(T));
  }

 private:
  const gpu::Pipeline& pipelineFor(const Job& job);
  void record(VkCommandBuffer commands) const;

  ImageStepDesc desc_;
  UniformSlice uniforms_;
  uint64_t uniformStride_ = 0;
  bool compute_ = false;
  Configuration configuration_;
  FrameBuilder* frame_ = nullptr;
  const gpu::GraphResources* resources_ = nullptr;
  gpu::SetLayout inputLayout_, outputLayout_;
  gpu::DescriptorSets inputSets_, outputSet_;
  TileFlags tiles_;
  std::map<std::pair<std::vector<uint32_t>, bool>, gpu::Pipeline> pipelines_;  // whether on some tiles
  struct RecordedJob {
    const gpu::Pipeline* pipeline;
    TileChoice where;
  };
  std::vector<RecordedJob> jobs_;
};

}  // namespace scumble::frame
