// Every knob that there is, values for it, and what a look makes of it; for the tests of this room.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "look/look_data.h"
#include "look/setting_path.h"
#include "scumble/look.h"

namespace scumble {

struct Row {
  const look::ParamBlock* block;
  const look::ParamRow* row;
  // Bytes in the struct.
  size_t size() const {
    return row->kind == look::ParamKind::color || row->kind == look::ParamKind::triple ? 12 : 4;
  }
  std::string path() const { return std::string(block->path) + "." + row->name; }
  // Where a setting for all stands: below a section, where the knob is not for the whole scene.
  std::string settingPath() const {
    return (block->targets & look::kScene ? ""
                                          : std::string(look::firstSection(block->targets).name) + ".any.") +
           path();
  }
  bool isNumber() const {
    return row->kind == look::ParamKind::number || row->kind == look::ParamKind::integer;
  }
};

inline std::vector<Row> allRows() {
  std::vector<Row> rows;
  for (const look::ParamBlock* block : look::allBlocks())
    for (const look::ParamRow& row : block->rows) rows.push_back({block, &row});
  return rows;
}

// "a.b.c" and a value as a look file.
inline std::string nested(const std::string& path, const nlohmann::json& value) {
  nlohmann::json root = value;
  std::string rest = path;
  while (!rest.empty()) {
    const size_t dot = rest.rfind('.');
    root = nlohmann::json{{dot == std::string::npos ? rest : rest.substr(dot + 1), root}};
    rest = dot == std::string::npos ? "" : rest.substr(0, dot);
  }
  return root.dump();
}

// A value that is not the default, as text for set() and as JSON for files.
struct Sample {
  std::string text;
  nlohmann::json value;
};
inline Sample sampleOf(const look::ParamRow& row) {
  switch (row.kind) {
    case look::ParamKind::color:
      return {"#12AB9f", "#12AB9f"};
    case look::ParamKind::picture:
    case look::ParamKind::choice: {
      const std::vector<std::string> names = look::choiceNames(row);
      const std::string& name = names[row.defaultValue == 0 ? names.size() - 1 : 0];
      return {name, name};
    }
    case look::ParamKind::toggle:
      return {row.defaultValue == 0 ? "true" : "false", row.defaultValue == 0};
    case look::ParamKind::integer: {
      const int value = int(row.defaultValue == row.max ? row.min : row.max);
      return {std::to_string(value), value};
    }
    case look::ParamKind::triple: {
      const double step = 0.125 * (row.max - row.min);
      const nlohmann::json value{row.min + step, row.min + 2 * step, row.min + 3 * step};
      const std::string text = value.dump();
      return {text.substr(1, text.size() - 2), value};
    }
    case look::ParamKind::name:
      return {"Sail.001", "Sail.001"};
    case look::ParamKind::number:
      break;
  }
  const double value = row.min + 0.375 * (row.max - row.min);
  return {nlohmann::json(value).dump(), value};
}

// The bytes of a block under a look, for all or for one material.
inline std::vector<char> bytesOf(const look::ParamBlock& block, const Look& look,
                                 const std::string* material = nullptr) {
  std::vector<char> bytes(block.structSize, 0);
  if (material)
    look.data().fillFor(block, look::kMaterials, *material, bytes.data());
  else if (block.targets & look::kScene)
    look.data().fill(block, bytes.data());
  else
    look.data().fillFor(block, look::firstSection(block.targets).target, "any", bytes.data());
  return bytes;
}

inline float numberIn(const std::vector<char>& bytes, const look::ParamRow& row) {
  float value = 0;
  std::memcpy(&value, bytes.data() + row.offset, sizeof(value));
  return value;
}

inline Look mustRead(const std::string& text) {
  const Result<Look> look = Look::fromJson(text, "test.json");
  EXPECT_TRUE(look.ok()) << look.error().message();
  return look.ok() ? look.value() : Look();
}

inline const look::ParamBlock* blockAt(const std::string& path) {
  for (const look::ParamBlock* block : look::allBlocks())
    if (block->path == path) return block;
  return nullptr;
}

}  // namespace scumble
