// Fields: what is measured of a picture. Numbers a pixel, and which pixels count.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "scumble/image.h"

namespace scumble::measuring {

// Where depths differ by more than this part, there is an edge between two surfaces: what lies on one must
// not be mixed or compared with what lies on the other.
constexpr float kSameSurface = 0.03f;

// Row 0 at the top. Places are in pixels from the left upper corner: the first pixel's centre is (0.5, 0.5).
struct Field {
  int width = 0, height = 0, channels = 1;
  std::vector<float> values;   // interleaved
  std::vector<uint8_t> valid;  // 1 where the pixel counts
  std::vector<float> depth;    // metres from the eye, where it is known; else empty

  Field() = default;
  Field(int w, int h, int channelCount);  // zeros, none of them valid

  size_t pixelCount() const { return valid.size(); }
  size_t validCount() const;
  // Whether both pixels count and lie on one surface: not on either side of a silhouette.
  bool isPair(size_t a, size_t b) const {
    return valid[a] && valid[b] &&
           (depth.empty() || std::abs(depth[a] - depth[b]) <= kSameSurface * std::min(depth[a], depth[b]));
  }
  const float* at(size_t pixel) const { return values.data() + pixel * size_t(channels); }
  float* at(size_t pixel) { return values.data() + pixel * size_t(channels); }
};

// `count` channels of a picture from `first` on, times `scale`. What counts are pixels whose `maskChannel` in
// `mask` is above 0, as far as their values are finite. Pictures of one size.
Field fieldOf(const Image& image, uint32_t first, uint32_t count, const Image& mask, uint32_t maskChannel,
              float scale = 1);

// Where to look something up: for each pixel a place in another field, valid where there is one.
using Places = Field;  // channels: x, y

// The field at these places, by a Lanczos kernel of three lobes: noise of half the highest frequency keeps
// its amplitude to a percent. Not valid where one of the 36 pixels that count is not.
Field sampleAt(const Field& field, const Places& places);

}  // namespace scumble::measuring
