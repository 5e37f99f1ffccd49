#include "calls.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

using namespace scumble;

namespace scumble_python {

void raise(const Error& error) {
  const char* name = "InternalError";
  switch (error.kind) {
    case ErrorKind::internal:
      break;
    case ErrorKind::usage:
      name = "UsageError";
      break;
    case ErrorKind::unusableFile:
      name = "UnusableFile";
      break;
    case ErrorKind::noUsableGpu:
      name = "NoUsableGpu";
      break;
    case ErrorKind::outputNotWritten:
      name = "OutputNotWritten";
      break;
    case ErrorKind::cancelled:
      name = "Cancelled";
      break;
  }
  const py::object type = py::module_::import("scumble._errors").attr(name);
  const py::object instance =
      type(error.message(), error.file, error.line, error.jsonPath, error.problem, error.advice);
  PyErr_SetObject(type.ptr(), instance.ptr());
  throw py::error_already_set();
}

void raiseUsage(const std::string& problem, const std::string& advice) {
  raise({ErrorKind::usage, "", 0, "", problem, advice});
}

void runWatched(const std::function<void(const Progress&)>& call, const py::object& progress) {
  std::mutex mutex;
  std::condition_variable ended;
  bool hasEnded = false;
  std::atomic<bool> stops = false;
  std::atomic<double> part = 0;
  std::exception_ptr thrown, stoppedBy;

  std::thread worker([&] {
    try {
      call([&](double now) {
        part = now;
        return !stops;
      });
    } catch (...) {
      thrown = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    hasEnded = true;
    ended.notify_one();
  });

  double told = -1;
  for (bool isOver = false; !isOver;) {
    {
      const py::gil_scoped_release released;
      std::unique_lock lock(mutex);
      isOver = ended.wait_for(lock, std::chrono::milliseconds(50), [&] { return hasEnded; });
    }
    if (stops) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (const double now = part; !progress.is_none() && now > told) {
        told = now;
        const py::object goesOn = progress(now);
        if (!goesOn.is_none() && !py::cast<bool>(goesOn)) stops = true;
      }
    } catch (...) {
      stoppedBy = std::current_exception();
      stops = true;
    }
  }
  worker.join();
  if (stoppedBy) std::rethrow_exception(stoppedBy);
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace scumble_python
