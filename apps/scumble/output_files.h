// The files that a call writes. Before long work begins: each can be written, only an ordinary file is ever
// replaced, and none is an input or another output of the same call, however it is spelt.
#pragma once

#include <string>
#include <vector>

#include "scumble/result.h"

namespace scumble::app {

class OutputFiles {
 public:
  explicit OutputFiles(std::vector<std::string> inputs) : inputs_(std::move(inputs)) {}

  // `what` says in messages what it holds, e.g. "--stats". An empty path: none is wanted. Fails with usage
  // for a second output of one name, and with outputNotWritten.
  Status add(const std::string& path, const std::string& what);
  // The same for one of many files, like a sequence's, which are known to differ from each other.
  Status check(const std::string& path, const std::string& what) const;
  // Inputs that were found out later, e.g. a scene's pictures. Fails like add().
  Status addInputs(const std::vector<std::string>& files);

 private:
  struct Added {
    std::string path, file, what;
  };
  std::vector<std::string> inputs_;
  std::vector<Added> added_;
};

}  // namespace scumble::app
