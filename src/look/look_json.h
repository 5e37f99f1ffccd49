// Reading the parts of a look's JSON file.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "look/look_data.h"

namespace scumble::look {

// In the order of the file, since of two settings alike the later one wins.
using Json = nlohmann::ordered_json;

// Where in which file something stands.
struct JsonPlace {
  const std::string& file;
  std::string path;

  JsonPlace member(const std::string& key) const { return {file, path + "." + key}; }
  JsonPlace item(size_t i) const { return {file, path + "[" + std::to_string(i) + "]"}; }
  Error fail(std::string problem, std::string advice) const;
};

// Whether a path may lead out of the folder that it is relative to.
bool leadsOutside(const std::filesystem::path& path);

// A knob's value; a picture that it names is loaded into `data`, once.
Result<Value> readJsonValue(const ParamRow& row, const Json& value, const JsonPlace& place, LookData& data);

constexpr size_t kMaxTrackKeys = 100000;

// { "keys": [[0, 0.3], [2.5, 0.5]], "interpolation": "linear", "repeat": false }
Result<Track> readTrack(const ParamRow& row, const Json& object, const JsonPlace& place, LookData& data);

}  // namespace scumble::look
