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
  Opened opened;
  std::optional<Viewpoint> viewpoint;  // where it is not ViewerOptions::viewpoint
  Edits edits;
  double time = 0;  // seconds
  uint32_t width = 0, height = 0;
  // A film, instead of the picture at that time: so many seconds of what plays, from its start, or once
  // around.
  struct Film {
    bool isTurn = false;
    double seconds = 0;
  };
  std::optional<Film> film;
  std::string stereo;  // how both eyes lie in it, as `render --stereo` takes it; empty: one eye
};

struct ViewerOptions {
  DocumentSources sources;
  // The words of the command that draws the same picture, without where it is saved.
  std::function<std::vector<std::string>(const Shown& shown)> command;
  Viewpoint viewpoint;  // of the scenes that it is opened with, until somebody moves the camera
  double time = 0;      // seconds
  uint32_t width = 1280, height = 720, samples = 4, seed = 0;
  std::string stereo;  // how both eyes are seen at first, where the window knows that; empty: one is
  float ipd = 0.063f;  // metres
  RendererOptions renderer;
  std::string shaderBuild;  // the folder of a build whose shaders are compiled as they are saved; empty: none
  std::string stateFolder;  // where it keeps what is not saved, and what was opened last; empty: nowhere
};

// Until the window is closed. Fails with noUsableGpu where there is no display or no device, and as loading
// the scene or the look does the first time.
Status runViewer(const ViewerOptions& options);

}  // namespace scumble::viewer
