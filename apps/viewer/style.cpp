#include "style.h"

#include <fontconfig/fontconfig.h>
#include <imgui.h>

#include <string>

namespace scumble::viewer {

namespace {

constexpr float kLetters = 15;  // pixels high, at scale 1

// Of the system's plain letters; empty where there are none.
std::string letterFile() {
  std::string file;
  FcPattern* const wanted =
      FcNameParse(reinterpret_cast<const FcChar8*>("sans:weight=80:slant=0:scalable=true"));
  if (!wanted) return file;
  FcConfigSubstitute(nullptr, wanted, FcMatchPattern);
  FcDefaultSubstitute(wanted);
  FcResult result = FcResultNoMatch;
  if (FcPattern* const found = FcFontMatch(nullptr, wanted, &result)) {
    FcChar8* name = nullptr;
    if (FcPatternGetString(found, FC_FILE, 0, &name) == FcResultMatch)
      file = reinterpret_cast<const char*>(name);
    FcPatternDestroy(found);
  }
  FcPatternDestroy(wanted);
  return file;
}

ImVec4 grey(float level, float alpha = 1) {
  return {level, level, level, alpha};
}

}  // namespace

void setStyle(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  const std::string file = letterFile();
  // Letters, and what names of files need in Europe.
  static const ImWchar kRanges[] = {0x20,   0x24F,  0x370,  0x52F,  0x2000, 0x206F,
                                    0x2190, 0x21FF, 0x25A0, 0x25FF, 0};
  if (file.empty() || !io.Fonts->AddFontFromFileTTF(file.c_str(), kLetters * scale, nullptr, kRanges)) {
    ImFontConfig config;
    config.SizePixels = 13 * scale;
    io.Fonts->AddFontDefault(&config);
  }

  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  style.WindowRounding = 4, style.FrameRounding = style.GrabRounding = style.PopupRounding = 3;
  style.WindowBorderSize = style.PopupBorderSize = 0;
  style.WindowPadding = {12, 10}, style.FramePadding = {7, 4}, style.ItemSpacing = {8, 6};
  style.ScaleAllSizes(scale);
  ImGui::StyleColorsDark(&style);
  ImVec4* const colors = style.Colors;
  colors[ImGuiCol_Text] = grey(0.86f);
  colors[ImGuiCol_TextDisabled] = grey(0.55f);
  colors[ImGuiCol_WindowBg] = colors[ImGuiCol_PopupBg] = grey(0.13f, 0.94f);
  colors[ImGuiCol_FrameBg] = grey(0.2f), colors[ImGuiCol_FrameBgHovered] = grey(0.25f);
  colors[ImGuiCol_FrameBgActive] = grey(0.3f);
  colors[ImGuiCol_Button] = grey(0.24f), colors[ImGuiCol_ButtonHovered] = grey(0.31f);
  colors[ImGuiCol_ButtonActive] = grey(0.38f);
  colors[ImGuiCol_Header] = grey(0.27f), colors[ImGuiCol_HeaderHovered] = grey(0.31f);
  colors[ImGuiCol_HeaderActive] = grey(0.36f);
  colors[ImGuiCol_SliderGrab] = grey(0.55f), colors[ImGuiCol_SliderGrabActive] = grey(0.72f);
  colors[ImGuiCol_CheckMark] = grey(0.8f);
  colors[ImGuiCol_Separator] = grey(0.26f);
  colors[ImGuiCol_ScrollbarBg] = grey(0.13f, 0), colors[ImGuiCol_ScrollbarGrab] = grey(0.3f);
  colors[ImGuiCol_TextSelectedBg] = grey(0.4f);
}

}  // namespace scumble::viewer
