// Errors as values. Nothing in libscumble throws across its public face: whatever a user gave us and
// that cannot be used comes back as an Error that says where it is, what is wrong and what to do. Results are
// values: each thread has its own.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "scumble/export.h"

namespace scumble {

// Whose fault an error is. The program turns each kind into its own exit code.
enum class ErrorKind {
  internal,          // our own fault
  usage,             // a call or command line that makes no sense
  unusableFile,      // a file that was given cannot be used
  noUsableGpu,       // no device fulfils the requirements, or it was lost
  outputNotWritten,  // the output cannot be written
  cancelled          // the caller wanted it to stop
};

struct SCUMBLE_API Error {
  ErrorKind kind = ErrorKind::internal;
  std::string file;      // the file concerned, as the user named it; empty when there is none
  int line = 0;          // 1-based line in `file`; 0 when unknown
  std::string jsonPath;  // e.g. "meshes[0].primitives[1].attributes.POSITION"; empty when there is none
  std::string problem;   // what is wrong, without a full stop
  std::string advice;    // what to do about it; may be empty

  // "FILE[:LINE][ (JSON path)]: what is wrong; what to do", always a single line.
  std::string message() const;
};

// Either a value or an Error.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  // The value; only when ok().
  T& value() & { return std::get<0>(state_); }
  const T& value() const& { return std::get<0>(state_); }
  T&& value() && { return std::get<0>(std::move(state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  // The error; only when not ok().
  const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

// Success carries nothing.
struct Done {};
using Status = Result<Done>;

}  // namespace scumble
