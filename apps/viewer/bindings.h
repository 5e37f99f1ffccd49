// What keys do. One table: the window obeys it, its help shows it, and docs/viewer.md prints it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace scumble::viewer {

enum class Command {
  help,
  panel,
  fullscreen,
  quit,
  copyCommand,
  save,
  undo,
  redo,
  frameAll,
  lookCamera,
  viewFront,
  viewRight,
  viewTop,
  viewBack,
  viewLeft,
  viewBottom,
  rollLeft,
  rollRight,
  narrow,
  widen,
  play,
  stepBack,
  stepOn,
  toStart,
  onTwos,
  slower,
  faster,
  flyForwards,
  flyBack,
  flyLeft,
  flyRight,
  flyDown,
  flyUp,
  open,
  make,
  looks,
  split,
  compare,
  passes,
  eyes,
  nextCamera,
  handles,
  key,
  leave,
};

struct Binding {
  int key, modifiers;  // GLFW's numbers; of modifiers Shift, Control and Alt count
  Command command;
  const char* name;     // of the key
  const char* meaning;  // null: the same as the one before it
};
std::span<const Binding> bindings();
std::optional<Command> commandOf(int key, int modifiers);

// Rows of the help: mouse and keys, those of one meaning together.
struct HelpRow {
  std::string names;
  const char* meaning;
};
std::vector<HelpRow> helpRows();

}  // namespace scumble::viewer
