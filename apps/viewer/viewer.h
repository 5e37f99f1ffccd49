// The window in which scenes are looked at.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "document.h"
#include "scumble/renderer.h"

namespace scumble::viewer {

// What a window shows, to be drawn elsewhere.
struct Shown {
  std::optional<Viewpoint> viewpoint;  // where it is not ViewerOptions::viewpoint
  std::string look;                    // as Document::lookName
  Edits edits;
  double time = 0;  // seconds
  uint32_t width = 0, height = 0;
};

struct ViewerOptions {
  std::string title;  // of the scene
  DocumentSources sources;
  // The words of a shell that draw the same picture.
  std::function<std::string(const Shown& shown)> command;
  Viewpoint viewpoint;  // until somebody moves the camera
  double time = 0;      // seconds
  uint32_t width = 1280, height = 720, samples = 4, seed = 0;
  RendererOptions renderer;
};

// Until the window is closed. Fails with noUsableGpu where there is no display or no device, and as loading
// the scene or the look does the first time.
Status runViewer(const ViewerOptions& options);

}  // namespace scumble::viewer
