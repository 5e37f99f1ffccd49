#include "scene/json.h"

#include <algorithm>
#include <cmath>

#include "base/json_place.h"

namespace scumble::scene {

namespace {

constexpr int kMaxNesting = 256;

int lineAt(std::string_view text, size_t offset) {
  offset = std::min(offset, text.size());
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<ptrdiff_t>(offset), '\n'));
}

[[noreturn]] void failInLine(int line, std::string problem, std::string advice) {
  throw ImportFailure{Error{ErrorKind::unusableFile, {}, line, {}, std::move(problem), std::move(advice)}};
}

void checkNesting(std::string_view text) {
  int depth = 0;
  bool inString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxNesting)
        failInLine(lineAt(text, i), "is nested deeper than " + std::to_string(kMaxNesting) + " levels",
                   "no glTF needs that; check how it was made");
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

// nlohmann's message holds its own error number and place first; the cause is after the column. It may quote
// any bytes of the file, so what is not plain ASCII goes.
std::string causeOf(const std::string& what) {
  std::string cause = what;
  if (const size_t at = what.find(": ", what.find("column")); at != std::string::npos)
    cause = what.substr(at + 2);
  else if (const size_t bracket = what.find("] "); bracket != std::string::npos)
    cause = what.substr(bracket + 2);
  for (char& c : cause)
    if (static_cast<unsigned char>(c) >= 0x7f || static_cast<unsigned char>(c) < 0x20) c = '?';
  if (cause.size() > 200) cause = cause.substr(0, 200) + "...";
  return cause;
}

uint64_t unsignedOf(const Json& value, const std::string& path) {
  if (value.is_number_unsigned()) return value.get<uint64_t>();
  if (value.is_number_integer() && value.get<int64_t>() >= 0)
    return static_cast<uint64_t>(value.get<int64_t>());
  if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number >= 0 && number < 9007199254740992.0 && std::floor(number) == number)
      return static_cast<uint64_t>(number);
  }
  fail(path, "is not a whole number of zero or more");
}

float finiteOf(const Json& value, const std::string& path) {
  if (!value.is_number()) fail(path, "is not a number");
  const float number = static_cast<float>(value.get<double>());
  if (!std::isfinite(number)) fail(path, "is not a finite number");
  return number;
}

}  // namespace

Json parseJson(std::string_view text) {
  checkNesting(text);
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    failInLine(lineAt(text, error.byte > 0 ? error.byte - 1 : 0),
               "is not valid JSON: " + causeOf(error.what()), "mend the text or export the scene again");
  } catch (const Json::exception& error) {
    // Such a number's place is not told, but how far the parser reads it can be.
    const char* lastRead = text.data();
    Json::accept(JsonReading(text.data(), lastRead), JsonReading(text.data() + text.size(), lastRead));
    failInLine(lineOf(text, lastRead), "is not valid JSON: " + causeOf(error.what()),
               "mend the text or export the scene again");
  }
}

std::string JsonView::pathOf(std::string_view key) const {
  if (key.empty()) return path_;
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

const Json* JsonView::find(const char* key) const {
  if (!value_) return nullptr;
  if (!value_->is_object()) fail(path_, "is not an object");
  const auto found = value_->find(key);
  return found == value_->end() ? nullptr : &*found;
}

JsonView JsonView::object(const char* key) const {
  const Json* value = find(key);
  if (value && !value->is_object()) failAt(key, "is not an object");
  return value ? JsonView(value, pathOf(key)) : JsonView();
}

JsonView JsonView::list(const char* key) const {
  const Json* value = find(key);
  if (value && !value->is_array()) failAt(key, "is not an array");
  return value ? JsonView(value, pathOf(key)) : JsonView();
}

JsonView JsonView::extension(const char* name) const {
  const JsonView extensions = object("extensions");
  return extensions ? extensions.object(name) : JsonView();
}

JsonView JsonView::at(size_t i) const {
  std::string path = path_ + "[" + std::to_string(i) + "]";
  const Json& value = (*value_)[i];
  if (!value.is_object()) fail(path, "is not an object");
  return JsonView(&value, std::move(path));
}

size_t JsonView::indexAt(size_t i, size_t limit, const char* what) const {
  const std::string path = path_ + "[" + std::to_string(i) + "]";
  const uint64_t number = unsignedOf((*value_)[i], path);
  if (number >= limit)
    fail(path, "names " + std::string(what) + " " + std::to_string(number) + " of " + std::to_string(limit),
         "export the scene again");
  return static_cast<size_t>(number);
}

int64_t JsonView::index(const char* key, size_t limit, const char* what) const {
  const Json* value = find(key);
  if (!value) return -1;
  const uint64_t number = unsignedOf(*value, pathOf(key));
  if (number >= limit)
    failAt(key, "names " + std::string(what) + " " + std::to_string(number) + " of " + std::to_string(limit),
           "export the scene again");
  return static_cast<int64_t>(number);
}

int64_t JsonView::requiredIndex(const char* key, size_t limit, const char* what) const {
  const int64_t number = index(key, limit, what);
  if (number < 0) failAt(key, "is missing");
  return number;
}

uint64_t JsonView::count(const char* key, uint64_t otherwise) const {
  const Json* value = find(key);
  if (!value) return otherwise;
  const uint64_t number = unsignedOf(*value, pathOf(key));
  // Keeps sums and products of offsets and lengths far from overflow.
  if (number > (1ull << 48)) failAt(key, "is absurdly large");
  return number;
}

uint64_t JsonView::requiredCount(const char* key) const {
  if (!has(key)) failAt(key, "is missing");
  return count(key, 0);
}

float JsonView::number(const char* key, float otherwise) const {
  const Json* value = find(key);
  return value ? finiteOf(*value, pathOf(key)) : otherwise;
}

bool JsonView::flag(const char* key, bool otherwise) const {
  const Json* value = find(key);
  if (!value) return otherwise;
  if (!value->is_boolean()) failAt(key, "is neither true nor false");
  return value->get<bool>();
}

std::string JsonView::text(const char* key, std::string otherwise) const {
  const Json* value = find(key);
  if (!value) return otherwise;
  if (!value->is_string()) failAt(key, "is not a string");
  return value->get<std::string>();
}

bool JsonView::numbers(const char* key, double* out, size_t count) const {
  const Json* value = find(key);
  if (!value) return false;
  if (!value->is_array() || value->size() != count)
    failAt(key, "is not an array of " + std::to_string(count) + " numbers");
  for (size_t i = 0; i < count; ++i) {
    if (!(*value)[i].is_number()) finiteOf((*value)[i], pathOf(key) + "[" + std::to_string(i) + "]");
    out[i] = (*value)[i].get<double>();
    // Squares of coordinates must fit a float.
    if (!std::isfinite(static_cast<float>(out[i])))
      fail(pathOf(key) + "[" + std::to_string(i) + "]", "is not a finite number");
  }
  return true;
}

bool JsonView::numbers(const char* key, float* out, size_t count) const {
  std::vector<double> read(count);
  if (!numbers(key, read.data(), count)) return false;
  for (size_t i = 0; i < count; ++i) out[i] = static_cast<float>(read[i]);
  return true;
}

}  // namespace scumble::scene
