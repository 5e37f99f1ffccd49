// A window that shows pictures as they come, and nothing else.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <mutex>
#include <string>

#include "scumble/image.h"
#include "scumble/renderer.h"
#include "window.h"

namespace scumble::viewer {

class PictureWindow {
 public:
  // On a device of its own (`options.device` chooses). Fails with noUsableGpu where there is no display.
  static Result<std::unique_ptr<PictureWindow>> open(const std::string& title, const glm::uvec2& size,
                                                     const RendererOptions& options);

  // From any thread: this one is seen next; 8-bit codes of four channels. Those that nobody has seen by then
  // are not.
  void show(std::shared_ptr<const Image> picture);
  // From any thread: run() returns.
  void end();
  // Until end(), or until somebody closes the window; then it is gone. Called by the thread that opened it.
  Status run();

 private:
  PictureWindow() = default;
  Status draw();

  std::unique_ptr<Window> window_;
  std::unique_ptr<Renderer> renderer_;  // for its device
  std::mutex mutex_;
  std::shared_ptr<const Image> next_;
  bool isEnding_ = false, isGone_ = false;
};

}  // namespace scumble::viewer
