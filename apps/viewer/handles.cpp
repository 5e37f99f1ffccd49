#include "handles.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "knob_text.h"
#include "scumble/placement.h"
#include "track_edit.h"

namespace scumble::viewer {

namespace {

constexpr float kReach = 0.75f;      // heights of letters around a handle where it is taken
constexpr float kArrow = 4.5f;       // of an axis, likewise
constexpr int kRing = 48;            // corners of a circle
constexpr int kWay = 96;             // corners of the camera's way
constexpr float kLeastSize = 1e-4f;  // meters, of what is added
constexpr float kDisc = 5;           // radius of a disc of directions (Lens::discOf), in heights of letters
constexpr ImU32 kThing = IM_COL32(226, 180, 92, 255), kSun = IM_COL32(255, 226, 120, 255),
                kCamera = IM_COL32(122, 184, 226, 255), kShade = IM_COL32(20, 20, 20, 150),
                kText = IM_COL32(240, 240, 240, 255);
constexpr ImU32 kAxes[] = {IM_COL32(214, 92, 84, 255), IM_COL32(118, 178, 90, 255),
                           IM_COL32(90, 138, 214, 255)};

// The knobs below a section that place something: their group, and of its knobs the place and the choice of
// what it is.
struct PlaceKnobs {
  std::string section, group, place, choice;
  std::vector<std::string> words;  // of the choice
  const Knob* find(const std::string& knob) const {
    const auto found = std::find_if(allKnobs().begin(), allKnobs().end(), [&](const Knob& each) {
      return each.path == group + "." + knob && isSetFor(each, section);
    });
    return found == allKnobs().end() ? nullptr : &*found;
  }
  // Whether a knob has something to do with what is of this kind: its meaning says so.
  bool isOf(const std::string& knob, const std::string& word) const {
    const Knob* const found = find(knob);
    return found && found->meaning.find(word) != std::string::npos;
  }
};

const std::vector<PlaceKnobs>& placeKnobs() {
  static const std::vector<PlaceKnobs> all = [] {
    std::vector<PlaceKnobs> found;
    for (const char* const section : {"colorizers", "decorations"})
      for (const Knob& knob : allKnobs()) {
        const size_t dot = knob.path.rfind('.');
        const std::string name = knob.path.substr(dot + 1), group = knob.path.substr(0, dot);
        if (!isSetFor(knob, section)) continue;
        if (knob.type == "vector" && (name == "center" || name == "at")) {
          if (found.empty() || found.back().group != group) found.push_back({section, group, "", "", {}});
          found.back().place = name;
        } else if (knob.type == "choice" && (found.empty() || found.back().group != group)) {
          found.push_back({section, group, "", name, wordsOf(knob)});
        }
      }
    std::erase_if(found, [](const PlaceKnobs& knobs) { return knobs.place.empty(); });
    return found;
  }();
  return all;
}

float radiusOf(const SceneSummary& summary) {
  glm::vec3 extent;
  for (int i = 0; i < 3; ++i) extent[i] = float(summary.max[i] - summary.min[i]);
  return std::max(0.5f * glm::length(extent), 1e-6f);
}

glm::vec3 pointIn(const glm::mat4& space, const glm::vec3& point) {
  return space * glm::vec4(point, 1);
}

// About x, then y, then z, in degrees.
glm::mat3 turnedBy(const glm::vec3& rotation) {
  const glm::mat4 none(1);
  const auto about = [&](int axis, const glm::vec3& way) {
    return glm::rotate(none, glm::radians(rotation[axis]), way);
  };
  return glm::mat3(about(2, {0, 0, 1}) * about(1, {0, 1, 0}) * about(0, {1, 0, 0}));
}

// The turn that takes y to a direction.
glm::vec3 rotationTo(const glm::vec3& up) {
  return {glm::degrees(std::acos(std::clamp(up.y, -1.0f, 1.0f))), glm::degrees(std::atan2(up.x, up.z)), 0};
}

// Four digits say it.
float rounded(float number) {
  if (number == 0 || !std::isfinite(number)) return number;
  const double digits = std::pow(10.0, 3 - std::floor(std::log10(std::abs(double(number)))));
  return float(std::round(double(number) * digits) / digits);
}
glm::vec3 rounded(const glm::vec3& numbers) {
  return {rounded(numbers.x), rounded(numbers.y), rounded(numbers.z)};
}

}  // namespace

std::vector<Addable> addables() {
  std::vector<Addable> all;
  for (const PlaceKnobs& knobs : placeKnobs())
    for (const std::string& word : knobs.words) all.push_back({knobs.section, word});
  return all;
}

Added added(const Addable& what, const Look& look, const glm::vec3& place, float size) {
  const auto knobs = std::find_if(placeKnobs().begin(), placeKnobs().end(),
                                  [&](const PlaceKnobs& each) { return each.section == what.section; });
  std::string name = what.word;
  name[0] = char(std::toupper(static_cast<unsigned char>(name[0])));
  const std::vector<std::string> taken = look.names(what.section);
  const auto isTaken = [&](const std::string& one) {
    return std::find(taken.begin(), taken.end(), one) != taken.end();
  };
  std::string free = name;
  for (int number = 2; isTaken(free); ++number) free = name + "-" + std::to_string(number);
  Added made{{what.section, free}, {}};
  const std::string path = what.section + "." + free + ".";
  const auto set = [&](const std::string& knob, const std::string& value) {
    if (const auto setting = settingOf(path + knob)) made.edits[path + knob] = value;
  };
  const float wide = std::max(rounded(size), kLeastSize);
  set(knobs->group + "." + knobs->choice, what.word);
  set(knobs->group + "." + knobs->place, textOf(rounded(place)));
  if (knobs->isOf("radius", what.word)) set(knobs->group + ".radius", textOf(double(wide)));
  if (knobs->isOf("size", what.word)) set(knobs->group + ".size", textOf(glm::vec3(wide)));
  if (knobs->group != "volume") return made;
  // What does nothing would not be seen.
  set("grade.tint", "#FFC070");
  set("grade.gain", "1.3");
  return made;
}

Result<Turn> cameraKeyed(const Scene& scene, const Look& look, const Viewpoint& from, double time) {
  const Result<glm::dmat4> space = cameraShiftToWorld(scene, look, time);
  if (!space) return space.error();
  Turn turn{"camera", {}};
  const auto key = [&](const char* path, const KnobValue& value) {
    if (const auto text = keyedAt(look, path, value, time, Interpolation::ease)) turn.edits[path] = *text;
  };
  turn.edits["camera.mode"] = "eye";
  key("camera.eye", glm::vec3(*from.eye));
  key("camera.shift", glm::vec3(glm::inverse(*space) * glm::dvec4(*from.target, 1)));
  key("camera.roll", std::round(1e3 * double(from.roll.value_or(0))) / 1e3);
  key("camera.fov", double(from.verticalFov.value_or(34)));
  return turn;
}

// ---- What there is to be pulled

class Handles::Maker {
 public:
  Maker(const glm::vec2& window, const Now& now)
      : scene_(now.scene),
        look_(now.look),
        time_(now.time),
        chosen_(now.chosen),
        showsWay_(!now.isThroughTheLook),
        radius_(radiusOf(now.summary)),
        window_(window),
        lens_(now.view, window),
        list_(ImGui::GetBackgroundDrawList()),
        unit_(ImGui::GetFontSize()) {}

