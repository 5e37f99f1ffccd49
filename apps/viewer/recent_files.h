// Which scenes were opened last, kept from one start to the next.
#pragma once

#include <string>
#include <vector>

namespace scumble::viewer {

class RecentFiles {
 public:
  static constexpr size_t kMost = 12;

  // `folder`: where they are kept; empty: nowhere. What cannot be read there counts as nothing.
  explicit RecentFiles(const std::string& folder);

  // Whole paths, the last one first; those that are gone are left out.
  std::vector<std::string> files() const;
  // Opened just now. Another program may have added some meanwhile: they stay.
  void add(const std::vector<std::string>& files);

 private:
  std::vector<std::string> read() const;

  std::string file_;
};

}  // namespace scumble::viewer
