// Reading looks: JSON files, --set, the looks that ship; and describing the knobs as a list and as a JSON
// schema.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/image_decode.h"
#include "look/look_data.h"
#include "look/shipped_looks.h"
#include "scumble/look.h"

namespace scumble {

using look::Assignment;
using look::KnobRef;
using look::LookData;
using look::ParamBlock;
using look::ParamKind;
using look::ParamRow;
// In the order of the file, since of two settings alike the later one wins.
using json = nlohmann::ordered_json;

namespace {

constexpr size_t kMaxLookFile = 16 << 20;

// Splits "materials.Sail*.warp.amount" into pattern and knob. Material names may contain dots, so the knob is
// the shortest tail that is one.
Result<Assignment> resolve(const std::string& path) {
  const std::string prefix = "materials.";
  if (path.compare(0, prefix.size(), prefix) != 0) {
    const Result<KnobRef> knob = look::findKnob(path);
    if (!knob) return knob.error();
    return Assignment{"", knob->block, knob->row, {}};
  }
  const std::string rest = path.substr(prefix.size());
  if (rest.empty() || rest[0] == '.')
    return Error{ErrorKind::usage,
                 "",
                 0,
                 "",
                 "'" + path + "' names no material",
                 "write it like materials.Sail*.warp.amount"};
  for (size_t dot = rest.rfind('.'); dot != std::string::npos && dot > 0; dot = rest.rfind('.', dot - 1)) {
    const Result<KnobRef> knob = look::findKnob(rest.substr(dot + 1));
    if (!knob) continue;
    if (!knob->block->perMaterial)
      return Error{ErrorKind::usage,
                   "",
                   0,
                   "",
                   "'" + rest.substr(dot + 1) + "' holds for the whole scene",
                   "set it without 'materials.'"};
    return Assignment{rest.substr(0, dot), knob->block, knob->row, {}};
  }
  const size_t dot = rest.find('.');
  if (dot == std::string::npos)
    return Error{ErrorKind::usage,
                 "",
                 0,
                 "",
                 "'" + path + "' names no knob",
                 "write it like materials.Sail*.warp.amount"};
  return look::findKnob(rest.substr(dot + 1)).error();
}

// A picture that fits a knob is no photograph of a landscape.
constexpr uint32_t kMaxPictureSide = 4096;

Result<look::LookPicture> loadPicture(const std::string& file) {
  const auto fail = [&](std::string problem) {
    return Error{ErrorKind::unusableFile,
                 file,
                 0,
                 "",
                 std::move(problem),
                 "give a PNG, JPEG or WebP of at most " + std::to_string(kMaxPictureSide) +
                     " pixels a side, or a picture that is built in"};
  };
  look::LookPicture picture{file, {}, 0};
  FileBytes bytes;
  std::string problem;
  if (!bytes.open(file, problem)) return fail(problem);
  uint32_t width = 0, height = 0;
  if (!readImageSize(bytes.bytes(), width, height, problem)) return fail(problem);
  if (width > kMaxPictureSide || height > kMaxPictureSide) return fail("this picture is too large");
  if (!decodeImage(bytes.bytes(), picture.pixels, problem)) return fail(problem);
  picture.contents = contentsOf(picture.pixels);
  return picture;
}

// A value as text; a picture's file is loaded into `data`.
Result<look::Value> readValue(const ParamRow& row, const std::string& text, const std::string& folder,
                              LookData& data) {
  const Result<look::Value> parsed = look::parseValue(row, text);
  if (parsed || row.kind != ParamKind::picture) return parsed;
  // A word without a dot is a slip in a built-in name rather than a file.
  if (text.find('.') == std::string::npos) return parsed;
  Result<look::LookPicture> picture = loadPicture((std::filesystem::path(folder) / text).string());
  if (!picture) return picture.error();
  data.pictures.push_back(std::make_shared<const look::LookPicture>(std::move(picture).value()));
  return look::Value{-double(data.pictures.size()), {}};
}

bool leadsOutside(const std::filesystem::path& path) {
  return path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
}

// Walks a look's JSON; the first mistake ends it.
class Reader {
 public:
  Reader(LookData& out, std::string file) : out_(out), file_(std::move(file)) {}

