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

Touch::Touch(const Scene& scene, std::function<void(const std::string&)> tell)
    : editor_(scene), scene_(scene), tell_(std::move(tell)) {
  if (const Result<Scene> edited = editor_.scene()) scene_ = *edited;
}

Status Touch::go(const HandsState& hands, const Place& place, Look& look) {
  rays_.clear();
  bool isMoved = false;
  // Where everything is matters only to hands that are closed.
  const bool isGrabbing =
      std::any_of(held_.begin(), held_.end(), [](const Held& held) { return held.use == Use::thing; });
  Grasp::Moment moment;
  if (isGrabbing) moment.world = nodesToWorld(scene_, look, place.time);
  for (size_t h = 0; h < kHands; ++h) {
    const Hand& hand = hands.hands[h];
    Held& held = held_[h];
    const Use use = hand.grabs ? Use::thing : hand.points ? Use::colours : Use::none;
    if (use != held.use) {
      letGo(held, moment.world);
      held = {use, ++count_};
    }
    if (use == Use::none || !hand.aim) continue;
    if (!held.isAsked) held.aim = *hand.aim;
    moment.hand = inScene(place.stand, *hand.aim);
    if (held.object || held.material) take(held, place, look, moment);
    if (held.grasp) {
      if (const int push = held.push.go(hand.stick.y)) held.grasp->widen(editor_, push > 0, moment);
      if (Status status = held.grasp->follow(editor_, moment); !status) return status;
      isMoved = true;
    }
    if (held.tint)
      if (Status status = held.tint->follow(look, *hand.aim); !status) return status;
    const glm::vec3 ahead = hand.aim->turn * glm::vec3(0, 0, -held.reach);
    rays_.push_back({hand.aim->place, hand.aim->place + ahead});
  }
  if (!isMoved) return Done{};
  Result<Scene> scene = editor_.scene();
  if (!scene) return scene.error();
  scene_ = std::move(scene).value();
  return Done{};
}

std::optional<Touch::Question> Touch::takeQuestion() {
  for (size_t h = 0; h < kHands; ++h) {
    Held& held = held_[h];
    // A hand whose place nobody knows yet has no ray either.
    if (held.use == Use::none || held.isAsked || rays_.empty()) continue;
    held.isAsked = true;
    return Question{h, held.number, held.aim};
  }
  return std::nullopt;
}

void Touch::answer(const Question& question, const Frame& frame, size_t view) {
  Held& held = held_[question.hand];
  const Image *const id = layerOf(frame, "id", view), *const depth = layerOf(frame, "depth", view);
  // It may hold something else by now.
  if (held.number != question.number || !id || !depth) return;
  held.reach = std::min(depth->at(0, 0, 0), kFarthest);
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
  held.reach /= place.stand.scale;
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
    Result<Tint> tint = Tint::take(look, *held.material, place.time, held.aim);
    if (tint)
      held.tint = std::move(tint).value();
    else
      tellWhy(tint.error());
  }
  held.object.reset(), held.material.reset();
}

void Touch::letGo(const Held& held, const std::vector<glm::mat4>& world) const {
  if (held.grasp) tell_("moved: " + held.grasp->told(editor_, world));
  if (held.tint && !held.tint->told().empty()) tell_("colours: " + held.tint->told());
}

void Touch::letGoOfColours() {
  for (Held& held : held_) {
    if (held.use != Use::colours) continue;
    letGo(held, {});
    held.tint.reset(), held.material.reset();
  }
}

}  // namespace scumble::xr
