#include "look/look_text.h"

#include <map>
#include <optional>

#include "base/json_place.h"

namespace scumble::look {

namespace {

constexpr size_t kMaxWarnings = 100;  // a hostile file could ask for any number

// Follows the parser through the text.
class Follower {
 public:
  Follower(const std::string& text, const std::string& file, const char*& lastRead,
           std::vector<std::string>& warnings)
      : text_(text), file_(file), lastRead_(lastRead), warnings_(warnings) {}

  void follow(Json::parse_event_t event, const Json& parsed) {
    using Event = Json::parse_event_t;
    switch (event) {
      case Event::object_start:
      case Event::array_start:
        levels_.push_back({event == Event::array_start, 0, "", {}});
        break;
      case Event::object_end:
      case Event::array_end:
        levels_.pop_back();
        countItem();
        break;
      case Event::key:
        takeKey(parsed.get_ref<const std::string&>());
        break;
      case Event::value:
        if (parsed.is_string()) checkText(parsed.get_ref<const std::string&>());
        countItem();
        break;
    }
  }

  std::optional<Error> failure() const { return failure_; }
  void finish() const {
    if (leftOut_ > 0) warnings_.push_back(file_ + ": " + std::to_string(leftOut_) + " more keys stand twice");
  }

 private:
  struct Level {
    bool isList;
    size_t item;
    std::string key;
    std::map<std::string, int> lines;  // of keys
  };

  void countItem() {
    if (!levels_.empty() && levels_.back().isList) ++levels_.back().item;
  }

  void takeKey(const std::string& key) {
    Level& level = levels_.back();
    level.key = key;
    checkText(key);
    const int line = lineOf(text_, lastRead_);
    const auto [known, isNew] = level.lines.try_emplace(key, line);
    if (isNew) return;
    if (warnings_.size() >= kMaxWarnings)
      ++leftOut_;
    else
      warnings_.push_back(Error{ErrorKind::unusableFile, file_, line, path(),
                                "it stands in line " + std::to_string(known->second) + " already",
                                "what stands here counts"}
                              .message());
    known->second = line;
  }

  // Where C ends a text, a name would go on.
  void checkText(const std::string& text) {
    if (failure_ || text.find('\0') == std::string::npos) return;
    failure_ = Error{
        ErrorKind::unusableFile, file_, lineOf(text_, lastRead_), "", "a text here holds the character NUL",
        "leave \\u0000 out"};
  }

  std::string path() const {
    std::string path;
    for (const Level& level : levels_)
      if (level.isList)
        path += "[" + std::to_string(level.item) + "]";
      else
        path += (path.empty() ? "" : ".") + level.key;
    return path;
  }

  const std::string& text_;
  const std::string& file_;
  const char*& lastRead_;
  std::vector<std::string>& warnings_;
  std::vector<Level> levels_;
  std::optional<Error> failure_;
  size_t leftOut_ = 0;
};

}  // namespace

Result<Json> parseText(const std::string& text, const std::string& file, std::vector<std::string>& warnings) {
  const char* lastRead = text.data();
  const auto fail = [&](std::string problem, std::string advice) {
    return Error{ErrorKind::unusableFile, file, lineOf(text, lastRead), "", std::move(problem),
                 std::move(advice)};
  };
  constexpr bool kThrows = true, kSkipsComments = true;
  try {
    Follower follower(text, file, lastRead, warnings);
    Json root = Json::parse(
        JsonReading(text.data(), lastRead), JsonReading(text.data() + text.size(), lastRead),
        [&](int, Json::parse_event_t event, const Json& parsed) {
          follower.follow(event, parsed);
          return true;
        },
        kThrows, kSkipsComments);
    follower.finish();
    if (const std::optional<Error> failure = follower.failure()) return *failure;
    return root;
  } catch (const Json::parse_error&) {
    return fail("this is no JSON", "mind commas, quotes and brackets there");
  } catch (const Json::out_of_range&) {
    return fail("a number here is too large", "no knob takes such a number");
  } catch (const Json::exception&) {
    return fail("this JSON cannot be read", "see `scumble schema`");
  }
}

}  // namespace scumble::look
