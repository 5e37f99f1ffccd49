#include "knob_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "track_edit.h"

namespace scumble::viewer {

namespace {

std::string inSmallLetters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

// IEC 61966-2-1.
float curveOf(float linear) {
  const float x = std::clamp(linear, 0.0f, 1.0f);
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}
float linearOf(float curve) {
  const float x = std::clamp(curve, 0.0f, 1.0f);
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

}  // namespace

std::string textOf(double value) {
  char text[32];
  // Of a number that was a float, the digits that a float has.
  const auto asFloat = float(value);
  const std::to_chars_result end = double(asFloat) == value ? std::to_chars(text, text + sizeof text, asFloat)
                                                            : std::to_chars(text, text + sizeof text, value);
  return {text, end.ptr};
}

std::string textOf(const glm::vec3& value) {
  return textOf(double(value.x)) + "," + textOf(double(value.y)) + "," + textOf(double(value.z));
}

std::string textOf(const KnobValue& value, const Knob& knob) {
  if (const bool* toggle = std::get_if<bool>(&value)) return *toggle ? "true" : "false";
  if (const int* integer = std::get_if<int>(&value)) return std::to_string(*integer);
  if (const double* number = std::get_if<double>(&value)) return textOf(*number);
  if (const auto* triple = std::get_if<glm::vec3>(&value))
    return knob.type == "color" ? hexOf(*triple) : textOf(*triple);
  return std::get<std::string>(value);
}

glm::vec3 curveOf(const glm::vec3& linear) {
  return {curveOf(linear.x), curveOf(linear.y), curveOf(linear.z)};
}
glm::vec3 linearOf(const glm::vec3& curve) {
  return {linearOf(curve.x), linearOf(curve.y), linearOf(curve.z)};
}

std::string hexOf(const glm::vec3& linear) {
  const glm::ivec3 bytes = glm::ivec3(curveOf(linear) * 255.0f + 0.5f);
  char text[8];
  std::snprintf(text, sizeof text, "#%02X%02X%02X", unsigned(bytes.x), unsigned(bytes.y), unsigned(bytes.z));
  return text;
}

const std::vector<Knob>& allKnobs() {
  static const std::vector<Knob> knobs = Look::knobs();
  return knobs;
}

bool isSetFor(const Knob& knob, const std::string& target) {
  return std::find(knob.targets.begin(), knob.targets.end(), target) != knob.targets.end();
}

std::optional<Setting> settingOf(const std::string& path) {
  std::optional<Setting> found;
  const size_t dot = path.find('.');
  for (const Knob& knob : allKnobs()) {
    if (knob.path == path) return Setting{"", "", &knob};
    const std::string section = path.substr(0, dot);
    if (!isSetFor(knob, section)) continue;
    // Names may have dots, so the knob is the shortest tail that is one.
    if (path.size() < dot + knob.path.size() + 3 || !path.ends_with("." + knob.path)) continue;
    if (found && found->knob->path.size() < knob.path.size()) continue;
    found = Setting{section, path.substr(dot + 1, path.size() - knob.path.size() - dot - 2), &knob};
  }
  return found;
}

std::string valueText(const Look& look, const std::string& path) {
  const std::optional<Setting> setting = settingOf(path);
  const Result<KnobValue> value = look.get(path);
  if (!setting || !value) return "";
  const Result<std::optional<KnobTrack>> track = look.track(path);
  if (track && *track) return textOf(**track, *setting->knob).value_or("");
  return textOf(*value, *setting->knob);
}

std::vector<std::string> wordsOf(const Knob& knob) {
  std::vector<std::string> words;
  std::stringstream unit(knob.unit);
  for (std::string word; std::getline(unit, word, '|');) words.push_back(word);
  return words;
}

bool isFound(const Knob& knob, const std::string& search) {
  if (search.empty()) return true;  // as for most of the frames in which all knobs are asked
  const std::string text = inSmallLetters(knob.path + " " + knob.meaning + " " + knob.unit);
  std::stringstream words(inSmallLetters(search));
  for (std::string word; words >> word;)
    if (text.find(word) == std::string::npos) return false;
  return true;
}

}  // namespace scumble::viewer
