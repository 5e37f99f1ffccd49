// Other programs: their command lines, and what they print.
#pragma once

#include <string>
#include <vector>

#include "scumble/result.h"

namespace scumble::app {

// As a POSIX shell takes them: words with anything but letters, digits and a few signs in quotes.
std::string shellWord(const std::string& word);
std::string shellWords(const std::vector<std::string>& words);

bool isOnPath(const std::string& program);

// What a program prints on standard output; what it says on standard error goes where ours goes, or nowhere.
// Fails with outputNotWritten, and the program's name, where it cannot be run or ends with a code other
// than 0.
enum class Complaints { shown, hidden };
Result<std::string> outputOf(const std::vector<std::string>& words,
                             Complaints complaints = Complaints::shown);

}  // namespace scumble::app
