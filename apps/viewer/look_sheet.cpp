#include "look_sheet.h"

#include <imgui.h>

#include <algorithm>

#include "interface.h"

namespace scumble::viewer {

std::optional<size_t> layOutLookSheet(
    const glm::vec2& window, const std::vector<std::string>& names,
    const std::function<std::shared_ptr<const Picture>(size_t number)>& pictures, float aspect) {
  std::optional<size_t> taken;
  const float unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({unit, unit});
  ImGui::SetNextWindowSize({window.x - 2 * unit, window.y - 2 * unit});
  ImGui::Begin("looks", nullptr, kFixedWindow);
  if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
  ImGui::TextUnformatted("Looks");
  ImGui::SameLine();
  ImGui::TextDisabled("a click takes one, L or Escape leaves");
  ImGui::BeginChild("sheet");
  const float room = ImGui::GetContentRegionAvail().x, gap = 0.6f * unit;
  const int columns = std::max(1, int(room / (19 * unit)));
  const float width = (room - gap * float(columns - 1)) / float(columns), height = width / aspect;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i % size_t(columns) != 0) ImGui::SameLine(0, gap);
    ImGui::PushID(int(i));
    ImGui::BeginGroup();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("take", {width, height})) taken = i;
    const bool isHovered = ImGui::IsItemHovered();
    ImDrawList* const list = ImGui::GetWindowDrawList();
    const ImVec2 end{at.x + width, at.y + height};
    if (const auto picture = pictures(i))
      list->AddImage(ImTextureID(picture->image.view()), at, end);
    else
      list->AddRectFilled(at, end, ImGui::GetColorU32(ImGuiCol_FrameBg));
    if (isHovered) list->AddRect(at, end, ImGui::GetColorU32(ImGuiCol_Text), 0, 0, 2);
    ImGui::TextUnformatted(names[i].c_str());
    ImGui::EndGroup();
    ImGui::PopID();
  }
  ImGui::EndChild();
  ImGui::End();
  return taken;
}

}  // namespace scumble::viewer
