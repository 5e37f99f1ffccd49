// Options that several commands share, and what they mean.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scumble/renderer.h"

namespace scumble::app {

struct SceneArguments {
  std::vector<std::string> files, places;
  bool allowOutside = false;
  std::optional<int> sceneNumber;
  std::string patternCoordinates = "auto";

  // `without`: what is meant where no file is given; empty: one must be.
  void addTo(CLI::App& command, const std::string& without = "");
  // All files in one world, at their places, as these options ask for and `options` else; warnings go to
  // stderr.
  Result<Scene> load(bool quiet, SceneOptions options = {}) const;
};

struct LookArguments {
  std::string look;  // empty: SCENE.look.json if there is one, else the default look
  std::string clip;  // the only one that plays, by name or number; empty: as the look has it
  std::vector<std::string> settings;

  void addTo(CLI::App& command);
  // Its name or file.
  std::string lookFor(const std::string& sceneFile) const;
  // The look with all settings, which win over the clip; warnings go to stderr.
  Result<Look> load(const std::string& sceneFile, bool quiet) const;
  Result<Look> withClip(const Look& look, const Scene& scene) const;
  // Of what it sets to no effect in this scene.
  void warnOfIdle(const Look& look, const Scene& scene, const std::string& sceneFile) const;

 private:
  Status applySettings(Look& look) const;
};

struct PictureArguments {
  std::string camera, frame, orbit, eye, target, size = "1280x720", stereo;
  std::optional<float> roll, fov;
  std::optional<double> turntable;  // seconds
  int samples = 4;
  float ipd = 0.063f;
  const CLI::Option* ipdOption = nullptr;
  std::string device;
  uint32_t seed = 0;
  bool validate = false;

  void addTo(CLI::App& command);
  // Of these, for commands whose views have a size of their own.
  void addStandpointTo(CLI::App& command);  // where the camera is and what it looks at
  void addQualityTo(CLI::App& command);     // samples, seed, validation
  void addStereoTo(CLI::App& command);      // for commands that draw one view or two
  void addTurntableTo(CLI::App& command);   // for commands that draw films
  bool isStereo() const { return !stereo.empty(); }
  Result<RenderOptions> renderOptions() const;
  Result<Viewpoint> viewpoint() const;
  // Of options that count for nothing beside others.
  void warnOfIdle() const;
  // At a time in seconds.
  Result<std::vector<View>> views(const Scene& scene, const Look& look, double time = 0) const;
  RendererOptions rendererOptions() const;
};

// A file's ending in lower case, with its dot.
std::string endingOf(const std::string& path);
// "1280x720" and the like; nothing when it is not of that form.
std::optional<std::pair<uint32_t, uint32_t>> parseSize(const std::string& text);
// Numbers separated by commas, all finite.
std::optional<std::vector<double>> parseNumbers(const std::string& text);

// $XDG_CACHE_HOME/scumble or ~/.cache/scumble; empty where neither is known. The XDG Base Directory
// Specification has a relative path ignored.
std::string cacheFolder();
// Likewise $XDG_STATE_HOME/scumble or ~/.local/state/scumble: what outlives a run and is no setting.
std::string stateFolder();

}  // namespace scumble::app
