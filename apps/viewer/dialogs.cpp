#include "dialogs.h"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>

#include "export_job.h"
#include "inspector.h"
#include "interface.h"
#include "knob_text.h"
#include "panel.h"

namespace scumble::viewer {

namespace {

std::string lowerEndingOf(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

std::string nameOf(const std::string& file) {
  return std::filesystem::path(file).filename().string();
}

// Of folders, too, which come with a slash at the end from some programs.
std::string withoutSlash(std::string file) {
  while (file.size() > 1 && file.back() == '/') file.pop_back();
  return file;
}

template <size_t kSize>
void put(char (&typed)[kSize], const std::string& text) {
  std::strncpy(typed, text.c_str(), kSize - 1);
  typed[kSize - 1] = 0;
}

void begin(const glm::vec2& window, const char* id, const std::string& title, float width) {
  const float unit = ImGui::GetFontSize();
  // Beside the panel, where there is room for both.
  const float room = window.x - panelWidth(window), wide = std::min(width * unit, window.x - 2 * unit);
  ImGui::SetNextWindowPos({wide < room ? room / 2 : window.x / 2, window.y * 0.4f}, ImGuiCond_Always,
                          {0.5f, 0.5f});
  ImGui::SetNextWindowSize({wide, 0});
  ImGui::SetNextWindowBgAlpha(1);
  ImGui::Begin(id, nullptr, kFixedWindow);
  if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
  ImGui::TextUnformatted(title.c_str());
  ImGui::Separator();
}

}  // namespace

// ---- What is to be seen

std::optional<OpenWish> OpenDialog::layOut(const glm::vec2& window) {
  std::optional<OpenWish> wish;
  begin(window, "open", "Open a scene", 36);
  ImGui::TextDisabled("Files can be dropped on the window, too.");
  for (const std::string& file : recent_) {
    ImGui::PushID(file.c_str());
    if (ImGui::Button("Add")) wish = {{file}, true};
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Beside what is there");
    ImGui::SameLine();
    if (ImGui::Selectable(nameOf(file).c_str())) wish = {{file}, false};
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", file.c_str());
    ImGui::PopID();
  }
  ImGui::Separator();
  ImGui::SetNextItemWidth(-1);
  const bool isEntered = ImGui::InputTextWithHint("##file", "A file's name", typed_, sizeof typed_,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
  const bool isTyped = typed_[0] != 0;
  if ((ImGui::Button("Open") || isEntered) && isTyped) wish = {{typed_}, false};
  ImGui::SameLine();
  if (ImGui::Button("Add") && isTyped) wish = {{typed_}, true};
  ImGui::SameLine();
  if (ImGui::Button("Close")) close();
  ImGui::End();
  if (wish) close();
  return wish;
}

// ---- What is to be made

void SaveDialog::open(const std::string& file, const glm::uvec2& size, bool isFilm) {
  isOpen_ = true;
  from_ = file, present_ = size, isFilm_ = isFilm;
  if (wish_.size == glm::uvec2(0)) wish_.size = size;
  if (!isFilm && wish_.kind == SaveWish::Kind::film) wish_.kind = SaveWish::Kind::picture;
  name();
}

void SaveDialog::name() {
  const bool isPicture = wish_.kind == SaveWish::Kind::picture;
  put(typed_,
      freeName(from_, wish_.kind == SaveWish::Kind::turn ? "-turn" : "", isPicture ? ".png" : ".mp4"));
}

std::optional<SaveWish> SaveDialog::layOut(const glm::vec2& window) {
  const float unit = ImGui::GetFontSize();
  std::optional<SaveWish> wish;
  begin(window, "save", "Save a picture or a film", 34);
  const auto kind = [&](const char* label, SaveWish::Kind which) {
    if (ImGui::RadioButton(label, wish_.kind == which)) wish_.kind = which, name();
  };
  kind("This picture", SaveWish::Kind::picture);
  ImGui::SameLine();
  kind("A turn around it", SaveWish::Kind::turn);
  if (isFilm_) {
    ImGui::SameLine();
    kind("What plays", SaveWish::Kind::film);
  }
  if (wish_.kind == SaveWish::Kind::turn) {
    ImGui::SetNextItemWidth(12 * unit);
    ImGui::SliderFloat("##seconds", &wish_.seconds, 1, 60, "%.0f s once around",
                       ImGuiSliderFlags_AlwaysClamp);
  }
  const glm::uvec2 sizes[] = {present_, {1280, 720}, {1920, 1080}, {3840, 2160}};
  const auto label = [](const glm::uvec2& size) {
    return std::to_string(size.x) + " x " + std::to_string(size.y);
  };
  ImGui::SetNextItemWidth(12 * unit);
  if (ImGui::BeginCombo("##size", label(wish_.size).c_str())) {
    for (const glm::uvec2& size : sizes)
      if (ImGui::Selectable(label(size).c_str(), size == wish_.size)) wish_.size = size;
    ImGui::EndCombo();
  }
  ImGui::SetNextItemWidth(-1);
  ImGui::InputText("##file", typed_, sizeof typed_);
  if (ImGui::Button("Save") && typed_[0] != 0) {
    wish = wish_;
    wish->file = typed_;
  }
  ImGui::SameLine();
  if (ImGui::Button("Close") || wish) close();
  ImGui::End();
  return wish;
}

// ---- What was dropped

Drop sorted(const std::vector<std::string>& files) {
  Drop drop;
  for (const std::string& dropped : files) {
    const std::string file = withoutSlash(dropped), ending = lowerEndingOf(file);
    std::error_code error;
    if (ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".webp")
      drop.pictures.push_back(file);
    else if (ending == ".json")
      (file.ends_with(".look.json") || Look::load(file) ? drop.looks : drop.scenes).push_back(file);
    else if (ending == ".gltf" || ending == ".glb" || ending == ".tilt" || ending == ".apa" ||
             std::filesystem::is_directory(file, error))
      drop.scenes.push_back(file);
    else
      drop.others.push_back(file);
  }
  return drop;
}

std::optional<DropDialog::Answer> DropDialog::layOut(const glm::vec2& window) {
  std::optional<Answer> answer;
  const bool isScene = !drop_.scenes.empty();
  const std::string& first = isScene ? drop_.scenes[0] : drop_.pictures[0];
  begin(window, "drop", nameOf(first), 26);
  const ImVec2 wide{-1, 0};
  if (isScene) {
    if (ImGui::Button("Open", wide)) answer = {{{drop_.scenes, false}}, "", "", ""};
    if (ImGui::Button("Add to what is there", wide)) answer = {{{drop_.scenes, true}}, "", "", ""};
  } else {
    if (ImGui::Button("Put behind everything", wide)) answer = {{}, first, "", ""};
    ImGui::TextDisabled("Or take it for a knob:");
    ImGui::BeginChild("knobs", {0, 12 * ImGui::GetTextLineHeightWithSpacing()});
    const auto offer = [&](const Target& target) {
      for (const Knob& knob : allKnobs()) {
        if (knob.type != "picture" || !isSetFor(knob, target.section.empty() ? "scene" : target.section))
          continue;
        ImGui::PushID(target.section.c_str());
        if (ImGui::Selectable(knob.path.c_str())) answer = {{}, "", target.path(knob), first};
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", knob.meaning.c_str());
        ImGui::PopID();
      }
    };
    if (!material_.empty()) {
      ImGui::TextDisabled("Of %s alone:", material_.c_str());
      offer({"materials", material_});
      ImGui::TextDisabled("Of everything:");
    }
    offer({});
    ImGui::EndChild();
  }
  const bool isLeft = ImGui::Button("Cancel", wide);
  ImGui::End();
  // One after the other.
  if (answer || isLeft) {
    if (isScene)
      drop_.scenes.clear();
    else
      drop_.pictures.erase(drop_.pictures.begin());
  }
  return answer;
}

}  // namespace scumble::viewer
