// A look as the rooms behind it read it: a list of assignments to rows, evaluated block by block.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/name_pattern.h"
#include "base/pixels.h"
#include "look/param.h"
#include "look/track.h"
#include "scumble/result.h"

namespace scumble::look {

struct Assignment {
  std::string pattern;  // of names, '*' and '?' match; empty: the whole scene
  const ParamBlock* block;
  const ParamRow* row;
  Value value;          // of a track, the one at time 0
  bool byHand = false;  // by Look::set, not by the look's file
  Target target = kScene;
  std::shared_ptr<const Track> track = nullptr;  // where the value changes with time
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
  std::vector<std::string> texts;  // what knobs name (Name::index)
  std::vector<std::string> files;  // that were read, pictures apart
  std::vector<std::string> warnings;

  // Whether a setting changes with time.
  bool isAnimated() const;
  // The look of one moment, in seconds: a pure function of time, without tracks. Pictures are shared.
  LookData at(double time) const;

  // What follows reads tracks as they are at time 0: ask at(time) where there is a time.
  //
  // The order in which settings count, the last one winning: the file's for the whole scene, the file's for
  // some names, those by hand for the whole scene, those by hand for some names; of two alike the later one.
  // Fills a block's struct with what holds for the whole scene.
  void fill(const ParamBlock& block, void* out) const;
  // With what holds for one material, node or clip.
  void fillFor(const ParamBlock& block, Target target, const std::string& name, void* out) const;

  // With what holds for one material and, over that, settings by their places in the list, in this order.
  void fillFor(const ParamBlock& block, const std::string& material, std::span<const uint32_t> over,
               void* out) const;

  // The setting of one row that counts for the whole scene, or for what is called `name`; null: none does.
  const Assignment* settingOf(const ParamRow& row, const ParamBlock& block, Target target,
                              const std::string& name) const;
  // What it says, or the default.
  Value valueOf(const ParamRow& row, const ParamBlock& block, Target target, const std::string& name) const;

  // The setting of a row that counts for the whole scene; null: none does.
  const Assignment* settingOf(const ParamBlock& block, const char* row) const;

  // Whether a setting for some materials, nodes or clips sets this row, for this name or for any pattern.
  bool names(const ParamBlock& block, const char* row, Target target, const std::string& name) const;
  bool setsAny(const ParamBlock& block, const char* row, Target target) const;

  // The names that a section declares, in the order in which they appear: its keys without '*' and '?'.
  std::vector<std::string> declared(Target target) const;

  const std::string& text(Name name) const;

  template <class Params>
  Params get() const {
    Params params;
    fill(Params::block(), &params);
    return params;
  }
  template <class Params>
  Params getFor(Target target, const std::string& name) const {
    Params params;
    fillFor(Params::block(), target, name, &params);
    return params;
  }
  template <class Params>
  Params getForMaterial(const std::string& material) const {
    return getFor<Params>(kMaterials, material);
  }
  template <class Params>
  Params getForMaterial(const std::string& material, std::span<const uint32_t> over) const {
    Params params;
    fillFor(Params::block(), material, over, &params);
    return params;
  }
};

// Whether there is a '*' or '?' in it.
bool isPattern(const std::string& name);

using scumble::matches;  // a name and a pattern

// Resolves "a.b.row"; fails with a suggestion when there is no such knob: one of those that may be set for
// `targets`.
struct KnobRef {
  const ParamBlock* block;
  const ParamRow* row;
};
Result<KnobRef> findKnob(const std::string& path, Targets targets = ~Targets(0));
bool isKnob(const std::string& path);

// Whether a number is one of the row's, or of one of a colour's or triple's three; `text` is how messages
// show it. Fails with ErrorKind::usage.
Status checkNumber(const ParamRow& row, double number, const std::string& text);

// Reads a value as text ("0.4", "true", "exact", "#EADFC8", the name of a picture that is built in); the
// problem is in Error::problem.
Result<Value> parseValue(const ParamRow& row, const std::string& text);
std::string formatValue(const ParamRow& row, double number);
// What a row has where nobody sets it.
Value defaultOf(const ParamRow& row);
// Writes a row's member of its block's struct.
void store(const ParamRow& row, const Value& value, void* block);

}  // namespace scumble::look
