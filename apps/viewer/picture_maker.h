// Draws pictures beside the window, on a thread of its own, so that the window never waits for one. What is
// wished last is drawn next; what was wished before and has not begun is not drawn at all.
#pragma once

#include <condition_variable>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "vulkan_parts.h"

namespace scumble::viewer {

struct Wish {
  Scene scene;
  Look look;
  Viewpoint viewpoint;
  double time = 0;  // seconds
  glm::uvec2 size{0};
  uint32_t samples = 4, seed = 0;
};

struct Picture {
  static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;  // in sRGB's curve

  Image image;              // VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
  uint64_t number = 0;      // of the wish: they grow
  double milliseconds = 0;  // without what only a first one takes: uploads and compiling
};

class PictureMaker {
 public:
  // `whenDone`: called by the thread after each picture and each failure.
  PictureMaker(std::unique_ptr<Renderer> renderer, std::function<void()> whenDone);
  ~PictureMaker();  // what is being drawn is given up
  PictureMaker(const PictureMaker&) = delete;
  PictureMaker& operator=(const PictureMaker&) = delete;

  void wish(Wish wish);
  // The last one that is done; null before the first. As long as somebody has it nothing is drawn into it.
  std::shared_ptr<const Picture> latest() const;
  // What went wrong last, once.
  std::optional<Error> takeFailure();
  // While no picture is being made.
  const Renderer& renderer() const { return *renderer_; }

 private:
  void run();
  std::shared_ptr<Picture> blank(const glm::uvec2& size);
  Result<std::shared_ptr<Picture>> draw(const Wish& wish);

  const std::unique_ptr<Renderer> renderer_;
  const VulkanDevice device_;
  const std::function<void()> whenDone_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Wish> next_;
  uint64_t number_ = 0;
  bool isEnding_ = false;
  std::shared_ptr<const Picture> latest_;
  std::optional<Error> failure_;
  std::vector<std::shared_ptr<Picture>> pictures_;  // the thread's own
  std::thread thread_;
};

}  // namespace scumble::viewer
