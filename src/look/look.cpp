// The public face of looks: loading them, setting knobs, listing the knobs and the looks that ship.
#include "scumble/look.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/color_text.h"
#include "base/usage.h"
#include "look/look_source.h"
#include "look/read_value.h"
#include "look/setting_path.h"
#include "look/shipped_looks.h"

namespace scumble {

Look::Look() : data_(std::make_shared<look::LookData>()) {}

const std::string& Look::description() const {
  return data_->description;
}

std::vector<std::string> Look::files() const {
  std::vector<std::string> files = data_->files;
  for (const auto& picture : data_->pictures) files.push_back(picture->file);
  return files;
}

const std::vector<std::string>& Look::warnings() const {
  return data_->warnings;
}

bool isColor(const std::string& text) {
  return parseColor(text).has_value();
}

Result<Look> Look::load(const std::string& nameOrFile) {
  const Result<look::LookSource> source = look::findLook(nameOrFile);
  if (!source) return source.error();
  return fromJson(source->text, source->file);
}

Result<Look> Look::fromJson(const std::string& text, const std::string& file) {
  auto data = std::make_shared<look::LookData>();
  if (const Status status = look::readLook({file, text}, {}, *data); !status) return status.error();
  Look look;
  look.data_ = std::move(data);
  return look;
}

namespace {

// The number or numbers of a value that is no text, as rows have them.
Result<look::Value> typedValue(const look::ParamRow& row, const KnobValue& value) {
  using look::ParamKind;
  if (const bool* const on = std::get_if<bool>(&value)) {
    if (row.kind == ParamKind::toggle) return look::Value{double(*on), {}};
    return usage("it is no toggle", "give it a value of its own type");
  }
  if (const glm::vec3* const three = std::get_if<glm::vec3>(&value)) {
    if (row.kind != ParamKind::color && row.kind != ParamKind::triple)
      return usage("it is neither a colour nor a vector", "give it a value of its own type");
    for (int c = 0; c < 3; ++c) {
      const double number = double((*three)[c]);
      if (const Status status = look::checkNumber(row, number, fmt::format("{:g}", number)); !status)
        return status.error();
    }
    return look::Value{0, *three};
  }
  if (row.kind != ParamKind::number && row.kind != ParamKind::integer)
    return usage("it is no number", "give it a value of its own type");
  const double number = value.index() == 1 ? double(std::get<int>(value)) : std::get<double>(value);
  if (const Status status = look::checkNumber(row, number, fmt::format("{:g}", number)); !status)
    return status.error();
  return look::Value{number, {}};
}

// Names that a look declares count in the order of their first setting: that one stays where it is.
bool isFirstOfItsName(const std::vector<look::Assignment>& settings, const look::Assignment& setting) {
  const bool declares = setting.target != look::kScene && look::firstSection(setting.target).most > 0 &&
                        !look::isPattern(setting.pattern);
  return declares && &setting == &*std::find_if(settings.begin(), settings.end(), [&](const auto& other) {
           return other.target == setting.target && other.pattern == setting.pattern;
         });
}

bool isAlike(const look::Assignment& a, const look::Assignment& b) {
  return a.row == b.row && a.block == b.block && a.target == b.target && a.pattern == b.pattern &&
         a.byHand == b.byHand;
}

}  // namespace

Status Look::set(const std::string& path, const KnobValue& value) {
  const std::string* const text = std::get_if<std::string>(&value);
  if ((path + (text ? *text : "")).find('\0') != std::string::npos)
    return usage("a setting holds the character NUL", "leave it out");
  Result<look::Assignment> assignment = look::parseSettingPath(path);
  if (!assignment) return assignment.error();
  auto changed = std::make_shared<look::LookData>(*data_);
  const Result<look::Value> parsed =
      text ? look::readValue(*assignment->row, *text, "", *changed) : typedValue(*assignment->row, value);
  if (!parsed) {
    Error error = parsed.error();
    if (error.file.empty()) error.problem = path + ": " + error.problem;
    return error;
  }
  assignment->value = *parsed;
  assignment->byHand = true;
  std::vector<look::Assignment> kept;
  for (const look::Assignment& a : changed->assignments)
    if (!isAlike(a, *assignment) || isFirstOfItsName(changed->assignments, a)) kept.push_back(a);
  changed->assignments = std::move(kept);
  changed->assignments.push_back(*assignment);
  for (const look::Section& section : look::kSections)
    if (section.most > 0 && section.target == assignment->target &&
        changed->declared(section.target).size() > section.most)
      return usage(path + ": these are too many " + section.name,
                   "a look declares " + std::to_string(section.most) + " at most");
  data_ = std::move(changed);
  return Done{};
}

Status Look::unset(const std::string& path) {
  Result<look::Assignment> assignment = look::parseSettingPath(path);
  if (!assignment) return assignment.error();
  assignment->byHand = true;
  auto changed = std::make_shared<look::LookData>(*data_);
  std::erase_if(changed->assignments, [&](const look::Assignment& a) { return isAlike(a, *assignment); });
  data_ = std::move(changed);
  return Done{};
}

Result<KnobValue> Look::get(const std::string& path, double time) const {
  const Result<look::Assignment> knob = look::parseSettingPath(path);
  if (!knob) return knob.error();
  if (look::isPattern(knob->pattern))
    return usage(path + ": what '" + knob->pattern + "' matches has no one value", "ask for one name");
  const look::ParamRow& row = *knob->row;
  const look::LookData now = data_->at(time);
  const look::Value value = now.valueOf(row, *knob->block, knob->target, knob->pattern);
  switch (row.kind) {
    case look::ParamKind::toggle:
      return KnobValue(value.number != 0);
    case look::ParamKind::integer:
      return KnobValue(int(value.number));
    case look::ParamKind::number:
      return KnobValue(value.number);
    case look::ParamKind::color:
    case look::ParamKind::triple:
      return KnobValue(value.linear);
    case look::ParamKind::name:
      return KnobValue(now.text(look::Name(value.number)));
    case look::ParamKind::picture:
      if (value.number < 0) return KnobValue(now.pictures[size_t(-value.number) - 1]->file);
      [[fallthrough]];
    default:
      return KnobValue(look::formatValue(row, value.number));
  }
}

std::vector<ShippedLook> Look::shipped() {
  std::vector<ShippedLook> looks;
  for (const look::ShippedLookFile& file : look::shippedLookFiles()) {
    const Result<Look> look = load(std::string(file.name));
    looks.push_back({std::string(file.name), look ? look->description() : look.error().message()});
  }
  return looks;
}

std::vector<Knob> Look::knobs() {
  static constexpr const char* kTypes[] = {"number", "integer", "toggle", "choice",
                                           "color",  "picture", "vector", "name"};
  std::vector<Knob> knobs;
  for (const look::ParamBlock* block : look::allBlocks())
    for (const look::ParamRow& row : block->rows) {
      Knob knob;
      knob.path = std::string(block->path) + "." + row.name;
      knob.type = kTypes[size_t(row.kind)];
      knob.defaultValue = look::formatValue(row, row.defaultValue);
      knob.min = look::formatValue(row, row.min);
      knob.max = look::formatValue(row, row.max);
      knob.unit = row.unit;
      knob.meaning = row.meaning;
      if (block->targets & look::kScene) knob.targets.emplace_back("scene");
      for (const look::Section& section : look::kSections)
        if (block->targets & section.target) knob.targets.emplace_back(section.name);
      knobs.push_back(std::move(knob));
    }
  return knobs;
}

}  // namespace scumble
