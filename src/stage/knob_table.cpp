#include "stage/knob_table.h"

#include <algorithm>
#include <cassert>

namespace scumble::stage {

void KnobTable::layOut() {
  constexpr size_t kAlignment = 16;
  blocks_ = look::allBlocks();
  places_.clear();
  size_t size = 0;
  for (const look::ParamBlock* block : blocks_) {
    places_[block] = size;
    size += (block->structSize + kAlignment - 1) / kAlignment * kAlignment;
  }
  defaults_.assign(size, std::byte(0));
  for (const look::ParamBlock* block : blocks_)
    for (const look::ParamRow& row : block->rows)
      look::store(row, look::defaultOf(row), defaults_.data() + places_[block]);
}

size_t KnobTable::placeOf(const look::ParamBlock& block) const {
  const auto found = places_.find(&block);
  assert(found != places_.end() && "a block that is in no list");
  return found->second;
}

void KnobTable::apply(const look::Assignment& setting, Row& row) const {
  look::store(*setting.row, setting.value, row.data() + placeOf(*setting.block));
}

void KnobTable::evaluate(const look::LookData& now) {
  look_ = &now;
  if (blocks_ != look::allBlocks()) layOut();
  scene_ = defaults_;
  for (const bool byHand : {false, true})
    for (const look::Assignment& setting : now.assignments)
      if (setting.target == look::kScene && setting.byHand == byHand) apply(setting, scene_);
  rows_.clear();
  rowOf_.clear();

  // What was found for names holds as long as the look's patterns are the same.
  const bool isSame = std::equal(now.assignments.begin(), now.assignments.end(), subjects_.begin(),
                                 subjects_.end(), [](const look::Assignment& a, const Subject& b) {
                                   return a.row == b.row && a.target == b.target && a.byHand == b.byHand &&
                                          a.pattern == b.pattern;
                                 });
  if (isSame) return;
  known_.clear();
  subjects_.clear();
  for (const look::Assignment& a : now.assignments)
    subjects_.push_back({a.row, a.target, a.byHand, a.pattern});
}

KnobTable::Places KnobTable::placesFor(const Material& material) const {
  const std::vector<look::Assignment>& all = look_->assignments;
  const std::string name(material.name);
  Places places;
  for (const bool byHand : {false, true}) {
    for (uint32_t i = 0; i < all.size(); ++i)
      if (all[i].target == look::kMaterials && all[i].byHand == byHand && look::matches(all[i].pattern, name))
        places.push_back(i);
    for (const uint32_t i : material.settings)
      if (all[i].byHand == byHand) places.push_back(i);
  }
  return places;
}

void KnobTable::evaluate(std::span<const Material> materials) {
  rows_.clear();
  rowOf_.clear();
  std::map<const Places*, uint32_t> rowOfPlaces;
  std::map<Places, const Places*> same;
  for (const Material& material : materials) {
    std::pair<std::string, Places> key{material.name,
                                       Places(material.settings.begin(), material.settings.end())};
    auto known = known_.find(key);
    if (known == known_.end()) {
      Places places = placesFor(material);
      known = known_.emplace(std::move(key), std::move(places)).first;
    }
    const Places* const places = same.try_emplace(known->second, &known->second).first->second;
    const auto [row, isNew] = rowOfPlaces.try_emplace(places, uint32_t(rows_.size()));
    rowOf_.push_back(row->second);
    if (!isNew) continue;
    if (places->empty()) {
      rows_.push_back(scene_);
      continue;
    }
    // Those by hand come after all of the file's, for the whole scene and for some names.
    Row& values = rows_.emplace_back(defaults_);
    for (const bool byHand : {false, true}) {
      for (const look::Assignment& setting : look_->assignments)
        if (setting.target == look::kScene && setting.byHand == byHand) apply(setting, values);
      for (const uint32_t place : *places)
        if (look_->assignments[place].byHand == byHand) apply(look_->assignments[place], values);
    }
  }
}

}  // namespace scumble::stage
