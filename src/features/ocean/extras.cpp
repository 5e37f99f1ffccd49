#include "features/ocean/extras.h"

#include <nlohmann/json.hpp>

#include "features/ocean/floating.h"

namespace scumble::ocean {

namespace {

using Json = nlohmann::json;
using Problems = scene::ExtraRule::Problems;

constexpr const char *kOceanKey = "scumble_ocean", *kFloatKey = "scumble_float", *kHullKey = "scumble_hull",
                     *kWaterKey = "scumble_water";

// Modelling programs write 0 and 1 as well. Absent: it is neither.
std::optional<bool> flagOf(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number() && (json.get<double>() == 0 || json.get<double>() == 1))
    return json.get<double>() == 1;
  return std::nullopt;
}

// Metres; none: it is no size.
std::optional<float> sizeOf(const Json& value) {
  constexpr double kLongest = 1000;  // as the knobs have it
  const double metres = value.is_number() ? value.get<double>() : -1;
  return metres >= 0 && metres <= kLongest ? std::optional(float(metres)) : std::nullopt;
}

Problems problemsOfFloats(const Json& json) {
  if (flagOf(json)) return {};
  if (!json.is_object()) return {{"", "what floats is ignored: it is neither true nor an object"}};
  Problems problems;
  for (const auto& [key, value] : json.items()) {
    const bool isSize = key == "length" || key == "beam";
    if (isSize && !sizeOf(value))
      problems.push_back({"." + key, "a size of what floats is ignored: it is no number from 0 to 1000"});
    else if (key == "bow" && value != "x" && value != "z")
      problems.push_back({"." + key, "a bow is ignored: it is neither \"x\" nor \"z\""});
    else if (!isSize && key != "bow")
      problems.push_back({"." + key, "is ignored: what floats has length, beam and bow"});
  }
  return problems;
}

std::optional<int> hullRole(const Json& json) {
  if (const std::optional<bool> flag = flagOf(json)) return *flag ? kHullWhole : kHullOff;
  return json == "inside" ? std::optional(kHullInside) : std::nullopt;
}

const Json* find(const scene::Node& node, const char* key) {
  const auto found = node.extras.find(key);
  return found == node.extras.end() ? nullptr : found->second.get();
}

}  // namespace

std::optional<bool> saysOcean(const scene::Node& node) {
  const Json* const json = find(node, kOceanKey);
  return json ? flagOf(*json) : std::nullopt;
}

std::optional<bool> saysWater(const scene::Node& node) {
  const Json* const json = find(node, kWaterKey);
  return json ? flagOf(*json) : std::nullopt;
}

std::optional<Floats> floatsOf(const scene::Node& node) {
  // Asked for in each frame: whatever else a hostile file has in there is not gone through.
  const Json* const json = find(node, kFloatKey);
  if (!json) return std::nullopt;
  if (const std::optional<bool> flag = flagOf(*json)) return *flag ? std::optional(Floats()) : std::nullopt;
  if (!json->is_object()) return std::nullopt;
  const auto size = [&](const char* key) -> std::optional<float> {
    const auto found = json->find(key);
    const std::optional<float> metres = found != json->end() ? sizeOf(*found) : std::nullopt;
    return metres ? std::optional(*metres * node.extrasScale) : std::nullopt;
  };
  const auto bow = json->find("bow");
  return Floats{size("length"), size("beam"), bow != json->end() && *bow == "z"};
}

std::optional<int> hullOf(const scene::Node& node) {
  const Json* const json = find(node, kHullKey);
  return json ? hullRole(*json) : std::nullopt;
}

std::vector<scene::ExtraRule> extraRules() {
  const auto flag = [](const Json& json) {
    return flagOf(json) ? Problems() : Problems{{"", "is ignored: it is neither true nor false"}};
  };
  return {{kOceanKey, flag},
          {kWaterKey, flag},
          {kFloatKey, problemsOfFloats},
          {kHullKey, [](const Json& json) {
             return hullRole(json) ? Problems()
                                   : Problems{{"", "is ignored: it is neither true, false nor \"inside\""}};
           }}};
}

}  // namespace scumble::ocean
