// Knobs that were turned and are saved nowhere, kept in files of the window's own, so that they outlive it
// however it ends.
#pragma once

#include <optional>
#include <string>

#include "document.h"

namespace scumble::viewer {

class Recovery {
 public:
  // `folder`: where they are kept; empty: nowhere.
  explicit Recovery(std::string folder) : folder_(std::move(folder)) {}

  struct Kept {
    std::string look;  // that they were turned on, by name or whole path
    Edits edits;
    std::string when;  // "14:32 on 26 November", local time
  };
  // Of these scenes, until something else is; no edits: nothing any more. `look`: by name or file. Fails with
  // outputNotWritten.
  Status keep(const std::vector<std::string>& scenes, const std::string& look, const Edits& edits) const;
  // What is damaged counts as nothing.
  std::optional<Kept> find(const std::vector<std::string>& scenes) const;

 private:
  std::string fileOf(const std::vector<std::string>& scenes) const;

  std::string folder_;
};

}  // namespace scumble::viewer
