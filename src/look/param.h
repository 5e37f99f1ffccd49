// The parameter mechanism: every knob is one row of a .params file,
//
//   PARAM(float, radius, 12.0, 0.0, 128.0, "px at 1080 lines", "Roundness of the shadow shapes.")
//         type   name    default min  max   unit                meaning
//
// that C++ (through look/define_params.h) and GLSL (with PARAM defined as `type name;`) both include.
// Types: float; int; toggle (0 or 1); choice (a number; the unit column lists the names:
// "off|approximate|exact"); srgb (0xRRGGBB in the row, linear in the struct); picture (a number; the unit
// column lists the pictures that are built in, any other word is a file's path); triple (three numbers, with
// one default and range for all); name (any text, empty by default).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace scumble::look {

enum class ParamKind : uint8_t { number, integer, toggle, choice, color, picture, triple, name };

struct ParamRow {
  const char* name;
  ParamKind kind;
  double defaultValue, min, max;
  const char* unit;
  const char* meaning;
  size_t offset;  // in the block's struct
};

// What a setting holds for: the whole scene, or the materials, nodes or clips whose names match a pattern, or
// the colorizers and decorations that looks themselves declare.
enum Target : uint32_t {
  kScene = 1,
  kMaterials = 2,
  kNodes = 4,
  kClips = 8,
  kColorizers = 16,
  kDecorations = 32
};
using Targets = uint32_t;  // a set of them

// The rows of one .params file under their common path.
struct ParamBlock {
  const char* path;  // e.g. "shadow" or "warp.metatexture"
  Targets targets;   // what `path.row`, `materials.PATTERN.path.row` ... may set them for
  std::vector<ParamRow> rows;
  size_t structSize;
};

struct Value {
  double number = 0;       // all kinds but color and triple
  glm::vec3 linear{0.0f};  // color, triple
};

glm::vec3 linearFromSrgb(uint32_t rrggbb);
uint32_t srgbFromLinear(const glm::vec3& linear);

// The C++ faces of the row types; scalar layout gives the GLSL ones the same size.
struct Toggle {
  uint32_t on = 0;
  Toggle(double v = 0) : on(v != 0) {}
  operator bool() const { return on != 0; }
};
struct Choice {
  int32_t index = 0;
  Choice(double v = 0) : index(int32_t(v)) {}
  operator int() const { return index; }
};
struct Color {
  glm::vec3 linear{0.0f};
  Color(double rrggbb = 0) : linear(linearFromSrgb(uint32_t(rrggbb))) {}
  operator glm::vec3() const { return linear; }
};

// A picture that is built in (0 and up, in the order of the row), or one of the look's own: -1 - its index in
// LookData::pictures.
struct Picture {
  int32_t index = 0;
  Picture(double v = 0) : index(int32_t(v)) {}
  bool operator==(const Picture&) const = default;
};

struct Triple {
  glm::vec3 value{0.0f};
  Triple(double v = 0) : value(float(v)) {}
  operator glm::vec3() const { return value; }
};

// 0: no name; else 1 + its index in LookData::texts.
struct Name {
  int32_t index = 0;
  Name(double v = 0) : index(int32_t(v)) {}
  bool operator==(const Name&) const = default;
};

template <class T>
constexpr ParamKind kindOf() {
  if constexpr (std::is_same_v<T, float>) return ParamKind::number;
  if constexpr (std::is_same_v<T, int>) return ParamKind::integer;
  if constexpr (std::is_same_v<T, Toggle>) return ParamKind::toggle;
  if constexpr (std::is_same_v<T, Choice>) return ParamKind::choice;
  if constexpr (std::is_same_v<T, Color>) return ParamKind::color;
  if constexpr (std::is_same_v<T, Picture>) return ParamKind::picture;
  if constexpr (std::is_same_v<T, Triple>) return ParamKind::triple;
  if constexpr (std::is_same_v<T, Name>) return ParamKind::name;
}

// Every block that looks may set: those of the program, in the order of the documentation, and those that
// have been added.
const std::vector<const ParamBlock*>& allBlocks();

// The program's own. This room knows none of who reads them: defined by the list of passes.
const std::vector<const ParamBlock*>& ownBlocks();

// Adds a block with a path of its own, for a pass from outside, as long as this lives: from before looks that
// set it are read until all of them are gone. It is not for a pass to have, since passes are made often. Not
// while other threads read looks or draw.
class AddedBlock {
 public:
  explicit AddedBlock(const ParamBlock& block);
  ~AddedBlock();
  AddedBlock(const AddedBlock&) = delete;
  AddedBlock& operator=(const AddedBlock&) = delete;

 private:
  const ParamBlock* block_;
};

// The names of a choice or picture row, split at '|'.
std::vector<std::string> choiceNames(const ParamRow& row);

}  // namespace scumble::look
