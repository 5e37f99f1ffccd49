#include "interface_input.h"

#include <imgui.h>

#include <set>
#include <tuple>

#include "glfw.h"

namespace scumble::viewer {

namespace {

constexpr int kButtons = 5;  // that ImGui knows

template <class... Cases>
struct Match : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Match(Cases...) -> Match<Cases...>;

void give(const Event& event, ImGuiIO& io) {
  const auto modifiers = [&](int bits) {
    io.KeyCtrl = bits & GLFW_MOD_CONTROL, io.KeyShift = bits & GLFW_MOD_SHIFT;
    io.KeyAlt = bits & GLFW_MOD_ALT, io.KeySuper = bits & GLFW_MOD_SUPER;
  };
  std::visit(
      Match{[&](const MouseMoved& moved) {
              io.MousePos = {moved.to.x, moved.to.y};
            },
            [&](const MouseButton& button) {
              if (button.button < kButtons) io.MouseDown[button.button] = button.isDown;
              modifiers(button.modifiers);
            },
            [&](const MouseWheel& wheel) { io.MouseWheelH += wheel.steps.x, io.MouseWheel += wheel.steps.y; },
            [&](const Key& key) {
              if (key.key >= 0 && key.key < int(std::size(io.KeysDown))) io.KeysDown[key.key] = key.isDown;
              modifiers(modifiersAfter(key));
            },
            [&](const Character& character) { io.AddInputCharacter(character.codepoint); },
            [&](const Dropped&) {},
            [&](const Focus& focus) {
              if (focus.isThere) return;
              for (bool& down : io.KeysDown) down = false;
              modifiers(0);
            }},
      event);
}

}  // namespace

int modifiersAfter(const Key& key) {
  const std::tuple<int, int, int> own[] = {{GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_MOD_CONTROL},
                                           {GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, GLFW_MOD_SHIFT},
                                           {GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT, GLFW_MOD_ALT}};
  for (const auto& [left, right, bit] : own)
    if (key.key == left || key.key == right) return key.isDown ? key.modifiers | bit : key.modifiers & ~bit;
  return key.modifiers;
}

size_t distinguishable(const std::deque<Event>& events) {
  bool hasMoved = false, hasPressed = false, hasWheeled = false, hasTyped = false;
  std::set<int> buttons, keys;
  size_t count = 0;
  for (const Event& event : events) {
    const bool fits =
        std::visit(Match{[&](const MouseMoved&) { return !hasPressed && !hasWheeled && (hasMoved = true); },
                         [&](const MouseButton& b) {
                           // What is dragged is where it was last before it is let go of.
                           return !hasWheeled && (b.isDown || !hasMoved) && buttons.insert(b.button).second &&
                                  (hasPressed = true);
                         },
                         [&](const MouseWheel&) { return !hasPressed && (hasWheeled = true); },
                         // Where letters go is known only when what was pressed has been seen.
                         [&](const Key& k) {
                           return !hasTyped && !hasPressed && (k.isRepeated || keys.insert(k.key).second);
                         },
                         [&](const Character&) { return hasTyped = true; },
                         [&](const Dropped&) { return true; }, [&](const Focus&) { return true; }},
                   event);
    if (!fits) break;
    ++count;
  }
  return count;
}

InterfaceInput::InterfaceInput(const Window& window) {
  ImGuiIO& io = ImGui::GetIO();
  io.BackendPlatformName = "scumble";
  const std::pair<ImGuiKey, int> keys[] = {{ImGuiKey_Tab, GLFW_KEY_TAB},
                                           {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                           {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                           {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                           {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                           {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                           {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                           {ImGuiKey_Home, GLFW_KEY_HOME},
                                           {ImGuiKey_End, GLFW_KEY_END},
                                           {ImGuiKey_Insert, GLFW_KEY_INSERT},
                                           {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                           {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                           {ImGuiKey_Space, GLFW_KEY_SPACE},
                                           {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                           {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                           {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                           {ImGuiKey_A, GLFW_KEY_A},
                                           {ImGuiKey_C, GLFW_KEY_C},
                                           {ImGuiKey_V, GLFW_KEY_V},
                                           {ImGuiKey_X, GLFW_KEY_X},
                                           {ImGuiKey_Y, GLFW_KEY_Y},
                                           {ImGuiKey_Z, GLFW_KEY_Z}};
  for (const auto& [key, number] : keys) io.KeyMap[key] = number;
  io.ClipboardUserData = window.handle();
  io.GetClipboardTextFn = [](void* handle) {
    return glfwGetClipboardString(static_cast<GLFWwindow*>(handle));
  };
  io.SetClipboardTextFn = [](void* handle, const char* text) {
    glfwSetClipboardString(static_cast<GLFWwindow*>(handle), text);
  };
}

void InterfaceInput::add(std::vector<Event> events) {
  for (Event& event : events) waiting_.push_back(std::move(event));
}

std::vector<Event> InterfaceInput::feed() {
  std::vector<Event> fed;
  for (size_t left = distinguishable(waiting_); left > 0; --left) {
    give(waiting_.front(), ImGui::GetIO());
    fed.push_back(std::move(waiting_.front()));
    waiting_.pop_front();
  }
  return fed;
}

}  // namespace scumble::viewer
