// The JSON schema of looks: it is complete, and it accepts and refuses what the reader does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <regex>
#include <set>

#include "look/look_json.h"
#include "look/setting_path.h"
#include "look/shipped_looks.h"
#include "look/test_rows.h"
#include "scumble/look.h"

namespace scumble {
namespace {

using nlohmann::json;

bool hasType(const json& value, const std::string& type) {
  return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
         (type == "string" && value.is_string()) || (type == "boolean" && value.is_boolean()) ||
         (type == "number" && value.is_number()) ||
         (type == "integer" && value.is_number() && value.get<double>() == std::floor(value.get<double>()));
}

// JSON Schema 2020-12, as far as looks use it; other words fail.
bool accepts(const json& root, const json& schema, const json& value) {
  if (schema.is_boolean()) return schema.get<bool>();
  for (const auto& [word, rule] : schema.items()) {
    bool ok = true;
    if (word == "type") {
      ok = hasType(value, rule);
    } else if (word == "enum") {
      ok = std::find(rule.begin(), rule.end(), value) != rule.end();
    } else if (word == "pattern") {
      ok = !value.is_string() ||
           std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()));
    } else if (word == "minimum") {
      ok = !value.is_number() || value >= rule;
    } else if (word == "maximum") {
      ok = !value.is_number() || value <= rule;
    } else if (word == "minLength") {
      ok = !value.is_string() || value.get<std::string>().size() >= rule;
    } else if (word == "propertyNames" && value.is_object()) {
      for (const auto& [name, child] : value.items()) ok &= accepts(root, rule, name);
    } else if (word == "minItems") {
      ok = !value.is_array() || value.size() >= rule;
    } else if (word == "maxItems") {
      ok = !value.is_array() || value.size() <= rule;
    } else if (word == "required") {
      for (const json& name : rule) ok &= !value.is_object() || value.contains(name.get<std::string>());
    } else if (word == "oneOf") {
      ok = std::count_if(rule.begin(), rule.end(), [&](const json& s) { return accepts(root, s, value); }) ==
           1;
    } else if (word == "$ref") {
      ok = accepts(root, root.at(json::json_pointer(rule.get<std::string>().substr(1))), value);
    } else if (word == "items" && value.is_array()) {
      const size_t first = schema.contains("prefixItems") ? schema["prefixItems"].size() : 0;
      for (size_t i = first; i < value.size(); ++i) ok &= accepts(root, rule, value[i]);
    } else if (word == "prefixItems" && value.is_array()) {
      for (size_t i = 0; i < std::min(rule.size(), value.size()); ++i) ok &= accepts(root, rule[i], value[i]);
    } else if (word == "properties" && value.is_object()) {
      for (const auto& [name, child] : rule.items())
        ok &= !value.contains(name) || accepts(root, child, value[name]);
    } else if (word == "additionalProperties" && value.is_object()) {
      for (const auto& [name, child] : value.items())
        ok &= (schema.contains("properties") && schema["properties"].contains(name)) ||
              accepts(root, rule, child);
    } else {
      static const std::set<std::string> kOthers{
          "$schema", "$defs",       "title",      "description",          "default",
          "items",   "prefixItems", "properties", "additionalProperties", "propertyNames"};
      ok = kOthers.count(word);
    }
    if (!ok) return false;
  }
  return true;
}

// What the reader says; the schema must say the same.
void expectSame(const json& look, bool good) {
  static const json schema = json::parse(Look::jsonSchema());
  EXPECT_EQ(Look::fromJson(look.dump(), "f").ok(), good) << look.dump().substr(0, 200);
  EXPECT_EQ(accepts(schema, schema, look), good) << look.dump().substr(0, 200);
}

// The schema of a setting, by its path; null where there is none.
json schemaAt(const json& schema, const std::string& path) {
  json at = schema;
  for (size_t from = 0; from <= path.size();) {
    const size_t dot = std::min(path.find('.', from), path.size());
    if (!at.contains("properties") || !at["properties"].contains(path.substr(from, dot - from))) return {};
    const json next = at["properties"][path.substr(from, dot - from)];
    at = next, from = dot + 1;
  }
  return at;
}

