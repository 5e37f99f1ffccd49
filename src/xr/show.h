// A scene in a headset: what `scumble xr` does. OpenXR 1.0, through the loader that is installed, and
// XR_KHR_vulkan_enable2.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scumble/renderer.h"

namespace scumble::xr {

// Both eyes of a head that looks straight ahead from a camera, as headsets of 2023 see: 2064 x 2208 pixels
// each, 94 degrees wide and 99 high, more of them outwards and down. For measuring without one. Fails as
// makeViews does.
Result<std::vector<View>> usualEyes(const Scene& scene, const Look& look, const Viewpoint& viewpoint,
                                    double time);

// What those who do not wear the headset see: another view of the same frames, with a steadier head.
struct Spectator {
  glm::uvec2 size{1280, 720};  // pixels
  float verticalFov = 60;      // degrees
  float inertia = 0.3f;        // seconds in which its head comes nearer by two thirds; 0: it is the wearer's
  // Each frame, when it is done: its picture in codes, and when it was to be seen, in seconds since the first
  // one, of which times when nothing was seen count one at most. Called by the thread that shows; what takes
  // long belongs on another one.
  std::function<void(std::shared_ptr<const Image> picture, double seconds)> see;
};

// Whether the runtime is told what it takes to make every other frame by itself: never, always, or from when
// on the device is late with as few pixels as there may be.
enum class FrameSynthesis { off, on, whenLate };

struct ShowOptions {
  Scene scene;
  // What it looks like, and what a hand may have instead, by their names: there is one at least.
  std::vector<std::pair<std::string, Look>> looks;
  // The camera: who wears the headset is at its place, looks where it does, and keeps the horizon.
  Viewpoint viewpoint;
  double time = 0;          // seconds, when the first frame is seen; it goes on from there
  bool isStanding = false;  // the floor lies 1.6 m below the camera; else the head is at the camera
  float scale = 1;          // metres of the scene that are one of the room
  bool hasVignette = true;  // while hands move who wears it, it is dark around what is looked at
  float refreshRate = 90;   // frames a second, as near as the headset has it; 0: as it is
  // Of the pixels of both sides of an eye that the runtime recommends, 0.1 to 1; none: as many as there is
  // time for, from half of them on.
  std::optional<float> resolution;
  FrameSynthesis synthesis = FrameSynthesis::off;
  std::optional<Spectator> spectator;
  // Looks that a hand may have are made ready beforehand as long as this takes, seconds; others are when they
  // are taken.
  double readying = 3;
  uint32_t samples = 4, seed = 0;
  RendererOptions renderer;        // `device` means nothing: the runtime chooses
  std::optional<uint64_t> frames;  // ends when so many were drawn; none: when the runtime or somebody ends it
  std::function<bool()> isEnding;  // asked once a frame: whether somebody ends it
  std::function<void(const std::string&)> tell;  // a line for who is at the keyboard
  // One for what hands have changed: where a thing is now, and options that give the colours.
  std::function<void(const std::string&)> changed;
};

struct ShowReport {
  uint64_t frames = 0;  // that were drawn
  int validationMessages = 0;
};
class Instance;

// The runtime that is there, and its headset.
class Headset {
 public:
  // Fails with noUsableGpu where there is no loader, no runtime, or one without Vulkan.
  static Result<std::unique_ptr<Headset>> find();
  ~Headset();
  Headset(const Headset&) = delete;
  Headset& operator=(const Headset&) = delete;

  const std::string& runtime() const;  // its name and version
  const std::string& name() const;     // of the headset; empty: the runtime has none now
  const std::optional<Error>& lack() const { return lack_; }  // why it has none

  // Returns when the session has ended. A session that is lost begins anew as soon as the headset is there
  // again; where no frame is seen for a minute then, and where the runtime ends, it fails with noUsableGpu.
  Result<ShowReport> show(const ShowOptions& options);

 private:
  explicit Headset(std::unique_ptr<Instance> instance);

  std::unique_ptr<Instance> instance_;
  std::optional<Error> lack_;
};

}  // namespace scumble::xr
