// What hands do, as Dear ImGui takes it. (Of version 1.86 a frame sees states, not events: a key that goes
// down and up between two slow frames would be lost. So a frame gets only so much as it can tell apart, and
// the rest waits.)
#pragma once

#include <deque>
#include <vector>

#include "window.h"

namespace scumble::viewer {

class InterfaceInput {
 public:
  // Sets up keys and the clipboard of ImGui's present context.
  explicit InterfaceInput(const Window& window);

  void add(std::vector<Event> events);
  // Before ImGui::NewFrame: gives it the events of one frame, and returns them.
  std::vector<Event> feed();
  bool hasMore() const { return !waiting_.empty(); }

 private:
  std::deque<Event> waiting_;
};

// GLFW's bits of the modifiers that are down after a key: of a modifier itself GLFW tells those before it.
int modifiersAfter(const Key& key);

// How many of the events one frame can tell apart: at least one, where there is one.
size_t distinguishable(const std::deque<Event>& events);

}  // namespace scumble::viewer
