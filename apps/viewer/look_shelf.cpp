#include "look_shelf.h"

namespace scumble::viewer {

const Look& LookShelf::look(const std::string& nameOrFile) {
  const auto [known, isNew] = looks_.try_emplace(nameOrFile);
  if (isNew)
    if (Result<Look> look = Look::load(nameOrFile)) known->second = std::move(look).value();
  return known->second;
}

std::vector<std::pair<std::string, Look>> LookShelf::all(const std::string& own) {
  std::vector<std::pair<std::string, Look>> looks;
  if (isLookFile(own)) looks.emplace_back(own, look(own));
  for (const ShippedLook& shipped : shipped_) looks.emplace_back(shipped.name, look(shipped.name));
  return looks;
}

}  // namespace scumble::viewer
