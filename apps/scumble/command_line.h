// The words of the command line: what the parser is given, and what is said of those that it refuses.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "scumble/result.h"

namespace scumble::app {

// The words as the parser takes them. `--json` prints, and writes where a name follows that is no scene's:
// the parser itself would take the scene that follows for a file.
std::vector<std::string> wordsOf(int argc, char** argv);

// For all options of all commands, once they are there: an empty value is a slip, e.g. of a script whose
// variable is not set, and so is one for an option that takes none.
void refuseSlips(CLI::App& program);

// What is wrong with words that the parser has refused.
Error wrongWords(const CLI::App& program, const CLI::ParseError& error);

}  // namespace scumble::app
