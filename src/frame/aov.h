// What a pass lets users save beside the picture, and how its image is to be read.
#pragma once

#include <array>
#include <cstdint>

namespace scumble::frame {

struct Aov {
  const char* name;
  // Of one image after the other; those that are not named mean nothing.
  std::array<const char*, 8> channels{"R", "G", "B", "A"};
  bool isColor = false;
  // So many of the first channels were accumulated under the coverage in the fourth one.
  uint8_t premultiplied = 0;
  bool isSquareRoot = false;  // R, G and B: of linear colour
  bool needsFloat = false;    // metres, positions, numbers of objects: halves are too coarse
  bool isOnce = false;        // one image for all views
  bool hasOwnSize = false;    // not the frame's
  bool namesObjects = false;  // holds numbers of Frame::objects
  bool isInternal = false;    // for the library's own use: users do not know the name
};

}  // namespace scumble::frame
