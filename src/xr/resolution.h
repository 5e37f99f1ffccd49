// How many pixels an eye gets: as many as there is time for.
//
// Marks keep their angles whatever that is, since knobs' pixels follow the picture's height: another number
// of pixels is another sharpness, and nothing else.
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace scumble::xr {

class Resolution {
 public:
  // Steps of both sides, as parts of what the runtime recommends: the pixels fall by a fifth each.
  static constexpr float kSteps[] = {1.0f, 0.9f, 0.8f, 0.72f, 0.64f, 0.57f, 0.5f};

  // `fixed`: always this part of both sides, 0.1 to 1.
  explicit Resolution(std::optional<float> fixed) : fixed_(fixed) {}

  // What the device took for a frame of these pixels, and from one frame of the display to the next, both in
  // milliseconds; 0: not known. One that is late again and again has fewer pixels next; one that would have
  // time for more for a while, more.
  void took(double device, double period);

  // Late again and again, with as few pixels as there may be.
  bool isTooMuch() const { return isTooMuch_; }

  float scale() const { return fixed_.value_or(kSteps[step_]); }
  // Of a recommended size: whole pixels, 1 at least.
  glm::uvec2 of(const glm::uvec2& size) const;

 private:
  std::optional<float> fixed_;
  size_t step_ = 0;
  int late_ = 0, early_ = 0;  // frames, one after the other
  bool isTooMuch_ = false;
};

}  // namespace scumble::xr
