// How the program speaks: one line for an error, warnings once, and the exit codes that scripts rely on.
#pragma once

#include <string>
#include <vector>

#include "scumble/result.h"

namespace scumble::app {

enum ExitCode { kDone = 0, kOurFault = 1, kWrongUsage = 2, kUnusableFile = 3, kNoGpu = 4, kNotWritten = 5 };

// A call that makes no sense.
Error usage(std::string problem, std::string advice);

// "did you mean 'render'?", or `otherwise` where nothing is near.
std::string suggestion(const std::string& word, const std::vector<std::string>& known,
                       const std::string& otherwise);

// "scumble: error: ..." on stderr; returns the exit code of the error's kind.
int fail(const Error& error);
int failUsage(const std::string& problem, const std::string& advice);

void warn(const std::vector<std::string>& warnings);

}  // namespace scumble::app
