#include "timeline.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "interface.h"
#include "knob_text.h"
#include "track_edit.h"

namespace scumble::viewer {

namespace {

constexpr int kMostLanes = 6;  // that are seen at once
constexpr int kSamples = 96;   // of a curve
constexpr float kNames = 13;   // width of lanes' names, in heights of letters
constexpr float kLane = 1.7f;  // height, likewise
constexpr ImU32 kCurve = IM_COL32(150, 158, 168, 255), kDot = IM_COL32(226, 180, 92, 255),
                kDotChosen = IM_COL32(255, 236, 200, 255), kNow = IM_COL32(235, 235, 235, 160);

struct Lane {
  glm::vec2 low, size;
  double duration;
  float xOf(double time) const { return low.x + float(time / duration) * size.x; }
  double timeAt(float x) const { return double((x - low.x) / size.x) * duration; }
};

// Of a number between the least and the greatest that its keys have; of a colour itself.
void drawCurve(const Lane& lane, const KnobTrack& track, const Look& look, const std::string& path) {
  ImDrawList* const list = ImGui::GetWindowDrawList();
  const auto number = [](const KnobValue& value) -> std::optional<float> {
    if (const double* real = std::get_if<double>(&value)) return float(*real);
    if (const int* whole = std::get_if<int>(&value)) return float(*whole);
    return std::nullopt;
  };
  const bool isColor = settingOf(path)->knob->type == "color";
  float least = 0, most = 0;
  for (size_t i = 0; i < track.keys.size(); ++i) {
    const std::optional<float> value = number(track.keys[i].value);
    if (!value && !isColor) return;
    least = i ? std::min(least, value.value_or(0)) : value.value_or(0);
    most = i ? std::max(most, value.value_or(0)) : value.value_or(0);
  }
  glm::vec2 last(0);
  for (int i = 0; i <= kSamples; ++i) {
    const double time = lane.duration * i / kSamples;
    const Result<KnobValue> value = look.get(path, time);
    if (!value) return;
    const float x = lane.xOf(time), step = lane.size.x / kSamples;
    if (isColor) {
      const glm::vec3 curve = curveOf(std::get<glm::vec3>(*value));
      if (i < kSamples)
        list->AddRectFilled({x, lane.low.y + 0.3f * lane.size.y},
                            {x + step + 1, lane.low.y + 0.7f * lane.size.y},
                            ImGui::GetColorU32(ImVec4(curve.x, curve.y, curve.z, 1)));
      continue;
    }
    // What rounding alone tells apart is one value.
    const bool isFlat = most - least <= 1e-4f * std::max(1.0f, std::abs(most));
    const float part = isFlat ? 0.5f : (number(*value).value_or(least) - least) / (most - least);
    const glm::vec2 place(x, lane.low.y + lane.size.y * (0.82f - 0.64f * std::clamp(part, -0.2f, 1.2f)));
    if (i > 0) list->AddLine({last.x, last.y}, {place.x, place.y}, kCurve, 1.2f);
    last = place;
  }
}

}  // namespace

std::vector<std::string> tracksOf(const Look& look) {
  std::vector<std::string> paths;
  for (const std::string& path : look.animated())
    if (const auto track = look.track(path); track && *track) paths.push_back(path);
  std::sort(paths.begin(), paths.end());
  return paths;
}

Timeline::Change Timeline::layOut(const glm::vec2& window, Playback& playback,
                                  const std::vector<std::string>& clips, Document& document) {
  const float unit = ImGui::GetFontSize();
  const std::vector<std::string> tracks = tracksOf(document.look());
  const bool showsTracks = isOpen_ && !tracks.empty();
  Change change;
  ImGui::SetNextWindowPos({window.x / 2, window.y - unit}, ImGuiCond_Always, {0.5f, 1});
  const float wide = window.x - 2 * unit;
  if (showsTracks) ImGui::SetNextWindowSize({wide, 0});
  ImGui::Begin("time", nullptr, showsTracks ? kFixedWindow : kFittingWindow);
  if (showsTracks) {
    const int lanes = std::min(int(tracks.size()), kMostLanes);
    const float gap = ImGui::GetStyle().ItemSpacing.y;
    ImGui::BeginChild("lanes", {0, float(lanes) * (kLane * unit + gap)});
    for (const std::string& path : tracks)
      if (const auto track = document.look().track(path); track && *track)
        layOutLane(path, **track, playback, document, change);
    ImGui::EndChild();
    if (const auto track = document.look().track(chosen_); track && *track)
      layOutChosen(**track, playback.pictureTime(), document, change);
  }
  layOutBar(wide, playback, clips, document, !tracks.empty(), change);
  height_ = ImGui::GetWindowHeight() + unit;
  ImGui::End();
  return change;
}

void Timeline::layOutBar(float width, Playback& playback, const std::vector<std::string>& clips,
                         const Document& document, bool hasTracks, Change& change) {
  constexpr const char* kAsTheLook = "as the look has it";
  const float unit = ImGui::GetFontSize(), clipWidth = clips.size() > 1 ? 11 * unit : 0;
  if (ImGui::Button(playback.isPlaying ? "Pause" : "Play", {4.5f * unit, 0})) playback.toggle();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(
      std::clamp(width - 32 * unit - clipWidth - (hasTracks ? 5 * unit : 0), 8 * unit, 40 * unit));
  auto at = float(playback.pictureTime());
  change.isMoved |=
      ImGui::SliderFloat("##time", &at, 0, float(playback.duration), "%.2f s", ImGuiSliderFlags_AlwaysClamp);
  if (change.isMoved) playback.seek(double(at));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(5.5f * unit);
  auto duration = float(playback.duration);
  if (ImGui::DragFloat("##duration", &duration, 0.05f, 0.1f, 3600, "of %.2f s", ImGuiSliderFlags_AlwaysClamp))
    change.duration = double(duration);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("How much of it plays, and is filmed; drag, or Ctrl and click");
  ImGui::SameLine();
  ImGui::Checkbox("On twos", &playback.onTwos);
  if (hasTracks) {
    ImGui::SameLine();
    if (ImGui::Button(isOpen_ ? "Hide tracks" : "Tracks")) isOpen_ = !isOpen_;
  }
  if (playback.speed != 1) {
    ImGui::SameLine();
    ImGui::Text("%g x", playback.speed);
  }
  if (clips.size() > 1) {
    const std::string& clip = document.opened().clip;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(clipWidth - unit);
    if (ImGui::BeginCombo("##clip", clip.empty() ? kAsTheLook : clip.c_str())) {
      if (ImGui::Selectable(kAsTheLook, clip.empty())) change.clip = "";
      for (size_t i = 0; i < clips.size(); ++i) {
        // Clips may have one name, or none: then it is their number that counts.
        ImGui::PushID(int(i));
        if (ImGui::Selectable(clips[i].c_str(), clips[i] == clip)) change.clip = clips[i];
        ImGui::PopID();
      }
      ImGui::EndCombo();
    }
  }
}

void Timeline::layOutLane(const std::string& path, const KnobTrack& track, Playback& playback,
                          Document& document, Change& change) {
  const float unit = ImGui::GetFontSize(), dot = 0.32f * unit;
  ImGui::PushID(path.c_str());
  const ImVec2 begin = ImGui::GetCursorScreenPos();
  const float room = ImGui::GetContentRegionAvail().x;
  const Lane lane{{begin.x + kNames * unit, begin.y},
                  {std::max(room - (kNames + 1) * unit, unit), kLane * unit},
                  std::max(playback.duration, 1e-3)};
  if (ImGui::Selectable("##name", path == chosen_, 0, {(kNames - 0.6f) * unit, kLane * unit})) choose(path);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", path.c_str());
  ImDrawList* const list = ImGui::GetWindowDrawList();
  // The end of a path says most.
  std::string name = path;
  while (name.size() > 3 && ImGui::CalcTextSize(name.c_str()).x > (kNames - 1) * unit)
    name = ".." + name.substr(name.starts_with("..") ? 3 : 1);
  list->AddText({begin.x + 0.2f * unit, begin.y + 0.3f * unit}, ImGui::GetColorU32(ImGuiCol_Text),
                name.c_str());
  list->AddRectFilled({lane.low.x, lane.low.y}, {lane.low.x + lane.size.x, lane.low.y + lane.size.y},
                      ImGui::GetColorU32(ImGuiCol_FrameBg), 3);
  drawCurve(lane, track, document.look(), path);
  const float now = lane.xOf(std::min(playback.pictureTime(), playback.duration));
  list->AddLine({now, lane.low.y}, {now, lane.low.y + lane.size.y}, kNow);
  // Keys lie over what moves the time.
  ImGui::SetCursorScreenPos({lane.low.x, lane.low.y});
  ImGui::SetItemAllowOverlap();
  ImGui::InvisibleButton("lane", {lane.size.x, lane.size.y});
  ImGui::SetItemAllowOverlap();
  if (ImGui::IsItemActive()) {
    playback.seek(std::clamp(lane.timeAt(ImGui::GetIO().MousePos.x), 0.0, playback.duration));
    change.isMoved = true;
  }
  for (size_t i = 0; i < track.keys.size(); ++i) {
    const float x = lane.xOf(track.keys[i].time), y = lane.low.y + 0.5f * lane.size.y;
    if (track.keys[i].time < 0 || track.keys[i].time > playback.duration + kNearKey) continue;
    ImGui::PushID(int(i));
    ImGui::SetCursorScreenPos({x - 1.6f * dot, lane.low.y});
    ImGui::InvisibleButton("key", {3.2f * dot, lane.size.y});
    if (ImGui::IsItemActivated()) choose(path), key_ = i;
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 2)) {
      KnobTrack moved = track;
      const double picture = 1 / playback.rate();
      const double wanted = std::clamp(lane.timeAt(ImGui::GetIO().MousePos.x), 0.0, playback.duration);
      playback.seek(moveKey(moved, i, std::round(wanted / picture) * picture));
      put(path, moved, document, change);
    }
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("%.2f s: %s", track.keys[i].time,
                        textOf(track.keys[i].value, *settingOf(path)->knob).c_str());
    const bool isChosen = path == chosen_ && key_ == i;
    list->AddQuadFilled({x, y - dot}, {x + dot, y}, {x, y + dot}, {x - dot, y}, isChosen ? kDotChosen : kDot);
    ImGui::PopID();
  }
  ImGui::SetCursorScreenPos({begin.x, begin.y + kLane * unit + ImGui::GetStyle().ItemSpacing.y});
  ImGui::PopID();
}

