#include "panorama/canvas.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/packing.hpp>

#include "base/srgb.h"
#include "scene/parallel.h"

namespace scumble::panorama {

namespace {

// Weights of four neighbours, a Catmull-Rom spline: `t` of the way from the second to the third.
glm::vec4 splineOf(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return 0.5f * glm::vec4(-t + 2 * t2 - t3, 2 - 5 * t2 + 3 * t3, t + 4 * t2 - 3 * t3, t3 - t2);
}

// The way between a part's picture and the panorama; pixels, from their upper left corners.
class Way {
 public:
  Way(const Tiling& tiling, Place place, float longitudes, uint32_t width, uint32_t height)
      : turn_(turnOf(tiling.bands[place.band].longitudeOf(place.part), tiling.bands[place.band].latitude)),
        toEye_(glm::transpose(turn_)),
        middle_(0.5f * glm::vec2(tiling.bands[place.band].size)),
        pixelsOfRadian_(tiling.pixelsOfRadian),
        scale_(float(width) / longitudes, float(height) / glm::pi<float>()),
        origin_(0.5f * glm::vec2(width, height)) {}

  glm::vec2 toFrame(const glm::vec2& pixel) const {
    const glm::vec2 angle = (pixel - origin_) / scale_;
    const float out = std::cos(angle.y);
    const glm::vec3 d =
        toEye_ * glm::vec3(std::sin(angle.x) * out, -std::sin(angle.y), -std::cos(angle.x) * out);
    return middle_ + pixelsOfRadian_ / -d.z * glm::vec2(d.x, -d.y);
  }
  glm::vec2 toPanorama(const glm::vec2& pixel) const {
    const glm::vec2 side = (pixel - middle_) / pixelsOfRadian_;
    const glm::vec3 d = glm::normalize(turn_ * glm::vec3(side.x, -side.y, -1));
    return origin_ + scale_ * glm::vec2(std::atan2(d.x, -d.z), -std::asin(std::clamp(d.y, -1.0f, 1.0f)));
  }
  // Between two places of the panorama, the short way around.
  glm::vec2 between(const glm::vec2& from, const glm::vec2& to) const {
    glm::vec2 way = to - from;
    way.x -= kTurn * scale_.x * std::round(way.x / (kTurn * scale_.x));
    return way;
  }
  // How much farther than along the axis it is through a pixel.
  float lengthening(const glm::vec2& pixel) const {
    const glm::vec2 side = (pixel - middle_) / pixelsOfRadian_;
    return std::sqrt(1 + glm::dot(side, side));
  }

