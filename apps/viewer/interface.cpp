#include "interface.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bindings.h"
#include "interface_pass.h"
#include "panel.h"

namespace scumble::viewer {

namespace {

constexpr float kStrip = 2;  // pixels of the line between two pictures

float margin() {
  return ImGui::GetFontSize();
}

struct Box {
  glm::vec2 low, high;
};

// In the middle of the window, with its aspect kept.
Box placed(const glm::vec2& window, const glm::vec2& picture) {
  const glm::vec2 scale = window / picture, shown = picture * std::min(scale.x, scale.y);
  const glm::vec2 low = glm::round(0.5f * (window - shown));
  return {low, low + shown};
}

// That part of it which lies between two places across the window, in pixels.
void addPart(const Box& box, void* texture, float from, float to) {
  const float left = std::max(box.low.x, from), right = std::min(box.high.x, to);
  if (right <= left) return;
  const float width = box.high.x - box.low.x;
  ImGui::GetBackgroundDrawList()->AddImage(texture, {left, box.low.y}, {right, box.high.y},
                                           {(left - box.low.x) / width, 0}, {(right - box.low.x) / width, 1});
}

}  // namespace

void layOutPicture(const glm::vec2& window, const PictureShown& picture, const PictureShown* other,
                   float split) {
  const float line = other ? std::round(split * window.x) : window.x;
  addPart(placed(window, picture.size), picture.texture, 0, line);
  if (other) addPart(placed(window, other->size), other->texture, line, window.x);
}

namespace {

constexpr const char* kEyeLayouts[] = {"", "side-by-side", "crossed", "anaglyph"};  // by Eyes

}  // namespace

std::string layoutOf(Eyes eyes) {
  return kEyeLayouts[size_t(eyes)];
}

Eyes eyesOf(const std::string& layout) {
  for (const Eyes eyes : {Eyes::one, Eyes::crossed, Eyes::anaglyph})
    if (layout == kEyeLayouts[size_t(eyes)]) return eyes;
  return Eyes::sideBySide;
}

glm::uvec2 viewSize(const glm::uvec2& window, Eyes eyes) {
  const bool isHalf = eyes == Eyes::sideBySide || eyes == Eyes::crossed;
  return isHalf ? glm::uvec2(window.x / 2, window.y) : window;
}

void layOutEyes(const glm::vec2& window, const PictureShown& left, const PictureShown& right, Eyes eyes) {
  ImDrawList* const list = ImGui::GetBackgroundDrawList();
  if (eyes == Eyes::anaglyph) {
    const Box box = placed(window, left.size);
    const auto add = [&](const PictureShown& picture, ImU32 tint) {
      list->AddImage(picture.texture, {box.low.x, box.low.y}, {box.high.x, box.high.y}, {0, 0}, {1, 1}, tint);
    };
    add(left, IM_COL32(255, 0, 0, 255));
    list->AddCallback(InterfacePass::kAdd, nullptr);
    add(right, IM_COL32(0, 255, 255, 255));
    list->AddCallback(InterfacePass::kOver, nullptr);
    return;
  }
  const glm::vec2 half(std::floor(window.x / 2), window.y);
  const PictureShown* const pictures[] = {eyes == Eyes::crossed ? &right : &left,
                                          eyes == Eyes::crossed ? &left : &right};
  for (int i = 0; i < 2; ++i) {
    const Box box = placed(half, pictures[i]->size);
    const float x = float(i) * half.x;
    list->AddImage(pictures[i]->texture, {box.low.x + x, box.low.y}, {box.high.x + x, box.high.y});
  }
}

bool layOutSplit(const glm::vec2& window, const std::string& left, const std::string& right, float& split) {
  const float line = std::round(split * window.x), unit = margin();
  constexpr ImU32 kLine = IM_COL32(230, 230, 230, 255), kShade = IM_COL32(20, 20, 20, 170);
  ImDrawList* const list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled({line - kStrip / 2, 0}, {line + kStrip / 2, window.y}, kLine);
  const float y = window.y - 6.5f * unit;
  const auto label = [&](const std::string& text, float x) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list->AddRectFilled({x - 0.4f * unit, y - 0.3f * unit},
                        {x + size.x + 0.4f * unit, y + size.y + 0.3f * unit}, kShade, 3);
    list->AddText({x, y}, kLine, text.c_str());
  };
  label(left, line - unit - ImGui::CalcTextSize(left.c_str()).x);
  label(right, line + unit);

