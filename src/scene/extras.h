// What nodes say in their `extras` to features, under names that begin with "scumble_".
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace scumble::scene {

struct ExtraRule {
  const char* key;  // the whole name
  // What is wrong with a value, which whoever reads it leaves out: each with the path within the value
  // (".length", or empty), and what is to be said.
  using Problems = std::vector<std::pair<std::string, std::string>>;
  Problems (*problemsOf)(const nlohmann::json& value);
};

// The program's own. This room knows none of who reads them: defined by the list of features.
const std::vector<ExtraRule>& extraRules();

}  // namespace scumble::scene
