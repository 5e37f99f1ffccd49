#include "bindings.h"

#include "glfw.h"

namespace scumble::viewer {

namespace {

constexpr int kCtrl = GLFW_MOD_CONTROL, kShift = GLFW_MOD_SHIFT;

constexpr Binding kBindings[] = {
    {GLFW_KEY_H, 0, Command::help, "H", "this help"},
    {GLFW_KEY_N, 0, Command::panel, "N", "the panels, or the picture alone"},
    {GLFW_KEY_F11, 0, Command::fullscreen, "F11", "the whole screen, and back"},
    {GLFW_KEY_ESCAPE, 0, Command::leave, "Escape", "leave what is open, or picked"},
    {GLFW_KEY_Q, kCtrl, Command::quit, "Ctrl+Q", "quit"},
    {GLFW_KEY_O, kCtrl, Command::open, "Ctrl+O", "open another scene, or add one"},
    {GLFW_KEY_F12, 0, Command::make, "F12", "save a picture or a film"},
    {GLFW_KEY_C, kCtrl, Command::copyCommand, "Ctrl+C", "copy the command that draws this picture"},
    {GLFW_KEY_S, kCtrl, Command::save, "Ctrl+S", "save what was turned into the look's file"},
    {GLFW_KEY_Z, kCtrl, Command::undo, "Ctrl+Z", "undo what a knob was turned to"},
    {GLFW_KEY_Y, kCtrl, Command::redo, "Ctrl+Y", "and do it again; so does Ctrl+Shift+Z"},
    {GLFW_KEY_Z, kCtrl | kShift, Command::redo, "Ctrl+Shift+Z", nullptr},
    {GLFW_KEY_L, 0, Command::looks, "L", "all looks on this scene, to take one"},
    {GLFW_KEY_V, 0, Command::split, "V", "another look beside it, at a line that is dragged"},
    {GLFW_KEY_C, 0, Command::compare, "C, held", "as the look is saved"},
    {GLFW_KEY_P, 0, Command::passes, "P", "what passes put out, their times, and what is under the mouse"},
    {GLFW_KEY_B, 0, Command::eyes, "B", "both eyes: side by side, crossed, red and cyan; and one again"},
    {GLFW_KEY_G, 0, Command::handles, "G", "handles of what the look places: light, colorizers, camera"},
    {GLFW_KEY_I, 0, Command::key, "I", "a key now: of the knob under the mouse, or of the camera"},
    {GLFW_KEY_HOME, 0, Command::frameAll, "Home", "frame what was picked, or everything"},
    {GLFW_KEY_F, 0, Command::frameAll, "F", nullptr},
    {GLFW_KEY_KP_0, 0, Command::lookCamera, "Keypad 0", "the camera of look and scene again"},
    {GLFW_KEY_0, 0, Command::lookCamera, "0", nullptr},
    {GLFW_KEY_K, 0, Command::nextCamera, "K", "the next of the scene's cameras"},
    {GLFW_KEY_KP_1, 0, Command::viewFront, "Keypad 1", "from the front; with Ctrl from behind"},
    {GLFW_KEY_1, 0, Command::viewFront, "1", nullptr},
    {GLFW_KEY_KP_1, kCtrl, Command::viewBack, "Ctrl+Keypad 1", nullptr},
    {GLFW_KEY_1, kCtrl, Command::viewBack, "Ctrl+1", nullptr},
    {GLFW_KEY_KP_3, 0, Command::viewRight, "Keypad 3", "from the right; with Ctrl from the left"},
    {GLFW_KEY_3, 0, Command::viewRight, "3", nullptr},
    {GLFW_KEY_KP_3, kCtrl, Command::viewLeft, "Ctrl+Keypad 3", nullptr},
    {GLFW_KEY_3, kCtrl, Command::viewLeft, "Ctrl+3", nullptr},
    {GLFW_KEY_KP_7, 0, Command::viewTop, "Keypad 7", "from above; with Ctrl from below"},
    {GLFW_KEY_7, 0, Command::viewTop, "7", nullptr},
    {GLFW_KEY_KP_7, kCtrl, Command::viewBottom, "Ctrl+Keypad 7", nullptr},
    {GLFW_KEY_7, kCtrl, Command::viewBottom, "Ctrl+7", nullptr},
    {GLFW_KEY_LEFT_BRACKET, 0, Command::rollLeft, "[", "roll to the left"},
    {GLFW_KEY_RIGHT_BRACKET, 0, Command::rollRight, "]", "roll to the right"},
    {GLFW_KEY_EQUAL, 0, Command::narrow, "+", "a narrower field of view"},
    {GLFW_KEY_EQUAL, kShift, Command::narrow, "Shift+=", nullptr},
    {GLFW_KEY_KP_ADD, 0, Command::narrow, "Keypad +", nullptr},
    {GLFW_KEY_MINUS, 0, Command::widen, "-", "a wider one"},
    {GLFW_KEY_KP_SUBTRACT, 0, Command::widen, "Keypad -", nullptr},
    {GLFW_KEY_W, 0, Command::flyForwards, "W", "fly forwards"},
    {GLFW_KEY_S, 0, Command::flyBack, "S", "back"},
    {GLFW_KEY_A, 0, Command::flyLeft, "A", "to the left"},
    {GLFW_KEY_D, 0, Command::flyRight, "D", "to the right"},
    {GLFW_KEY_Q, 0, Command::flyDown, "Q", "down"},
    {GLFW_KEY_E, 0, Command::flyUp, "E", "up"},
    {GLFW_KEY_SPACE, 0, Command::play, "Space", "play, pause"},
    {GLFW_KEY_LEFT, 0, Command::stepBack, "Left", "one frame back"},
    {GLFW_KEY_RIGHT, 0, Command::stepOn, "Right", "one frame on"},
    {GLFW_KEY_LEFT, kShift, Command::toStart, "Shift+Left", "to the start"},
    {GLFW_KEY_T, 0, Command::onTwos, "T", "on twos, twelve pictures a second, and back"},
    {GLFW_KEY_COMMA, 0, Command::slower, ",", "half as fast"},
    {GLFW_KEY_PERIOD, 0, Command::faster, ".", "twice as fast"},
};

}  // namespace

std::span<const Binding> bindings() {
  return kBindings;
}

std::vector<HelpRow> helpRows() {
  std::vector<HelpRow> rows{
      {"Left, clicked", "pick what has knobs of its own"},     {"Left, on a handle", "move it"},
      {"Left or middle, dragged", "around what is looked at"}, {"with Shift", "along"},
      {"with Ctrl, or the wheel", "nearer and farther"},       {"Right, dragged", "look around"}};
  for (const Binding& binding : kBindings) {
    if (binding.meaning)
      rows.push_back({binding.name, binding.meaning});
    else if (!(binding.modifiers & kCtrl))
      rows.back().names += std::string(", ") + binding.name;
  }
  return rows;
}

std::optional<Command> commandOf(int key, int modifiers) {
  modifiers &= kCtrl | kShift | GLFW_MOD_ALT;
  for (const Binding& binding : kBindings)
    if (binding.key == key && binding.modifiers == modifiers) return binding.command;
  return std::nullopt;
}

}  // namespace scumble::viewer
