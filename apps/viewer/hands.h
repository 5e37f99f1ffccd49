// Mouse and keys: which of their events are commands, which move the camera, and which are clicks.
#pragma once

#include <glm/glm.hpp>
#include <set>
#include <string>
#include <vector>

#include "bindings.h"
#include "window.h"

namespace scumble::viewer {

class Hands {
 public:
  enum class Grip { orbit, pan, zoom, lookAround };
  // Who does what they say.
  class Doer {
   public:
    virtual void obey(Command command) = 0;
    virtual void drag(Grip grip, const glm::vec2& way) = 0;  // heights of the window, y downwards
    virtual void zoom(float steps) = 0;
    virtual void click(const glm::vec2& place) = 0;  // pixels
    // Whether something lies there that is pulled instead of the camera, until it is let go.
    virtual bool grab(const glm::vec2& place) = 0;
    virtual void pull(const glm::vec2& place) = 0;
    virtual void letGo() = 0;
    virtual void drop(const std::vector<std::string>& files) = 0;

   protected:
    ~Doer() = default;
  };

  // What the interface wants of mouse and keys is not taken from it. `isThere`: a picture, to be dragged.
  void take(const Event& event, const glm::uvec2& window, bool isThere, Doer& doer);

  // Commands that last as long as their key is held.
  bool isHeld(Command command) const { return held_.count(command) > 0; }
  bool isFlying() const;
  glm::vec3 flight() const;                          // to the right, up and forwards, each -1 to 1
  const glm::vec2& mouse() const { return mouse_; }  // pixels

 private:
  void press(const MouseButton& button, bool isThere, Doer& doer);
  void move(const glm::vec2& to, const glm::uvec2& window, bool isThere, Doer& doer);
  void key(const Key& key, Doer& doer);
  Grip grip() const;

  glm::vec2 mouse_{0}, pressedAt_{0};
  bool isClick_ = false, isPulling_ = false;
  int button_ = -1, modifiers_ = 0;
  std::set<Command> held_;
};

}  // namespace scumble::viewer
