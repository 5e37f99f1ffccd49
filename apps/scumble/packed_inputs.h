// The files that a call reads, in one archive, in which they lie to each other and to the folder of the call
// as they do here: so that the same call, made inside of what is unpacked, reads the same.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scumble/result.h"

namespace scumble::app {

class PackedInputs {
 public:
  // Fails with usage where two of them would lie in one place, which links and ".." can bring about.
  static Result<PackedInputs> of(const std::vector<std::string>& files);

  // The folder in it where the call is made, and an input as it is called there.
  std::string inside() const { return inside_; }
  std::string fromInside(const std::string& file) const;

  // Their places, each once, in order.
  std::vector<std::string> files() const;
  uint64_t bytes() const;

  // Packs them, by the program tar; the same files give the same bytes, and the archive's name says which.
  // Gives the name. Fails with outputNotWritten.
  Result<std::string> pack(const std::string& folder) const;

 private:
  PackedInputs() = default;
  std::filesystem::path here_;
  std::string inside_;
  std::map<std::string, std::filesystem::path> files_;  // by their places in the archive
};

}  // namespace scumble::app
