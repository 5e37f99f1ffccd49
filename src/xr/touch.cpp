#include "xr/touch.h"

#include <algorithm>
#include <cmath>

namespace scumble::xr {

namespace {

constexpr float kFarthest = 100;  // metres of the room: rays end there

const Image* layerOf(const Frame& frame, const char* name, size_t view) {
  for (const Frame::Layer& layer : frame.layers)
    if (layer.name == name && view < layer.views.size() && layer.views[view].width > 0)
      return &layer.views[view];
  return nullptr;
}

}  // namespace

Touch::Touch(const Scene& scene, Tell tell, Tell changed)
    : editor_(scene), scene_(scene), tell_(std::move(tell)), changed_(std::move(changed)) {
  if (const Result<Scene> edited = editor_.scene()) scene_ = *edited;
}

void Touch::go(const HandsState& hands, const Place& place, Look& look) {
  rays_.clear();
  look_ = place.look, scale_ = place.stand.scale;
  bool isMoved = false;
  // Where everything is matters only to hands that are closed.
  Grasp::Moment moment;
  if (std::any_of(held_.begin(), held_.end(), [](const Held& held) { return held.use == Use::thing; }))
    moment.world = world_ = nodesToWorld(scene_, look, place.time);
  for (size_t h = 0; h < kHands; ++h) {
    const Hand& hand = hands.hands[h];
    Held& held = held_[h];
    const Use use = hand.grabs ? Use::thing : hand.points ? Use::colours : Use::none;
    if (use != held.use) {
      letGo(held);
      held = {use, ++count_};
    }
    // One that is pushed already as the hand closes means something else.
    const int push = held.push.go(hand.stick.y);
    if (use == Use::none || !hand.aim) continue;
    if (!held.isAsked) held.aim = *hand.aim;
    moment.hand = glm::translate(glm::dmat4(1.0), place.stand.origin) *
                  glm::dmat4(matrixOf(inScene(place.stand, *hand.aim)));
    if (held.object || held.material) {
      take(held, place, look, moment);
      letGoOfOthers(h);
    }
    Status status = Done{};
    if (held.grasp) {
      if (push != 0 && held.grasp->widen(editor_, push > 0, moment)) letGoOfOthers(h);
      status = held.grasp->follow(editor_, moment);
      isMoved = true;
    }
    if (held.tint) status = held.tint->follow(look, *hand.aim);
    if (!status) {
      tell_("'" + held.name + "' is let go: " + status.error().problem);
      held.grasp.reset(), held.tint.reset();
    }
    const glm::vec3 ahead = hand.aim->turn * glm::vec3(0, 0, -held.reach);
    rays_.push_back({hand.aim->place, hand.aim->place + ahead});
  }
  if (!isMoved) return;
  if (Result<Scene> scene = editor_.scene()) {
    scene_ = std::move(scene).value();
  } else {
    tell_("what is held is let go: " + scene.error().problem);
    for (Held& held : held_) held.grasp.reset();
  }
}

std::optional<Touch::Question> Touch::takeQuestion() {
  for (size_t h = 0; h < kHands; ++h) {
    Held& held = held_[h];
    if (held.use == Use::none || held.isAsked || !held.aim) continue;
    held.isAsked = true;
    return Question{h, held.number, scale_, *held.aim};
  }
  return std::nullopt;
}

void Touch::answer(const Question& question, const Frame& frame, size_t view) {
  Held& held = held_[question.hand];
  const Image *const id = layerOf(frame, "id", view), *const depth = layerOf(frame, "depth", view);
  // It may hold something else by now.
  if (held.number != question.number || !id || !depth) return;
  held.reach = std::min(depth->at(0, 0, 0) / question.scale, kFarthest);
  const auto object = size_t(std::lround(id->at(0, 0, 0))), material = size_t(std::lround(id->at(0, 0, 1)));
  if (object == 0 || object > frame.objects.size() || material > frame.materials.size()) return;
  if (held.use == Use::thing) {
    held.name = frame.objects[object - 1];
    held.object = int(object) - 1;
  } else if (material > 0) {
    held.name = frame.materials[material - 1];
    held.material = held.name;
  }
}

void Touch::take(Held& held, const Place& place, const Look& look, const Grasp::Moment& moment) {
  const auto tellWhy = [&](const Error& error) {
    tell_("'" + held.name + "' stays as it is: " + error.problem);
  };
  if (held.object) {
    Result<Grasp> grasp = Grasp::take(editor_, NodeId(*held.object), place.support, moment);
    if (grasp)
      held.grasp = std::move(grasp).value();
    else
      tellWhy(grasp.error());
  } else {
    Result<Tint> tint = Tint::take(look, *held.material, place.time, *held.aim);
    if (tint)
      held.tint = std::move(tint).value();
    else
      tellWhy(tint.error());
  }
  held.object.reset(), held.material.reset();
}

void Touch::letGo(const Held& held) const {
  if (held.grasp)
    if (const std::string told = held.grasp->told(editor_, world_); !told.empty()) changed_("moved: " + told);
  if (held.tint)
    if (const std::string told = held.tint->told(); !told.empty())
      changed_("colours: --look '" + look_ + "' " + told);
}

// What one hand takes the other has no more.
void Touch::letGoOfOthers(size_t hand) {
  const std::optional<Grasp>& own = held_[hand].grasp;
  for (size_t h = 0; h < kHands && own; ++h) {
    std::optional<Grasp>& other = held_[h].grasp;
    if (h != hand && other && other->concerns(editor_, *own)) {
      letGo(held_[h]);
      other.reset();
    }
  }
}

void Touch::letGoOfColours() {
  for (Held& held : held_) {
    if (held.use != Use::colours) continue;
    letGo(held);
    // Nothing more until it is pulled anew; an answer that is under way comes too late.
    held = {Use::colours, ++count_, true};
  }
}

void Touch::letGoOfAll() {
  for (Held& held : held_) {
    letGo(held);
    held = {held.use, ++count_, true};
  }
}

}  // namespace scumble::xr
