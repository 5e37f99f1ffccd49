// A window of the platform's, and what happens in it. All of it is called from the thread that made it, but
// for wake().
#pragma once

#include <vulkan/vulkan.h>

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "scumble/result.h"
#include "scumble/vulkan.h"

struct GLFWwindow;

namespace scumble::viewer {

// In the order in which they happened. Keys, buttons and modifiers are GLFW's numbers; places are pixels of
// the framebuffer.
struct MouseMoved {
  glm::vec2 to;
};
struct MouseButton {
  int button;
  bool isDown;
  int modifiers;
};
struct MouseWheel {
  glm::vec2 steps;
};
struct Key {
  int key;
  bool isDown;  // also where it repeats
  bool isRepeated;
  int modifiers;
};
struct Character {
  uint32_t codepoint;
};
struct Dropped {
  std::vector<std::string> files;
};
struct Focus {
  bool isThere;
};
using Event = std::variant<MouseMoved, MouseButton, MouseWheel, Key, Character, Dropped, Focus>;

class Window {
 public:
  // Fails with noUsableGpu where there is no display, or no Vulkan on it.
  static Result<std::unique_ptr<Window>> open(const std::string& title, uint32_t width, uint32_t height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Of a device that shows what it draws in windows.
  static VulkanWishes vulkanWishes();
  // Throws VulkanFailure.
  VkSurfaceKHR makeSurface(VkInstance instance) const;

  // Until something happens, somebody wakes it, or so many seconds are over (below 0: never; 0: at once).
  void wait(double seconds);
  // From any thread.
  static void wake();
  std::vector<Event> takeEvents();
  bool wasTouched();  // shown anew, resized, or uncovered since the last call

  bool shouldClose() const;
  void close();
  glm::uvec2 framebufferSize() const;  // 0, 0 while it is minimised
  float contentScale() const;          // the monitor's, for sizes of what is read
  void setTitle(const std::string& title);
  void copy(const std::string& text);  // to the clipboard
  void setFullscreen(bool isFull);
  bool isFullscreen() const;
  GLFWwindow* handle() const { return window_; }

 private:
  Window() = default;
  glm::vec2 pixelsOf(double x, double y) const;

  GLFWwindow* window_ = nullptr;
  std::vector<Event> events_;
  bool wasTouched_ = true;
  glm::ivec4 windowed_{0};  // place and size before it filled the screen
};

}  // namespace scumble::viewer