void Timeline::layOutChosen(const KnobTrack& track, double time, Document& document, Change& change) {
  const float unit = ImGui::GetFontSize();
  const std::optional<Setting> setting = settingOf(chosen_);
  if (!setting) return;
  if (key_ && *key_ >= track.keys.size()) key_.reset();
  ImGui::SetNextItemWidth(7 * unit);

  if (ImGui::BeginCombo("##interpolation", kInterpolations[size_t(track.interpolation)])) {
    for (size_t i = 0; i < (isSmooth(*setting->knob) ? 4u : 1u); ++i)
      if (ImGui::Selectable(kInterpolations[i], size_t(track.interpolation) == i)) {
        KnobTrack changed = track;
        changed.interpolation = Interpolation(i);
        put(chosen_, changed, document, change);
      }
    ImGui::EndCombo();
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("How it goes from key to key");
  ImGui::SameLine();
  bool repeats = track.repeat;
  if (ImGui::Checkbox("Repeats", &repeats)) {
    KnobTrack changed = track;
    changed.repeat = repeats;
    put(chosen_, changed, document, change);
  }
  ImGui::SameLine();
  const auto set = [&](const std::optional<std::string>& text) {
    document.closeStep();
    if (const Status status = text ? document.set(chosen_, *text) : Status(noTrackOf(chosen_)); !status)
      document.tell(Concern::knob, status.error().message());
    document.closeStep();
    change.isTurned = true;
  };
  const bool isAtKey = keyAt(track, time).has_value();
  if (ImGui::Button(isAtKey ? "Remove key" : "Key here")) set(keyToggledAt(document.look(), chosen_, time));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("At the present time");
  ImGui::SameLine();
  if (ImGui::Button("One value"))
    if (const Result<KnobValue> value = document.look().get(chosen_, time); value)
      set(textOf(*value, *setting->knob));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("What it is at the present time, for ever");
}

void Timeline::put(const std::string& path, const KnobTrack& track, Document& document, Change& change) {
  const std::optional<std::string> text = textOf(track, *settingOf(path)->knob);
  const Status status = text ? document.set(path, *text) : Status(noTrackOf(path));
  if (!status) document.tell(Concern::knob, status.error().message());
  change.isTurned = true;
}

}  // namespace scumble::viewer
