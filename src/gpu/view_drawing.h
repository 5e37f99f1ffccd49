// Rendering into the layers of images, one layer a view: all views at once by multiview, or one after the
// other where a driver gets that wrong.
#pragma once

#include <functional>
#include <span>

#include "gpu/resources.h"

namespace scumble::gpu {

// The views that are drawn, and how.
struct Views {
  uint32_t count = 1;
  ViewDrawing drawing = ViewDrawing::together;
  bool operator==(const Views&) const = default;
  // What pipelines are made with.
  uint32_t mask() const { return drawing == ViewDrawing::together ? (1u << count) - 1 : 1; }
};

// What is drawn into.
struct Target {
  const Image* image = nullptr;
  const Image* resolve = nullptr;  // null where `image` has one sample
  VkClearValue clear{};
  enum class Before : uint8_t {
    cleared,
    undefined,
    kept,
    tested                     // depth that stays as it is (Use::depthTest)
  } before = Before::cleared;  // what is in it to begin with
  bool keepsSamples = false;   // they are read later, besides what they are resolved into
};

// Begins rendering into targets of one size, calls `draw` with the number of the first view that it draws,
// and ends rendering: once for all views, or once for each. `depth` may be null.
void drawViews(VkCommandBuffer commands, const Views& views, std::span<const Target> colors,
               const Target* depth, const std::function<void(uint32_t firstView)>& draw);

// The same for what is drawn once a frame, whatever the views.
void drawOnce(VkCommandBuffer commands, std::span<const Target> colors, const Target* depth,
              const std::function<void()>& draw);

}  // namespace scumble::gpu
