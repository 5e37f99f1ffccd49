// The parts of the interface that lie over the picture. Each is an ImGui window of its own.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "inspector.h"
#include "playback.h"

namespace scumble::viewer {

void layOutPicture(const glm::vec2& window, const glm::vec2& picture, void* texture);
void layOutWaiting(const glm::vec2& window, const std::string& text);
void layOutProblem(const glm::vec2& window, const std::string& text);
void layOutHelp(const glm::vec2& window);
// True where somebody has moved the playhead.
bool layOutTime(const glm::vec2& window, Playback& playback);
// `facts`: lines about the picture. True where a knob was turned.
bool layOutPanel(const glm::vec2& window, const std::string& title, const std::string& facts,
                 Document& document, Inspector& inspector, double time);

}  // namespace scumble::viewer
