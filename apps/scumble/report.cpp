#include "report.h"

#include <cstdio>

#include "scumble/nearest.h"

namespace scumble::app {

Error usage(std::string problem, std::string advice) {
  return {ErrorKind::usage, "", 0, "", std::move(problem), std::move(advice)};
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known,
                       const std::string& otherwise) {
  const std::string meant = nearest(word, known);
  return meant.empty() ? otherwise : "did you mean '" + meant + "'?";
}

int fail(const Error& error) {
  std::fprintf(stderr, "scumble: error: %s\n", error.message().c_str());
  switch (error.kind) {
    case ErrorKind::usage:
      return kWrongUsage;
    case ErrorKind::unusableFile:
      return kUnusableFile;
    case ErrorKind::noUsableGpu:
      return kNoGpu;
    case ErrorKind::outputNotWritten:
      return kNotWritten;
    case ErrorKind::internal:
    case ErrorKind::cancelled:  // the program cancels nothing
      break;
  }
  return kOurFault;
}

int failUsage(const std::string& problem, const std::string& advice) {
  return fail(Error{ErrorKind::usage, "", 0, "", problem, advice});
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::fprintf(stderr, "scumble: warning: %s\n", warning.c_str());
}

}  // namespace scumble::app
