// Which way of drawing several views a device gets right. Drivers are not asked, and not known by name: two
// layers are drawn, cleared, resolved and read back, with the code that frames are drawn with. Mesa 22.3's
// llvmpipe draws what covers whole tiles into the first layer, whatever the view; SwiftShader resolves the
// first layer alone. Neither says a word.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gpu/view_drawing.h"

namespace scumble::gpu {

// What the probe reads back, layer by layer: two colours a pixel, each R in [0, 255], and the depth.
struct ProbePicture {
  static constexpr uint32_t kSize =
      96;  // pixels a side: a whole tile of a tiled rasteriser, and parts of others
  struct Layer {
    std::vector<uint8_t> byVertexShader, byFragmentShader;
    std::vector<float> depth;
  };
  std::array<Layer, 2> layers;
};

// Whether each layer holds its own view: the shape where it is drawn, and what was cleared elsewhere. Pixels
// on the shape's edge are not looked at.
bool isRight(const ProbePicture& picture);

// Draws with one way.
ProbePicture drawProbe(Device& device, ViewDrawing drawing, uint32_t samples);

// The fastest way that is right at this number of samples, and at one sample, which image passes have;
// nothing where none is.
std::optional<ViewDrawing> findViewDrawing(Device& device, uint32_t samples);

// The answers as they are kept on disk, with the driver's own words before them. What is not about this
// driver counts as not being there.
std::optional<ViewDrawings> readViewDrawings(const std::string& file, const std::string& driver);
void writeViewDrawings(const std::string& file, const std::string& driver, const ViewDrawings& drawings);

}  // namespace scumble::gpu
