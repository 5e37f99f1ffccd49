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
  // `tell`: a line for who is at the keyboard; `changed`: one for what hands have changed.
  using Tell = std::function<void(const std::string&)>;
  Touch(const Scene& scene, Tell tell, Tell changed);

  // What lies where a hand points, to be asked of a frame: of a view from there of one pixel, its AOVs `id`
  // and `depth`.
  struct Question {
    size_t hand = 0;
    uint64_t number = 0;
    float scale = 1;  // metres of the scene that are one of the room
    Pose aim;         // in the room
  };

  // Where whoever has the hands stands, and what carries them; the look that they see, and when.
  struct Place {
    Stand stand;
    int support = -1;
    double time = 0;
    std::string look;  // its name
  };
  // Goes on by a frame: what is held goes along. What a scene or a look refuses is let go.
  void go(const HandsState& hands, const Place& place, Look& look);
  // What is to be asked next, once.
  std::optional<Question> takeQuestion();
  // What the view has seen: its number among those of the frame.
  void answer(const Question& question, const Frame& frame, size_t view);
  // Another look is seen from now on: colours are let go. And everything is: the room is another one.
  void letGoOfColours();
  void letGoOfAll();
  // Whether a hand has hold of a thing: its stick is about that.
  bool hasThing(size_t hand) const { return held_[hand].grasp.has_value(); }

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
    std::optional<Pose> aim;  // in the room, as it was asked; none: nobody knows yet where the hand is
    Push push;                // of its stick
  };
  void letGo(const Held& held) const;
  void letGoOfOthers(size_t hand);
  void take(Held& held, const Place& place, const Look& look, const Grasp::Moment& moment);

  SceneEditor editor_;
  Scene scene_;
  Tell tell_, changed_;
  std::vector<glm::dmat4> world_;  // where nodes were, when somebody had hold of something
  std::string look_;
  float scale_ = 1;
  std::array<Held, kHands> held_;
  std::vector<Ray> rays_;
  uint64_t count_ = 0;
};

}  // namespace scumble::xr
