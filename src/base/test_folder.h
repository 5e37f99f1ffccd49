// A folder of its own for a test that writes files; removed at the end.
#pragma once

#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/passing_file.h"

namespace scumble {

inline std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void putContent(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

class TestFolder {
 public:
  TestFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "scumble test XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::string path() const { return path_.string(); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  // Writes a file, in folders of its own where `name` has slashes, and gives its path.
  std::string put(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    putContent(file(name), bytes);
    return file(name);
  }
  // Of what lies in it, or in a folder in it.
  size_t count(const std::string& name = "") const {
    return size_t(std::distance(std::filesystem::directory_iterator(path_ / name),
                                std::filesystem::directory_iterator()));
  }

  // Whether files here can be without a name. Elsewhere a killed process leaves one.
  bool hasNamelessFiles() const {
    const PassingFile passing = openPassingFile(file(""));
    close(passing.descriptor);
    if (!passing.name.empty()) unlink(passing.name.c_str());
    return passing.name.empty();
  }

 private:
  std::filesystem::path path_;
};

}  // namespace scumble
