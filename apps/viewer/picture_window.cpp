#include "picture_window.h"

#include <imgui.h>

#include <array>
#include <exception>

#include "interface.h"
#include "interface_pass.h"
#include "screen.h"

namespace scumble::viewer {

Result<std::unique_ptr<PictureWindow>> PictureWindow::open(const std::string& title, const glm::uvec2& size,
                                                           const RendererOptions& options) {
  std::unique_ptr<PictureWindow> made(new PictureWindow);
  Result<std::unique_ptr<Window>> window = Window::open(title, size.x, size.y);
  if (!window) return window.error();
  made->window_ = std::move(window).value();
  Result<std::unique_ptr<Renderer>> renderer = createRenderer(Window::vulkanWishes(), options);
  if (!renderer) return renderer.error();
  made->renderer_ = std::move(renderer).value();
  return made;
}

void PictureWindow::show(std::shared_ptr<const Image> picture) {
  // There is nobody to wake where the window is gone.
  const std::lock_guard lock(mutex_);
  if (isGone_) return;
  next_ = std::move(picture);
  Window::wake();
}

void PictureWindow::end() {
  const std::lock_guard lock(mutex_);
  isEnding_ = true;
  if (!isGone_) Window::wake();
}

Status PictureWindow::run() {
  Status status = Done{};
  try {
    status = draw();
  } catch (const std::exception& failure) {
    status = Error{ErrorKind::noUsableGpu, "", 0, "", failure.what(), "go on without the window"};
  }
  {
    const std::lock_guard lock(mutex_);
    isGone_ = true;
  }
  renderer_.reset();
  window_.reset();
  return status;
}

Status PictureWindow::draw() {
  const VulkanDevice device = vulkanDeviceOf(*renderer_);
  const InterfaceContext context;
  Screen screen(device, window_->makeSurface(device.instance));
  InterfacePass pass(device, screen.format());
  // What is drawn stays until a frame later than the last that draws it.
  std::array<std::shared_ptr<DeviceImage>, Screen::kFrames> held;
  std::shared_ptr<DeviceImage> shown;
  while (!window_->shouldClose()) {
    window_->wait(-1);
    window_->takeEvents();
    std::shared_ptr<const Image> picture;
    {
      const std::lock_guard lock(mutex_);
      if (isEnding_) break;
      picture = std::exchange(next_, nullptr);
    }
    if (picture)
      shown = std::make_shared<DeviceImage>(
          uploaded(device, {picture->width, picture->height}, picture->codes.data(), "picture"));
    else if (!window_->wasTouched())
      continue;
    const glm::uvec2 size = window_->framebufferSize();
    if (!shown || size.x == 0 || size.y == 0) continue;
    ImGui::GetIO().DisplaySize = {float(size.x), float(size.y)};
    ImGui::NewFrame();
    layOutPicture(glm::vec2(size),
                  {reinterpret_cast<void*>(shown->view()), {shown->extent().width, shown->extent().height}},
                  nullptr, 1);
    ImGui::Render();
    screen.draw(size, [&](VkCommandBuffer commands, uint32_t frame) {
      held[frame] = shown;
      pass.record(commands, frame, *ImGui::GetDrawData(), screen.extent());
    });
  }
  screen.settle();
  return Done{};
}

}  // namespace scumble::viewer
