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
  for (Places& places : forScene_) places.clear();
  for (uint32_t i = 0; i < now.assignments.size(); ++i)
    if (now.assignments[i].target == look::kScene) forScene_[now.assignments[i].byHand].push_back(i);
  scene_ = defaults_;
  for (const Places& places : forScene_)
    for (const uint32_t place : places) apply(now.assignments[place], scene_);
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
  byName_.clear();
  byPattern_.clear();
  for (uint32_t i = 0; i < now.assignments.size(); ++i) {
    const look::Assignment& a = now.assignments[i];
    subjects_.push_back({a.row, a.target, a.byHand, a.pattern});
    if (a.target == look::kMaterials)
      (look::isPattern(a.pattern) ? byPattern_ : byName_)[a.pattern].push_back(i);
  }
}

KnobTable::Places KnobTable::placesFor(const Material& material) const {
  // Those for the material, in the order of the look.
  const std::string name(material.name);
  Places own;
  const auto add = [&](const Places& some) { own.insert(own.end(), some.begin(), some.end()); };
  if (const auto found = byName_.find(name); found != byName_.end()) add(found->second);
  for (const auto& [pattern, some] : byPattern_)
    if (look::matches(pattern, name)) add(some);
  std::sort(own.begin(), own.end());

  Places places;
  for (const bool byHand : {false, true})
    for (const std::span<const uint32_t> some : {std::span<const uint32_t>(own), material.settings})
      for (const uint32_t i : some)
        if (look_->assignments[i].byHand == byHand) places.push_back(i);
  return places;
}

void KnobTable::evaluate(std::span<const Material> materials) {
  // Names of scenes that come and go must not fill the memory.
  constexpr size_t kMostKnown = 1 << 16;
  if (known_.size() > kMostKnown) known_.clear();
  rows_.clear();
  rowOf_.clear();
  std::map<Places, uint32_t> rowOfPlaces;
  for (const Material& material : materials) {
    std::pair<std::string, Places> key{material.name,
                                       Places(material.settings.begin(), material.settings.end())};
    auto known = known_.find(key);
    if (known == known_.end()) {
      Places places = placesFor(material);
      known = known_.emplace(std::move(key), std::move(places)).first;
    }
    const Places& places = known->second;
    const auto [row, isNew] = rowOfPlaces.try_emplace(places, uint32_t(rows_.size()));
    rowOf_.push_back(row->second);
    if (!isNew) continue;
    if (places.empty()) {
      rows_.push_back(scene_);
      continue;
    }
    // Those by hand come after all of the file's, for the whole scene and for some names.
    Row& values = rows_.emplace_back(defaults_);
    for (const bool byHand : {false, true}) {
      for (const uint32_t place : forScene_[byHand]) apply(look_->assignments[place], values);
      for (const uint32_t place : places)
        if (look_->assignments[place].byHand == byHand) apply(look_->assignments[place], values);
    }
  }
}

}  // namespace scumble::stage
