// The panorama as it is put together: one layer of it, for one eye.
#pragma once

#include "panorama/tiling.h"
#include "scumble/image.h"

namespace scumble::panorama {

// How the numbers of a layer change on their way from a frame into the panorama.
struct Carry {
  bool isMixed = false;  // colours: filtered, and mixed where frames overlap; else the nearest frame's
  // What the first numbers are in pixels: the way since the frame before; that to where something is taken
  // from; two gradients.
  enum class Pixels { none, motion, vector, gradients } pixels = Pixels::none;
  // Which number is metres along the frame's axis, which become metres from the eye; as many as `nothing`
  // mean that nothing is there.
  int depth = -1;
  float nothing = 0;
};
Carry carryOf(const std::string& layer, bool isColor);

// Where a frame's part lies.
struct Place {
  size_t band;
  int part;
};

class Canvas {
 public:
  // A panorama of `width` by `height`, which shows so many radians of longitude.
  Canvas(const Tiling& tiling, uint32_t width, uint32_t height, float longitudes);

  // Adds what a frame shows of its part. `frame` holds floats, straight; every part is added once.
  void add(const Image& frame, Place place, Carry carry);
  // What has been put together, in a format.
  Image take(PixelFormat format);

 private:
  void addRow(const Image& frame, Place place, Carry carry, uint32_t y);

  const Tiling& tiling_;
  uint32_t width_, height_;
  float longitudes_;
  Image image_;
  bool isMixed_ = false;
};

}  // namespace scumble::panorama
