#include "look/look_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "base/color_text.h"
#include "base/numbers.h"
#include "base/usage.h"
#include "look/absent_groups.h"
#include "scumble/nearest.h"

namespace scumble::look {

namespace {

bool sets(const Assignment& a, const ParamBlock& block, const char* row, Target target) {
  return a.block == &block && a.target == target && std::strcmp(a.row->name, row) == 0;
}

std::string firstWord(const std::string& path) {
  return path.substr(0, path.find('.'));
}

std::string lastWord(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

// The knob that was probably meant, or empty.
std::string suggestionFor(const std::string& path, const std::vector<std::string>& known) {
  std::string slip = nearestWithin(path, known, 2);
  if (!slip.empty()) return slip;
  // A right word in a wrong place below the right group (texture.example for texture.metatexture.example) ...
  std::vector<std::string> ofGroup;
  for (const std::string& candidate : known)
    if (firstWord(candidate) == firstWord(path)) ofGroup.push_back(lastWord(candidate));
  const std::string row = nearest(lastWord(path), ofGroup);
  for (const std::string& candidate : known)
    if (firstWord(candidate) == firstWord(path) && lastWord(candidate) == row) return candidate;
  std::string far = nearest(path, known);
  if (!far.empty()) return far;
  // ... or in a wrong group.
  for (const std::string& candidate : known)
    if (lastWord(candidate) == lastWord(path)) return candidate;
  return "";
}

}  // namespace

void store(const ParamRow& row, const Value& value, void* block) {
  std::byte* const target = static_cast<std::byte*>(block) + row.offset;
  const auto put = [&](const auto& v) { std::memcpy(target, &v, sizeof(v)); };
  switch (row.kind) {
    case ParamKind::number:
      put(float(value.number));
      break;
    case ParamKind::integer:
      put(int(value.number));
      break;
    case ParamKind::toggle:
      put(Toggle(value.number));
      break;
    case ParamKind::choice:
      put(Choice(value.number));
      break;
    case ParamKind::color:
      put(value.linear);
      break;
    case ParamKind::picture:
      put(Picture(value.number));
      break;
    case ParamKind::triple:
      put(value.linear);
      break;
    case ParamKind::name:
      put(Name(value.number));
      break;
  }
}

bool LookData::isAnimated() const {
  return std::any_of(assignments.begin(), assignments.end(), [](const Assignment& a) { return a.track; });
}

LookData LookData::at(double time) const {
  LookData moment = *this;
  for (Assignment& a : moment.assignments)
    if (a.track) {
      a.value = a.track->at(*a.row, time);
      a.track.reset();
    }
  return moment;
}

void LookData::fill(const ParamBlock& block, void* out) const {
  for (const bool byHand : {false, true})
    for (const Assignment& a : assignments)
      if (a.block == &block && a.byHand == byHand && a.target == kScene) store(*a.row, a.value, out);
}

void LookData::fillFor(const ParamBlock& block, Target target, const std::string& name, void* out) const {
  for (const bool byHand : {false, true})
    for (const Target wanted : {kScene, target})
      for (const Assignment& a : assignments)
        if (a.block == &block && a.byHand == byHand && a.target == wanted &&
            (wanted == kScene || matches(a.pattern, name)))
          store(*a.row, a.value, out);
}

void LookData::fillFor(const ParamBlock& block, const std::string& material, std::span<const uint32_t> over,
                       void* out) const {
  for (const bool byHand : {false, true}) {
    const auto use = [&](const Assignment& a) {
      if (a.block == &block && a.byHand == byHand) store(*a.row, a.value, out);
    };
    for (const Assignment& a : assignments)
      if (a.target == kScene) use(a);
    for (const Assignment& a : assignments)
      if (a.target == kMaterials && matches(a.pattern, material)) use(a);
    for (const uint32_t place : over) use(assignments[place]);
  }
}

const Assignment* LookData::settingOf(const ParamRow& row, const ParamBlock& block, Target target,
                                      const std::string& name) const {
  const Assignment* found = nullptr;
  for (const bool byHand : {false, true})
    for (const Target wanted : {kScene, target})
      for (const Assignment& a : assignments)
        if (a.byHand == byHand && sets(a, block, row.name, wanted) &&
            (wanted == kScene || matches(a.pattern, name)))
          found = &a;
  return found;
}

Value LookData::valueOf(const ParamRow& row, const ParamBlock& block, Target target,
                        const std::string& name) const {
  const Assignment* const setting = settingOf(row, block, target, name);
  return setting ? setting->value : defaultOf(row);
}

const Assignment* LookData::settingOf(const ParamBlock& block, const char* row) const {
  const Assignment* found = nullptr;
  for (const bool byHand : {false, true})
    for (const Assignment& a : assignments)
      if (a.byHand == byHand && sets(a, block, row, kScene)) found = &a;
  return found;
}

bool LookData::names(const ParamBlock& block, const char* row, Target target, const std::string& name) const {
  return std::any_of(assignments.begin(), assignments.end(), [&](const Assignment& a) {
    return sets(a, block, row, target) && matches(a.pattern, name);
  });
}

bool LookData::setsAny(const ParamBlock& block, const char* row, Target target) const {
  return std::any_of(assignments.begin(), assignments.end(),
                     [&](const Assignment& a) { return sets(a, block, row, target); });
}

std::vector<std::string> LookData::declared(Target target) const {
  std::vector<std::string> names;
  for (const Assignment& a : assignments)
    if (a.target == target && !isPattern(a.pattern) &&
        std::find(names.begin(), names.end(), a.pattern) == names.end())
      names.push_back(a.pattern);
  return names;
}

const std::string& LookData::text(Name name) const {
  static const std::string kNone;
  return name.index > 0 ? texts[size_t(name.index - 1)] : kNone;
}

bool isPattern(const std::string& name) {
  return name.find_first_of("*?") != std::string::npos;
}

Result<KnobRef> findKnob(const std::string& path, Targets targets) {
  std::vector<std::string> known;
  for (const ParamBlock* block : allBlocks())
    for (const ParamRow& row : block->rows) {
      const std::string here = std::string(block->path) + "." + row.name;
      if (here == path) return KnobRef{block, &row};
      if (here.compare(0, path.size() + 1, path + ".") == 0)
        return usage("'" + path + "' is a group of knobs", "give values to knobs in it, like '" + here + "'");
      if (block->targets & targets) known.push_back(here);
    }
  if (const std::string feature = absentFeatureOf(path); !feature.empty())
    return usage("this program was built without '" + path + "'",
                 "use one with the feature '" + feature + "' (cmake -DSCUMBLE_WITHOUT)");
  const std::string suggestion = suggestionFor(path, known);
  return usage("there is no knob '" + path + "'",
               suggestion.empty() ? "`scumble params` lists them all" : "did you mean '" + suggestion + "'?");
}

bool isKnob(const std::string& path) {
  const size_t dot = path.rfind('.');
  if (dot == std::string::npos) return false;
  for (const ParamBlock* block : allBlocks())
    if (path.compare(0, dot, block->path) == 0)
      for (const ParamRow& row : block->rows)
        if (path.compare(dot + 1, std::string::npos, row.name) == 0) return true;
  return false;
}

Status checkNumber(const ParamRow& row, double number, const std::string& text) {
  const bool isColor = row.kind == ParamKind::color;
  const double least = isColor ? 0 : row.min, most = isColor ? 1 : row.max;
  if (!(number >= least && number <= most))
    return usage(fmt::format("{} is out of range", text), fmt::format("it may be {:g} to {:g}", least, most));
  if (row.kind == ParamKind::integer && number != std::floor(number))
    return usage("'" + text + "' is no whole number", "write a whole number");
  return Done{};
}

namespace {

Result<double> parseNumber(const ParamRow& row, const std::string& text) {
  const std::optional<double> number = numberOf(text);
  if (!number) return usage("'" + text + "' is no number", "write a number");
  if (const Status status = checkNumber(row, *number, text); !status) return status.error();
  return *number;
}

Result<Value> parseTriple(const ParamRow& row, const std::string& text) {
  Value value;
  size_t from = 0;
  for (int i = 0; i < 3; ++i) {
    const size_t comma = text.find(',', from);
    if ((comma == std::string::npos) != (i == 2))
      return usage("'" + text + "' is not three numbers", "write them like 1,2,3");
    const Result<double> number = parseNumber(row, text.substr(from, comma - from));
    if (!number) return number.error();
    value.linear[i] = float(*number);
    from = comma + 1;
  }
  return value;
}

}  // namespace

Result<Value> parseValue(const ParamRow& row, const std::string& text) {
  if (row.kind == ParamKind::color) {
    if (const std::optional<uint32_t> color = parseColor(text)) return Value{0, linearFromSrgb(*color)};
    std::string small = text;
    for (char& c : small)
      if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    const std::string meant = text.starts_with('#') ? "" : nearest(small, colorNames());
    return usage("'" + text + "' is no colour", meant.empty() ? "write it as #RRGGBB, #RGB or a name of CSS"
                                                              : "did you mean '" + meant + "'?");
  }
  if (row.kind == ParamKind::choice || row.kind == ParamKind::picture) {
    const std::vector<std::string> names = choiceNames(row);
    const auto it = std::find(names.begin(), names.end(), text);
    if (it == names.end())
      return usage("'" + text + "' is none of " + row.unit, row.kind == ParamKind::picture
                                                                ? "choose one of them, or a picture's file"
                                                                : "choose one of them");
    return Value{double(it - names.begin()), {}};
  }
  if (row.kind == ParamKind::toggle) {
    if (text == "true" || text == "1" || text == "on") return Value{1, {}};
    if (text == "false" || text == "0" || text == "off") return Value{0, {}};
    return usage("'" + text + "' is neither true nor false", "write true or false");
  }
  if (row.kind == ParamKind::triple) return parseTriple(row, text);
  const Result<double> number = parseNumber(row, text);
  if (!number) return number.error();
  return Value{*number, {}};
}

Value defaultOf(const ParamRow& row) {
  if (row.kind == ParamKind::color) return {0, linearFromSrgb(uint32_t(row.defaultValue))};
  if (row.kind == ParamKind::triple) return {0, glm::vec3(float(row.defaultValue))};
  return {row.defaultValue, {}};
}

std::string formatValue(const ParamRow& row, double number) {
  switch (row.kind) {
    case ParamKind::toggle:
      return number != 0 ? "true" : "false";
    case ParamKind::choice:
    case ParamKind::picture:
      return choiceNames(row)[size_t(number)];
    case ParamKind::color:
      return fmt::format("#{:06X}", uint32_t(number));
    case ParamKind::triple:
      return fmt::format("{0:g},{0:g},{0:g}", number);
    case ParamKind::name:
      return "";
    default:
      return fmt::format("{:g}", number);
  }
}

}  // namespace scumble::look
