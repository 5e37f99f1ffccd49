// What was probably meant: for messages about words that nobody knows. From any thread.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scumble/export.h"

namespace scumble {

// The candidate nearest to `word` by letters (bytes) added, left out or changed, the first of several; empty
// when none is near: within a third of its letters, or two. Of a long word the first 64 letters count.
SCUMBLE_API std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

// The same, with at most `most` letters between them.
SCUMBLE_API std::string nearestWithin(const std::string& word, const std::vector<std::string>& candidates,
                                      size_t most);

}  // namespace scumble