  // Draws what lies between them.
  std::vector<Handle> make() {
    for (const PlaceKnobs& knobs : placeKnobs())
      for (const std::string& name : look_.names(knobs.section)) addThing(knobs, name);
    addSun();
    if (showsWay_) addWay();
    return std::move(handles_);
  }

 private:
  template <class T>
  std::optional<T> value(const std::string& path) const {
    const Result<KnobValue> value = look_.get(path, time_);
    return value && std::holds_alternative<T>(*value) ? std::optional(std::get<T>(*value)) : std::nullopt;
  }
  Edits turned(const std::string& path, const std::string& text) const {
    const std::optional<std::string> turned = turnedAt(look_, path, text, time_);
    return turned ? Edits{{path, *turned}} : Edits();
  }

  void add(const std::string& id, const glm::vec3& place, ImU32 color, float size, const std::string& label,
           std::optional<Target> target, std::function<Edits(const glm::vec2&)> pulled) {
    if (const std::optional<glm::vec2> pixel = lens_.pixelOf(place))
      handles_.push_back({id, *pixel, color, size, label, std::move(target), std::move(pulled)});
  }

  void line(const glm::vec3& from, const glm::vec3& to, ImU32 color, float width = 1.5f) {
    const auto a = lens_.pixelOf(from), b = lens_.pixelOf(to);
    if (a && b) list_->AddLine({a->x, a->y}, {b->x, b->y}, color, width);
  }
  // Around the third of a space's axes: two of them are its radii.
  void ring(const glm::vec3& centre, const glm::vec3& a, const glm::vec3& b, ImU32 color) {
    glm::vec3 last = centre + a;
    for (int i = 1; i <= kRing; ++i) {
      const float angle = 6.2831853f * float(i) / kRing;
      const glm::vec3 next = centre + std::cos(angle) * a + std::sin(angle) * b;
      line(last, next, color);
      last = next;
    }
  }

