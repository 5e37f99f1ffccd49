// The look of a moment, evaluated once a frame into a table: what every knob is for the whole scene, and for
// each of its materials.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "look/look_data.h"

namespace scumble::stage {

class KnobTable {
 public:
  // A look without tracks (LookData::at), which stays as long as this is asked. Forgets materials.
  void evaluate(const look::LookData& now);

  // What a material's knobs follow from: its name, and over it settings by their places in the look's list
  // (NodeSettings).
  struct Material {
    std::string_view name;
    std::span<const uint32_t> settings;
  };
  // After evaluate(now). Materials for which the look says the same share a row; names are matched with
  // patterns only where there is a new name or another list of patterns than in the last frame.
  void evaluate(std::span<const Material> materials);

  const look::LookData& look() const { return *look_; }
  // What holds for the whole scene.
  template <class Params>
  const Params& scene() const {
    return *reinterpret_cast<const Params*>(scene_.data() + placeOf(Params::block()));
  }
  // By material, in the order of evaluate().
  template <class Params>
  const Params& of(size_t material) const {
    return *reinterpret_cast<const Params*>(rows_[rowOf_[material]].data() + placeOf(Params::block()));
  }
  size_t materialCount() const { return rowOf_.size(); }
  // How many rows they take.
  size_t rowCount() const { return rows_.size(); }

 private:
  using Row = std::vector<std::byte>;
  using Places = std::vector<uint32_t>;  // of settings, in the order in which they count

  // Where each block's struct lies in a row.
  void layOut();
  size_t placeOf(const look::ParamBlock& block) const;
  void apply(const look::Assignment& setting, Row& row) const;
  // Those of a material that are not for the whole scene.
  Places placesFor(const Material& material) const;

  // What of a setting decides whom it is for.
  struct Subject {
    const look::ParamRow* row;
    look::Target target;
    bool byHand;
    std::string pattern;
  };

  std::vector<const look::ParamBlock*> blocks_;
  std::unordered_map<const look::ParamBlock*, size_t> places_;
  Row defaults_;  // what knobs are where nobody sets them

  const look::LookData* look_ = nullptr;
  Places forScene_[2];  // settings for the whole scene: the file's, and those by hand
  Row scene_;
  std::vector<Row> rows_;
  std::vector<uint32_t> rowOf_;
  std::vector<Subject> subjects_;  // that what follows was found for
  // Places of settings for materials by the pattern that they are for: names, and those that match several.
  std::map<std::string, Places> byName_, byPattern_;
  std::map<std::pair<std::string, Places>, Places> known_;
};

}  // namespace scumble::stage
