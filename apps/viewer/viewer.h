// The window in which scenes are looked at.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scumble/renderer.h"

namespace scumble::viewer {

struct ViewerOptions {
  std::string title;                    // of the scene
  std::vector<std::string> sceneFiles;  // read anew when one is saved, as are those that they name
  std::string lookFile;                 // likewise; empty: the look ships
  // Called from other threads, one of them at a time, and again when a file was saved.
  std::function<Result<Scene>()> loadScene;
  std::function<Result<Look>(const Scene& scene)> loadLook;
  // The words of a shell that draw the same picture: from a viewpoint, or from the one below where it is
  // empty.
  std::function<std::string(const std::optional<Viewpoint>& viewpoint, double time, uint32_t width,
                            uint32_t height)>
      command;
  Viewpoint viewpoint;  // until somebody moves the camera
  double time = 0;      // seconds
  uint32_t width = 1280, height = 720, samples = 4, seed = 0;
  RendererOptions renderer;
};

// Until the window is closed. Fails with noUsableGpu where there is no display or no device, and as loading
// the scene or the look does the first time.
Status runViewer(const ViewerOptions& options);

}  // namespace scumble::viewer