  void addThing(const PlaceKnobs& knobs, const std::string& name) {
    const std::string base = knobs.section + "." + name + "." + knobs.group + ".";
    const std::string word = knobs.choice.empty() ? "" : value<std::string>(base + knobs.choice).value_or("");
    const std::optional<glm::vec3> place = value<glm::vec3>(base + knobs.place);
    if (!place || word == "scene") return;
    const std::string node = value<std::string>(base + "node").value_or("");
    const Result<glm::dmat4> toWorld = nodeToWorld(scene_, node, look_, time_);
    if (!toWorld) return;
    const glm::mat4 space(lens_.fromWorld() * *toWorld);
    const glm::vec3 centre = pointIn(space, *place);
    const Target target{knobs.section, name};
    const bool isChosen = chosen_ == target, isLevel = !knobs.find("rotation");
    const glm::mat4 toSpace = glm::inverse(space);
    const auto put = [=, this](const glm::vec3& there) {
      return turned(base + knobs.place, textOf(rounded(pointIn(toSpace, there))));
    };
    const float radius = knobs.isOf("radius", word) ? float(value<double>(base + "radius").value_or(0)) : 0;
    drawShape(base, word, radius, space, centre, isChosen ? kThing : (kThing & 0x00FFFFFF) | 0x90000000);
    add(base + knobs.place, centre, kThing, isChosen ? 0.42f : 0.34f, name, target,
        [=, this](const glm::vec2& pixel) {
          if (!isLevel) return put(lens_.draggedFreely(centre, pixel));
          const std::optional<glm::vec3> level = lens_.draggedLevel(centre, pixel);
          return level ? put(*level) : Edits();
        });
    if (!isChosen) return;
    for (int i = 0; i < 3; ++i) {
      if (isLevel && i == 1) continue;
      glm::vec3 axis(0);
      axis[i] = 1;
      const glm::vec3 tip = centre + axis * (kArrow * unit_ * lens_.pixelSize(centre));
      line(centre, tip, kAxes[i], 2);
      add(base + "axis" + std::to_string(i), tip, kAxes[i], 0.3f, "", target,
          [=, this](const glm::vec2& pixel) {
            const std::optional<glm::vec3> along = lens_.draggedAlong(tip, axis, pixel);
            return along ? put(centre + *along - tip) : Edits();
          });
    }
    addSizes(base, word, radius, space, centre, target);
  }

  // What the knobs of a shape say of it, in the world.
  glm::mat3 axesOf(const std::string& base, const glm::mat4& space) const {
    return glm::mat3(space) * turnedBy(value<glm::vec3>(base + "rotation").value_or(glm::vec3(0)));
  }

