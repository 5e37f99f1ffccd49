#include "interface.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "bindings.h"

namespace scumble::viewer {

namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
constexpr ImGuiWindowFlags kFitting = kFixed | ImGuiWindowFlags_AlwaysAutoResize;
constexpr float kPanelWidth = 25, kTimeHeight = 4.5f;  // in heights of letters

float margin() {
  return ImGui::GetFontSize();
}

}  // namespace

void layOutPicture(const glm::vec2& window, const glm::vec2& picture, void* texture) {
  const glm::vec2 scale = window / picture, shown = picture * std::min(scale.x, scale.y);
  const glm::vec2 low = glm::round(0.5f * (window - shown)), high = low + shown;
  ImGui::GetBackgroundDrawList()->AddImage(texture, {low.x, low.y}, {high.x, high.y});
}

void layOutWaiting(const glm::vec2& window, const std::string& text) {
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::Begin("waiting", nullptr, kFitting);
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

void layOutProblem(const glm::vec2& window, const std::string& text) {
  ImGui::SetNextWindowPos({margin(), margin()});
  ImGui::SetNextWindowSize(
      {std::clamp(window.x - (kPanelWidth + 3) * margin(), 16 * margin(), 52 * margin()), 0});
  ImGui::Begin("problem", nullptr, kFixed);
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.95f, 0.6f, 0.5f, 1));
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
  ImGui::TextDisabled("What was there before stays.");
  ImGui::End();
}

void layOutHelp(const glm::vec2& window) {
  ImGui::SetNextWindowPos({margin(), margin()});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {window.x - 2 * margin(), window.y - 2 * margin()});
  ImGui::Begin("help", nullptr, kFitting);
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const HelpRow& row : helpRows()) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(row.names.c_str());
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", row.meaning);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

bool layOutTime(const glm::vec2& window, Playback& playback) {
  const float unit = margin();
  ImGui::SetNextWindowPos({window.x / 2, window.y - unit}, ImGuiCond_Always, {0.5f, 1});
  ImGui::Begin("time", nullptr, kFitting);
  if (ImGui::Button(playback.isPlaying ? "Pause" : "Play", {4.5f * unit, 0})) playback.toggle();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(std::clamp(window.x - 34 * unit, 8 * unit, 40 * unit));
  auto at = float(playback.pictureTime());
  const bool isMoved =
      ImGui::SliderFloat("##time", &at, 0, float(playback.duration), "%.2f s", ImGuiSliderFlags_AlwaysClamp);
  if (isMoved) playback.seek(double(at));
  ImGui::SameLine();
  ImGui::Text("of %.2f s", playback.duration);
  ImGui::SameLine();
  ImGui::Checkbox("On twos", &playback.onTwos);
  if (playback.speed != 1) {
    ImGui::SameLine();
    ImGui::Text("%g x", playback.speed);
  }
  ImGui::End();
  return isMoved;
}

bool layOutPanel(const glm::vec2& window, const std::string& title, const std::string& facts,
                 Document& document, Inspector& inspector, double time) {
  const float unit = margin(), width = std::min(kPanelWidth * unit, window.x - 2 * unit);
  ImGui::SetNextWindowPos({window.x - unit, unit}, ImGuiCond_Always, {1, 0});
  ImGui::SetNextWindowSize({width, std::max(window.y - (1 + kTimeHeight) * unit, 6 * unit)});
  ImGui::Begin("panel", nullptr, kFixed);
  ImGui::TextUnformatted(title.c_str());
  ImGui::SetNextItemWidth(-1);
  const std::string& chosen = document.lookName();
  constexpr const char* kOwn = "the scene's look";
  if (ImGui::BeginCombo("##look", chosen.empty() ? kOwn : chosen.c_str())) {
    if (ImGui::Selectable(kOwn, chosen.empty())) document.chooseLook("");
    for (const ShippedLook& look : Look::shipped()) {
      if (ImGui::Selectable(look.name.c_str(), look.name == chosen)) document.chooseLook(look.name);
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", look.description.c_str());
    }
    ImGui::EndCombo();
  }
  if (!document.look().description().empty()) ImGui::TextWrapped("%s", document.look().description().c_str());
  if (!facts.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", facts.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::Separator();
  const bool isTurned = inspector.layOut(document, time);
  ImGui::End();
  return isTurned;
}

}  // namespace scumble::viewer
