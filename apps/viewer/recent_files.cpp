#include "recent_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scumble/image.h"

namespace scumble::viewer {

RecentFiles::RecentFiles(const std::string& folder) : file_(folder.empty() ? "" : folder + "/recent.json") {}

std::vector<std::string> RecentFiles::read() const {
  std::vector<std::string> files;
  std::ifstream in(file_);
  const nlohmann::json list = nlohmann::json::parse(in, nullptr, false);
  if (!list.is_array()) return files;
  for (const nlohmann::json& one : list)
    if (one.is_string()) files.push_back(one.get<std::string>());
  return files;
}

std::vector<std::string> RecentFiles::files() const {
  std::vector<std::string> files = read();
  std::erase_if(files, [](const std::string& file) {
    std::error_code error;
    return !std::filesystem::exists(file, error);
  });
  return files;
}

void RecentFiles::add(const std::vector<std::string>& files) {
  if (file_.empty()) return;
  std::vector<std::string> all;
  const auto take = [&](const std::string& file) {
    std::error_code error;
    const std::string whole = std::filesystem::weakly_canonical(file, error).string();
    if (!error && std::find(all.begin(), all.end(), whole) == all.end() && all.size() < kMost)
      all.push_back(whole);
  };
  for (const std::string& file : files) take(file);
  for (const std::string& file : read()) take(file);
  std::error_code error;
  std::filesystem::create_directories(std::filesystem::path(file_).parent_path(), error);
  // Without it the window is as useful as before.
  static_cast<void>(writeText(
      file_, nlohmann::json(all).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"));
}

}  // namespace scumble::viewer
