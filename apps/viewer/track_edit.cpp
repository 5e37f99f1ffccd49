#include "track_edit.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "knob_text.h"

namespace scumble::viewer {

namespace {

Interpolation usualFor(const Knob& knob) {
  return isSmooth(knob) ? Interpolation::linear : Interpolation::step;
}

std::string jsonOf(const KnobValue& value, const Knob& knob) {
  const std::string text = textOf(value, knob);
  if (knob.type == "vector") return "[" + text + "]";
  const bool isWord = knob.type != "number" && knob.type != "integer" && knob.type != "toggle";
  return isWord ? nlohmann::json(text).dump() : text;
}

std::optional<KnobTrack> trackOf(const Look& look, const std::string& path) {
  const Result<std::optional<KnobTrack>> track = look.track(path);
  return track ? *track : std::nullopt;
}

std::optional<KnobValue> valueFrom(const std::string& path, const std::string& text) {
  Look look;
  if (!look.set(path, text)) return std::nullopt;
  const Result<KnobValue> value = look.get(path);
  return value ? std::optional(*value) : std::nullopt;
}

}  // namespace

bool isSmooth(const Knob& knob) {
  return knob.type == "number" || knob.type == "integer" || knob.type == "color" || knob.type == "vector";
}

std::optional<std::string> textOf(const KnobTrack& track, const Knob& knob) try {
  std::string keys;
  for (const KnobTrack::Key& key : track.keys)
    keys += (keys.empty() ? "[" : ", [") + textOf(key.time) + ", " + jsonOf(key.value, knob) + "]";
  std::string text = "{ \"keys\": [" + keys + "]";
  if (track.interpolation != usualFor(knob))
    text += std::string(", \"interpolation\": \"") + kInterpolations[size_t(track.interpolation)] + "\"";
  return text + (track.repeat ? ", \"repeat\": true }" : " }");
} catch (const nlohmann::json::exception&) {
  return std::nullopt;
}

Error noTrackOf(const std::string& path) {
  return {ErrorKind::usage,
          "",
          0,
          "",
          path + ": a file's name is no UTF-8, and has no place in a track",
          "give the file another name"};
}

bool isTrackText(const std::string& text) {
  const auto parsed =
      text.starts_with('{') ? nlohmann::json::parse(text, nullptr, false) : nlohmann::json(nullptr);
  return parsed.is_object() && parsed.contains("keys");
}

double onKeyGrid(double time) {
  return std::floor(time * kKeysPerSecond + 1e-6) / kKeysPerSecond;
}

std::optional<size_t> keyAt(const KnobTrack& track, double time) {
  std::optional<size_t> nearest;
  const auto away = [&](size_t i) { return std::abs(track.keys[i].time - time); };
  for (size_t i = 0; i < track.keys.size(); ++i)
    if (away(i) < kNearKey && (!nearest || away(i) < away(*nearest))) nearest = i;
  return nearest;
}

void putKey(KnobTrack& track, double time, const KnobValue& value) {
  if (const std::optional<size_t> there = keyAt(track, time)) {
    track.keys[*there].value = value;
    return;
  }
  const auto after = std::upper_bound(track.keys.begin(), track.keys.end(), time,
                                      [](double t, const KnobTrack::Key& key) { return t < key.time; });
  track.keys.insert(after, {onKeyGrid(time), value});
}

double moveKey(KnobTrack& track, size_t key, double time) {
  if (key > 0) time = std::max(time, track.keys[key - 1].time + 2 * kNearKey);
  if (key + 1 < track.keys.size()) time = std::min(time, track.keys[key + 1].time - 2 * kNearKey);
  // Between two that leave no room it stays.
  const bool isBetween = (key == 0 || time > track.keys[key - 1].time) &&
                         (key + 1 == track.keys.size() || time < track.keys[key + 1].time);
  if (isBetween) track.keys[key].time = onKeyGrid(time);
  return track.keys[key].time;
}

std::optional<std::string> turnedAt(const Look& look, const std::string& path, const std::string& value,
                                    double time) {
  std::optional<KnobTrack> track = trackOf(look, path);
  if (!track) return value;
  const std::optional<KnobValue> turned = valueFrom(path, value);
  if (!turned) return std::nullopt;
  putKey(*track, time, *turned);
  return textOf(*track, *settingOf(path)->knob);
}

std::optional<std::string> keyToggledAt(const Look& look, const std::string& path, double time) {
  const Result<KnobValue> present = look.get(path, time);
  const std::optional<Setting> setting = settingOf(path);
  if (!present || !setting) return std::nullopt;
  std::optional<KnobTrack> track = trackOf(look, path);
  if (!track) track = KnobTrack{{}, usualFor(*setting->knob)};
  if (const std::optional<size_t> there = keyAt(*track, time)) {
    track->keys.erase(track->keys.begin() + std::ptrdiff_t(*there));
    if (track->keys.empty()) return textOf(*present, *setting->knob);
  } else {
    putKey(*track, time, *present);
  }
  return textOf(*track, *setting->knob);
}

std::optional<std::string> keyedAt(const Look& look, const std::string& path, const KnobValue& value,
                                   double time, Interpolation interpolation) {
  KnobTrack track = trackOf(look, path).value_or(KnobTrack{{}, interpolation});
  putKey(track, time, value);
  return textOf(track, *settingOf(path)->knob);
}

}  // namespace scumble::viewer
