#include "members.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "scumble/nearest.h"

namespace scumble::serve {

using nlohmann::json;

std::string listed(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

void refuse(const std::string& where, const std::string& problem, const std::string& advice) {
  throw Refusal{{ErrorKind::usage, "", 0, where, problem, advice}};
}

Members::Members(const json& object, std::string where) : object_(object), where_(std::move(where)) {
  if (!object.is_object()) refuse(where_, "this is no object", "write it in braces");
}

std::string Members::place(const std::string& name) const {
  return where_.empty() || name.empty() ? where_ + name : where_ + "." + name;
}

const json* Members::find(const std::string& name) {
  asked_.insert(name);
  const auto found = object_.find(name);
  return found == object_.end() || found->is_null() ? nullptr : &*found;
}

const json& Members::require(const std::string& name) {
  const json* found = find(name);
  if (!found) refuse(place(name), "this is missing", "docs/serve.md says what there must be");
  return *found;
}

std::optional<bool> Members::flag(const std::string& name) {
  const json* found = find(name);
  if (!found) return std::nullopt;
  if (!found->is_boolean()) refuse(place(name), "this is neither true nor false", "give one of them");
  return found->get<bool>();
}

std::optional<std::string> Members::text(const std::string& name) {
  const json* found = find(name);
  if (!found) return std::nullopt;
  if (!found->is_string()) refuse(place(name), "this is no text", "write it in quotes");
  return found->get<std::string>();
}

std::string Members::requireText(const std::string& name) {
  require(name);
  return *text(name);
}

std::optional<double> Members::number(const std::string& name) {
  const json* found = find(name);
  if (!found) return std::nullopt;
  if (!found->is_number() || !std::isfinite(found->get<double>()))
    refuse(place(name), "this is no number", "give one");
  return found->get<double>();
}

std::optional<uint64_t> Members::whole(const std::string& name, uint64_t max) {
  const std::optional<double> given = number(name);
  if (!given) return std::nullopt;
  // Doubles tell whole numbers apart up to 2^53, which is more than there are bytes.
  if (!(*given >= 0 && *given <= double(max)) || *given != std::floor(*given))
    refuse(place(name), "this is out of range", "use a whole number from 0 to " + std::to_string(max));
  return uint64_t(*given);
}

uint64_t Members::requireWhole(const std::string& name, uint64_t max) {
  require(name);
  return *whole(name, max);
}

std::optional<std::vector<double>> Members::numbers(const std::string& name, size_t count) {
  const json* found = find(name);
  if (!found) return std::nullopt;
  const std::string advice = "give an array of " + std::to_string(count) + " numbers";
  if (!found->is_array() || found->size() != count)
    refuse(place(name), "this is no array of " + std::to_string(count), advice);
  std::vector<double> values;
  for (const json& item : *found) {
    if (!item.is_number() || !std::isfinite(item.get<float>()))
      refuse(place(name), "this holds something that is no number", advice);
    values.push_back(item.get<double>());
  }
  return values;
}

std::optional<glm::dvec3> Members::vector(const std::string& name) {
  const auto values = numbers(name, 3);
  return values ? std::optional(glm::dvec3((*values)[0], (*values)[1], (*values)[2])) : std::nullopt;
}

std::optional<glm::dmat4> Members::matrix(const std::string& name) {
  const auto values = numbers(name, 16);
  return values ? std::optional(glm::make_mat4(values->data())) : std::nullopt;
}

std::optional<std::vector<std::string>> Members::texts(const std::string& name) {
  if (!has(name)) return std::nullopt;
  std::vector<std::string> values;
  for (const json& item : list(name)) {
    if (!item.is_string()) refuse(place(name), "this holds something that is no text", "give texts alone");
    values.push_back(item.get<std::string>());
  }
  return values;
}

std::optional<size_t> Members::word(const std::string& name, const std::vector<std::string>& words) {
  const std::optional<std::string> given = text(name);
  if (!given) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), *given);
  if (found == words.end())
    refuse(place(name), "'" + *given + "' is none of its words", "use " + listed(words));
  return size_t(found - words.begin());
}

const json& Members::list(const std::string& name) {
  static const json kNone = json::array();
  const json* found = find(name);
  if (!found) return kNone;
  if (!found->is_array()) refuse(place(name), "this is no array", "write it in brackets");
  return *found;
}

void Members::end() const {
  for (const auto& [name, value] : object_.items()) {
    if (asked_.count(name)) continue;
    const std::vector<std::string> known(asked_.begin(), asked_.end());
    const std::string near = nearest(name, known);
    refuse(place(name), "this is unknown",
           near.empty() ? "there is " + listed(known) : "did you mean '" + near + "'?");
  }
}

}  // namespace scumble::serve
