// Tells when files were saved. It watches their folders: most programs save by writing another file and
// renaming it.
#pragma once

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

  // These from now on, and no others. Files need not be there; folders that are not are not watched.
  void watch(const std::vector<std::string>& files);
  // Of those that are watched, as they were named, what was saved since the last call.
  std::set<std::string> takeSaved();

 private:
  void run();
  void read();

  const std::function<void()> whenSaved_;
  int inotify_ = -1, stop_ = -1;
  std::mutex mutex_;
  std::map<std::string, int> folders_;                                     // with inotify's number
  std::map<std::pair<int, std::string>, std::vector<std::string>> names_;  // by folder and name in it
  std::set<std::string> saved_;
  std::thread thread_;
};

}  // namespace scumble::viewer
