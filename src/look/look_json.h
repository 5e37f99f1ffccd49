// Reading the parts of a look's JSON file.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <utility>

#include "look/look_data.h"

namespace scumble::look {

// An object whose keys stay in their order, and are found at once: the library's own looks through all of
// them for each, which takes a look of 100,000 materials half a minute.
template <class Key, class T, class Less = std::less<Key>,
          class Allocator = std::allocator<std::pair<const Key, T>>>
struct IndexedMap : nlohmann::ordered_map<Key, T, Less, Allocator> {
  using Base = nlohmann::ordered_map<Key, T, Less, Allocator>;
  using iterator = typename Base::iterator;
  using Base::Base;

  std::pair<iterator, bool> emplace(const Key& key, T&& value) {
    if (places_.size() != this->size()) {
      places_.clear();
      for (const auto& [known, mapped] : *this) places_.emplace(known, places_.size());
    }
    const auto [place, isNew] = places_.try_emplace(key, this->size());
    if (isNew) Base::Container::emplace_back(key, std::move(value));
    return {this->begin() + std::ptrdiff_t(place->second), isNew};
  }
  T& operator[](const Key& key) { return emplace(key, T{}).first->second; }
  const T& operator[](const Key& key) const { return this->at(key); }

 private:
  std::unordered_map<Key, size_t> places_;
};

// In the order of the file, since of two settings alike the later one wins.
using Json = nlohmann::basic_json<IndexedMap>;

// Where in which file something stands.
struct JsonPlace {
  const std::string& file;  // empty: it was set by hand
  std::string path;

  JsonPlace member(const std::string& key) const { return {file, path + "." + key}; }
  JsonPlace item(size_t i) const { return {file, path + "[" + std::to_string(i) + "]"}; }
  Error fail(std::string problem, std::string advice) const;
};

// Whether a path may lead out of the folder that it is relative to.
bool leadsOutside(const std::filesystem::path& path);

// A knob's value; a picture that it names is loaded into `data`, once.
Result<Value> readJsonValue(const ParamRow& row, const Json& value, const JsonPlace& place, LookData& data);

// { "keys": [[0, 0.3], [2.5, 0.5]], "interpolation": "linear", "repeat": false }
Result<Track> readTrack(const ParamRow& row, const Json& object, const JsonPlace& place, LookData& data);

}  // namespace scumble::look
