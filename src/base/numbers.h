// Numbers as text, the same whatever locale a host program has set (Qt and GTK programs set the user's).
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace scumble {

// The number at the beginning of a text, and how many letters it takes: decimal or with an exponent, with one
// sign. Nothing where there is none, or where it is not finite.
struct NumberAtStart {
  double value;
  size_t length;
};
inline std::optional<NumberAtStart> numberAtStart(std::string_view text) {
  // from_chars knows no plus.
  const size_t sign = text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0;
  double value = 0;
  const char* const begin = text.data() + sign;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return NumberAtStart{value, size_t(end - text.data())};
}

// A text that is one number.
inline std::optional<double> numberOf(std::string_view text) {
  const std::optional<NumberAtStart> number = numberAtStart(text);
  if (!number || number->length != text.size()) return std::nullopt;
  return number->value;
}

}  // namespace scumble
