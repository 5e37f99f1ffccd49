// --json, which all commands that tell something have: alone it prints the report as JSON in place of the
// text, and with a file's name it writes the report there.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "scumble/result.h"

namespace scumble::app {

struct JsonOption {
  static constexpr const char* kPrinted = "-";
  // Whether a word that follows the option is its file: it is neither an option nor named like a scene or a
  // picture.
  static bool isFile(const std::string& word);

  void addTo(CLI::App& command);
  bool isPrinted() const { return value_ == kPrinted; }
  // Where it is written; empty: nowhere.
  std::string file() const { return isPrinted() ? "" : value_; }
  // Prints or writes the report, where it is wanted.
  Status give(const nlohmann::json& report) const;

 private:
  std::string value_;
};

// A report's text. Names that are not UTF-8 show what could be read of them.
std::string textOf(const nlohmann::json& report);

}  // namespace scumble::app
