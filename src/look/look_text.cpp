#include "look/look_text.h"

#include <algorithm>
#include <map>
#include <optional>

#include "base/json_place.h"

namespace scumble::look {

namespace {

constexpr size_t kMaxWarnings = 100;  // a hostile file could ask for any number

// Builds the JSON as the parser goes through the text. (The library's own builder, when it may be asked about
// each value, looks through all of an object after each of its members.)
class Builder : public nlohmann::json_sax<Json> {
 public:
  Builder(const std::string& text, const std::string& file, const char*& lastRead,
          std::vector<std::string>& warnings, const std::string* wanted = nullptr)
      : file_(file), lastRead_(lastRead), warnings_(warnings), wanted_(wanted), counted_(text.data()) {}

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
  // The line of the wanted path, or of the last thing on its way that is there; 0: nothing is.
  int wantedLine() const { return wantedLine_; }
  Json finish() {
    if (leftOut_ > 0) warnings_.push_back(file_ + ": " + std::to_string(leftOut_) + " more keys stand twice");
    return std::move(root_);
  }

 private:
  struct Level {
    Json* value;
    std::string key;                   // of an object: the last one
    std::map<std::string, int> lines;  // of its keys
    // Letters of the wanted path that lead here, and on to what is being read in it; kNone where they do not.
    size_t here = kNone, on = kNone;
  };
  static constexpr size_t kNone = std::string::npos;

  // Where the next value stands. What is open does not move while something in it is.
  Json& place() {
    if (levels_.empty()) return root_;
    Level& level = levels_.back();
    if (!level.value->is_array()) return (*level.value)[level.key];
    Json& value = level.value->emplace_back();
    noteLine();
    return value;
  }
  bool add(Json value) {
    place() = std::move(value);
    return true;
  }
  bool begin(Json empty) {
    Json& value = place();
    value = std::move(empty);
    levels_.push_back({&value, "", {}, levels_.empty() ? 0 : levels_.back().on});
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
    noteLine();
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

  // Whether this is the wanted path, or on its way there; of keys that stand twice the later one counts.
  // Level by level: files may be nested deeply.
  void noteLine() {
    Level& level = levels_.back();
    level.on = kNone;
    if (!wanted_ || level.here == kNone) return;
    const std::string part = level.value->is_array() ? "[" + std::to_string(level.value->size() - 1) + "]"
                                                     : (level.here == 0 ? "" : ".") + level.key;
    const size_t end = level.here + part.size();
    const bool isOnTheWay = wanted_->compare(level.here, part.size(), part) == 0 &&
                            (wanted_->size() == end || (*wanted_)[end] == '.' || (*wanted_)[end] == '[');
    if (!isOnTheWay) return;
    level.on = end;
    if (end < wantedFound_) return;
    wantedFound_ = end;
    wantedLine_ = lineHere();
  }

  const std::string& file_;
  const char*& lastRead_;
  std::vector<std::string>& warnings_;
  const std::string* const wanted_;
  size_t wantedFound_ = 1;  // letters of it
  int wantedLine_ = 0;
  Json root_;
  std::vector<Level> levels_;
  std::optional<Error> failure_;
  size_t leftOut_ = 0;
  const char* counted_;  // up to where lines are counted
  int line_ = 1;
};

void parse(const std::string& text, const char*& lastRead, Builder& builder) {
  constexpr bool kIsWhole = true, kSkipsComments = true;
  Json::sax_parse(JsonReading(text.data(), lastRead), JsonReading(text.data() + text.size(), lastRead),
                  &builder, Json::input_format_t::json, kIsWhole, kSkipsComments);
}

}  // namespace

Result<Json> parseText(const std::string& text, const std::string& file, std::vector<std::string>& warnings) {
  const char* lastRead = text.data();
  Builder builder(text, file, lastRead, warnings);
  try {
    parse(text, lastRead, builder);
  } catch (const Json::exception&) {
    return Error{ErrorKind::unusableFile, file, lineOf(text, lastRead), "", "this JSON cannot be read",
                 "see `scumble schema`"};
  }
  if (builder.failure()) return *builder.failure();
  return builder.finish();
}

int lineOfPath(const std::string& text, const std::string& path) {
  std::vector<std::string> warnings;
  const char* lastRead = text.data();
  const std::string file;
  Builder builder(text, file, lastRead, warnings, &path);
  parse(text, lastRead, builder);
  return builder.wantedLine();
}

}  // namespace scumble::look
