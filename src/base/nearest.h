// What was probably meant.
#pragma once

#include <string>
#include <vector>

namespace scumble {

// The candidate nearest to `word` by letters added, left out or changed, or empty when none is near; `most`:
// so many letters at most.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);
std::string nearestWithin(const std::string& word, const std::vector<std::string>& candidates, size_t most);

}  // namespace scumble
