// The picture behind everything, in device memory. It may be another one in each frame (a film); the same
// one is uploaded once.
#pragma once

#include <memory>

#include "gpu/frames_in_flight.h"
#include "scumble/image.h"
#include "shading/backdrop.shared.h"

namespace scumble::world {

class Backdrop {
 public:
  // Texels that are kept of a picture that covers a frame: its own size, or the largest whole part of it that
  // is not coarser than the frame's pixels.
  static glm::uvec2 sizeFor(const Image& picture, uint32_t width, uint32_t height);

  // Throws gpu::VulkanError when it does not fit.
  Backdrop(gpu::Device& device, const glm::uvec2& size);

  // Records the upload, unless this very picture was the last one; `frame` is below gpu::kFramesInFlight, and
  // its last turn is over. The picture has channels R, G, B, or R, G, B, A, and is put over black.
  void upload(VkCommandBuffer commands, uint32_t frame, const std::shared_ptr<const Image>& picture);
  // What was recorded last is not on its way to the device after all.
  void forget() { last_.reset(); }

  // RGB, and in A the square of the luminance, so that mip levels tell the variance of what they hold.
  const gpu::Image& image() const { return image_; }
  glm::uvec2 size() const { return {image_.desc().width, image_.desc().height}; }

 private:
  void convert(const Image& picture, uint16_t* texels) const;

  gpu::Device* device_;
  gpu::Image image_;
  gpu::Buffer staging_[gpu::kFramesInFlight];  // made when they are first needed
  std::shared_ptr<const Image> last_;
};

// What passes see of it.
struct BackdropInput {
  const gpu::Image* image;
  shared::Backdrop uniforms;
};

}  // namespace scumble::world
