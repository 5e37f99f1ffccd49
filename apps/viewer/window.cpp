#include "window.h"

#include <algorithm>
#include <cstring>

#include "glfw.h"
#include "vulkan_parts.h"

namespace scumble::viewer {

namespace {

Window& self(GLFWwindow* window) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

std::string lastProblem() {
  const char* text = nullptr;
  glfwGetError(&text);
  std::string problem = text ? text : "no reason is known";
  problem.erase(problem.find_last_not_of(' ') + 1);
  return problem;
}

// As keys are labelled, not where they lie: GLFW tells of an American keyboard. Keys without a letter of
// GLFW's stay.
int labelled(int key, int scancode) {
  const char* const name = key < GLFW_KEY_ESCAPE ? glfwGetKeyName(key, scancode) : nullptr;
  if (!name || name[0] == 0 || name[1] != 0) return key;
  if (name[0] >= 'a' && name[0] <= 'z') return GLFW_KEY_A + (name[0] - 'a');
  return std::strchr("',-./;=[\\]`", name[0]) ? int(name[0]) : key;
}

Error noWindow(const std::string& problem) {
  return Error{ErrorKind::noUsableGpu, "", 0, "", problem, "`scumble render` needs no window"};
}

}  // namespace

Result<std::unique_ptr<Window>> Window::open(const std::string& title, uint32_t width, uint32_t height) {
  if (!glfwInit()) return noWindow("no window can be opened: " + lastProblem());
  std::unique_ptr<Window> made(new Window);
  if (!glfwVulkanSupported()) return noWindow("the display has no Vulkan: " + lastProblem());
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  GLFWwindow* const window = glfwCreateWindow(int(width), int(height), title.c_str(), nullptr, nullptr);
  if (!window) return noWindow("no window can be opened: " + lastProblem());
  made->window_ = window;
  glfwSetWindowUserPointer(window, made.get());
  glfwSetWindowSizeLimits(window, 320, 200, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    self(w).events_.push_back(MouseMoved{self(w).pixelsOf(x, y)});
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
    self(w).events_.push_back(MouseButton{button, action == GLFW_PRESS, modifiers});
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    self(w).events_.push_back(MouseWheel{{float(x), float(y)}});
  });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int modifiers) {
    self(w).events_.push_back(
        Key{labelled(key, scancode), action != GLFW_RELEASE, action == GLFW_REPEAT, modifiers});
  });
  glfwSetCharCallback(
      window, [](GLFWwindow* w, unsigned codepoint) { self(w).events_.push_back(Character{codepoint}); });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** files) {
    self(w).events_.push_back(Dropped{{files, files + count}});
  });
  glfwSetWindowFocusCallback(
      window, [](GLFWwindow* w, int focused) { self(w).events_.push_back(Focus{focused == GLFW_TRUE}); });
  const auto touched = [](GLFWwindow* w) { self(w).wasTouched_ = true; };
  glfwSetWindowRefreshCallback(window, touched);
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { self(w).wasTouched_ = true; });
  glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { self(w).wasTouched_ = true; });
  return made;
}

Window::~Window() {
  if (window_) glfwDestroyWindow(window_);
  glfwTerminate();
}

VulkanWishes Window::vulkanWishes() {
  uint32_t count = 0;
  const char** const names = glfwGetRequiredInstanceExtensions(&count);
  VulkanWishes wishes;
  wishes.instanceExtensions = {names, names + count};
  wishes.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  return wishes;
}

VkSurfaceKHR Window::makeSurface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  must(glfwCreateWindowSurface(instance, window_, nullptr, &surface), "glfwCreateWindowSurface");
  return surface;
}

void Window::wait(double seconds) {
  if (seconds < 0)
    glfwWaitEvents();
  else if (seconds > 0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

void Window::wake() {
  glfwPostEmptyEvent();
}

std::vector<Event> Window::takeEvents() {
  return std::exchange(events_, {});
}
bool Window::wasTouched() {
  return std::exchange(wasTouched_, false);
}
bool Window::shouldClose() const {
  return glfwWindowShouldClose(window_);
}
void Window::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

glm::uvec2 Window::framebufferSize() const {
  glm::ivec2 size(0);
  if (!glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) glfwGetFramebufferSize(window_, &size.x, &size.y);
  return glm::uvec2(glm::max(size, 0));
}

float Window::contentScale() const {
  glm::vec2 scale(1);
  glfwGetWindowContentScale(window_, &scale.x, &scale.y);
  return std::clamp(scale.y, 1.0f, 4.0f);
}

void Window::setTitle(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::copy(const std::string& text) {
  glfwSetClipboardString(window_, text.c_str());
}

bool Window::isFullscreen() const {
  return glfwGetWindowMonitor(window_) != nullptr;
}

void Window::setFullscreen(bool isFull) {
  if (isFull == isFullscreen()) return;
  if (isFull) {
    glfwGetWindowPos(window_, &windowed_.x, &windowed_.y);
    glfwGetWindowSize(window_, &windowed_.z, &windowed_.w);
    GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* const mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (mode) glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  } else {
    glfwSetWindowMonitor(window_, nullptr, windowed_.x, windowed_.y, windowed_.z, windowed_.w,
                         GLFW_DONT_CARE);
  }
}

// Places come in the window's units, which are not pixels everywhere.
glm::vec2 Window::pixelsOf(double x, double y) const {
  glm::ivec2 size(1), pixels(1);
  glfwGetWindowSize(window_, &size.x, &size.y);
  glfwGetFramebufferSize(window_, &pixels.x, &pixels.y);
  return glm::vec2(x, y) * glm::vec2(pixels) / glm::vec2(glm::max(size, 1));
}

}  // namespace scumble::viewer
