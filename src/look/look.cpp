// The public face of looks: loading them, setting knobs, listing the knobs and the looks that ship.
#include "scumble/look.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/color_text.h"
#include "base/usage.h"
#include "look/look_json.h"
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

bool isLookFile(const std::string& nameOrFile) {
  return nameOrFile.find('/') != std::string::npos ||
         (nameOrFile.size() > 5 && nameOrFile.compare(nameOrFile.size() - 5, 5, ".json") == 0);
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

Result<look::Value> valueFrom(const look::ParamRow& row, const KnobValue& value, look::LookData& data) {
  const std::string* const text = std::get_if<std::string>(&value);
  return text ? look::readValue(row, *text, "", data) : typedValue(row, value);
}

// What is wrong with a setting by hand: its path stands before it, unless it is a file that is wrong.
Error ofSetting(const std::string& path, Error error) {
  if (error.file.empty()) error = usage(path + error.jsonPath + ": " + error.problem, error.advice);
  return error;
}

// Names may begin like a track.
bool isTrackText(const look::ParamRow& row, const std::string& text) {
  if (!text.starts_with('{')) return false;
  if (row.kind != look::ParamKind::name) return true;
  const auto parsed = look::Json::parse(text, nullptr, false);
  return parsed.is_object() && parsed.contains("keys");
}

Result<look::Track> trackFrom(const look::ParamRow& row, const std::string& text, look::LookData& data) {
  const look::Json parsed = look::Json::parse(text, nullptr, false);
  if (!parsed.is_object())
    return usage("this track is no JSON", "write it like {\"keys\": [[0, VALUE], [2.5, VALUE]]}");
  const std::string byHand;
  return look::readTrack(row, parsed, {byHand, ""}, data);
}

Result<look::Track> trackFrom(const look::ParamRow& row, const KnobTrack& from, look::LookData& data) {
  if (from.keys.empty() || from.keys.size() > look::kMaxTrackKeys)
    return usage(fmt::format("a track has {} keys", from.keys.size()),
                 fmt::format("give it 1 to {}", look::kMaxTrackKeys));
  if (from.interpolation != Interpolation::step && !look::isSmooth(row.kind))
    return usage("nothing lies between the values of this knob", "let its track go by steps");
  look::Track track{{}, from.interpolation, from.repeat};
  for (const KnobTrack::Key& key : from.keys) {
    if (!(std::abs(key.time) <= look::kMaxKeyTime))
      return usage(fmt::format("the time {:g} is out of range", key.time),
                   "it is in seconds, a billion at most");
    if (!track.keys.empty() && key.time <= track.keys.back().time)
      return usage(fmt::format("the time {:g} is not later than the key's before", key.time),
                   "put keys in the order of time");
    const Result<look::Value> value = valueFrom(row, key.value, data);
    if (!value) return value.error();
    track.keys.push_back({key.time, *value});
  }
  return track;
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

namespace {

Result<look::Assignment> settingAt(const std::string& path) {
  if (path.find('\0') != std::string::npos) return usage("a setting holds the character NUL", "leave it out");
  return look::parseSettingPath(path);
}

// With one more setting by hand, in place of such as are like it.
Status add(look::Assignment setting, const std::string& path, look::LookData& data) {
  setting.byHand = true;
  std::vector<look::Assignment> kept;
  for (const look::Assignment& a : data.assignments)
    if (!isAlike(a, setting) || isFirstOfItsName(data.assignments, a)) kept.push_back(a);
  data.assignments = std::move(kept);
  data.assignments.push_back(setting);
  for (const look::Section& section : look::kSections)
    if (section.most > 0 && section.target == setting.target &&
        data.declared(section.target).size() > section.most)
      return usage(path + ": these are too many " + section.name,
                   "a look declares " + std::to_string(section.most) + " at most");
  return Done{};
}

Status addTrack(look::Assignment setting, Result<look::Track> track, const std::string& path,
                look::LookData& data) {
  if (!track) return ofSetting(path, track.error());
  setting.value = track->at(*setting.row, 0);
  setting.track = std::make_shared<const look::Track>(std::move(track).value());
  return add(std::move(setting), path, data);
}

}  // namespace

Status Look::set(const std::string& path, const KnobValue& value) {
  const std::string* const text = std::get_if<std::string>(&value);
  Result<look::Assignment> setting = settingAt(path);
  if (!setting) return setting.error();
  auto changed = std::make_shared<look::LookData>(*data_);
  Status status = Done{};
  if (text && isTrackText(*setting->row, *text)) {
    status = addTrack(*setting, trackFrom(*setting->row, *text, *changed), path, *changed);
  } else {
    const Result<look::Value> parsed = valueFrom(*setting->row, value, *changed);
    if (!parsed) return ofSetting(path, parsed.error());
    setting->value = *parsed;
    status = add(*setting, path, *changed);
  }
  if (status) data_ = std::move(changed);
  return status;
}

Status Look::set(const std::string& path, const KnobTrack& track) {
  const Result<look::Assignment> setting = settingAt(path);
  if (!setting) return setting.error();
  auto changed = std::make_shared<look::LookData>(*data_);
  Status status = addTrack(*setting, trackFrom(*setting->row, track, *changed), path, *changed);
  if (status) data_ = std::move(changed);
  return status;
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

namespace {

// A knob of which one thing holds.
Result<look::Assignment> knobAt(const std::string& path) {
  Result<look::Assignment> knob = look::parseSettingPath(path);
  if (knob && look::isPattern(knob->pattern))
    return usage(path + ": what '" + knob->pattern + "' matches has no one value", "ask for one name");
  return knob;
}

KnobValue knobValue(const look::ParamRow& row, const look::Value& value, const look::LookData& data) {
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
      return KnobValue(data.text(look::Name(value.number)));
    case look::ParamKind::picture:
      if (value.number < 0) return KnobValue(data.pictures[size_t(-value.number) - 1]->file);
      [[fallthrough]];
    default:
      return KnobValue(look::formatValue(row, value.number));
  }
}

}  // namespace

Result<KnobValue> Look::get(const std::string& path, double time) const {
  const Result<look::Assignment> knob = knobAt(path);
  if (!knob) return knob.error();
  const look::ParamRow& row = *knob->row;
  const look::Assignment* const setting = data_->settingOf(row, *knob->block, knob->target, knob->pattern);
  const look::Value value = !setting         ? look::defaultOf(row)
                            : setting->track ? setting->track->at(row, time)
                                             : setting->value;
  return knobValue(row, value, *data_);
}

Result<std::optional<KnobTrack>> Look::track(const std::string& path) const {
  const Result<look::Assignment> knob = knobAt(path);
  if (!knob) return knob.error();
  const look::Assignment* const setting =
      data_->settingOf(*knob->row, *knob->block, knob->target, knob->pattern);
  if (!setting || !setting->track) return std::optional<KnobTrack>();
  KnobTrack track{{}, setting->track->interpolation, setting->track->repeat};
  for (const look::Key& key : setting->track->keys)
    track.keys.push_back({key.time, knobValue(*knob->row, key.value, *data_)});
  return std::optional(std::move(track));
}

std::vector<std::string> Look::animated() const {
  std::vector<std::string> paths;
  for (const look::Assignment& a : data_->assignments) {
    if (!a.track) continue;
    std::string path = std::string(a.block->path) + "." + a.row->name;
    if (a.target != look::kScene)
      path = std::string(look::firstSection(a.target).name) + "." + a.pattern + "." + path;
    if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(std::move(path));
  }
  return paths;
}

double Look::lastKeyTime() const {
  double last = 0;
  for (const look::Assignment& a : data_->assignments)
    if (a.track) last = std::max(last, a.track->keys.back().time);
  return last;
}

std::vector<std::string> Look::names(const std::string& section) const {
  const look::Section* const found = look::findSection(section);
  return found ? data_->declared(found->target) : std::vector<std::string>();
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
