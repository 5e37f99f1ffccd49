// JSON with its place in the file: a value and the path that leads to it, so that every error says where.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "scene/import_failure.h"

namespace scumble::scene {

using Json = nlohmann::json;

// Parses a whole text; fails with the line of the first mistake. Nesting is limited, because the parser's
// callers and the tree's owners must not run out of stack.
Json parseJson(std::string_view text);

// A value in the tree, or the absence of one. The readers fail where a member has the wrong type or range and
// return the given default where it is absent.
class JsonView {
 public:
  JsonView() = default;
  JsonView(const Json* value, std::string path) : value_(value), path_(std::move(path)) {}

  bool exists() const { return value_ != nullptr; }
  explicit operator bool() const { return exists(); }
  const Json& json() const { return *value_; }
  const std::string& path() const { return path_; }
  std::string pathOf(std::string_view key) const;

  bool has(const char* key) const { return find(key) != nullptr; }
  JsonView object(const char* key) const;  // absent or an object
  JsonView list(const char* key) const;    // absent or an array
  JsonView extension(const char* name) const;

  size_t size() const { return value_ ? value_->size() : 0; }      // of a list
  JsonView at(size_t i) const;                                     // element of a list that must be an object
  size_t indexAt(size_t i, size_t limit, const char* what) const;  // element of a list that must be an index

  // -1 when absent; fails unless below `limit`.
  int64_t index(const char* key, size_t limit, const char* what) const;
  int64_t requiredIndex(const char* key, size_t limit, const char* what) const;
  uint64_t count(const char* key, uint64_t otherwise) const;
  uint64_t requiredCount(const char* key) const;
  float number(const char* key, float otherwise) const;
  bool flag(const char* key, bool otherwise) const;
  std::string text(const char* key, std::string otherwise = {}) const;

  // False when absent; fails unless it is `count` finite numbers.
  bool numbers(const char* key, float* out, size_t count) const;
  bool numbers(const char* key, double* out, size_t count) const;

  [[noreturn]] void failAt(std::string_view key, std::string problem, std::string advice = {}) const {
    fail(pathOf(key), std::move(problem), std::move(advice));
  }

 private:
  const Json* find(const char* key) const;

  const Json* value_ = nullptr;
  std::string path_;
};

}  // namespace scumble::scene
