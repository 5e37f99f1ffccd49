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
  // Names of files are bytes, and come back as Python has them.
  const auto text = [](const std::string& bytes) {
    return py::reinterpret_steal<py::str>(
        PyUnicode_DecodeUTF8(bytes.data(), Py_ssize_t(bytes.size()), "surrogateescape"));
  };
  const py::object type = py::module_::import("scumble._errors").attr(name);
  const py::object instance = type(text(error.message()), text(error.file), error.line, text(error.jsonPath),
                                   text(error.problem), text(error.advice));
  PyErr_SetObject(type.ptr(), instance.ptr());
  throw py::error_already_set();
}

void raiseUsage(const std::string& problem, const std::string& advice) {
  raise({ErrorKind::usage, "", 0, "", problem, advice});
}

std::string kindOf(bool) {
  return "True or False";
}
std::string kindOf(double) {
  return "a number";
}
std::string kindOf(float) {
  return "a number";
}
std::string kindOf(int) {
  return "a whole number";
}
std::string kindOf(uint32_t) {
  return "a whole number from 0 on";
}
std::string kindOf(const std::string&) {
  return "a text";
}

void refuse(const py::handle& value, const std::string& name, const std::string& kind) {
  constexpr size_t kMostLetters = 60;
  std::string shown = py::repr(value);
  if (shown.size() > kMostLetters) shown = py::str(py::type::handle_of(value));
  raiseUsage(name + " cannot be " + shown, "give " + kind);
}

size_t wordOf(const py::handle& value, const std::string& name, const std::vector<std::string>& words) {
  std::string all;
  for (size_t i = 0; i < words.size(); ++i) {
    if (py::isinstance<py::str>(value) && value.cast<std::string>() == words[i]) return i;
    all += (i == 0 ? "'" : i + 1 < words.size() ? ", '" : " or '") + words[i] + "'";
  }
  refuse(value, name, all);
}

namespace {

std::atomic<int> running = 0;
std::atomic<bool> isEnding = false;
std::thread::id endingThread;

void refuseAtTheEnd() {
  if (!isEnding || std::this_thread::get_id() == endingThread) return;
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

}  // namespace

Running::Running() {
  refuseAtTheEnd();
  ++running;
}
Running::~Running() {
  --running;
}
void Running::addTo(py::module_& module) {
  module.def("_end", [] {
    endingThread = std::this_thread::get_id();
    isEnding = true;
    const py::gil_scoped_release released;
    while (running > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  py::module_::import("atexit").attr("register")(module.attr("_end"));
}

namespace {

// True and everything that is no truth value go on.
bool saysStop(const py::handle& answer) {
  const bool isTruth =
      PyBool_Check(answer.ptr()) || py::isinstance(answer, py::module_::import("numpy").attr("bool_"));
  return isTruth && PyObject_IsTrue(answer.ptr()) == 0;
}

}  // namespace

void runWatched(const std::function<void(const Progress&)>& call, const py::object& progress) {
  const Running counted;
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
    if (isEnding) stops = true;
    if (stops) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (const double now = part; !progress.is_none() && now > told) {
        told = now;
        if (saysStop(progress(now))) stops = true;
      }
    } catch (...) {
      stoppedBy = std::current_exception();
      stops = true;
    }
  }
  worker.join();
  if (stops) refuseAtTheEnd();
  if (stoppedBy) std::rethrow_exception(stoppedBy);
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace scumble_python
