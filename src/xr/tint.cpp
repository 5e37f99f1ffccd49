#include "xr/tint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace scumble::xr {

float rollBetween(const Pose& from, const Pose& to) {
  // Of the turn between them what is about the axis, which is -z: of its quaternion w and z.
  const glm::quat turn = glm::inverse(from.turn) * to.turn;
  return -2 * std::remainder(std::atan2(turn.z, turn.w), glm::pi<float>());
}

Result<Tint> Tint::take(const Look& look, const std::string& material, double time, const Pose& hand) {
  if (material.empty())
    return Error{
        ErrorKind::usage, "", 0, "", "the material has no name", "give it one, so that looks know it"};
  if (material.find_first_of("=*?[]\n\r") != std::string::npos)
    return Error{
        ErrorKind::usage,      "", 0, "", "looks cannot name a material with =, *, ? or [ in its name",
        "give it another name"};
  Tint tint;
  tint.hand_ = hand;
  for (const char* const side : {"lit", "shadowed"})
    for (const bool isHue : {true, false}) {
      const std::string path = "materials." + material + "." + side + (isHue ? ".hue" : ".brightness");
      const Result<KnobValue> value = look.get(path, time);
      if (!value) return value.error();
      const double number = std::get<double>(*value);
      (isHue ? tint.hues_ : tint.brightnesses_).push_back({path, number, number});
    }
  return tint;
}

Status Tint::follow(Look& look, const Pose& hand) {
  // A wrist turns no more than half a turn from one frame to the next, and may do so again and again.
  const float roll = rollBetween(hand_, hand);
  turned_ += std::remainder(roll - turned_, glm::two_pi<float>());
  const double lighter = std::exp2((hand.place.y - hand_.place.y) / kLightnessHeight);
  for (Knob& knob : hues_) knob.now = std::remainder(knob.before + glm::degrees(double(turned_)), 360.0);
  for (Knob& knob : brightnesses_) knob.now = std::clamp(knob.before * lighter, 0.0, 3.0);
  for (const std::vector<Knob>* knobs : {&hues_, &brightnesses_})
    for (const Knob& knob : *knobs)
      if (Status status = look.set(knob.path, knob.now); !status) return status;
  return Done{};
}

std::string Tint::told() const {
  std::string text;
  for (const std::vector<Knob>* knobs : {&hues_, &brightnesses_})
    for (const Knob& knob : *knobs) {
      if (knob.now == knob.before) continue;
      const std::string number = fmt::format("{:.3g}", knob.now);
      // As shells take words.
      std::string word;
      for (const char letter : knob.path) word += letter == '\'' ? "'\\''" : std::string(1, letter);
      text += (text.empty() ? "--set '" : " --set '") + word + "=" + number + "'";
    }
  return text;
}

}  // namespace scumble::xr
