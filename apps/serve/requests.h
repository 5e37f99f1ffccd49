// The two ends of the line: requests as they come in, answers as they go out. Both are JSON, one a line.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "scumble/result.h"

namespace scumble::serve {

nlohmann::json toJson(const Error& error);

// From any thread, a line at a time.
class Answers {
 public:
  explicit Answers(int file) : file_(file) {}
  void send(const nlohmann::json& answer);
  bool isLost() const { return isLost_; }  // nobody listens any more

 private:
  std::mutex mutex_;
  int file_;
  std::atomic<bool> isLost_ = false;
};

// Requests that wait, and which of them are not wanted any more. One thread reads them, another one takes
// them.
class Requests {
 public:
  explicit Requests(Answers& answers) : answers_(answers) {}

  // Reads lines until there are no more. What is no request is answered at once, and so is `cancel`.
  void read(int file);
  // Waits for the next one; nothing when there will be none.
  std::optional<nlohmann::json> take();
  bool isCancelled(int64_t id) const;
  void done(int64_t id);

 private:
  void add(const std::string& line);
  void refuse(const Error& error);
  Answers& answers_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  struct Waiting {
    nlohmann::json request;
    size_t bytes = 0;  // of its line
  };
  std::deque<Waiting> waiting_;
  size_t waitingBytes_ = 0;
  std::set<int64_t> open_, cancelled_;
  bool isAtEnd_ = false;
};

}  // namespace scumble::serve
