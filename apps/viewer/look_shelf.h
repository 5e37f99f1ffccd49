// Looks that one can choose from: those that ship, and the scene's own.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scumble/look.h"

namespace scumble::viewer {

class LookShelf {
 public:
  // By its name or file, read once; defaults where it cannot be read.
  const Look& look(const std::string& nameOrFile);
  // Reads them anew when they are asked for next.
  void forget() { looks_.clear(); }
  // All that ship; before them `own`, where that is a file.
  std::vector<std::pair<std::string, Look>> all(const std::string& own);

 private:
  const std::vector<ShippedLook> shipped_ = Look::shipped();
  std::map<std::string, Look> looks_;
};

}  // namespace scumble::viewer
