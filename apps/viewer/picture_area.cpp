#include "picture_area.h"

#include <imgui.h>

#include "visible.h"

namespace scumble::viewer {

namespace {

PictureShown shownOf(const DeviceImage& image) {
  const VkExtent2D extent = image.extent();
  return {ImTextureID(image.view()), {extent.width, extent.height}};
}

// Numbers that have names.
std::string named(const std::vector<std::string>& names, float number) {
  return number >= 1 && size_t(number) <= names.size() ? names[size_t(number) - 1] : "nothing";
}

}  // namespace

glm::uvec2 PictureArea::viewSize(const glm::uvec2& window) const {
  return viewer::viewSize(window, isSeenByBoth() ? eyes_ : Eyes::one);
}

PictureArea::Place PictureArea::placeIn(glm::vec2 place) const {
  if (viewSize({2, 1}).x == 2) return {place, 0};
  const bool isAtRight = place.x >= 0.5f;
  place.x = 2 * place.x - (isAtRight ? 1.0f : 0.0f);
  return {place, isAtRight == (eyes_ == Eyes::sideBySide) ? 1u : 0u};
}

const Picture* PictureArea::keep(std::shared_ptr<const Picture> picture) {
  return picture ? shown_.emplace_back(std::move(picture)).get() : nullptr;
}

bool PictureArea::layOut(const glm::vec2& window, const Pictures& pictures) {
  const Picture* const picture = keep(pictures.shown());
  if (!picture) return false;
  PictureShown first = shownOf(picture->image);
  if (isSeenByBoth() && picture->right.handle() != VK_NULL_HANDLE) {
    layOutEyes(window, first, shownOf(picture->right), eyes_);
    return false;
  }
  if (!pass_.empty())
    if (const Picture* const pass = keep(pictures.pass()))
      for (const Picture::Layer& layer : pass->layers)
        if (layer.aov == pass_) first = shownOf(layer.shown);
  const Picture* const other = isSplit() ? keep(pictures.other()) : nullptr;
  const PictureShown second = other ? shownOf(other->image) : PictureShown();
  layOutPicture(window, first, other ? &second : nullptr, line_);
  return isSplit() &&
         layOutSplit(window, "as it is", otherLook_.empty() ? "as it is saved" : otherLook_, line_);
}

std::string PictureArea::pixelFacts(const glm::vec2& mouse, const Pictures& pictures) const {
  const std::shared_ptr<const Picture> pass = pictures.pass();
  const glm::vec2 window{ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y};
  if (!pass || isSeenByBoth() || ImGui::GetIO().WantCaptureMouse ||
      glm::any(glm::lessThan(mouse, glm::vec2(0))) || glm::any(glm::greaterThanEqual(mouse, window)))
    return "";
  std::string text;
  for (const Picture::Layer& layer : pass->layers) {
    const glm::uvec2 size{layer.values.width, layer.values.height};
    const glm::uvec2 at = glm::min(glm::uvec2(mouse / window * glm::vec2(size)), size - 1u);
    text += (text.empty() ? "" : "\n") + layer.aov + ": ";
    text += layer.aov == "id" ? named(pass->objects, layer.values.at(at.x, at.y, 0)) + ", " +
                                    named(pass->materials, layer.values.at(at.x, at.y, 1))
                              : pixelText(layer.values, at.x, at.y);
  }
  return text;
}

}  // namespace scumble::viewer
