#include "hands.h"

#include <imgui.h>

#include <algorithm>
#include <iterator>

#include "glfw.h"
#include "interface_input.h"

namespace scumble::viewer {

namespace {

constexpr float kClick = 0.25f;  // heights of letters that a hand may move while it clicks

struct Flight {
  Command command;
  glm::vec3 way;
};
constexpr Flight kFlights[] = {{Command::flyRight, {1, 0, 0}},    {Command::flyLeft, {-1, 0, 0}},
                               {Command::flyUp, {0, 1, 0}},       {Command::flyDown, {0, -1, 0}},
                               {Command::flyForwards, {0, 0, 1}}, {Command::flyBack, {0, 0, -1}}};

// What goes on while its key is held: told again and again by the platform, or for as long as it is down.
bool repeats(Command command) {
  constexpr Command kRepeated[] = {Command::rollLeft, Command::rollRight, Command::narrow, Command::widen,
                                   Command::stepBack, Command::stepOn,    Command::undo,   Command::redo};
  return std::find(std::begin(kRepeated), std::end(kRepeated), command) != std::end(kRepeated);
}

bool lasts(Command command) {
  return command == Command::compare ||
         std::any_of(std::begin(kFlights), std::end(kFlights),
                     [command](const Flight& flight) { return flight.command == command; });
}

}  // namespace

bool Hands::isFlying() const {
  return std::any_of(std::begin(kFlights), std::end(kFlights),
                     [this](const Flight& flight) { return isHeld(flight.command); });
}

glm::vec3 Hands::flight() const {
  glm::vec3 way(0);
  for (const Flight& flight : kFlights)
    if (isHeld(flight.command)) way += flight.way;
  return way;
}

Hands::Grip Hands::grip() const {
  if (button_ == GLFW_MOUSE_BUTTON_RIGHT) return Grip::lookAround;
  if (modifiers_ & GLFW_MOD_SHIFT) return Grip::pan;
  return modifiers_ & GLFW_MOD_CONTROL ? Grip::zoom : Grip::orbit;
}

void Hands::press(const MouseButton& button, bool isThere, Doer& doer) {
  modifiers_ = button.modifiers;
  if (!button.isDown && button.button == button_) {
    if (isPulling_)
      doer.letGo();
    else if (isClick_ && button_ == GLFW_MOUSE_BUTTON_LEFT && isThere)
      doer.click(mouse_);
    button_ = -1, isPulling_ = false;
  }
  if (button.isDown && button_ < 0 && !ImGui::GetIO().WantCaptureMouse &&
      button.button <= GLFW_MOUSE_BUTTON_MIDDLE) {
    button_ = button.button;
    pressedAt_ = mouse_;
    isClick_ = true;
    isPulling_ = button_ == GLFW_MOUSE_BUTTON_LEFT && doer.grab(mouse_);
  }
}

void Hands::move(const glm::vec2& to, const glm::uvec2& window, bool isThere, Doer& doer) {
  const glm::vec2 from = isClick_ ? pressedAt_ : mouse_;
  mouse_ = to;
  if (button_ < 0 || !isThere) return;
  // A hand that clicks is not quite still.
  if (isClick_ && glm::distance(to, pressedAt_) < kClick * ImGui::GetFontSize()) return;
  isClick_ = false;
  if (to == from) return;
  if (isPulling_)
    doer.pull(to);
  else
    doer.drag(grip(), (to - from) / float(std::max(window.y, 1u)));
}

void Hands::key(const Key& key, Doer& doer) {
  modifiers_ = modifiersAfter(key);
  const std::optional<Command> command = commandOf(key.key, key.modifiers);
  const bool isForAll = command == Command::quit || command == Command::leave;
  if (key.isDown && command && (!key.isRepeated || repeats(*command)) &&
      (!ImGui::GetIO().WantTextInput || isForAll)) {
    if (lasts(*command))
      held_.insert(*command);
    else
      doer.obey(*command);
  }
  // A key that is let go of may have others beside it by now.
  if (!key.isDown)
    for (const Binding& binding : bindings())
      if (binding.key == key.key) held_.erase(binding.command);
}

void Hands::take(const Event& event, const glm::uvec2& window, bool isThere, Doer& doer) {
  if (const auto* moved = std::get_if<MouseMoved>(&event)) {
    move(moved->to, window, isThere, doer);
  } else if (const auto* button = std::get_if<MouseButton>(&event)) {
    press(*button, isThere, doer);
  } else if (const auto* wheel = std::get_if<MouseWheel>(&event)) {
    if (!ImGui::GetIO().WantCaptureMouse && isThere && wheel->steps.y != 0) doer.zoom(wheel->steps.y);
  } else if (const auto* pressed = std::get_if<Key>(&event)) {
    key(*pressed, doer);
  } else if (const auto* focus = std::get_if<Focus>(&event)) {
    if (focus->isThere) return;
    if (isPulling_) doer.letGo();
    held_.clear(), button_ = -1, modifiers_ = 0, isPulling_ = false;
  } else if (const auto* dropped = std::get_if<Dropped>(&event)) {
    doer.drop(dropped->files);
  }
}

}  // namespace scumble::viewer