  Status readRoot(const json& root) {
    if (!root.is_object()) return fail("", "a look is a JSON object", "see `scumble schema`");
    for (const auto& [key, value] : root.items()) {
      if (key == "$schema") continue;
      if (key == "description") {
        if (!value.is_string()) return fail(key, "the description is no string", "write it in quotes");
        out_.description = value.get<std::string>();
      } else if (key == "materials") {
        if (!value.is_object())
          return fail(key, "it is no object", "its keys are material names or patterns");
        for (const auto& [pattern, knobs] : value.items()) {
          if (pattern.empty()) return fail(key, "a material's pattern is empty", "'*' matches all");
          const Status status = readGroup(knobs, "", pattern, "materials." + pattern);
          if (!status) return status;
        }
      } else {
        const Status status = readGroup(value, key, "", key);
        if (!status) return status;
      }
    }
    return Done{};
  }

 private:
  Error fail(const std::string& path, std::string problem, std::string advice) const {
    return {ErrorKind::unusableFile, file_, 0, path, std::move(problem), std::move(advice)};
  }

  Status readGroup(const json& value, const std::string& knobPath, const std::string& pattern,
                   const std::string& jsonPath) {
    if (value.is_object()) {
      // No knob lies deeper; a hostile file could use up the stack.
      if (std::count(knobPath.begin(), knobPath.end(), '.') > 8)
        return fail(jsonPath, "there is no knob so deep inside", "`scumble params` lists them all");
      for (const auto& [key, child] : value.items()) {
        const Status status =
            readGroup(child, knobPath.empty() ? key : knobPath + "." + key, pattern, jsonPath + "." + key);
        if (!status) return status;
      }
      return Done{};
    }
    const Result<KnobRef> knob = look::findKnob(knobPath);
    if (!knob) return fail(jsonPath, knob.error().problem, knob.error().advice);
    if (!pattern.empty() && !knob->block->perMaterial)
      return fail(jsonPath, "this knob holds for the whole scene", "move it out of 'materials'");
    const bool wantsText = knob->row->kind == ParamKind::color || knob->row->kind == ParamKind::choice ||
                           knob->row->kind == ParamKind::picture;
    const bool fits = wantsText                              ? value.is_string()
                      : knob->row->kind == ParamKind::toggle ? value.is_boolean()
                                                             : value.is_number();
    if (!fits)
      return fail(jsonPath, "the value has the wrong type",
                  knob->row->kind == ParamKind::color    ? "write a colour as \"#RRGGBB\""
                  : knob->row->kind == ParamKind::choice ? std::string("choose one of ") + knob->row->unit
                  : knob->row->kind == ParamKind::picture
                      ? std::string("write a picture's path, or one of ") + knob->row->unit
                  : knob->row->kind == ParamKind::toggle ? "write true or false"
                                                         : "write a number");
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    // A look may come with a scene from anywhere: it reads pictures beside itself and below, and no others.
    if (knob->row->kind == ParamKind::picture && leadsOutside(text))
      return fail(jsonPath, "this picture lies outside of the look's folder", "put it beside the look");
    const Result<look::Value> parsed =
        readValue(*knob->row, text, std::filesystem::path(file_).parent_path().string(), out_);
    if (!parsed)
      return fail(
          jsonPath,
          parsed.error().file.empty() ? parsed.error().problem : "'" + text + "': " + parsed.error().problem,
          parsed.error().advice);
    out_.assignments.push_back({pattern, knob->block, knob->row, *parsed});
    return Done{};
  }

