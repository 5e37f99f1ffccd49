// What both hands do to what they point at: one that is closed takes hold of things, and one that pulls its
// trigger of a material's colours.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scumble/renderer.h"
#include "xr/grasp.h"
#include "xr/hands.h"
#include "xr/pointer.h"
#include "xr/tint.h"

namespace scumble::xr {

class Touch {
 public:
  // `tell`: a line for who is at the keyboard.
  Touch(const Scene& scene, std::function<void(const std::string&)> tell);

  // What lies where a hand points, to be asked of a frame: of a view from there of one pixel, its AOVs `id`
  // and `depth`.
  struct Question {
    size_t hand = 0;
    uint64_t number = 0;
    Pose aim;  // in the room
  };

  // Where whoever has the hands stands, and what carries them; the look that they see, and when.
  struct Place {
    Stand stand;
    int support = -1;
    double time = 0;
  };
  // Goes on by a frame: what is held goes along. Fails where a scene or a look refuses that.
  Status go(const HandsState& hands, const Place& place, Look& look);
  // What is to be asked next, once.
  std::optional<Question> takeQuestion();
  // What the view has seen: its number among those of the frame.
  void answer(const Question& question, const Frame& frame, size_t view);
  // Another look is seen from now on: colours are let go.
  void letGoOfColours();

  const Scene& scene() const { return scene_; }  // with what was moved
  const std::vector<Ray>& rays() const { return rays_; }

 private:
  enum class Use { none, colours, thing };
  struct Held {
    Use use = Use::none;
    uint64_t number = 0;  // of this hold
    bool isAsked = false;
    float reach = 1;   // metres of the room, to what it has hold of
    std::string name;  // of that
    std::optional<Tint> tint;
    std::optional<Grasp> grasp;
    // What was seen there: it is taken hold of in the next go().
    std::optional<int> object;
    std::optional<std::string> material;
    Pose aim;   // in the room, as it was asked
    Push push;  // of its stick
  };
  void letGo(const Held& held, const std::vector<glm::mat4>& world) const;
  void take(Held& held, const Place& place, const Look& look, const Grasp::Moment& moment);

  SceneEditor editor_;
  Scene scene_;
  std::function<void(const std::string&)> tell_;
  std::array<Held, kHands> held_;
  std::vector<Ray> rays_;
  uint64_t count_ = 0;
};

}  // namespace scumble::xr
