#include "requests.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>

#include "members.h"

namespace scumble::serve {

using nlohmann::json;

namespace {

constexpr size_t kLongestLine = size_t(64) << 20;   // bytes
constexpr size_t kMostWaiting = size_t(256) << 20;  // bytes of lines
constexpr int kDeepest = 32;
constexpr uint64_t kMostId = uint64_t(1) << 53;

const char* nameOf(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
      return "usage";
    case ErrorKind::unusableFile:
      return "unusable-file";
    case ErrorKind::noUsableGpu:
      return "no-gpu";
    case ErrorKind::outputNotWritten:
      return "not-written";
    case ErrorKind::cancelled:
      return "cancelled";
    case ErrorKind::internal:
      break;
  }
  return "internal";
}

json parsed(const std::string& line) {
  bool isTooDeep = false;
  json request = json::parse(
      line,
      [&](int depth, json::parse_event_t, json&) {
        isTooDeep = isTooDeep || depth > kDeepest;
        return !isTooDeep;
      },
      false);
  if (isTooDeep) refuse("", "the request is nested too deeply", "docs/serve.md says what there is");
  if (request.is_discarded()) refuse("", "the line is no JSON", "write one object a line");
  return request;
}

}  // namespace

json toJson(const Error& error) {
  json described = {{"kind", nameOf(error.kind)}, {"problem", error.problem}, {"message", error.message()}};
  if (!error.file.empty()) described["file"] = error.file;
  if (error.line > 0) described["line"] = error.line;
  if (!error.jsonPath.empty()) described["where"] = error.jsonPath;
  if (!error.advice.empty()) described["advice"] = error.advice;
  return described;
}

void Answers::send(const json& answer) {
  const std::string line = answer.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  const std::lock_guard lock(mutex_);
  for (size_t done = 0; done < line.size() && !isLost_;) {
    const ssize_t put = ::write(file_, line.data() + done, line.size() - done);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0)
      isLost_ = true;
    else
      done += size_t(put);
  }
}

void Requests::add(const std::string& line) {
  if (line.find_first_not_of(" \t\r") == std::string::npos) return;
  json id;
  try {
    json request = parsed(line);
    Members members(request, "");
    const int64_t number = int64_t(members.requireWhole("id", kMostId));
    id = number;
    if (members.requireText("do") == "cancel") {
      const auto unwanted = int64_t(members.requireWhole("of", kMostId));
      members.end();
      {
        const std::lock_guard lock(mutex_);
        if (open_.count(unwanted)) cancelled_.insert(unwanted);
      }
      answers_.send({{"id", id}, {"done", json::object()}});
      return;
    }
    const std::lock_guard lock(mutex_);
    if (waitingBytes_ + line.size() > kMostWaiting)
      serve::refuse("", "too much waits already", "wait for answers");
    if (!open_.insert(number).second)
      serve::refuse("id", "another request of this number is not yet answered", "count up");
    waiting_.push_back({std::move(request), line.size()});
    waitingBytes_ += line.size();
    changed_.notify_one();
  } catch (const Refusal& refusal) {
    answers_.send({{"id", id}, {"error", toJson(refusal.error)}});
  }
}

void Requests::refuse(const Error& error) {
  answers_.send({{"id", nullptr}, {"error", toJson(error)}});
}

void Requests::read(int file) {
  std::string line;
  bool isTooLong = false;
  char bytes[1 << 16];
  while (!answers_.isLost()) {
    // Whether anybody listens is looked at now and then.
    pollfd waiting = {file, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, 200);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t got = ::read(file, bytes, sizeof bytes);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    for (ssize_t i = 0; i < got; ++i) {
      // One request that is too much for this machine is no reason to end.
      try {
        if (bytes[i] == '\n') {
          if (!isTooLong) add(line);
          line.clear(), isTooLong = false;
        } else if (!isTooLong) {
          line.push_back(bytes[i]);
          isTooLong = line.size() > kLongestLine;
          if (isTooLong)
            refuse({ErrorKind::usage, "", 0, "", "a line is longer than 64 MiB",
                    "share memory for what is large"});
        }
      } catch (const std::bad_alloc&) {
        line = std::string();
        isTooLong = bytes[i] != '\n';
        refuse({ErrorKind::usage, "", 0, "", "there is not enough memory for a line", "send less at once"});
      }
    }
  }
  const std::lock_guard lock(mutex_);
  isAtEnd_ = true;
  changed_.notify_one();
}

std::optional<json> Requests::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return isAtEnd_ || !waiting_.empty(); });
  if (waiting_.empty()) return std::nullopt;
  json request = std::move(waiting_.front().request);
  waitingBytes_ -= waiting_.front().bytes;
  waiting_.pop_front();
  return request;
}

bool Requests::isCancelled(int64_t id) const {
  const std::lock_guard lock(mutex_);
  return answers_.isLost() || cancelled_.count(id) > 0;
}

void Requests::done(int64_t id) {
  const std::lock_guard lock(mutex_);
  open_.erase(id), cancelled_.erase(id);
}

}  // namespace scumble::serve
