// A file that another one is written to before it takes its place. Where the file system can (Linux:
// O_TMPFILE), it has no name until then, so that not even a killed process leaves it behind.
#pragma once

#include <string>

namespace scumble {

// The part of a path up to its last slash, with the slash; empty where it has none.
std::string folderOf(const std::string& path);

struct PassingFile {
  int descriptor = -1;  // open for reading and writing; the owner closes it
  std::string name;     // empty while it has none
};

// Opens one in `folder`, as folderOf gives it. Where that fails, the descriptor is -1 and errno says why.
PassingFile openPassingFile(const std::string& folder);

// Gives the file its name, replacing what is there. `descriptor` may be any that is open for it. Returns 0 or
// the reason why not; a file with a passing name keeps it then, and one without stays without.
int putInPlace(int descriptor, const std::string& passingName, const std::string& target);

}  // namespace scumble
