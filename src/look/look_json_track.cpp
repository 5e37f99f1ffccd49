// Tracks in a look's JSON file.
#include <cmath>

#include "look/look_json.h"
#include "scumble/nearest.h"

namespace scumble::look {

namespace {

const std::vector<std::string> kMembers{"keys", "interpolation", "repeat"};
const std::vector<std::string> kInterpolations{"step", "linear", "cubic", "ease"};

Status readKeys(const ParamRow& row, const Json& keys, const JsonPlace& place, LookData& data, Track& out) {
  if (!keys.is_array()) return place.fail("the keys are no list", "write them like [[0, 0.3], [2.5, 0.5]]");
  if (keys.empty()) return place.fail("a track has no keys", "give at least one");
  if (keys.size() > kMaxTrackKeys)
    return place.fail("these are too many keys", "a track has " + std::to_string(kMaxTrackKeys) + " at most");
  out.keys.reserve(keys.size());
  for (size_t i = 0; i < keys.size(); ++i) {
    const JsonPlace here = place.item(i);
    if (!keys[i].is_array() || keys[i].size() != 2)
      return here.fail("a key is a time and a value", "write it like [2.5, VALUE]");
    const Json& time = keys[i][0];
    if (!time.is_number()) return here.item(0).fail("a key's time is no number", "write it in seconds");
    const double seconds = time.get<double>();
    if (!(std::abs(seconds) <= kMaxKeyTime))
      return here.item(0).fail("this time is out of range", "it is in seconds, a billion at most");
    if (i > 0 && seconds <= out.keys.back().time)
      return here.item(0).fail("this time is not later than the key's before",
                               "put keys in the order of time");
    const Result<Value> value = readJsonValue(row, keys[i][1], here.item(1), data);
    if (!value) return value.error();
    out.keys.push_back({seconds, *value});
  }
  return Done{};
}

Status readInterpolation(const ParamRow& row, const Json& value, const JsonPlace& place, Track& out) {
  const char* names = "it is step, linear, cubic or ease";
  if (!value.is_string()) return place.fail("the interpolation is no name", names);
  const std::string name = value.get<std::string>();
  for (size_t i = 0; i < kInterpolations.size(); ++i)
    if (name == kInterpolations[i]) {
      out.interpolation = Interpolation(i);
      if (out.interpolation != Interpolation::step && !isSmooth(row.kind))
        return place.fail("nothing lies between the values of this knob", "leave it out, or write \"step\"");
      return Done{};
    }
  const std::string suggestion = nearest(name, kInterpolations);
  return place.fail("there is no interpolation '" + name + "'",
                    suggestion.empty() ? names : "did you mean '" + suggestion + "'?");
}

}  // namespace

Result<Track> readTrack(const ParamRow& row, const Json& object, const JsonPlace& place, LookData& data) {
  Track track;
  track.interpolation = isSmooth(row.kind) ? Interpolation::linear : Interpolation::step;
  for (const auto& [name, value] : object.items()) {
    const JsonPlace here = place.member(name);
    Status status = Done{};
    if (name == "keys") {
      status = readKeys(row, value, here, data, track);
    } else if (name == "interpolation") {
      status = readInterpolation(row, value, here, track);
    } else if (name == "repeat") {
      if (!value.is_boolean()) return here.fail("the value has the wrong type", "write true or false");
      track.repeat = value.get<bool>();
    } else {
      const std::string suggestion = nearest(name, kMembers);
      return here.fail("a track has no '" + name + "'", suggestion.empty()
                                                            ? "it has keys, interpolation and repeat"
                                                            : "did you mean '" + suggestion + "'?");
    }
    if (!status) return status.error();
  }
  if (track.keys.empty()) return place.fail("this track has no keys", "write \"keys\": [[0, VALUE]]");
  return track;
}

}  // namespace scumble::look
