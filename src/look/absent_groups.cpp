#include "look/absent_groups.h"

#include <utility>

namespace scumble::look {

namespace {

// The last one ends a list that may be empty.
constexpr std::pair<const char*, const char*> kAbsent[] = {
#include "look/absent_groups.inc"
    {"", ""}};

}  // namespace

std::string absentFeatureOf(const std::string& path) {
  const std::string group = path.substr(0, path.find('.'));
  for (const auto& [absent, feature] : kAbsent)
    if (!group.empty() && group == absent) return feature;
  return "";
}

}  // namespace scumble::look