  ImGui::SetNextWindowPos({line - 0.5f * unit, 0});
  ImGui::SetNextWindowSize({unit, window.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("split", nullptr,
               kFixedWindow | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::InvisibleButton("line", {unit, window.y});
  const bool isDragged = ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.x != 0;
  if (ImGui::IsItemActive()) split = std::clamp(ImGui::GetIO().MousePos.x / window.x, 0.02f, 0.98f);
  ImGui::End();
  ImGui::PopStyleVar(2);
  return isDragged;
}

void layOutWaiting(const glm::vec2& window, const std::string& text) {
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::Begin("waiting", nullptr, kFittingWindow);
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

void layOutHelp(const glm::vec2& window) {
  ImGui::SetNextWindowPos({margin(), margin()});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {window.x - 2 * margin(), window.y - 2 * margin()});
  ImGui::Begin("help", nullptr, kFittingWindow);
  // In two halves where one is too tall.
  const std::vector<HelpRow> rows = helpRows();
  const size_t halves =
      float(rows.size() + 2) * ImGui::GetTextLineHeightWithSpacing() > window.y - 2 * margin() ? 2 : 1;
  const size_t tall = (rows.size() + halves - 1) / halves;
  if (ImGui::BeginTable("keys", int(2 * halves), ImGuiTableFlags_SizingFixedFit)) {
    for (size_t line = 0; line < tall; ++line) {
      ImGui::TableNextRow();
      for (size_t row = line; row < rows.size(); row += tall) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(rows[row].names.c_str());
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", rows[row].meaning);
      }
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

Notices::Notices(const glm::vec2& window) : window_(window), top_(margin()) {}

void Notices::begin(const char* name) {
  const float width = std::clamp(window_.x - panelWidth(window_) - margin(), 16 * margin(), 52 * margin());
  ImGui::SetNextWindowPos({margin(), top_});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::Begin(name, nullptr, kFixedWindow);
}

void Notices::end() {
  top_ += ImGui::GetWindowHeight() + 0.5f * margin();
  ImGui::End();
}

void Notices::problems(const std::map<Concern, std::string>& problems) {
  if (problems.empty()) return;
  begin("problem");
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.95f, 0.6f, 0.5f, 1));
  for (const auto& [concern, text] : problems) ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
  ImGui::TextDisabled("What was there before stays. Escape puts this away.");
  end();
}

Notices::Answer Notices::kept(const Recovery::Kept& kept) {
  Answer answer = Answer::none;
  begin("kept");
  ImGui::TextWrapped("%zu knob%s turned here and not saved (%s).", kept.edits.size(),
                     kept.edits.size() == 1 ? " was" : "s were", kept.when.c_str());
  if (ImGui::Button("Take")) answer = Answer::take;
  ImGui::SameLine();
  if (ImGui::Button("Throw away")) answer = Answer::throwAway;
  end();
  return answer;
}

bool Notices::job(const ExportJob& job) {
  const ExportJob::State state = job.state();
  begin("job");
  if (!state.isDone) {
    ImGui::TextWrapped("Making %s", job.file().c_str());
    ImGui::ProgressBar(float(state.part), {-6 * margin(), 0});
    ImGui::SameLine();
  } else if (state.problem.empty()) {
    ImGui::TextWrapped("%s is there.", job.file().c_str());
  } else {
    ImGui::TextWrapped("%s: %s", job.file().c_str(), state.problem.c_str());
  }
  const bool isClosed = ImGui::Button(state.isDone ? "Close" : "Stop");
  end();
  return isClosed;
}

}  // namespace scumble::viewer
