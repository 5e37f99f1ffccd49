// A request's JSON, read strictly: what is missing, of another type, out of range or unknown is refused, with
// its place in the request.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scumble/result.h"

namespace scumble::serve {

// Thrown by what reads requests; becomes the answer's error.
struct Refusal {
  Error error;
};

// Words with commas between them.
std::string listed(const std::vector<std::string>& words);

[[noreturn]] void refuse(const std::string& where, const std::string& problem, const std::string& advice);

// Throws where something failed.
template <class T>
T valueOf(Result<T> result, const std::string& where) {
  if (result) return std::move(*result);
  Error error = result.error();
  if (error.jsonPath.empty()) error.jsonPath = where;
  throw Refusal{std::move(error)};
}

class Members {
 public:
  // Of an object. `where` is its place, as errors tell it; it is empty for the request itself.
  Members(const nlohmann::json& object, std::string where);

  // Nothing where there is none, or null.
  const nlohmann::json* find(const std::string& name);
  const nlohmann::json& require(const std::string& name);
  bool has(const std::string& name) { return find(name) != nullptr; }

  std::optional<bool> flag(const std::string& name);
  std::optional<std::string> text(const std::string& name);
  std::string requireText(const std::string& name);
  std::optional<double> number(const std::string& name);
  std::optional<uint64_t> whole(const std::string& name, uint64_t max);
  uint64_t requireWhole(const std::string& name, uint64_t max);
  // Each one finite in single precision, too.
  std::optional<std::vector<double>> numbers(const std::string& name, size_t count);
  std::optional<glm::dvec3> vector(const std::string& name);
  std::optional<glm::dmat4> matrix(const std::string& name);  // column-major
  std::optional<std::vector<std::string>> texts(const std::string& name);
  // Its number among these words.
  std::optional<size_t> word(const std::string& name, const std::vector<std::string>& words);
  // An array; an empty one where there is none.
  const nlohmann::json& list(const std::string& name);

  // Refuses members that nobody has asked for.
  void end() const;
  std::string place(const std::string& name) const;

 private:
  const nlohmann::json& object_;
  std::string where_;
  std::set<std::string> asked_;
};

}  // namespace scumble::serve
