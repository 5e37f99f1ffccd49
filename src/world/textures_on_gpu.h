// A scene's images in device memory, with mip levels.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "base/shared.h"
#include "gpu/resources.h"
#include "scene/scene_data.h"

namespace scumble::world {

class TexturesOnGpu {
 public:
  explicit TexturesOnGpu(gpu::Device& device) : device_(device) {}

  // Uploads images that are not there yet, and lets go of those that are in the list no more. Calls `settle`
  // before one goes that frames under way may read. True where an index now stands for another image. Throws
  // gpu::VulkanError when they do not fit.
  bool update(gpu::Uploader& uploader, const std::vector<Shared<scene::TextureImage>>& images,
              const std::function<void()>& settle);

  // By their index in the scene; -1: white.
  VkImageView view(int image) const;
  // How many the last update() has uploaded, and the bytes of those that are there.
  uint32_t uploaded() const { return uploaded_; }
  uint64_t bytes() const;

 private:
  struct Texture {
    std::shared_ptr<const scene::TextureImage> of;
    gpu::Image image;
    uint64_t bytes;
  };
  gpu::Device& device_;
  gpu::Image white_;
  std::vector<std::shared_ptr<const Texture>> textures_;  // by index
  uint32_t uploaded_ = 0;
};

}  // namespace scumble::world
