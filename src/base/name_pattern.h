// Patterns that users write for names.
#pragma once

#include <string>

namespace scumble {

// Whether `name` matches a pattern of literal characters, '*' and '?'.
bool matches(const std::string& pattern, const std::string& name);

}  // namespace scumble
