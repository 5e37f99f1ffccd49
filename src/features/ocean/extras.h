// What a scene's nodes say of the ocean in their extras (docs/sea.md).
#pragma once

#include <optional>

#include "scene/extras.h"
#include "scene/scene_data.h"

namespace scumble::ocean {

// Whether a node stands for the ocean; none: it does not say, and its name decides.
std::optional<bool> saysOcean(const scene::Node& node);

// How a node rides the waves; what is absent is the look's to say.
struct Floats {
  std::optional<float> length, beam;  // metres
  bool bowAlongZ = false;             // else along x
};
// None: it does not ride them.
std::optional<Floats> floatsOf(const scene::Node& node);

// How its mesh keeps the sea out, as FloatParams::hull; none: it does not say.
std::optional<int> hullOf(const scene::Node& node);

// Whether its meshes lie on the water (features/ocean/draped.h); none: it does not say.
std::optional<bool> saysWater(const scene::Node& node);

std::vector<scene::ExtraRule> extraRules();

}  // namespace scumble::ocean