TEST(LookSchema, describesEveryKnobWhereItHolds) {
  const json schema = json::parse(Look::jsonSchema());
  EXPECT_EQ(schema["type"], "object");
  EXPECT_TRUE(schema.contains("$schema"));
  EXPECT_EQ(schema["properties"]["description"]["type"], "string");
  for (const Row& row : allRows()) {
    for (const look::Section& section : look::kSections)
      EXPECT_EQ(!schemaAt(schema["properties"][section.name]["additionalProperties"], row.path()).is_null(),
                bool(row.block->targets & section.target))
          << section.name << " " << row.path();
    const bool forScene = row.block->targets & look::kScene;
    EXPECT_EQ(!schemaAt(schema, row.path()).is_null(), forScene) << row.path();
    const json entry = schemaAt(
        forScene ? schema
                 : schema["properties"][look::firstSection(row.block->targets).name]["additionalProperties"],
        row.path());
    EXPECT_NE(entry["description"].get<std::string>().find(row.row->meaning), std::string::npos);
    if (row.isNumber()) {
      EXPECT_EQ(entry["oneOf"][0]["minimum"], row.row->min);
      EXPECT_EQ(entry["oneOf"][0]["maximum"], row.row->max);
    }
    // The schema's default is a value that the reader takes.
    ASSERT_TRUE(entry.contains("default")) << row.path();
    EXPECT_TRUE(Look::fromJson(nested(row.settingPath(), entry["default"]), "f").ok()) << row.path();
  }
}

// Every group forbids what it does not know, so that an editor shows the same mistakes as the program.
TEST(LookSchema, groupsForbidUnknownKnobs) {
  const json schema = json::parse(Look::jsonSchema());
  size_t groups = 0;
  const std::function<void(const json&)> visit = [&](const json& at) {
    if (at.contains("properties")) {
      ++groups;
      EXPECT_EQ(at.value("additionalProperties", json(true)), json(false));
      for (const auto& [name, child] : at["properties"].items())
        if (!look::findSection(name) && name != "$schema") visit(child);
    }
  };
  visit(schema);
  for (const look::Section& section : look::kSections)
    visit(schema["properties"][section.name]["additionalProperties"]);
  EXPECT_GT(groups, look::allBlocks().size());
}

TEST(LookSchema, agreesWithTheReaderOnKeys) {
  const json amount = {{"warp", {{"amount", 1}}}};
  expectSame(amount, true);
  expectSame({{"warp.amount", 1}}, false);
  expectSame({{"warp", {{"metatexture.size", 200}}}}, false);
  expectSame({{"", amount}}, false);
  expectSame({{"$schema", "look.schema.json"}}, true);
  expectSame({{"$schema", 1}}, false);
  for (const look::Section& section : look::kSections) {
    expectSame({{section.name, json::object()}}, true);
    expectSame({{section.name, {{"A.001", json::object()}}}}, true);
    expectSame({{section.name, {{"", json::object()}}}}, false);
    expectSame({{section.name, {{"A", {{"", json::object()}}}}}}, false);
    expectSame({{std::string(section.name) + ".A", json::object()}}, false);
  }
}

TEST(LookSchema, acceptsTheLooksThatShip) {
  for (const look::ShippedLookFile& file : look::shippedLookFiles()) expectSame(json::parse(file.text), true);
}

TEST(LookSchema, agreesWithTheReaderOnEveryKnob) {
  for (const Row& row : allRows()) {
    const json value = sampleOf(*row.row).value;
    const auto expectTrack = [&](const json& track, bool good) {
      expectSame(json::parse(nested(row.settingPath(), track)), good);
    };
    expectSame(json::parse(nested(row.settingPath(), value)), true);
    expectSame(json::parse(nested("nodes.A." + row.path(), value)), row.block->targets & look::kNodes);
    expectTrack({{"keys", json::array({json::array({0, value}), json::array({1.5, value})})}}, true);
    for (const char* interpolation : {"step", "linear", "cubic", "bezier"})
      expectTrack({{"keys", json::array({json::array({0, value})})},
                   {"interpolation", interpolation},
                   {"repeat", true}},
                  interpolation == std::string("step") ||
                      (look::isSmooth(row.row->kind) && interpolation != std::string("bezier")));
    for (const json& wrong : {json(), json::object(), json(7e7), json("#1234567"), json::array({value})})
      if ((row.row->kind != look::ParamKind::picture && row.row->kind != look::ParamKind::name) ||
          !wrong.is_string())
        expectTrack({{"keys", json::array({json::array({0, wrong})})}}, false);
    expectTrack(json::object(), false);
    expectTrack({{"keys", json::array()}}, false);
    expectTrack({{"keys", json::array({json::array({0})})}}, false);
    expectTrack({{"keys", json::array({json::array({0, value, 0})})}}, false);
    expectTrack({{"keys", json::array({json::array({"0", value})})}}, false);
    expectTrack({{"keys", json::array({json::array({0, value})})}, {"repeat", 1}}, false);
    expectTrack({{"keys", json::array({json::array({0, value})})}, {"loop", true}}, false);
  }
}

}  // namespace
}  // namespace scumble
