#include "export_job.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

namespace scumble::viewer {

std::string shellText(const std::vector<std::string>& words) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ' ';
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      text += word;
      continue;
    }
    text += '\'';
    for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
    text += '\'';
  }
  return text;
}

double partOf(const std::string& line) {
  const size_t of = line.find(" of ");
  if (of == std::string::npos || of == 0) return -1;
  size_t begin = of;
  while (begin > 0 && std::strchr("0123456789", line[begin - 1])) --begin;
  const auto numberAt = [&](size_t place) {
    double number = 0;
    std::from_chars(line.data() + place, line.data() + line.size(), number);
    return number;
  };
  const double done = numberAt(begin), all = numberAt(of + 4);
  return begin < of && all > 0 && done <= all ? done / all : -1;
}

std::string freeName(const std::string& file, const std::string& addition, const std::string& ending) {
  const std::string stem = std::filesystem::path(file).replace_extension().string() + addition;
  std::error_code error;
  for (int number = 1;; ++number) {
    std::string name = stem + "-" + std::to_string(number) + ending;
    if (!std::filesystem::exists(name, error)) return name;
  }
}

ExportJob::ExportJob(const std::vector<std::string>& words, std::string file, std::function<void()> whenNews)
    : file_(std::move(file)), whenNews_(std::move(whenNews)) {
  std::array<int, 2> errors{-1, -1};
  if (pipe2(errors.data(), O_CLOEXEC) != 0) {
    state_ = {0, true, std::string("no pipe can be made: ") + std::strerror(errno)};
    return;
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, errors[1], STDERR_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const int code = posix_spawn(&process_, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(errors[1]);
  if (code != 0) {
    close(errors[0]);
    process_ = -1;
    state_ = {0, true, std::string("the program cannot be started: ") + std::strerror(code)};
    return;
  }
  thread_ = std::thread([this, from = errors[0]] { listen(from); });
}

ExportJob::~ExportJob() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

void ExportJob::cancel() {
  const std::lock_guard lock(mutex_);
  if (process_ < 0) return;
  isCancelled_ = true;
  kill(process_, SIGTERM);
}

ExportJob::State ExportJob::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void ExportJob::listen(int errors) {
  std::string line, problem;
  std::array<char, 4096> part;
  for (ssize_t got; (got = read(errors, part.data(), part.size())) > 0 || (got < 0 && errno == EINTR);) {
    for (ssize_t i = 0; i < got; ++i) {
      if (part[size_t(i)] != '\n') {
        line += part[size_t(i)];
        continue;
      }
      if (line.find("error: ") != std::string::npos) problem = line.substr(line.find("error: ") + 7);
      if (const double done = partOf(line); done >= 0) {
        const std::lock_guard lock(mutex_);
        state_.part = done;
      }
      line.clear();
    }
    whenNews_();
  }
  close(errors);
  // It is waited for before another process can have its number.
  siginfo_t ended{};
  pid_t process;
  {
    const std::lock_guard lock(mutex_);
    process = process_;
  }
  while (waitid(P_PID, id_t(process), &ended, WEXITED | WNOWAIT) != 0 && errno == EINTR) continue;
  {
    const std::lock_guard lock(mutex_);
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    const bool isGood = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    state_.isDone = true;
    if (isGood)
      state_.part = 1;
    else
      state_.problem = isCancelled_ ? "it was stopped" : problem.empty() ? "it has failed" : problem;
  }
  whenNews_();
}

}  // namespace scumble::viewer
