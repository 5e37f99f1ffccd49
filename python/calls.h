// Calls of the library: results become values or exceptions, and what takes long can be stopped.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "scumble/progress.h"
#include "scumble/result.h"

namespace scumble_python {

namespace py = pybind11;

// What a call takes where it takes a file: a text or anything with __fspath__.
using Path = std::filesystem::path;

// The class of scumble/_errors.py that belongs to the error's kind.
[[noreturn]] void raise(const scumble::Error& error);
[[noreturn]] void raiseUsage(const std::string& problem, const std::string& advice = "");

template <class T>
T valueOf(scumble::Result<T> result) {
  if (!result) raise(result.error());
  return std::move(result).value();
}
inline void done(const scumble::Status& status) {
  if (!status) raise(status.error());
}

// What an argument is; one of another type raises UsageError, which says `name` and what to give.
std::string kindOf(bool), kindOf(double), kindOf(float), kindOf(int), kindOf(uint32_t),
    kindOf(const std::string&);
[[noreturn]] void refuse(const py::handle& value, const std::string& name, const std::string& kind);
template <class T>
T as(const py::handle& value, const std::string& name, const std::string& kind = kindOf(T())) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    refuse(value, name, kind);
  }
}
// Which of some words it is.
size_t wordOf(const py::handle& value, const std::string& name, const std::vector<std::string>& words);

// A call that the interpreter's end waits for. From then on, calls of other threads than the one that ends it
// end their thread (SystemExit): daemons may be drawing.
class Running {
 public:
  Running();
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  static void addTo(py::module_& module);  // what waits
};

// What a call gives while other threads run Python.
template <class Call>
auto withoutGil(Call call) {
  const Running running;
  const py::gil_scoped_release released;
  return call();
}

// Something that one thread at a time uses, in the process that made it. It is left to itself in a child of
// fork(), where its threads are not.
template <class T>
class Single {
 public:
  explicit Single(std::unique_ptr<T> held) : held_(std::move(held)) {}
  ~Single() {
    if (process_ != getpid()) held_.release();
  }
  Single(const Single&) = delete;
  Single& operator=(const Single&) = delete;

  // Raises where somebody else has it.
  class Turn {
   public:
    explicit Turn(Single& single) : single_(single) {
      if (single.process_ != getpid())
        raiseUsage("it was made before the process forked", "make another one here");
      if (single.isTaken_.exchange(true)) raiseUsage("another call is using it", "wait for that to end");
    }
    ~Turn() { single_.isTaken_ = false; }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    T* operator->() const { return single_.held_.get(); }
    T& operator*() const { return *single_.held_; }

   private:
    Single& single_;
  };
  Turn turn() { return Turn(*this); }

 private:
  std::unique_ptr<T> held_;
  std::atomic<bool> isTaken_ = false;
  pid_t process_ = getpid();
};

// Runs `call` on a thread of its own and without the GIL. This one meanwhile looks out for Ctrl+C, and tells
// `progress` (None, or a callable that takes the part that is done and may return False or raise to stop).
void runWatched(const std::function<void(const scumble::Progress&)>& call, const py::object& progress);

// The same with a result: Result<T> call(const Progress&).
template <class Call>
auto runLong(const py::object& progress, Call call) {
  using Outcome = std::invoke_result_t<Call, const scumble::Progress&>;
  std::optional<Outcome> outcome;
  runWatched([&](const scumble::Progress& part) { outcome.emplace(call(part)); }, progress);
  return valueOf(std::move(*outcome));
}

}  // namespace scumble_python