 private:
  glm::mat3 turn_, toEye_;
  glm::vec2 middle_;
  float pixelsOfRadian_;
  glm::vec2 scale_, origin_;
};

}  // namespace

Carry carryOf(const std::string& layer, bool isColor) {
  constexpr float kNothing = 1e29f, kFarthestHalf = 59999;
  if (layer == "depth") return {.depth = 0, .nothing = kNothing};
  if (layer == "warp") return {.pixels = Carry::Pixels::vector, .depth = 3, .nothing = kFarthestHalf};
  if (layer == "blur") return {.depth = 2, .nothing = kFarthestHalf};
  if (layer == "motion") return {.pixels = Carry::Pixels::motion};
  if (layer == "uv-gradient") return {.pixels = Carry::Pixels::gradients};
  return {.isMixed = isColor};
}

Canvas::Canvas(const Tiling& tiling, uint32_t width, uint32_t height, float longitudes)
    : tiling_(tiling), width_(width), height_(height), longitudes_(longitudes) {}

void Canvas::add(const Image& frame, Place place, Carry carry) {
  if (image_.width == 0) {
    image_ = {width_, height_, frame.channels, {}, frame.isColor};
    image_.pixels.resize(size_t(width_) * height_ * frame.channels.size());
    isMixed_ = carry.isMixed;
  }
  const Band& band = tiling_.bands[place.band];
  const auto rowOf = [&](float latitude) { return (0.5f - latitude / glm::pi<float>()) * float(height_); };
  const int first = std::max(int(rowOf(band.latitude + kShareEnds * band.above)) - 1, 0);
  const int end = std::min(int(rowOf(band.latitude - kShareEnds * band.below)) + 2, int(height_));
  if (end <= first) return;
  scene::parallelFor(size_t(end - first), scene::threadCount(0),
                     [&](size_t row) { addRow(frame, place, carry, uint32_t(first) + uint32_t(row)); });
}

void Canvas::addRow(const Image& frame, Place place, Carry carry, uint32_t y) {
  const Band& band = tiling_.bands[place.band];
  const float latitude = (0.5f - (float(y) + 0.5f) / float(height_)) * glm::pi<float>();
  const float up = latitude - band.latitude;
  const float towards = up < 0 ? band.below : band.above;
  const float rowShare = towards > 0 ? shareAt(up, towards) : 1;
  if (rowShare <= 0) return;
  const Way way(tiling_, place, longitudes_, width_, height_);
  const size_t channels = frame.channels.size();
  const float middle = band.longitudeOf(place.part), spacing = band.spacing();
  const float columns = float(width_) / longitudes_;  // in a radian
  // Columns around the part's middle, which go on at the other side.
  const float reach = band.parts == 1 ? 0.5f * kTurn : kShareEnds * spacing;
  const int whole = int(std::lround(columns * kTurn));
  const int first = int(std::floor((middle - reach + 0.5f * longitudes_) * columns)) - 1;
  const int last = band.parts == 1 ? first + whole - 1
                                   : int(std::ceil((middle + reach + 0.5f * longitudes_) * columns)) + 1;
  for (int column = first; column <= last; ++column) {
    int x = column % whole;
    if (x < 0) x += whole;
    if (x >= int(width_)) continue;
    const float longitude = (float(column) + 0.5f) / columns - 0.5f * longitudes_;
    const float share = rowShare * (band.parts == 1 ? 1 : shareAt(longitude - middle, spacing));
    if (share <= 0) continue;
    const glm::vec2 pixel(float(x) + 0.5f, float(y) + 0.5f), at = way.toFrame(pixel);
    float* const out = &image_.pixels[(size_t(y) * width_ + size_t(x)) * channels];
    const auto clamped = [&](int i, int j) {
      return &frame.pixels[(size_t(std::clamp(j, 0, int(frame.height) - 1)) * frame.width +
                            size_t(std::clamp(i, 0, int(frame.width) - 1))) *
                           channels];
    };
    if (carry.isMixed) {
      const glm::vec2 corner = glm::floor(at - 0.5f), t = at - 0.5f - corner;
      const glm::vec4 across = splineOf(t.x), down = splineOf(t.y);
      float sum[8] = {}, least[8], most[8];
      std::fill(least, least + 8, INFINITY), std::fill(most, most + 8, -INFINITY);
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
          const float* const in = clamped(int(corner.x) + i - 1, int(corner.y) + j - 1);
          const float weight = across[i] * down[j];
          // Of colours A is the coverage.
          const float covered = channels == 4 ? in[3] : 1;
          // The spline rings: no colour is brighter or darker than the four around it.
          const bool isAround = (i == 1 || i == 2) && (j == 1 || j == 2);
          for (size_t c = 0; c < channels; ++c) {
            const float value = c < 3 ? covered * in[c] : in[c];
            sum[c] += weight * value;
            if (isAround) least[c] = std::min(least[c], value), most[c] = std::max(most[c], value);
          }
        }
      for (size_t c = 0; c < channels; ++c) out[c] += share * std::clamp(sum[c], least[c], most[c]);
      continue;
    }
    // The nearest part's.
    const bool isOwn = (towards <= 0 || std::abs(up) <= 0.5f * towards) &&
                       (band.parts == 1 || std::abs(longitude - middle) <= 0.5f * spacing);
    if (!isOwn) continue;
    const float* const in = clamped(int(std::floor(at.x)), int(std::floor(at.y)));
    std::copy(in, in + channels, out);
    const glm::vec2 there = glm::floor(at) + 0.5f;
    if (carry.depth >= 0 && in[carry.depth] < carry.nothing) out[carry.depth] *= way.lengthening(there);
    switch (carry.pixels) {
      case Carry::Pixels::motion:
      case Carry::Pixels::vector: {
        const glm::vec2 vector(in[0], in[1]), here = way.toPanorama(there);
        const glm::vec2 carried = carry.pixels == Carry::Pixels::motion
                                      ? way.between(way.toPanorama(there - vector), here)
                                      : way.between(here, way.toPanorama(there + vector));
        out[0] = carried.x, out[1] = carried.y;
        break;
      }
      case Carry::Pixels::gradients: {
        const glm::vec2 right(0.5f, 0), down(0, 0.5f);
        const glm::vec2 byX = way.toFrame(pixel + right) - way.toFrame(pixel - right);
        const glm::vec2 byY = way.toFrame(pixel + down) - way.toFrame(pixel - down);
        for (size_t c = 0; c < 4; c += 2) {
          const glm::vec2 gradient(in[c], in[c + 1]);
          out[c] = glm::dot(gradient, byX), out[c + 1] = glm::dot(gradient, byY);
        }
        break;
      }
      case Carry::Pixels::none:
        break;
    }
  }
}

Image Canvas::take(PixelFormat format) {
  Image image = std::move(image_);
  const size_t channels = image.channels.size();
  image.format = format;
  if (format == PixelFormat::half) image.halves.resize(image.pixels.size());
  if (format == PixelFormat::srgb8) image.codes.resize(image.pixels.size());
  const SrgbEncoder& encode = SrgbEncoder::instance();
  scene::parallelFor(height_, scene::threadCount(0), [&](size_t row) {
    for (size_t i = row * width_; i < (row + 1) * width_; ++i) {
      float* const p = &image.pixels[i * channels];
      if (isMixed_ && channels == 4) {
        // Shares add up to one but for rounding.
        if (p[3] > 1 - 1e-5f) p[3] = 1;
        if (p[3] > 0)
          for (size_t c = 0; c < 3; ++c) p[c] /= p[3];
      }
      for (size_t c = 0; c < channels; ++c) {
        if (format == PixelFormat::half) image.halves[i * channels + c] = glm::packHalf1x16(p[c]);
        if (format == PixelFormat::srgb8)
          image.codes[i * channels + c] = c == 3 ? alphaCode(p[c]) : encode(p[c]);
      }
    }
  });
  if (format != PixelFormat::float32) image.pixels = {};
  return image;
}

}  // namespace scumble::panorama
