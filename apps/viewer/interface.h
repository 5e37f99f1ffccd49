// What lies over the picture, besides the panel, the time and the windows that are opened: the picture
// itself, the help, and what is told.
#pragma once

#include <imgui.h>

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "document.h"
#include "export_job.h"
#include "recovery.h"

namespace scumble::viewer {

// ImGui's context, as long as a window; it writes no file.
struct InterfaceContext {
  InterfaceContext() { ImGui::CreateContext(), ImGui::GetIO().IniFilename = nullptr; }
  ~InterfaceContext() { ImGui::DestroyContext(); }
  InterfaceContext(const InterfaceContext&) = delete;
  InterfaceContext& operator=(const InterfaceContext&) = delete;
};

// A part of the interface that stays where it is.
constexpr ImGuiWindowFlags kFixedWindow = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                          ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
// And one that is as large as what is in it.
constexpr ImGuiWindowFlags kFittingWindow = kFixedWindow | ImGuiWindowFlags_AlwaysAutoResize;

// The first of the pictures in the middle of the window, as large as it gets; right of `split` (from 0 to 1
// across the window) the other one, where there is one. Textures are as InterfacePass takes them.
struct PictureShown {
  void* texture = nullptr;
  glm::vec2 size{1};  // pixels
};
void layOutPicture(const glm::vec2& window, const PictureShown& picture, const PictureShown* other,
                   float split);
// How two eyes are seen in one window.
enum class Eyes {
  one,
  sideBySide,
  crossed,  // the right eye's picture at the left
  anaglyph  // red for the left eye, cyan for the right one
};
// The name of that for `render --stereo`, empty for one; and back, side by side for those that no window has.
std::string layoutOf(Eyes eyes);
Eyes eyesOf(const std::string& layout);
// Pixels that a view has then.
glm::uvec2 viewSize(const glm::uvec2& window, Eyes eyes);
void layOutEyes(const glm::vec2& window, const PictureShown& left, const PictureShown& right, Eyes eyes);
// The line between the two, which is dragged; true where it was.
bool layOutSplit(const glm::vec2& window, const std::string& left, const std::string& right, float& split);

void layOutWaiting(const glm::vec2& window, const std::string& text);
void layOutHelp(const glm::vec2& window);
// What is told at the left, from the top down: what is wrong, what was kept, what is being made.
class Notices {
 public:
  explicit Notices(const glm::vec2& window);
  void problems(const std::map<Concern, std::string>& problems);
  enum class Answer { none, take, throwAway };
  Answer kept(const Recovery::Kept& kept);
  // True where somebody has closed it, or stopped it.
  bool job(const ExportJob& job);

 private:
  void begin(const char* name);
  void end();

  glm::vec2 window_;
  float top_;
};

}  // namespace scumble::viewer
