// A look as the rooms behind it read it: a list of assignments to rows, evaluated block by block.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/pixels.h"
#include "look/param.h"
#include "scumble/result.h"

namespace scumble::look {

struct Value {
  double number = 0;       // all kinds but color
  glm::vec3 linear{0.0f};  // color
};

struct Assignment {
  std::string materialPattern;  // '*' and '?' match; empty: the whole scene
  const ParamBlock* block;
  const ParamRow* row;
  Value value;
  bool byHand = false;  // by Look::set, not by the look's file
};

// A picture file that a look names.
struct LookPicture {
  std::string file;
  Pixels pixels;
  uint64_t contents = 0;  // contentsOf(pixels)
};

struct LookData {
  std::string description;
  std::vector<Assignment> assignments;
  std::vector<std::shared_ptr<const LookPicture>> pictures;

  // The order in which settings count, the last one winning: the file's for the whole scene, the file's for
  // materials, those by hand for the whole scene, those by hand for materials; of two alike the later one.
  // Fills a block's struct with what holds for the whole scene.
  void fill(const ParamBlock& block, void* out) const;
  // With what holds for one material.
  void fillForMaterial(const ParamBlock& block, const std::string& material, void* out) const;

  template <class Params>
  Params get() const {
    Params params;
    fill(Params::block(), &params);
    return params;
  }
  template <class Params>
  Params getForMaterial(const std::string& material) const {
    Params params;
    fillForMaterial(Params::block(), material, &params);
    return params;
  }
};

// Whether `name` matches a pattern of literal characters, '*' and '?'.
bool matches(const std::string& pattern, const std::string& name);

// Resolves "a.b.row"; fails with a suggestion when there is no such knob.
struct KnobRef {
  const ParamBlock* block;
  const ParamRow* row;
};
Result<KnobRef> findKnob(const std::string& path);

// The candidate nearest to `word`, or empty when none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

// Reads a value as text ("0.4", "true", "exact", "#EADFC8", the name of a picture that is built in); the
// problem is in Error::problem.
Result<Value> parseValue(const ParamRow& row, const std::string& text);
std::string formatValue(const ParamRow& row, double number);

}  // namespace scumble::look
