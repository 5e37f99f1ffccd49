#include "file_watch.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <utility>

namespace scumble::viewer {

FileWatch::FileWatch(std::function<void()> whenSaved) : whenSaved_(std::move(whenSaved)) {
  inotify_ = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  stop_ = eventfd(0, EFD_CLOEXEC);
  if (inotify_ >= 0 && stop_ >= 0) thread_ = std::thread([this] { run(); });
}

FileWatch::~FileWatch() {
  if (thread_.joinable()) {
    const uint64_t one = 1;
    if (write(stop_, &one, sizeof one) == ssize_t(sizeof one)) thread_.join();
  }
  if (inotify_ >= 0) close(inotify_);
  if (stop_ >= 0) close(stop_);
}

void FileWatch::watch(const std::vector<std::string>& files) {
  const std::lock_guard lock(mutex_);
  std::map<std::string, int> folders;
  names_.clear();
  for (const std::string& file : files) {
    const std::filesystem::path path(file);
    const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
    auto found = folders.find(folder);
    if (found == folders.end()) {
      // Of a folder that is watched already it is the same number, unless it is another folder of that name
      // now.
      const int number = inotify_add_watch(inotify_, folder.c_str(), IN_CLOSE_WRITE | IN_MOVED_TO);
      if (number < 0) continue;
      found = folders.emplace(folder, number).first;
    }
    names_[{found->second, path.filename().string()}].push_back(file);
  }
  // Two names of one folder have one number.
  std::set<int> kept;
  for (const auto& [folder, number] : folders) kept.insert(number);
  for (const auto& [folder, number] : folders_)
    if (kept.insert(number).second) inotify_rm_watch(inotify_, number);
  folders_ = std::move(folders);
}

std::set<std::string> FileWatch::takeSaved() {
  const std::lock_guard lock(mutex_);
  return std::exchange(saved_, {});
}

void FileWatch::run() {
  pollfd polled[] = {{inotify_, POLLIN, 0}, {stop_, POLLIN, 0}};
  for (;;) {
    if (poll(polled, 2, -1) < 0 && errno != EINTR) return;
    if (polled[1].revents) return;
    if (polled[0].revents) read();
  }
}

void FileWatch::read() {
  alignas(inotify_event) char buffer[16384];
  bool isNews = false;
  for (ssize_t got; (got = ::read(inotify_, buffer, sizeof buffer)) > 0;) {
    const std::lock_guard lock(mutex_);
    for (const char* at = buffer; at < buffer + got;) {
      inotify_event event;
      std::memcpy(&event, at, sizeof event);
      const char* const name = at + sizeof event;
      if (event.len > 0)
        if (const auto known = names_.find({event.wd, name}); known != names_.end()) {
          saved_.insert(known->second.begin(), known->second.end());
          isNews = true;
        }
      at += sizeof event + event.len;
    }
  }
  if (isNews) whenSaved_();
}

}  // namespace scumble::viewer