  LookData& out_;
  std::string file_;
};

}  // namespace

Look::Look() : data_(std::make_shared<LookData>()) {}

const std::string& Look::description() const {
  return data_->description;
}

Result<Look> Look::fromJson(const std::string& text, const std::string& file) {
  auto data = std::make_shared<LookData>();
  try {
    const json root = json::parse(text);
    const Status status = Reader(*data, file).readRoot(root);
    if (!status) return status.error();
  } catch (const json::parse_error& error) {
    const size_t end = std::min(error.byte, text.size());
    const int line = 1 + int(std::count(text.begin(), text.begin() + long(end), '\n'));
    return Error{
        ErrorKind::unusableFile, file, line, "", "this is no JSON", "mind commas, quotes and brackets there"};
  } catch (const json::exception&) {
    return Error{ErrorKind::unusableFile, file, 0, "", "this JSON cannot be read", "see `scumble schema`"};
  }
  Look look;
  look.data_ = std::move(data);
  return look;
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
  if (!std::filesystem::is_regular_file(nameOrFile, ignored))
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
    return Error{ErrorKind::unusableFile,        nameOrFile,      0, "",
                 "this is too large for a look", "check the path"};
  std::string text(size_t(size), '\0');
  file.seekg(0);
  if (!file.read(text.data(), size) && size > 0)
    return Error{ErrorKind::unusableFile, nameOrFile, 0, "", "the look cannot be read", "check the path"};
  return fromJson(text, nameOrFile);
}

Status Look::set(const std::string& path, const std::string& value) {
  Result<Assignment> assignment = resolve(path);
  if (!assignment) return assignment.error();
  auto changed = std::make_shared<LookData>(*data_);
  const Result<look::Value> parsed = readValue(*assignment->row, value, "", *changed);
  if (!parsed) {
    Error error = parsed.error();
    if (error.file.empty()) error.problem = path + ": " + error.problem;
    return error;
  }
  assignment->value = *parsed;
  assignment->byHand = true;
  changed->assignments.push_back(*assignment);
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
  static constexpr const char* kTypes[] = {"number", "integer", "toggle", "choice", "color", "picture"};
  std::vector<Knob> knobs;
  for (const ParamBlock* block : look::allBlocks())
    for (const ParamRow& row : block->rows) {
      Knob knob;
      knob.path = std::string(block->path) + "." + row.name;
      knob.type = kTypes[size_t(row.kind)];
      knob.defaultValue = look::formatValue(row, row.defaultValue);
      knob.min = look::formatValue(row, row.min);
      knob.max = look::formatValue(row, row.max);
      knob.unit = row.unit;
      knob.meaning = row.meaning;
      knob.perMaterial = block->perMaterial;
      knobs.push_back(std::move(knob));
    }
  return knobs;
}

std::string Look::jsonSchema() {
  // Blocks with dotted paths nest; per-material blocks appear a second time under "materials".
  const auto rowSchema = [](const ParamRow& row) {
    json schema{{"description", std::string(row.meaning)}};
    switch (row.kind) {
      case ParamKind::color:
        schema["type"] = "string";
        schema["pattern"] = "^#[0-9A-Fa-f]{6}$";
        break;
      case ParamKind::choice:
        schema["enum"] = look::choiceNames(row);
        break;
      case ParamKind::picture:
        schema["type"] = "string";
        schema["description"] =
            std::string(row.meaning) + " A picture's path beside the look, or one of " + row.unit + ".";
        break;
      case ParamKind::toggle:
        schema["type"] = "boolean";
        break;
      default:
        schema["type"] = row.kind == ParamKind::integer ? "integer" : "number";
        schema["minimum"] = row.min;
        schema["maximum"] = row.max;
        if (*row.unit) schema["description"] = std::string(row.meaning) + " [" + row.unit + "]";
    }
    if (row.kind == ParamKind::toggle)
      schema["default"] = row.defaultValue != 0;
    else if (row.kind == ParamKind::number || row.kind == ParamKind::integer)
      schema["default"] = row.defaultValue;
    else
      schema["default"] = look::formatValue(row, row.defaultValue);
    return schema;
  };
  const auto group = [] {
    return json{{"type", "object"}, {"additionalProperties", false}, {"properties", json::object()}};
  };
  const auto addBlock = [&](json& root, const ParamBlock& block) {
    json* at = &root;
    std::string path = block.path;
    while (!path.empty()) {
      const size_t dot = std::min(path.find('.'), path.size());
      json& child = (*at)["properties"][path.substr(0, dot)];
      if (child.is_null()) child = group();
      at = &child;
      path = dot < path.size() ? path.substr(dot + 1) : "";
    }
    for (const ParamRow& row : block.rows) (*at)["properties"][row.name] = rowSchema(row);
  };
  json root = group(), material = group();
  root["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  root["title"] = "scumble look";
  root["properties"]["$schema"] = {{"type", "string"}};
  root["properties"]["description"] = {{"type", "string"}};
  for (const ParamBlock* block : look::allBlocks()) {
    addBlock(root, *block);
    if (block->perMaterial) addBlock(material, *block);
  }
  root["properties"]["materials"] = {{"type", "object"}, {"additionalProperties", material}};
  return root.dump(2);
}

}  // namespace scumble
