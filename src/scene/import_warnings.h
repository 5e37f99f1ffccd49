// What was ignored or replaced while a file was read: each kind once, with the first place where it happened.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

namespace scumble::scene {

class ImportWarnings {
 public:
  // `text` names the kind; equal texts are one warning with a count.
  void add(const std::string& jsonPath, const std::string& text);

  // Appends what another list holds. Tasks on several threads write lists of their own, which are merged in
  // the file's order, so that the result does not depend on the threads.
  void merge(const ImportWarnings& other);

  // "FILE (JSON path): what (and N more like it)", each a single line.
  std::vector<std::string> lines(const std::string& file) const;

 private:
  struct Entry {
    std::string path, text;
    size_t count = 0;
  };
  void addCounted(const std::string& jsonPath, const std::string& text, size_t count);

  std::vector<Entry> entries_;
  std::unordered_map<std::string, size_t> byText_;
  size_t leftOut_ = 0;
};

}  // namespace scumble::scene
