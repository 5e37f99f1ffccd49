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
void Panel::layOutTargets(const Look& look) {
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
  std::vector<Target> placed;
  for (const char* const section : {"colorizers", "decorations"})
    for (const std::string& name : look.names(section)) placed.push_back({section, name});
  // A setting that is taken back may take its name with it.
  const bool isThere = std::find(placed.begin(), placed.end(), target_) != placed.end();
  if ((target_.section == "colorizers" || target_.section == "decorations") && !isThere) target_ = {};
  if (placed.empty()) return;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##placed", isThere ? target_.name.c_str() : "in the picture")) return;
  for (const Target& target : placed) {
    ImGui::PushID(target.section.c_str());
    if (ImGui::Selectable(target.name.c_str(), target == target_)) target_ = target;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Of the look's %s", target.section.c_str());
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

// At the right of the title.
void Panel::layOutAdd(Change& change) {
  const float unit = ImGui::GetFontSize();
  ImGui::SameLine(ImGui::GetContentRegionMax().x - 2.6f * unit);
  if (ImGui::SmallButton("Add")) ImGui::OpenPopup("add");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Something that the look places in the picture");
  if (!ImGui::BeginPopup("add")) return;
  std::string section;
  for (const Addable& addable : addables()) {
    if (addable.section != section) ImGui::TextDisabled("%s", addable.section.c_str());
    section = addable.section;
    ImGui::PushID(section.c_str());
    if (ImGui::Selectable(addable.word.c_str())) change.added = addable;
    ImGui::PopID();
  }
  ImGui::EndPopup();
}

Panel::Change Panel::layOut(const glm::vec2& window, const Facts& facts, Document& document,
                            std::string* other) {
  Change change;
  const float unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({window.x - unit, unit}, ImGuiCond_Always, {1, 0});
  ImGui::SetNextWindowSize({panelWidth(window) - 2 * unit,
                            std::max(window.y - std::max(5.5f * unit, facts.below + 1.5f * unit), 6 * unit)});
  ImGui::Begin("panel", nullptr, kFixedWindow);
  ImGui::TextUnformatted(facts.title.c_str());
  layOutAdd(change);
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
  const bool isPlacing =
      !document.look().names("colorizers").empty() || !document.look().names("decorations").empty();
  if (!picked_.object.empty() || !picked_.material.empty() || isPlacing)
    layOutTargets(document.look());
  else if (!target_.section.empty())
    target_ = {};
  static_cast<Inspector::Change&>(change) = inspector_.layOut(document, target_, facts.time);
  ImGui::End();
  return change;
}

}  // namespace scumble::viewer