  void drawShape(const std::string& base, const std::string& word, float radius, const glm::mat4& space,
                 const glm::vec3& centre, ImU32 color) {
    const glm::mat3 axes = axesOf(base, space);
    if (word == "sphere" || word == "ellipsoid") {
      const glm::vec3 size =
          word == "sphere" ? glm::vec3(radius) : value<glm::vec3>(base + "size").value_or(glm::vec3(0));
      for (int i = 0; i < 3; ++i)
        ring(centre, axes[(i + 1) % 3] * size[(i + 1) % 3], axes[(i + 2) % 3] * size[(i + 2) % 3], color);
    } else if (word == "box") {
      const glm::vec3 size = value<glm::vec3>(base + "size").value_or(glm::vec3(0));
      for (int corner = 0; corner < 8; ++corner)
        for (int axis = 0; axis < 3; ++axis) {
          if (corner & (1 << axis)) continue;
          const auto at = [&](int c) {
            glm::vec3 place = centre;
            for (int i = 0; i < 3; ++i) place += axes[i] * (c & (1 << i) ? size[i] : -size[i]);
            return place;
          };
          line(at(corner), at(corner | (1 << axis)), color);
        }
    } else if (word == "capsule") {
      const auto length = float(value<double>(base + "length").value_or(0));
      for (const float end : {-length, length})
        for (int i = 0; i < 3; ++i)
          ring(centre + axes[1] * end, axes[i] * radius, axes[(i + 1) % 3] * radius, color);
      for (const int axis : {0, 2})
        for (const float side : {-radius, radius})
          line(centre + axes[axis] * side - axes[1] * length, centre + axes[axis] * side + axes[1] * length,
               color);
    } else if (word == "half-space") {
      const float wide = radius_;
      for (int i = -2; i <= 2; ++i) {
        const float beside = 0.5f * wide * float(i);
        line(centre + axes[0] * beside - axes[2] * wide, centre + axes[0] * beside + axes[2] * wide, color,
             1);
        line(centre + axes[2] * beside - axes[0] * wide, centre + axes[2] * beside + axes[0] * wide, color,
             1);
      }
    } else if (radius > 0) {
      ring(centre, glm::mat3(space)[0] * radius, glm::mat3(space)[2] * radius, color);
    }
  }

  void addSizes(const std::string& base, const std::string& word, float radius, const glm::mat4& space,
                const glm::vec3& centre, const Target& target) {
    const glm::mat3 axes = axesOf(base, space);
    // A way along an axis; what it is pulled to is set by `change`.
    using Change = std::function<Edits(float)>;
    const auto addWayAlong = [&](const std::string& id, const glm::vec3& axis, float length,
                                 const Change& change) {
      const float scale = glm::length(axis);
      if (!(scale > 0)) return;
      add(base + id, centre + axis * length, kThing, 0.3f, "", target, [=, this](const glm::vec2& pixel) {
        const auto along = lens_.draggedAlong(centre, axis / scale, pixel);
        const float pulled = along ? rounded(std::abs(glm::dot(*along - centre, axis)) / (scale * scale)) : 0;
        return pulled > 0 ? change(pulled) : Edits();
      });
    };
    const auto addLength = [&](const std::string& knob, const glm::vec3& axis, float length) {
      addWayAlong(knob, axis, length,
                  [=, this](float pulled) { return turned(base + knob, textOf(double(pulled))); });
    };
    if (word == "ellipsoid" || word == "box") {
      const glm::vec3 size = value<glm::vec3>(base + "size").value_or(glm::vec3(0));
      for (int i = 0; i < 3; ++i)
        addWayAlong("size" + std::to_string(i), axes[i], size[i], [=, this](float pulled) {
          glm::vec3 changed = size;
          changed[i] = pulled;
          return turned(base + "size", textOf(changed));
        });
    } else if (word == "capsule") {
      addLength("radius", axes[0], radius);
      addLength("length", axes[1], float(value<double>(base + "length").value_or(0)));
    } else if (word == "half-space") {
      const std::optional<glm::vec2> middle = lens_.pixelOf(centre);
      if (!middle) return;
      const glm::mat3 toSpace = glm::inverse(glm::mat3(space));
      addDirection(base + "rotation", *middle, glm::normalize(axes[1]), kThing, "", target,
                   [=, this](const glm::vec3& up) {
                     const glm::vec3 rotation = rotationTo(glm::normalize(toSpace * up));
                     return turned(base + "rotation", textOf(rounded(rotation)));
                   });
    } else if (radius > 0) {
      // Of a sphere beside it, as it is seen; of rings on the level.
      const bool isSphere = word == "sphere";
      const float scale = glm::length(glm::mat3(space)[0]);
      const glm::vec3 beside = isSphere ? lens_.right() * scale : glm::mat3(space)[0];
      addLength("radius", beside, radius);
    }
  }

