// Files of the checkout, and the real ones beside it, where they are there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scumble::test {

extern const std::filesystem::path kSource, kAssets;

// All files below a folder with one of these extensions, sorted; none where the folder is not there.
std::vector<std::filesystem::path> filesBelow(const std::filesystem::path& folder,
                                              const std::vector<std::string>& extensions);

}  // namespace scumble::test
