// What a look places, shown in the picture and moved by hand: colorizers and decorations, the key light, and
// the way of the look's camera.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "inspector.h"
#include "lens.h"

namespace scumble::viewer {

// What a hand has turned by moving something: one step of undoing.
struct Turn {
  std::string step;
  Edits edits;
};

// What looks can be given more of, below a section: a name that is free, with knobs that put it at a place,
// so large (metres). `word`: of the section's first choice (a shape, a kind).
struct Addable {
  std::string section, word;
};
std::vector<Addable> addables();
struct Added {
  Target target;
  Edits edits;
};
Added added(const Addable& what, const Look& look, const glm::vec3& place, float size);

// The camera where it stands now, as keys of the look's camera at a time; `from` has eye and target. Fails as
// cameraShiftToWorld does.
Result<Turn> cameraKeyed(const Scene& scene, const Look& look, const Viewpoint& from, double time);

class Handles {
 public:
  Handles();
  ~Handles();

  struct Now {
    const View& view;
    const Scene& scene;
    const SceneSummary& summary;
    const Look& look;
    double time = 0;                // seconds
    Target chosen;                  // whose handles are all there
    bool isThroughTheLook = false;  // the camera is the look's own, so its way is not shown
  };
  // Over the picture. `mouse`: pixels.
  void layOut(const glm::vec2& window, const Now& now, const glm::vec2& mouse);
  void hide();

  // True where there is something to be pulled.
  bool grab(const glm::vec2& mouse);
  bool isHeld() const { return held_.has_value(); }
  // What turns as it is pulled there.
  std::optional<Turn> pull(const glm::vec2& mouse);
  // Gives whose handle it was, if that has knobs.
  std::optional<Target> letGo();

 private:
  struct Handle {
    std::string id;
    glm::vec2 place;  // pixels
    unsigned color;
    float size;  // heights of letters
    std::string label;
    std::optional<Target> target;
    std::function<Edits(const glm::vec2& pixel)> pulled;
  };
  class Maker;
  const Handle* nearest(const glm::vec2& mouse) const;  // within reach; null: none is

  std::unique_ptr<Maker> maker_;
  std::vector<Handle> shown_;
  std::optional<std::string> held_;
  glm::vec2 offset_{0};  // from the mouse to the middle of what it holds
};

}  // namespace scumble::viewer
