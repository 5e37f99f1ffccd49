#include "inspector.h"

#include <imgui.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "knob_text.h"
#include "track_edit.h"

namespace scumble::viewer {

namespace {

constexpr float kWideRange = 400;

// Over ranges that a slider would cross in a hand's breadth one drags by parts of what is there.
std::optional<std::string> slider(const Knob& knob, const KnobValue& value) {
  const auto numberIn = [](const std::string& text) {
    float number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
  };
  const float low = numberIn(knob.min), high = numberIn(knob.max);
  const bool isWide = high - low > kWideRange;
  constexpr ImGuiSliderFlags kFlags = ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat;
  if (const int* whole = std::get_if<int>(&value)) {
    int turned = *whole;
    const float speed = std::max(0.1f, 0.01f * float(std::abs(turned)));
    const bool isTurned = isWide
                              ? ImGui::DragInt("##value", &turned, speed, int(low), int(high), "%d", kFlags)
                              : ImGui::SliderInt("##value", &turned, int(low), int(high), "%d", kFlags);
    return isTurned ? std::optional(std::to_string(turned)) : std::nullopt;
  }
  auto turned = float(std::get<double>(value));
  const float speed = std::max(0.02f, 0.01f * std::abs(turned));
  const bool isTurned = isWide && low < 0
                            ? ImGui::DragFloat("##value", &turned, speed, low, high, "%.4g", kFlags)
                            : ImGui::SliderFloat("##value", &turned, low, high, "%.4g",
                                                 kFlags | (isWide ? ImGuiSliderFlags_Logarithmic : 0));
  return isTurned ? std::optional(textOf(double(std::clamp(turned, low, high)))) : std::nullopt;
}

std::optional<std::string> words(const Knob& knob, const std::string& present) {
  std::optional<std::string> chosen;
  if (!ImGui::BeginCombo("##value", present.c_str())) return chosen;
  for (const std::string& word : wordsOf(knob))
    if (ImGui::Selectable(word.c_str(), word == present)) chosen = word;
  ImGui::EndCombo();
  return chosen;
}

std::optional<std::string> color(const glm::vec3& linear) {
  glm::vec3 curve = curveOf(linear);
  if (!ImGui::ColorEdit3("##value", &curve.x, ImGuiColorEditFlags_DisplayHex)) return std::nullopt;
  return hexOf(linearOf(curve));
}

std::optional<std::string> vector(const glm::vec3& present) {
  glm::vec3 turned = present;
  const float speed = 0.01f * std::max({1.0f, std::abs(present.x), std::abs(present.y), std::abs(present.z)});
  if (!ImGui::DragFloat3("##value", &turned.x, speed, 0, 0, "%.4g")) return std::nullopt;
  return textOf(turned);
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

// Whether it has a track, and a key at the time. True where one was wanted, or not wanted any more.
bool layOutKey(const Look& look, const std::string& path, double time, bool isUnderMouse) {
  const float unit = ImGui::GetFontSize(), size = 0.3f * unit;
  const Result<std::optional<KnobTrack>> track = look.track(path);
  const bool hasTrack = track && *track, isAtKey = hasTrack && keyAt(**track, time);
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const bool isWanted = ImGui::InvisibleButton("key", {0.9f * unit, ImGui::GetFrameHeight()});
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s", isAtKey    ? "Take the key at this time away (I)"
                            : hasTrack ? "A key at this time (I); turning the knob makes one, too"
                                       : "Let it change with time: a key at this time (I)");
  if (!hasTrack && !isUnderMouse) return isWanted;
  const ImVec2 at{low.x + 0.45f * unit, low.y + 0.5f * ImGui::GetFrameHeight()};
  const ImVec2 left{at.x - size, at.y}, top{at.x, at.y - size}, right{at.x + size, at.y},
      foot{at.x, at.y + size};
  constexpr ImU32 kKey = IM_COL32(226, 180, 92, 255);
  if (isAtKey)
    ImGui::GetWindowDrawList()->AddQuadFilled(left, top, right, foot, kKey);
  else
    ImGui::GetWindowDrawList()->AddQuad(left, top, right, foot,
                                        hasTrack ? kKey : ImGui::GetColorU32(ImGuiCol_TextDisabled), 1.5f);
  return isWanted;
}

}  // namespace

Inspector::Inspector() {
  for (const Knob& knob : allKnobs()) {
    const std::string name = knob.path.substr(0, knob.path.rfind('.'));
    if (groups_.empty() || groups_.back().name != name) groups_.push_back({name, {}});
    groups_.back().knobs.push_back(&knob);
  }
}

std::optional<std::string> Inspector::layOutWord(const std::string& present) {
  const ImGuiID id = ImGui::GetID("##value");
  if (typedInto_ != id) {
    std::strncpy(typed_, present.c_str(), sizeof typed_ - 1);
    typed_[sizeof typed_ - 1] = 0;
  }
  char text[sizeof typed_];
  std::memcpy(text, typed_, sizeof text);
  ImGui::InputText("##value", text, sizeof text);
  const bool isDone = ImGui::IsItemDeactivatedAfterEdit();
  typedInto_ = ImGui::IsItemActive() ? id : typedInto_ == id ? 0 : typedInto_;
  if (typedInto_ == id) std::memcpy(typed_, text, sizeof text);
  return isDone ? std::optional<std::string>(text) : std::nullopt;
}

// What a hand has made of it, if it did.
std::optional<std::string> Inspector::layOutValue(const Knob& knob, const KnobValue& value) {
  if (const bool* toggle = std::get_if<bool>(&value)) {
    bool turned = *toggle;
    if (!ImGui::Checkbox("##value", &turned)) return std::nullopt;
    return turned ? "true" : "false";
  }
  if (const auto* triple = std::get_if<glm::vec3>(&value))
    return knob.type == "color" ? color(*triple) : vector(*triple);
  if (const auto* word = std::get_if<std::string>(&value))
    return knob.type == "name" ? layOutWord(*word) : words(knob, *word);
  return slider(knob, value);
}

Inspector::Change Inspector::layOut(Document& document, const Target& target, double time) {
  hovered_.clear();
  ImGui::SetNextItemWidth(-1);
  ImGui::InputTextWithHint("##search", "Search knobs", search_, sizeof search_);
  ImGui::Checkbox("Only those turned here", &onlyTurned_);
  ImGui::Separator();
  ImGui::BeginChild("knobs");
  const bool isSearched = search_[0] != 0 || onlyTurned_;
  Change change;
  for (const Group& group : groups_) {
    std::vector<const Knob*> shown;
    for (const Knob* knob : group.knobs)
      if (isSetFor(*knob, target.section.empty() ? "scene" : target.section) && isFound(*knob, search_) &&
          (!onlyTurned_ || document.edits().count(target.path(*knob))))
        shown.push_back(knob);
    if (shown.empty()) continue;
    if (isSearched) ImGui::SetNextItemOpen(true);
    // What is placed has few.
    if (target.section == "colorizers" || target.section == "decorations")
      ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    // What is open while one searches is not what was open before.
    ImGui::PushID(isSearched);
    if (ImGui::CollapsingHeader(group.name.c_str()))
      for (const Knob* knob : shown) layOutKnob(*knob, target, document, time, change);
    ImGui::PopID();
  }
  ImGui::EndChild();
  return change;
}

void Inspector::layOutKnob(const Knob& knob, const Target& target, Document& document, double time,
                           Change& change) {
  const std::string path = target.path(knob);
  const Result<KnobValue> value = document.look().get(path, time);
  if (!value) return;
  const float unit = ImGui::GetFontSize();
  const bool isEdited = document.edits().count(path) > 0;
  std::optional<std::string> text;
  bool isReset = false;
  ImGui::PushID(path.c_str());
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(knob.path.c_str() + knob.path.rfind('.') + 1);
  if (ImGui::IsItemHovered()) explain(knob);
  const ImVec2 low = ImGui::GetItemRectMin();
  const bool isUnderMouse = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) &&
                            ImGui::IsMouseHoveringRect(low, {low.x + ImGui::GetContentRegionMax().x,
                                                             low.y + ImGui::GetFrameHeight()});
  if (isUnderMouse) hovered_ = path;
  ImGui::SameLine(9.4f * unit);
  const bool isKeyed = layOutKey(document.look(), path, time, isUnderMouse);
  ImGui::SameLine(10.5f * unit);
  ImGui::SetNextItemWidth(-4.2f * unit);
  text = layOutValue(knob, *value);
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive() && ImGui::GetIO().KeyAlt) explain(knob);
  if (isEdited) {
    ImGui::SameLine(ImGui::GetContentRegionMax().x - 3.8f * unit);
    isReset = ImGui::Button("Reset");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("What the look says again");
  }
  ImGui::PopID();
  if (isReset) document.unset(path);
  const bool isTurned = isKeyed || text;
  if (isKeyed)
    text = keyToggledAt(document.look(), path, time);
  else if (text)
    text = turnedAt(document.look(), path, *text, time);
  if (isTurned) {
    if (text && isTrackText(*text)) change.keyed = path;
    const Status status = text ? document.set(path, *text) : Status(noTrackOf(path));
    if (!status) document.tell(Concern::knob, status.error().message());
  }
  change.isTurned |= isTurned || isReset;
}

}  // namespace scumble::viewer
