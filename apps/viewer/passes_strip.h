// What each pass has put out, small and beside each other, and how long the steps of a frame take.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "picture_maker.h"

namespace scumble::viewer {

class PassesStrip {
 public:
  // Which one is seen in full; empty: the picture itself.
  const std::string& chosen() const { return chosen_; }
  void choose(const std::string& aov) { chosen_ = aov; }
  // `thumbnails`: null where they are not there yet. `times`: a picture in full, null likewise. `pixel`: a
  // few words about what is under the mouse, of lines; empty: nothing.
  // `room`: the place in the window that is left to it.
  void layOut(const glm::vec2& room, const Picture* thumbnails, const Picture* times,
              const std::string& pixel);

 private:
  std::string chosen_;
};

}  // namespace scumble::viewer
