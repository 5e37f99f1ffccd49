// Calls of the library: results become values or exceptions, and what takes long can be stopped.
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

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
