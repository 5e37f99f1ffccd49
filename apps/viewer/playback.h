// Which moment of a scene is seen: arithmetic alone. Times in seconds.
#pragma once

namespace scumble::viewer {

struct Playback {
  static constexpr double kRate = 24;  // pictures of a film a second

  double playhead = 0;
  double duration = 0;  // until everything has played once; 0: nothing plays
  double speed = 1;
  bool isPlaying = false;
  bool onTwos = false;  // every second picture of a film

  bool moves() const { return isPlaying && duration > 0; }
  double rate() const { return onTwos ? kRate / 2 : kRate; }
  // What is seen: the playhead itself, or while it plays that picture of a film.
  double pictureTime() const;
  void toggle();                 // plays, or stays at the picture that is seen
  void advance(double seconds);  // while it plays, around and around
  void step(int pictures);       // and pauses
  void seek(double time);        // and pauses
  void goFaster(double factor);  // within a sixteenth and 16 times
};

}  // namespace scumble::viewer
