// Tells when files were saved. It watches their folders: most programs save by writing another file and
// renaming it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace scumble::viewer {

class FileWatch {
 public:
  // `whenSaved`: called from a thread of its own. Without inotify nothing is ever told.
  explicit FileWatch(std::function<void()> whenSaved);
  ~FileWatch();
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  // These from now on, and no others. Neither files nor folders need to be there; of a folder that comes to
  // be there, or is another one of its name, all that are in it were saved.
  void watch(const std::vector<std::string>& files);
  // Of those that are watched, as they were named, what was saved since the last call.
  std::set<std::string> takeSaved();

 private:
  void run();
  bool read();
  void nudge() const;
  void want(const std::filesystem::path& path, const std::string& file);
  bool add(const std::string& folder);
  void loseWhatLay(int number);
  bool takeThere(const std::string& folder);
  bool lookForFolders();

  const std::function<void()> whenSaved_;
  int inotify_ = -1, wake_ = -1;
  std::mutex mutex_;
  bool isEnding_ = false;
  std::map<std::string, std::map<std::string, std::vector<std::string>>> wanted_;  // by folder, name in it
  std::map<std::string, int> folders_;  // those that are there, with inotify's number
  std::map<std::string, int> above_;    // folders above those, which may be moved with all that is in them
  std::set<std::string> saved_;
  std::thread thread_;
};

}  // namespace scumble::viewer
