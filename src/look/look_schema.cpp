// The JSON schema of look files, made from the knobs' rows.
#include <algorithm>

#include "base/color_text.h"
#include "look/look_json.h"
#include "look/setting_path.h"
#include "scumble/look.h"

namespace scumble {

namespace look {

namespace {

// What a value of this row is.
Json valueSchema(const ParamRow& row) {
  switch (row.kind) {
    case ParamKind::color:
      return Json::object({{"$ref", "#/$defs/color"}});
    case ParamKind::choice:
      return Json::object({{"enum", choiceNames(row)}});
    case ParamKind::picture:
    case ParamKind::name:
      return Json::object({{"type", "string"}});
    case ParamKind::triple: {
      const Json number{{"type", "number"}, {"minimum", row.min}, {"maximum", row.max}};
      return {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}};
    }
    case ParamKind::toggle:
      return Json::object({{"type", "boolean"}});
    default:
      return {{"type", row.kind == ParamKind::integer ? "integer" : "number"},
              {"minimum", row.min},
              {"maximum", row.max}};
  }
}

// A track of any values; each row says of its own which they are.
Json trackSchema(std::vector<std::string> interpolations, const char* usual) {
  const Json time = Json::object({{"type", "number"}});
  const Json key{{"type", "array"}, {"prefixItems", Json::array({time})}, {"minItems", 2}, {"maxItems", 2}};
  const Json keys{{"description", "Pairs of a time in seconds and a value; times increase."},
                  {"type", "array"},
                  {"minItems", 1},
                  {"maxItems", kMaxTrackKeys},
                  {"items", key}};
  return {{"description", "A value that changes with time."},
          {"type", "object"},
          {"additionalProperties", false},
          {"required", Json::array({"keys"})},
          {"properties",
           {{"keys", keys},
            {"interpolation", {{"enum", std::move(interpolations)}, {"default", usual}}},
            {"repeat", {{"type", "boolean"}, {"default", false}}}}}};
}

Json rowSchema(const ParamRow& row) {
  std::string description = row.meaning;
  if (row.kind == ParamKind::picture)
    description += std::string(" A picture's path beside the look, or one of ") + row.unit + ".";
  else if ((row.kind == ParamKind::number || row.kind == ParamKind::integer ||
            row.kind == ParamKind::triple) &&
           *row.unit)
    description += std::string(" [") + row.unit + "]";
  Json schema{{"description", description}};
  if (row.kind == ParamKind::toggle)
    schema["default"] = row.defaultValue != 0;
  else if (row.kind == ParamKind::number || row.kind == ParamKind::integer)
    schema["default"] = row.defaultValue;
  else if (row.kind == ParamKind::triple)
    schema["default"] = std::vector<double>(3, row.defaultValue);
  else
    schema["default"] = formatValue(row, row.defaultValue);
  const Json value = valueSchema(row);
  Json track;
  track["$ref"] = isSmooth(row.kind) ? "#/$defs/smoothTrack" : "#/$defs/stepTrack";
  track["properties"]["keys"]["items"]["prefixItems"] = Json::array({true, value});
  schema["oneOf"] = Json::array({value, track});
  return schema;
}

Json group() {
  return {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
}

// Blocks with dotted paths nest.
void addBlock(Json& root, const ParamBlock& block) {
  Json* at = &root;
  std::string path = block.path;
  while (!path.empty()) {
    const size_t dot = std::min(path.find('.'), path.size());
    Json& child = (*at)["properties"][path.substr(0, dot)];
    if (child.is_null()) child = group();
    at = &child;
    path = dot < path.size() ? path.substr(dot + 1) : "";
  }
  for (const ParamRow& row : block.rows) (*at)["properties"][row.name] = rowSchema(row);
}

}  // namespace

}  // namespace look

std::string Look::jsonSchema() {
  look::Json root = look::group();
  root["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  root["title"] = "scumble look";
  root["properties"]["$schema"] = {{"type", "string"}};
  root["properties"]["description"] = {{"type", "string"}};
  for (const look::ParamBlock* block : look::allBlocks())
    if (block->targets & look::kScene) look::addBlock(root, *block);
  for (const look::Section& section : look::kSections) {
    look::Json single = look::group();
    for (const look::ParamBlock* block : look::allBlocks())
      if (block->targets & section.target) look::addBlock(single, *block);
    root["properties"][section.name] = {
        {"type", "object"}, {"propertyNames", {{"minLength", 1}}}, {"additionalProperties", single}};
  }
  const look::Json digits{{"type", "string"}, {"pattern", "^#([0-9A-Fa-f]{3}|[0-9A-Fa-f]{6})$"}};
  const look::Json color{
      {"description", "A colour in sRGB: #RRGGBB, #RGB, or a name of CSS."},
      {"oneOf", look::Json::array({digits, look::Json::object({{"enum", colorNames()}})})}};
  root["properties"]["extends"] = {
      {"description", "A look that ships, or a .json beside this one: its settings come before these."},
      {"type", "string"}};
  root["$defs"] = {{"color", color},
                   {"smoothTrack", look::trackSchema({"step", "linear", "cubic", "ease"}, "linear")},
                   {"stepTrack", look::trackSchema({"step"}, "step")}};
  return root.dump(2);
}

}  // namespace scumble
