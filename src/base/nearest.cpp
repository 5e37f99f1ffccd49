#include "scumble/nearest.h"

#include <algorithm>

namespace scumble {

namespace {

size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearestWithin(const std::string& word, const std::vector<std::string>& candidates, size_t most) {
  std::string best;
  size_t bestDistance = most + 1;
  for (const std::string& candidate : candidates) {
    const size_t distance = editDistance(word.substr(0, 64), candidate);
    if (distance < bestDistance) best = candidate, bestDistance = distance;
  }
  return best;
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  return nearestWithin(word, candidates, std::max<size_t>(2, std::min<size_t>(word.size(), 64) / 3));
}

}  // namespace scumble
