// The time, and the tracks of knobs over it.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "document.h"
#include "playback.h"

namespace scumble::viewer {

class Timeline {
 public:
  struct Change {
    bool isMoved = false, isTurned = false;  // the time; a track
    std::optional<std::string> clip;         // that was chosen; empty: as the look has it
    std::optional<double> duration;          // that was set
  };
  // At the bottom of the window. Gives what somebody has done.
  Change layOut(const glm::vec2& window, Playback& playback, const std::vector<std::string>& clips,
                Document& document);
  // Pixels that it took last, from the bottom up.
  float height() const { return height_; }
  // Which track is to be edited: by its setting's path.
  void choose(const std::string& path) { chosen_ = path, key_.reset(), isOpen_ = true; }
  const std::string& chosen() const { return chosen_; }

 private:
  void layOutBar(float width, Playback& playback, const std::vector<std::string>& clips,
                 const Document& document, bool hasTracks, Change& change);
  void layOutLane(const std::string& path, const KnobTrack& track, Playback& playback, Document& document,
                  Change& change);
  void layOutChosen(const KnobTrack& track, double time, Document& document, Change& change);
  void put(const std::string& path, const KnobTrack& track, Document& document, Change& change);

  std::string chosen_;
  std::optional<size_t> key_;  // of the chosen track
  bool isOpen_ = false;
  float height_ = 0;
};

// Settings whose tracks count by their paths, sorted, but for those of patterns of names.
std::vector<std::string> tracksOf(const Look& look);

}  // namespace scumble::viewer
