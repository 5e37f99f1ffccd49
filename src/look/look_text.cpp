#include "look/look_text.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "base/json_place.h"

namespace scumble::look {

namespace {

constexpr size_t kMaxWarnings = 100;  // a hostile file could ask for any number

// Builds the JSON as the parser goes through the text. (The library's own builder, when it may be asked about
// each value, looks through all of an object after each of its members.)
class Builder : public nlohmann::json_sax<Json> {
 public:
  Builder(const std::string& text, const std::string& file, const char*& lastRead,
          std::vector<std::string>& warnings)
      : file_(file), lastRead_(lastRead), warnings_(warnings), counted_(text.data()) {}

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(Json::number_integer_t value) override { return add(value); }
  bool number_unsigned(Json::number_unsigned_t value) override { return add(value); }
  bool number_float(Json::number_float_t value, const std::string&) override { return add(value); }
  bool string(std::string& value) override { return checkText(value) && add(std::move(value)); }
  bool binary(Json::binary_t&) override { return false; }
  bool start_object(size_t) override { return begin(Json::object()); }
  bool start_array(size_t) override { return begin(Json::array()); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool key(std::string& key) override { return checkText(key) && takeKey(key); }
  bool parse_error(size_t, const std::string&, const nlohmann::detail::exception& error) override {
    constexpr int kNumberOverflow = 406;
    if (error.id == kNumberOverflow) return fail("a number here is too large", "no knob takes such a number");
    return fail("this is no JSON", "mind commas, quotes and brackets there");
  }

  const std::optional<Error>& failure() const { return failure_; }
  Json finish() {
    if (leftOut_ > 0) warnings_.push_back(file_ + ": " + std::to_string(leftOut_) + " more keys stand twice");
    return std::move(root_);
  }

 private:
  struct Level {
    Json* value;
    std::string key;                   // of an object: the last one
    std::map<std::string, int> lines;  // of its keys
  };

  // Where the next value stands. What is open does not move while something in it is.
  Json& place() {
    if (levels_.empty()) return root_;
    Level& level = levels_.back();
    return level.value->is_array() ? level.value->emplace_back() : (*level.value)[level.key];
  }
  bool add(Json value) {
    place() = std::move(value);
    return true;
  }
  bool begin(Json empty) {
    Json& value = place();
    value = std::move(empty);
    levels_.push_back({&value, "", {}});
    return true;
  }
  bool end() {
    levels_.pop_back();
    return true;
  }
  bool fail(std::string problem, std::string advice) {
    failure_ = Error{ErrorKind::unusableFile, file_, lineHere(), "", std::move(problem), std::move(advice)};
    return false;
  }

  bool takeKey(const std::string& key) {
    Level& level = levels_.back();
    level.key = key;
    const int line = lineHere();
    const auto [known, isNew] = level.lines.try_emplace(key, line);
    if (isNew) return true;
    if (warnings_.size() >= kMaxWarnings)
      ++leftOut_;
    else
      warnings_.push_back(Error{ErrorKind::unusableFile, file_, line, path(),
                                "it stands in line " + std::to_string(known->second) + " already",
                                "what stands here counts"}
                              .message());
    known->second = line;
    return true;
  }

  // Counted on from the last place, since all of the text for each key would take a large look minutes.
  int lineHere() {
    line_ += int(std::count(counted_, lastRead_, '\n'));
    counted_ = lastRead_;
    return line_;
  }

  // Where C ends a text, a name would go on.
  bool checkText(const std::string& text) {
    return text.find('\0') == std::string::npos ||
           fail("a text here holds the character NUL", "leave \\u0000 out");
  }

  std::string path() const {
    std::string path;
    for (const Level& level : levels_)
      if (level.value->is_array())
        path += "[" + std::to_string(level.value->size() - 1) + "]";
      else
        path += (path.empty() ? "" : ".") + level.key;
    return path;
  }

  const std::string& file_;
  const char*& lastRead_;
  std::vector<std::string>& warnings_;
  Json root_;
  std::vector<Level> levels_;
  std::optional<Error> failure_;
  size_t leftOut_ = 0;
  const char* counted_;  // up to where lines are counted
  int line_ = 1;
};

}  // namespace

Result<Json> parseText(const std::string& text, const std::string& file, std::vector<std::string>& warnings) {
  const char* lastRead = text.data();
  Builder builder(text, file, lastRead, warnings);
  constexpr bool kIsWhole = true, kSkipsComments = true;
  try {
    Json::sax_parse(JsonReading(text.data(), lastRead), JsonReading(text.data() + text.size(), lastRead),
                    &builder, Json::input_format_t::json, kIsWhole, kSkipsComments);
  } catch (const Json::exception&) {
    return Error{ErrorKind::unusableFile, file, lineOf(text, lastRead), "", "this JSON cannot be read",
                 "see `scumble schema`"};
  }
  if (builder.failure()) return *builder.failure();
  return builder.finish();
}

namespace {

// Goes through a text again, for the place of one path.
class LineFinder : public nlohmann::json_sax<Json> {
 public:
  LineFinder(std::string_view text, const std::string& path, const char*& lastRead)
      : text_(text), wanted_(path), lastRead_(lastRead) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(Json::number_integer_t) override { return value(); }
  bool number_unsigned(Json::number_unsigned_t) override { return value(); }
  bool number_float(Json::number_float_t, const std::string&) override { return value(); }
  bool string(std::string&) override { return value(); }
  bool binary(Json::binary_t&) override { return false; }
  bool start_object(size_t) override { return value() && open(false); }
  bool start_array(size_t) override { return value() && open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& key) override {
    Level& level = levels_.back();
    path_.resize(level.length);
    path_ += (path_.empty() ? "" : ".") + key;
    return note();
  }
  bool parse_error(size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

  int line() const { return line_; }

 private:
  struct Level {
    bool isArray;
    size_t length;  // of the path before its members
    size_t count = 0;
  };

  // Of an array's item, what it is called.
  bool value() {
    if (levels_.empty() || !levels_.back().isArray) return true;
    Level& level = levels_.back();
    path_.resize(level.length);
    path_ += "[" + std::to_string(level.count++) + "]";
    return note();
  }
  bool open(bool isArray) {
    levels_.push_back({isArray, path_.size()});
    return true;
  }
  bool close() {
    path_.resize(levels_.back().length);
    levels_.pop_back();
    return true;
  }
  // The path itself, or the last thing on the way to it; of keys that stand twice, the one that counts.
  bool note() {
    const bool isOnTheWay =
        wanted_.starts_with(path_) &&
        (wanted_.size() == path_.size() || wanted_[path_.size()] == '.' || wanted_[path_.size()] == '[');
    if (isOnTheWay && path_.size() >= found_) {
      found_ = path_.size();
      line_ = lineOf(text_, lastRead_);
    }
    return true;
  }

  std::string_view text_;
  const std::string& wanted_;
  const char*& lastRead_;
  std::string path_;
  std::vector<Level> levels_;
  size_t found_ = 1;
  int line_ = 0;
};

}  // namespace

int lineOfPath(const std::string& text, const std::string& path) {
  const char* lastRead = text.data();
  LineFinder finder(text, path, lastRead);
  constexpr bool kIsWhole = true, kSkipsComments = true;
  Json::sax_parse(JsonReading(text.data(), lastRead), JsonReading(text.data() + text.size(), lastRead),
                  &finder, Json::input_format_t::json, kIsWhole, kSkipsComments);
  return finder.line();
}

}  // namespace scumble::look
