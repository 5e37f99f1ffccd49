// Values of knobs as texts that Look::set takes, and back.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scumble/look.h"

namespace scumble::viewer {

// The shortest text of a number that means it again.
std::string textOf(double value);
std::string textOf(const glm::vec3& value);  // three numbers
std::string textOf(const KnobValue& value, const Knob& knob);
// Linear RGB as "#RRGGBB", in sRGB's curve; and its bytes from 0 to 1.
std::string hexOf(const glm::vec3& linear);
glm::vec3 curveOf(const glm::vec3& linear);
glm::vec3 linearOf(const glm::vec3& curve);

// All that there are, listed once.
const std::vector<Knob>& allKnobs();

// Whether it may be set for one of Knob::targets.
bool isSetFor(const Knob& knob, const std::string& target);

// A setting's path as Look::set takes it, taken apart: "materials.Paint.001.warp.amount" is "materials",
// "Paint.001" and the knob "warp.amount", and one of the whole scene has no section.
struct Setting {
  std::string section, name;
  const Knob* knob = nullptr;
};
// Nothing where there is no such knob.
std::optional<Setting> settingOf(const std::string& path);

// What a look says of a setting, as a text that Look::set takes, tracks too; empty for those that there are
// not.
std::string valueText(const Look& look, const std::string& path);

// The words of a choice, or the pictures that are built in: Knob::unit names them, "a|b|c".
std::vector<std::string> wordsOf(const Knob& knob);

// Whether a search finds a knob: each of its words is in its path, its meaning or its unit, in whatever case.
bool isFound(const Knob& knob, const std::string& search);

}  // namespace scumble::viewer
