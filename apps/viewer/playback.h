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
  // Of the picture of a film that is seen at the playhead.
  double pictureTime() const;
  void advance(double seconds);  // while it plays, around and around
  void step(int pictures);       // and pauses
  void seek(double time);        // and pauses
  void goFaster(double factor);  // within a sixteenth and 16 times
};

}  // namespace scumble::viewer
