#include "playback.h"

#include <algorithm>
#include <cmath>

namespace scumble::viewer {

namespace {

// A time that is a picture's own may be a little less than that, as numbers are.
constexpr double kSlack = 1e-6;

}  // namespace

double Playback::pictureTime() const {
  return isPlaying ? std::floor(playhead * rate() + kSlack) / rate() : playhead;
}

void Playback::toggle() {
  playhead = pictureTime();
  isPlaying = !isPlaying;
}

void Playback::advance(double seconds) {
  if (moves()) playhead = std::fmod(playhead + seconds * speed, duration);
}

void Playback::step(int pictures) {
  seek((std::floor(playhead * rate() + kSlack) + pictures) / rate());
}

void Playback::seek(double time) {
  isPlaying = false;
  playhead = std::max(time, 0.0);
}

void Playback::goFaster(double factor) {
  speed = std::clamp(speed * factor, 1 / 16.0, 16.0);
}

}  // namespace scumble::viewer