  // On a disc around a place.
  void addDirection(const std::string& id, const glm::vec2& middle, const glm::vec3& direction, ImU32 color,
                    const std::string& label, std::optional<Target> target,
                    const std::function<Edits(const glm::vec3&)>& turn) {
    const float radius = kDisc * unit_;
    const glm::vec2 place = middle + radius * lens_.discOf(direction);
    const ImU32 faint = (color & 0x00FFFFFF) | 0x60000000;
    for (const float ring : {radius, 2 * radius})
      list_->AddCircle({middle.x, middle.y}, ring, faint, 0, 1.5f);
    list_->AddLine({middle.x, middle.y}, {place.x, place.y}, faint, 1.5f);
    handles_.push_back({id, place, color, 0.5f, label, std::move(target), [=, this](const glm::vec2& pixel) {
                          return turn(lens_.directionAt((pixel - middle) / radius));
                        }});
  }

  void addSun() {
    const Result<glm::vec3> towards = towardsKeyLight(scene_, look_, time_);
    if (!towards) return;
    addDirection("light", 0.5f * window_, *towards, kSun, "key light", std::nullopt,
                 [=, this](const glm::vec3& from) {
                   const Result<glm::vec2> angles = keyLightAngles(scene_, from);
                   if (!angles) return Edits();
                   Edits edits = turned("light.azimuth", textOf(double(std::round(angles->x * 10) / 10)));
                   edits.merge(turned("light.elevation", textOf(double(std::round(angles->y * 10) / 10))));
                   edits["light.source"] = "look";
                   return edits;
                 });
  }

  // A place of the world, as the lens counts.
  glm::vec3 placeOf(const glm::vec3& world) const { return glm::dvec3(world) - lens_.origin(); }

  // The camera's way, where tracks take it: its keys are pulled.
  void addWay() {
    const auto track = look_.track("camera.eye");
    if (!track || !*track) return;
    const std::vector<KnobTrack::Key>& keys = (*track)->keys;
    const auto eyeAt = [&](double time) {
      const Result<KnobValue> eye = look_.get("camera.eye", time);
      return placeOf(eye ? std::get<glm::vec3>(*eye) : glm::vec3(0));
    };
    const double begin = keys.front().time, length = keys.back().time - begin;
    for (int i = 0; i < kWay && length > 0; ++i)
      line(eyeAt(begin + length * i / kWay), eyeAt(begin + length * (i + 1) / kWay), kCamera, 2);
    const auto lookedAt = [&](double time) {
      const Result<glm::dmat4> space = cameraShiftToWorld(scene_, look_, time);
      const Result<KnobValue> shift = look_.get("camera.shift", time);
      return space && shift ? std::optional(pointIn(lens_.fromWorld() * *space, std::get<glm::vec3>(*shift)))
                            : std::nullopt;
    };
    if (const auto at = lookedAt(time_)) {
      line(eyeAt(time_), *at, (kCamera & 0x00FFFFFF) | 0x80000000);
      if (const auto pixel = lens_.pixelOf(eyeAt(time_)))
        list_->AddCircle({pixel->x, pixel->y}, 0.5f * unit_, kCamera, 0, 2);
    }
    for (size_t i = 0; i < keys.size(); ++i) {
      const glm::vec3 place = placeOf(std::get<glm::vec3>(keys[i].value));
      const std::string label = fmt::format("{:.2f} s", keys[i].time);
      add("camera.eye" + std::to_string(i), place, kCamera, 0.38f, label, std::nullopt,
          [=, this](const glm::vec2& pixel) {
            // Of as many keys as there are, each would have a copy of all.
            const auto present = look_.track("camera.eye");
            if (!present || !*present) return Edits();
            KnobTrack changed = **present;
            changed.keys[i].value =
                rounded(glm::vec3(lens_.origin() + glm::dvec3(lens_.draggedFreely(place, pixel))));
            const auto text = textOf(changed, *settingOf("camera.eye")->knob);
            return text ? Edits{{"camera.eye", *text}} : Edits();
          });
    }
  }

