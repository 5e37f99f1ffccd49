#include "look_text.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <vector>

#include "knob_text.h"
#include "track_edit.h"

namespace scumble::viewer {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Where a value stands in a text.
struct Span {
  size_t begin = 0, end = 0;
};
struct Member {
  std::string key;
  size_t begin = 0;  // of the key
  Span value;
};
struct Object {
  Span span;  // with its braces
  std::vector<Member> members;
};

// Over a text that is JSON with comments already.
class Reader {
 public:
  explicit Reader(const std::string& text) : text_(text) {}

  size_t pastBlank(size_t at) const {
    for (;;) {
      while (at < text_.size() && std::isspace(static_cast<unsigned char>(text_[at]))) ++at;
      if (text_.compare(at, 2, "//") == 0)
        at = std::min(text_.find('\n', at), text_.size());
      else if (text_.compare(at, 2, "/*") == 0)
        at = text_.find("*/", at + 2) + 2;
      else
        return at;
    }
  }
  size_t pastString(size_t at) const {
    for (++at; text_[at] != '"'; ++at)
      if (text_[at] == '\\') ++at;
    return at + 1;
  }
  size_t pastValue(size_t at) const {
    if (text_[at] == '"') return pastString(at);
    if (text_[at] != '{' && text_[at] != '[') {
      while (at < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at])) &&
             std::string(",]}/").find(text_[at]) == std::string::npos)
        ++at;
      return at;
    }
    for (int depth = 0;;) {
      at = pastBlank(at);
      if (text_[at] == '"') {
        at = pastString(at);
        continue;
      }
      if (text_[at] == '{' || text_[at] == '[') ++depth;
      if (text_[at] == '}' || text_[at] == ']') --depth;
      ++at;
      if (depth == 0) return at;
    }
  }
  Object object(size_t at) const {
    Object object{{at, pastValue(at)}, {}};
    at = pastBlank(at + 1);
    while (text_[at] != '}') {
      const size_t key = at;
      at = pastString(at);
      Member member{nlohmann::json::parse(text_.substr(key, at - key)).get<std::string>(), key, {}};
      at = pastBlank(pastBlank(at) + 1);  // the colon
      member.value = {at, pastValue(at)};
      at = pastBlank(member.value.end);
      if (text_[at] == ',') at = pastBlank(at + 1);
      object.members.push_back(std::move(member));
    }
    return object;
  }

 private:
  const std::string& text_;
};

// Of a setting as looks have it in JSON. Words that are no number, truth or list of numbers are strings.
std::string jsonOf(const Setting& setting, const std::string& value) {
  if (isTrackText(value)) return value;
  const std::string& type = setting.knob->type;
  if (type == "number" || type == "integer" || type == "toggle") return value;
  return type == "vector" ? "[" + value + "]" : nlohmann::json(value).dump();
}

// The keys under which it stands.
std::vector<std::string> keysOf(const Setting& setting) {
  std::vector<std::string> keys;
  if (!setting.section.empty()) keys = {setting.section, setting.name};
  std::stringstream path(setting.knob->path);
  for (std::string key; std::getline(path, key, '.');) keys.push_back(key);
  return keys;
}

// The blanks with which the line of a place begins, if there is nothing else before it.
std::optional<std::string> indentationOf(const std::string& text, size_t at) {
  const size_t line = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const size_t begin = line == std::string::npos ? 0 : line + 1;
  const std::string before = text.substr(begin, at - begin);
  return line != std::string::npos && before.find_first_not_of(" \t") == std::string::npos
             ? std::optional(before)
             : std::nullopt;
}

// Adds a member at an object's end, as its others are written: each on a line of its own, or all in one.
void append(std::string& text, const Object& object, const std::string& member) {
  if (object.members.empty()) {
    const std::string inside = text.substr(object.span.begin + 1, object.span.end - object.span.begin - 2);
    const bool isBare = inside.find_first_not_of(" \t\r\n") == std::string::npos;
    text.replace(object.span.begin + 1, isBare ? inside.size() : 0,
                 isBare ? " " + member + " " : " " + member);
    return;
  }
  const Member& last = object.members.back();
  const std::optional<std::string> indentation = indentationOf(text, last.begin);
  text.insert(last.value.end, indentation ? ",\n" + *indentation + member : ", " + member);
}

bool put(std::string& text, const std::vector<std::string>& keys, const std::string& json) {
  const Reader reader(text);
  Object object =
      reader.object(reader.pastBlank(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0));
  for (auto key = keys.begin();; ++key) {
    // Of keys that stand twice the last one counts.
    const auto found = std::find_if(object.members.rbegin(), object.members.rend(),
                                    [&](const Member& member) { return member.key == *key; });
    const bool isKnob = key + 1 == keys.end();
    if (found == object.members.rend()) {
      std::string member = nlohmann::json(keys.back()).dump() + ": " + json;
      for (auto outer = keys.end() - 1; outer != key; --outer)
        member = nlohmann::json(*(outer - 1)).dump() + ": { " + member + " }";
      append(text, object, member);
      return true;
    }
    if (isKnob) {
      text.replace(found->value.begin, found->value.end - found->value.begin, json);
      return true;
    }
    if (text[found->value.begin] != '{') return false;
    object = reader.object(found->value.begin);
  }
}

}  // namespace

std::optional<std::string> withKnobs(const std::string& text, const Edits& edits) try {
  const bool isEmpty = text.find_first_not_of(" \t\r\n") == std::string::npos;
  std::string changed = isEmpty ? "{}\n" : text;
  const nlohmann::json parsed = nlohmann::json::parse(changed, nullptr, false, true);
  if (!parsed.is_object()) return std::nullopt;
  for (const auto& [path, value] : edits) {
    const std::optional<Setting> setting = settingOf(path);
    if (!setting || !put(changed, keysOf(*setting), jsonOf(*setting, value))) return std::nullopt;
  }
  return changed;
} catch (const nlohmann::json::exception&) {
  // A name that is not UTF-8.
  return std::nullopt;
}

}  // namespace scumble::viewer
