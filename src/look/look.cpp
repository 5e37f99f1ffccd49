// The public face of looks: loading them, setting knobs, listing the knobs and the looks that ship.
#include "scumble/look.h"

#include "base/color_text.h"
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

Status Look::set(const std::string& path, const std::string& value) {
  if ((path + value).find('\0') != std::string::npos)
    return Error{ErrorKind::usage, "", 0, "", "a setting holds the character NUL", "leave it out"};
  Result<look::Assignment> assignment = look::parseSettingPath(path);
  if (!assignment) return assignment.error();
  auto changed = std::make_shared<look::LookData>(*data_);
  const Result<look::Value> parsed = look::readValue(*assignment->row, value, "", *changed);
  if (!parsed) {
    Error error = parsed.error();
    if (error.file.empty()) error.problem = path + ": " + error.problem;
    return error;
  }
  assignment->value = *parsed;
  assignment->byHand = true;
  changed->assignments.push_back(*assignment);
  for (const look::Section& section : look::kSections)
    if (section.most > 0 && section.target == assignment->target &&
        changed->declared(section.target).size() > section.most)
      return Error{ErrorKind::usage,
                   "",
                   0,
                   "",
                   path + ": these are too many " + section.name,
                   "a look declares " + std::to_string(section.most) + " at most"};
  data_ = std::move(changed);
  return Done{};
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
