#include "file_watch.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <utility>

namespace scumble::viewer {

namespace {

constexpr int kLookMilliseconds = 500;  // between looks for folders that are not there

}  // namespace

FileWatch::FileWatch(std::function<void()> whenSaved) : whenSaved_(std::move(whenSaved)) {
  inotify_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  wake_ = eventfd(0, EFD_CLOEXEC);
  if (inotify_ >= 0 && wake_ >= 0) thread_ = std::thread([this] { run(); });
}

FileWatch::~FileWatch() {
  if (thread_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      isEnding_ = true;
    }
    nudge();
    thread_.join();
  }
  if (inotify_ >= 0) close(inotify_);
  if (wake_ >= 0) close(wake_);
}

// The thread, so that it sees what is another now.
void FileWatch::nudge() const {
  const uint64_t one = 1;
  if (wake_ >= 0 && write(wake_, &one, sizeof one) < 0) return;
}

void FileWatch::watch(const std::vector<std::string>& files) {
  bool isNews = false;
  {
    const std::lock_guard lock(mutex_);
    const auto before = std::exchange(wanted_, {});
    for (const std::string& file : files) {
      const std::filesystem::path path(file);
      want(path, file);
      // Of a link what it leads to is saved.
      std::error_code error;
      const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
      if (!error && std::filesystem::is_symlink(path, error)) want(real, file);
    }
    const std::map<std::string, int> numbers = std::exchange(folders_, {}), above = std::exchange(above_, {});
    // Two names of one folder have one number.
    std::set<int> kept;
    for (const auto& [folder, names] : wanted_) {
      if (!add(folder)) continue;
      kept.insert(folders_[folder]);
      // Another folder of a name that was watched, which nobody has looked into yet.
      const auto known = numbers.find(folder);
      if (before.count(folder) && (known == numbers.end() || known->second != folders_[folder]))
        isNews |= takeThere(folder);
    }
    for (const auto& [folder, number] : above_) kept.insert(number);
    for (const auto* const last : {&numbers, &above})
      for (const auto& [folder, number] : *last)
        if (kept.insert(number).second) inotify_rm_watch(inotify_, number);
  }
  nudge();
  if (isNews) whenSaved_();
}

void FileWatch::want(const std::filesystem::path& path, const std::string& file) {
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  wanted_[folder][path.filename().string()].push_back(file);
}

// All files of a folder that are there count as saved; true where there are some.
bool FileWatch::takeThere(const std::string& folder) {
  bool isNews = false;
  std::error_code error;
  for (const auto& [name, files] : wanted_[folder])
    if (std::filesystem::exists(std::filesystem::path(folder) / name, error)) {
      saved_.insert(files.begin(), files.end());
      isNews = true;
    }
  return isNews;
}

// Of a folder that is watched already it is the same number, unless it is another folder of that name now.
bool FileWatch::add(const std::string& folder) {
  const int number = inotify_add_watch(inotify_, folder.c_str(), IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVE_SELF);
  if (number < 0) return false;
  folders_[folder] = number;
  std::error_code error;
  std::filesystem::path up = std::filesystem::absolute(folder, error).lexically_normal();
  for (up = up.parent_path(); up != up.root_path(); up = up.parent_path())
    if (const int one = inotify_add_watch(inotify_, up.c_str(), IN_MOVE_SELF | IN_MASK_ADD); one >= 0)
      above_[up.string()] = one;
  return true;
}

// A folder is gone, or elsewhere, with all that lies in it.
void FileWatch::loseWhatLay(int number) {
  std::erase_if(folders_, [&](const auto& folder) { return folder.second == number; });
  for (const auto& [up, known] : above_) {
    if (known != number) continue;
    std::erase_if(folders_, [&, &path = up](const auto& folder) {
      std::error_code error;
      const std::string whole = std::filesystem::absolute(folder.first, error).lexically_normal().string();
      const bool isBelow = whole.starts_with(path + "/");
      if (isBelow) inotify_rm_watch(inotify_, folder.second);
      return isBelow;
    });
  }
  std::erase_if(above_, [&](const auto& folder) { return folder.second == number; });
}

// True where one has come, with a file in it.
bool FileWatch::lookForFolders() {
  const std::lock_guard lock(mutex_);
  bool isNews = false;
  for (const auto& [folder, names] : wanted_)
    if (!folders_.count(folder) && add(folder)) isNews |= takeThere(folder);
  return isNews;
}

std::set<std::string> FileWatch::takeSaved() {
  const std::lock_guard lock(mutex_);
  return std::exchange(saved_, {});
}

void FileWatch::run() {
  pollfd polled[] = {{inotify_, POLLIN, 0}, {wake_, POLLIN, 0}};
  for (;;) {
    bool isAllThere = false;
    {
      const std::lock_guard lock(mutex_);
      if (isEnding_) return;
      isAllThere = folders_.size() == wanted_.size();
    }
    if (poll(polled, 2, isAllThere ? -1 : kLookMilliseconds) < 0 && errno != EINTR) return;
    if (uint64_t count; polled[1].revents && ::read(wake_, &count, sizeof count) < 0) return;
    bool isNews = polled[0].revents && read();
    if (!isAllThere) isNews |= lookForFolders();
    if (isNews) whenSaved_();
  }
}

bool FileWatch::read() {
  alignas(inotify_event) char buffer[16384];
  bool isNews = false;
  for (ssize_t got; (got = ::read(inotify_, buffer, sizeof buffer)) > 0;) {
    const std::lock_guard lock(mutex_);
    for (const char* at = buffer; at < buffer + got;) {
      inotify_event event;
      std::memcpy(&event, at, sizeof event);
      const int number = event.wd;
      const std::string name = event.len > 0 ? at + sizeof event : "";
      at += sizeof event + event.len;
      // It is gone, or elsewhere.
      const bool isGone = event.mask & (IN_IGNORED | IN_MOVE_SELF);
      if (event.mask & IN_MOVE_SELF) inotify_rm_watch(inotify_, number);
      if (isGone) loseWhatLay(number);
      if (isGone || name.empty()) continue;
      for (const auto& [folder, known] : folders_) {
        if (known != number) continue;
        const auto& names = wanted_[folder];
        if (const auto named = names.find(name); named != names.end()) {
          saved_.insert(named->second.begin(), named->second.end());
          isNews = true;
        }
      }
    }
  }
  return isNews;
}

}  // namespace scumble::viewer
