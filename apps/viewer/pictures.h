// Which pictures the window asks for, and what it has of them: the one that is looked at, another look beside
// it, what passes put out, small ones of all looks, and what lies where somebody has clicked.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "document.h"
#include "picture_maker.h"
#include "sharpness.h"

namespace scumble::viewer {

// What lies at a pixel.
struct Picked {
  std::string object, material;  // names, as looks set knobs for them; empty: nothing
  glm::vec3 place{0};            // metres, in the world, where there is something
};

// From where, and when, everything is seen.
struct Moment {
  Viewpoint viewpoint;
  uint64_t moves = 0;  // grows with each change of the viewpoint
  double time = 0;     // seconds
  Stereo stereo = Stereo::mono;
};

struct PictureOptions {
  uint32_t samples = 4, seed = 0;
  float ipd = 0.063f;  // metres
};

class Pictures {
 public:
  Pictures(std::unique_ptr<Renderer> renderer, const PictureOptions& options, std::function<void()> whenDone);

  const Renderer& renderer() const { return maker_.renderer(); }
  // What is shown moves, or moved just now; so it is drawn coarsely for a while.
  void moved(double now) { sharpness_.moved(now); }
  // It rests, and is to be drawn in full; and in how many seconds it will be.
  bool isDue(double now) const { return isCoarse_ && shown_ && !sharpness_.isMoving(now); }
  std::optional<double> untilDue(double now) const;

  // Nothing is seen for now, so nothing is due.
  void hide() { isCoarse_ = false; }

  // Asks for what is to be seen. `full`: pixels that one view has in the window. Each frame of the window, in
  // any order; what is not asked for between two calls of begin() is forgotten.
  void begin(const Document& document, const Moment& moment, const glm::uvec2& full, double now);
  void askForShown(bool savedLook);
  void askForOther(const std::string& name, const Look& look);  // of the same size
  // What passes put out, small, each of Renderer::aovNames(); and one of them in full with the facts.
  void askForThumbnails();
  void askForPass(const std::string& aov);                                   // empty: the facts alone
  void askForLooks(const std::vector<std::pair<std::string, Look>>& looks);  // small, each of a name
  void end();

  // Null before the first one of its kind.
  const std::shared_ptr<const Picture>& shown() const { return shown_; }
  std::shared_ptr<const Picture> other() const { return maker_.latest(kOther); }
  std::shared_ptr<const Picture> thumbnails() const { return maker_.latest(kThumbnails); }
  std::shared_ptr<const Picture> pass() const { return maker_.latest(kPass); }
  std::shared_ptr<const Picture> look(size_t number) const { return maker_.latest(kLooks + int(number)); }

  // Where, from 0 to 1 across what a view (1: the right eye's) has.
  void pick(const glm::vec2& place, size_t view);
  // What was picked last, once.
  std::optional<Picked> takePicked();

  // Takes what was drawn since; true where something of it is to be seen.
  bool poll();
  std::optional<Error> takeFailure() { return maker_.takeFailure(); }

 private:
  enum Purpose { kShown, kPick, kOther, kPass, kThumbnails, kLooks };
  struct Asked {
    uint64_t version = 0, moves = 0;
    double time = 0;
    glm::uvec2 size{0};
    Stereo stereo = Stereo::mono;
    std::string what;
    bool operator==(const Asked&) const = default;
  };
  void ask(int purpose, const glm::uvec2& size, const std::string& what, Wish wish);
  glm::uvec2 smallSize(uint32_t width) const;
  Wish wishOf(const Look& look) const;

  const PictureOptions options_;
  const bool isOnCpu_;
  PictureMaker maker_;
  Sharpness sharpness_;
  bool isCoarse_ = false;
  std::map<int, Asked> asked_;
  std::set<int> isAsked_;  // since begin()
  // Of the present begin().
  const Document* document_ = nullptr;
  Moment moment_;
  glm::uvec2 full_{0}, size_{0};
  std::shared_ptr<const Picture> shown_;
  std::optional<glm::vec2> picking_;  // to be asked for
  size_t pickView_ = 0;
  glm::vec2 pickedAt_{0};
  uint64_t pickNumber_ = 0;
  std::optional<Picked> picked_;
};

}  // namespace scumble::viewer
