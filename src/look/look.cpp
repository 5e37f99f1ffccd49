// The public face of looks: loading them, setting knobs, listing the knobs and the looks that ship.
#include "scumble/look.h"

#include <filesystem>
#include <fstream>

#include "look/read_value.h"
#include "look/setting_path.h"
#include "look/shipped_looks.h"

namespace scumble {

namespace {

constexpr size_t kMaxLookFile = 16 << 20;

}  // namespace

Look::Look() : data_(std::make_shared<look::LookData>()) {}

const std::string& Look::description() const {
  return data_->description;
}

std::vector<std::string> Look::files() const {
  std::vector<std::string> files;
  for (const auto& picture : data_->pictures) files.push_back(picture->file);
  return files;
}

const std::vector<std::string>& Look::warnings() const {
  return data_->warnings;
}

Result<Look> Look::load(const std::string& nameOrFile) {
  const bool isFile = nameOrFile.find('/') != std::string::npos ||
                      (nameOrFile.size() > 5 && nameOrFile.compare(nameOrFile.size() - 5, 5, ".json") == 0);
  if (!isFile) {
    std::vector<std::string> names;
    for (const look::ShippedLookFile& file : look::shippedLookFiles()) {
      if (file.name == nameOrFile) return fromJson(std::string(file.text), nameOrFile);
      names.emplace_back(file.name);
    }
    const std::string suggestion = look::nearest(nameOrFile, names);
    return Error{ErrorKind::usage,
                 "",
                 0,
                 "",
                 "no look is called '" + nameOrFile + "'",
                 suggestion.empty() ? "`scumble looks` lists them; a file's name ends in .json"
                                    : "did you mean '" + suggestion + "'?"};
  }
  std::error_code ignored;
  if (nameOrFile.find('\0') != std::string::npos || !std::filesystem::is_regular_file(nameOrFile, ignored))
    return Error{
        ErrorKind::unusableFile,
        nameOrFile,
        0,
        "",
        std::filesystem::exists(nameOrFile, ignored) ? "this is no ordinary file" : "there is no such look",
        "give a JSON file, or a name that `scumble looks` lists"};
  std::ifstream file(nameOrFile, std::ios::binary | std::ios::ate);
  const auto size = file ? file.tellg() : std::streampos(-1);
  if (!file || size < 0)
    return Error{ErrorKind::unusableFile, nameOrFile, 0, "", "the look cannot be opened", "check the path"};
  if (size_t(size) > kMaxLookFile)
    return Error{
        ErrorKind::unusableFile,
        nameOrFile,
        0,
        "",
        "this is too large for a look: " + std::to_string((size_t(size) + (1 << 20) - 1) >> 20) + " MiB",
        "a look has " + std::to_string(kMaxLookFile >> 20) + " MiB at most; check the path"};
  std::string text(size_t(size), '\0');
  file.seekg(0);
  if (!file.read(text.data(), size) && size > 0)
    return Error{ErrorKind::unusableFile, nameOrFile, 0, "", "the look cannot be read", "check the path"};
  return fromJson(text, nameOrFile);
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
