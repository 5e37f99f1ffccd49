#include "passes_strip.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "interface.h"

namespace scumble::viewer {

namespace {

constexpr float kTimesWidth = 17;  // in heights of letters

void layOutTimes(const Picture& picture) {
  double longest = 1e-9;
  for (const PassTime& step : picture.steps) longest = std::max(longest, step.milliseconds);
  for (const PassTime& step : picture.steps) {
    const std::string text = fmt::format("{} {:.2f} ms", step.name, step.milliseconds);
    ImGui::ProgressBar(float(step.milliseconds / longest), {-1, 0}, text.c_str());
  }
}

}  // namespace

void layOutPasses(const glm::vec2& room, std::string& chosen, const Picture* thumbnails, const Picture* times,
                  const std::string& pixel) {
  const float unit = ImGui::GetFontSize(), height = 10.5f * unit;
  ImGui::SetNextWindowPos({unit, room.y - unit}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSize({std::max(room.x - 2 * unit, 16 * unit), height});
  ImGui::Begin("passes", nullptr, kFixedWindow);
  ImGui::BeginChild("times", {kTimesWidth * unit, 0});
  if (!pixel.empty())
    ImGui::TextWrapped("%s", pixel.c_str());
  else if (times && !times->steps.empty())
    layOutTimes(*times);
  else
    ImGui::TextDisabled("No times yet");
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("thumbnails", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
  const float tall = height - 4.8f * unit;
  const auto cell = [&](const std::string& aov, const char* label, const DeviceImage& image) {
    const VkExtent2D extent = image.extent();
    const float width = std::clamp(tall * float(extent.width) / float(extent.height), 2 * unit, 3 * tall);
    ImGui::PushID(label);
    ImGui::BeginGroup();
    const bool isChosen = chosen == aov;
    if (isChosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (ImGui::ImageButton(ImTextureID(image.view()), {width, tall}, {0, 0}, {1, 1}, 3)) chosen = aov;
    if (isChosen) ImGui::PopStyleColor();
    ImGui::TextUnformatted(label);
    ImGui::EndGroup();
    ImGui::PopID();
    ImGui::SameLine();
  };
  if (thumbnails) {
    cell("", "picture", thumbnails->image);
    for (const Picture::Layer& layer : thumbnails->layers) cell(layer.aov, layer.aov.c_str(), layer.shown);
  } else {
    ImGui::TextDisabled("Drawing what passes put out");
  }
  ImGui::EndChild();
  ImGui::End();
}

}  // namespace scumble::viewer
