#include "panel.h"

#include <imgui.h>

#include <algorithm>
#include <optional>

#include "interface.h"

namespace scumble::viewer {

namespace {

// A choice of looks; the one that was chosen. `none`: what no name is called.
std::optional<std::string> chosenLook(const char* label, const char* none, const std::string& present) {
  std::optional<std::string> chosen;
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo(label, present.empty() ? none : present.c_str())) return chosen;
  if (ImGui::Selectable(none, present.empty())) chosen = "";
  for (const ShippedLook& look : Look::shipped()) {
    if (ImGui::Selectable(look.name.c_str(), look.name == present)) chosen = look.name;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", look.description.c_str());
  }
  ImGui::EndCombo();
  return chosen;
}

}  // namespace

float panelWidth(const glm::vec2& window) {
  constexpr float kWidth = 25;  // in heights of letters
  const float unit = ImGui::GetFontSize();
  return std::min(kWidth * unit, window.x - 2 * unit) + 2 * unit;
}

void Panel::select(const Picked& picked) {
  picked_ = picked;
  target_ = picked.material.empty() ? Target() : Target{"materials", picked.material};
}

// Whose knobs they are.
void Panel::layOutTargets() {
  const Target targets[] = {{}, {"materials", picked_.material}, {"nodes", picked_.object}};
  for (const Target& target : targets) {
    if (!target.section.empty() && target.name.empty()) continue;
    const std::string label = target.section.empty() ? "Everything" : target.name;
    ImGui::PushID(target.section.c_str());
    if (!target.section.empty()) ImGui::SameLine();
    const bool isChosen = target_ == target;
    if (isChosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (ImGui::Button(label.c_str())) target_ = target;
    if (isChosen) ImGui::PopStyleColor();
    if (ImGui::IsItemHovered() && !target.section.empty())
      ImGui::SetTooltip("Knobs of this %s alone", target.section == "nodes" ? "object" : "material");
    ImGui::PopID();
  }
}

bool Panel::layOut(const glm::vec2& window, const Facts& facts, Document& document, std::string* other) {
  const float unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({window.x - unit, unit}, ImGuiCond_Always, {1, 0});
  ImGui::SetNextWindowSize({panelWidth(window) - 2 * unit, std::max(window.y - 5.5f * unit, 6 * unit)});
  ImGui::Begin("panel", nullptr, kFixedWindow);
  ImGui::TextUnformatted(facts.title.c_str());
  if (const auto look = chosenLook("##look", "the scene's look", document.opened().look))
    document.openLook(*look);
  if (other) {
    ImGui::TextDisabled("Right of the line:");
    if (const auto look = chosenLook("##other", "as it is saved", *other)) *other = *look;
  }
  if (!document.look().description().empty()) ImGui::TextWrapped("%s", document.look().description().c_str());
  if (!facts.lines.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", facts.lines.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::Separator();
  if (!picked_.object.empty() || !picked_.material.empty()) layOutTargets();
  const bool isTurned = inspector_.layOut(document, target_, facts.time);
  ImGui::End();
  return isTurned;
}

}  // namespace scumble::viewer
