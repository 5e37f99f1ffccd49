// What each pass has put out, small and beside each other, and how long the steps of a frame take.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "picture_maker.h"

namespace scumble::viewer {

// `chosen`: which one is seen in full; empty: the picture itself. `thumbnails`: null where they are not there
// yet. `times`: a picture in full, null likewise. `pixel`: a few words about what is under the mouse, of
// lines; empty: nothing. `room`: the place in the window that is left to it.
void layOutPasses(const glm::vec2& room, std::string& chosen, const Picture* thumbnails, const Picture* times,
                  const std::string& pixel);

}  // namespace scumble::viewer
