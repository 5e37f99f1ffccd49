#include "inspector.h"

#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "knob_text.h"

namespace scumble::viewer {

namespace {

constexpr float kWideRange = 200;  // from which on a slider gives small numbers more room

bool isOfScene(const Knob& knob) {
  return std::find(knob.targets.begin(), knob.targets.end(), "scene") != knob.targets.end();
}

std::optional<std::string> slider(const Knob& knob, const KnobValue& value) {
  const float low = std::strtof(knob.min.c_str(), nullptr), high = std::strtof(knob.max.c_str(), nullptr);
  if (const int* whole = std::get_if<int>(&value)) {
    int turned = *whole;
    if (!ImGui::SliderInt("##value", &turned, int(low), int(high), "%d", ImGuiSliderFlags_AlwaysClamp))
      return std::nullopt;
    return std::to_string(turned);
  }
  auto turned = float(std::get<double>(value));
  const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat |
                                 (high - low >= kWideRange && low >= 0 ? ImGuiSliderFlags_Logarithmic : 0);
  if (!ImGui::SliderFloat("##value", &turned, low, high, "%.4g", flags)) return std::nullopt;
  return textOf(double(std::clamp(turned, low, high)));
}

std::optional<std::string> words(const Knob& knob, const std::string& present) {
  std::optional<std::string> chosen;
  if (!ImGui::BeginCombo("##value", present.c_str())) return chosen;
  for (const std::string& word : wordsOf(knob))
    if (ImGui::Selectable(word.c_str(), word == present)) chosen = word;
  ImGui::EndCombo();
  return chosen;
}

std::optional<std::string> letters(const std::string& present) {
  char text[256];
  std::strncpy(text, present.c_str(), sizeof text - 1);
  text[sizeof text - 1] = 0;
  if (!ImGui::InputText("##value", text, sizeof text, ImGuiInputTextFlags_EnterReturnsTrue))
    return std::nullopt;
  return text;
}

std::optional<std::string> color(const glm::vec3& linear) {
  glm::vec3 curve = curveOf(linear);
  if (!ImGui::ColorEdit3("##value", &curve.x, ImGuiColorEditFlags_DisplayHex)) return std::nullopt;
  return hexOf(linearOf(curve));
}

std::optional<std::string> vector(const glm::vec3& present) {
  glm::vec3 turned = present;
  if (!ImGui::InputFloat3("##value", &turned.x, "%.4g", ImGuiInputTextFlags_EnterReturnsTrue))
    return std::nullopt;
  return textOf(turned);
}

// What a hand has made of it, if it did.
std::optional<std::string> widget(const Knob& knob, const KnobValue& value) {
  if (const bool* toggle = std::get_if<bool>(&value)) {
    bool turned = *toggle;
    if (!ImGui::Checkbox("##value", &turned)) return std::nullopt;
    return turned ? "true" : "false";
  }
  if (const auto* triple = std::get_if<glm::vec3>(&value))
    return knob.type == "color" ? color(*triple) : vector(*triple);
  if (const auto* word = std::get_if<std::string>(&value))
    return knob.type == "name" ? letters(*word) : words(knob, *word);
  return slider(knob, value);
}

void explain(const Knob& knob) {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(26 * ImGui::GetFontSize());
  ImGui::TextUnformatted(knob.path.c_str());
  ImGui::TextWrapped("%s", knob.meaning.c_str());
  const bool hasRange = knob.type == "number" || knob.type == "integer";
  std::string more = "default " + (knob.defaultValue.empty() ? "none" : knob.defaultValue);
  if (hasRange)
    more = knob.min + " to " + knob.max + " " + knob.unit + (knob.unit.empty() ? "" : ", ") + more;
  ImGui::TextDisabled("%s", more.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace

Inspector::Inspector() {
  for (Knob& knob : Look::knobs()) {
    if (!isOfScene(knob)) continue;
    const std::string name = knob.path.substr(0, knob.path.rfind('.'));
    if (groups_.empty() || groups_.back().name != name) groups_.push_back({name, {}});
    groups_.back().knobs.push_back(std::move(knob));
  }
}

bool Inspector::layOut(Document& document, double time) {
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##search", "Search knobs", search_, sizeof search_);
  ImGui::Checkbox("Only those turned here", &onlyTurned_);
  ImGui::Separator();
  ImGui::BeginChild("knobs");
  const bool isSearched = search_[0] != 0 || onlyTurned_;
  bool isTurned = false;
  for (const Group& group : groups_) {
    std::vector<const Knob*> shown;
    for (const Knob& knob : group.knobs)
      if (isFound(knob, search_) && (!onlyTurned_ || document.edits().count(knob.path)))
        shown.push_back(&knob);
    if (shown.empty()) continue;
    if (isSearched) ImGui::SetNextItemOpen(true);
    // What is open while one searches is not what was open before.
    ImGui::PushID(isSearched);
    if (ImGui::CollapsingHeader(group.name.c_str()))
      for (const Knob* knob : shown) isTurned |= layOutKnob(*knob, document, time);
    ImGui::PopID();
  }
  ImGui::EndChild();
  if (!ImGui::IsAnyItemActive()) document.closeStep();
  return isTurned;
}

bool Inspector::layOutKnob(const Knob& knob, Document& document, double time) const {
  const Result<KnobValue> value = document.look().get(knob.path, time);
  if (!value) return false;
  const float unit = ImGui::GetFontSize();
  const bool isEdited = document.edits().count(knob.path) > 0;
  std::optional<std::string> text;
  bool isReset = false;
  ImGui::PushID(knob.path.c_str());
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(knob.path.c_str() + knob.path.rfind('.') + 1);
  if (ImGui::IsItemHovered()) explain(knob);
  ImGui::SameLine(10.5f * unit);
  ImGui::SetNextItemWidth(-4.2f * unit);
  text = widget(knob, *value);
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive() && ImGui::GetIO().KeyAlt) explain(knob);
  if (isEdited) {
    ImGui::SameLine(ImGui::GetContentRegionMax().x - 3.8f * unit);
    isReset = ImGui::Button("Reset");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("What the look says again");
  }
  ImGui::PopID();
  if (isReset) document.unset(knob.path);
  if (text)
    if (const Status status = document.set(knob.path, *text); !status)
      document.tell(status.error().message());
  return text || isReset;
}

}  // namespace scumble::viewer
