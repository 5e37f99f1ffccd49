// How far a JSON parser has read, which it does not tell: for messages with lines.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>

namespace scumble {

// A text's characters, for a parser; notes the last one that was read.
class JsonReading {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  JsonReading(const char* at, const char*& lastRead) : at_(at), lastRead_(&lastRead) {}

  reference operator*() const { return *(*lastRead_ = at_); }
  JsonReading& operator++() { return ++at_, *this; }
  JsonReading operator++(int) { return {at_++, *lastRead_}; }
  bool operator==(const JsonReading& other) const { return at_ == other.at_; }
  bool operator!=(const JsonReading& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** lastRead_;
};

// The line, counted from 1, in which a character of the text stands.
inline int lineOf(std::string_view text, const char* character) {
  return 1 + int(std::count(text.data(), character, '\n'));
}

}  // namespace scumble
