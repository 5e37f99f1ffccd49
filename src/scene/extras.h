// What nodes say in their `extras` to features, under names that begin with "scumble_".
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace scumble::scene {

struct Node;

struct ExtraRule {
  const char* key;  // the whole name
  // What is wrong with a value, which whoever reads it leaves out: each with the path within the value
  // (".length", or empty), and what is to be said.
  using Problems = std::vector<std::pair<std::string, std::string>>;
  Problems (*problemsOf)(const nlohmann::json& value);
};

// The program's own. This room knows none of who reads them: defined by the list of features.
const std::vector<ExtraRule>& extraRules();

// What an object says, of names that there is a rule for, in place of what the node said. `tell` is called
// with the path (".scumble_x.length") and the text of each problem.
void readExtras(const nlohmann::json& object, Node& node,
                const std::function<void(const std::string& path, const std::string& text)>& tell);

}  // namespace scumble::scene