  // What is pulled later was seen in this frame: so these are copies.
  const Scene scene_;
  const Look look_;
  const double time_;
  const Target chosen_;
  const bool showsWay_;
  const float radius_;
  const glm::vec2 window_;
  const Lens lens_;
  ImDrawList* const list_;
  const float unit_;
  std::vector<Handle> handles_;
};

Handles::Handles() = default;
Handles::~Handles() = default;

void Handles::hide() {
  shown_.clear();
  held_.reset();
}

void Handles::layOut(const glm::vec2& window, const Now& now, const glm::vec2& mouse) {
  // What is held calls upon its maker.
  shown_.clear();
  maker_ = std::make_unique<Maker>(window, now);
  shown_ = maker_->make();
  const float unit = ImGui::GetFontSize();
  const Handle* const under = ImGui::GetIO().WantCaptureMouse ? nullptr : nearest(mouse);
  ImDrawList* const list = ImGui::GetBackgroundDrawList();
  for (const Handle& handle : shown_) {
    const bool isLit = held_ ? handle.id == *held_ : &handle == under;
    const float size = handle.size * unit * (isLit ? 1.3f : 1.0f);
    const ImVec2 place{handle.place.x, handle.place.y};
    list->AddCircleFilled(place, size + 2, kShade);
    list->AddCircleFilled(place, size, handle.color);
    if (handle.label.empty()) continue;
    const ImVec2 text = ImGui::CalcTextSize(handle.label.c_str());
    const ImVec2 low{place.x + size + 0.4f * unit, place.y - 0.5f * text.y};
    list->AddRectFilled({low.x - 0.2f * unit, low.y - 1}, {low.x + text.x + 0.2f * unit, low.y + text.y + 1},
                        kShade, 3);
    list->AddText(low, kText, handle.label.c_str());
  }
}

// The last ones lie on top.
const Handles::Handle* Handles::nearest(const glm::vec2& mouse) const {
  const Handle* found = nullptr;
  float least = kReach * ImGui::GetFontSize();
  for (const Handle& handle : shown_)
    if (const float distance = glm::distance(handle.place, mouse); distance <= least)
      found = &handle, least = distance;
  return found;
}

bool Handles::grab(const glm::vec2& mouse) {
  const Handle* const under = nearest(mouse);
  if (!under) return false;
  held_ = under->id, offset_ = under->place - mouse;
  return true;
}

std::optional<Turn> Handles::pull(const glm::vec2& mouse) {
  for (const Handle& handle : shown_) {
    if (handle.id != held_) continue;
    Edits edits = handle.pulled(mouse + offset_);
    return edits.empty() ? std::nullopt : std::optional(Turn{handle.id, std::move(edits)});
  }
  return std::nullopt;
}

std::optional<Target> Handles::letGo() {
  const std::optional<std::string> held = std::exchange(held_, std::nullopt);
  for (const Handle& handle : shown_)
    if (handle.id == held) return handle.target;
  return std::nullopt;
}

}  // namespace scumble::viewer
