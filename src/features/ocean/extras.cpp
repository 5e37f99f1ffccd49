#include "features/ocean/extras.h"

#include <nlohmann/json.hpp>

namespace scumble::ocean {

namespace {

using Json = nlohmann::json;
using Problems = scene::ExtraRule::Problems;

constexpr const char *kOceanKey = "scumble_ocean", *kFloatKey = "scumble_float";

// Modelling programs write 0 and 1 as well. Absent: it is neither.
std::optional<bool> flagOf(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number() && (json.get<double>() == 0 || json.get<double>() == 1))
    return json.get<double>() == 1;
  return std::nullopt;
}

// `problems` may be null.
std::optional<Floats> readFloats(const Json& json, Problems* problems) {
  const auto report = [&](const std::string& path, const char* text) {
    if (problems) problems->push_back({path, text});
  };
  if (const std::optional<bool> flag = flagOf(json)) return *flag ? std::optional(Floats()) : std::nullopt;
  if (!json.is_object()) {
    report("", "what floats is ignored: it is neither true nor an object");
    return std::nullopt;
  }
  constexpr double kLongest = 1000;  // as the knobs have it
  Floats floats;
  for (const auto& [key, value] : json.items()) {
    if (key == "length" || key == "beam") {
      const double metres = value.is_number() ? value.get<double>() : -1;
      if (metres >= 0 && metres <= kLongest)
        (key == "length" ? floats.length : floats.beam) = float(metres);
      else
        report("." + key, "a size of what floats is ignored: it is no number from 0 to 1000");
    } else if (key == "bow") {
      if (value == "x" || value == "z")
        floats.bowAlongZ = value == "z";
      else
        report("." + key, "a bow is ignored: it is neither \"x\" nor \"z\"");
    } else {
      report("." + key, "is ignored: what floats has length, beam and bow");
    }
  }
  return floats;
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

std::optional<Floats> floatsOf(const scene::Node& node) {
  const Json* const json = find(node, kFloatKey);
  std::optional<Floats> floats = json ? readFloats(*json, nullptr) : std::nullopt;
  if (floats)
    for (std::optional<float>* metres : {&floats->length, &floats->beam})
      if (*metres) **metres *= node.extrasScale;
  return floats;
}

std::vector<scene::ExtraRule> extraRules() {
  return {{kOceanKey,
           [](const Json& json) {
             return flagOf(json) ? Problems() : Problems{{"", "is ignored: it is neither true nor false"}};
           }},
          {kFloatKey, [](const Json& json) {
             Problems problems;
             readFloats(json, &problems);
             return problems;
           }}};
}

}  // namespace scumble::ocean
