#include "json_option.h"

#include <cstdio>

#include "options.h"
#include "scumble/image.h"

namespace scumble::app {

bool JsonOption::isFile(const std::string& word) {
  const std::string ending = endingOf(word);
  for (const char* input : {".glb", ".gltf", ".png", ".jpg", ".jpeg", ".webp", ".exr"})
    if (ending == input) return false;
  return !word.starts_with('-');
}

void JsonOption::addTo(CLI::App& command) {
  command.add_option("--json", value_, "Print JSON in place of the text; with a name, write it there")
      ->type_name("[FILE]");
}

Status JsonOption::give(const nlohmann::json& report) const {
  if (value_.empty()) return Done{};
  if (!isPrinted()) return writeText(value_, textOf(report));
  std::fputs(textOf(report).c_str(), stdout);
  return Done{};
}

std::string textOf(const nlohmann::json& report) {
  return report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace scumble::app
