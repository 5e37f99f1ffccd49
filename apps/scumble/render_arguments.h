// The options of a render call, and what they come to: scene, look, views, frames and files, checked as far
// as they can be without a device.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "background.h"
#include "options.h"
#include "output_files.h"
#include "outputs.h"
#include "panorama_kind.h"

namespace scumble::app {

struct RenderArguments {
  SceneArguments scene;
  LookArguments look;
  PictureArguments picture;
  std::string output, frames, background, panorama, stats, graph, exr = "float,zip", svg = "outlines";
  std::vector<std::string> aovs;
  std::optional<double> time;  // seconds
  double fps = 24;
  float strip = Panorama().strip;
  std::optional<int> quality;
  bool quiet = false, resume = false, missing = false;

  // What says which pictures are drawn; it stays the same in whatever portions they are drawn.
  void addTo(CLI::App& command);
  // What says how a call goes.
  void addCallTo(CLI::App& command);

  bool isGiven(const char* option) const { return command_->count(option) > 0; }

  // What is said of a panorama, as options that every picture has.
  Status choosePanorama();
  const PanoramaKindRow* kind = nullptr;  // null: no panorama
  // Of a panorama, that and where it is seen from.
  Panorama wanted() const {
    return {kind->kind, picture.ipd, picture.fov.value_or(Panorama().knobHeight), strip};
  }
  PictureArguments camera() const;

 private:
  const CLI::App* command_ = nullptr;
};

// "3..5": 3, 4 and 5. Fails with usage for what is not of that form.
Result<std::vector<int>> parseFrames(const std::string& text);
// Fails with usage where it is out of range.
Status checkFps(double fps);

struct RenderPlan {
  RenderArguments args;
  Background background;
  RenderOptions options;
  OutputPlan output;
  Look look;
  Scene scene;
  std::vector<View> views;   // of all frames, unless they move
  std::vector<int> numbers;  // of the frames to draw, with those that a film has; none for a single picture
  bool isPicture = false;    // a single one, at `args.time`

  bool isFilm() const { return output.kind() == OutputKind::film; }
  // Of what is drawn, in seconds.
  std::vector<double> times() const;
  // Everything that is read: scenes, the look, their files, the background.
  std::vector<std::string> inputs() const;
};

// Warnings go to stderr.
Result<RenderPlan> planRender(RenderArguments args);

}  // namespace scumble::app
