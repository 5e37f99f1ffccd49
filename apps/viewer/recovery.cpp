#include "recovery.h"

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "look_text.h"
#include "scumble/image.h"

namespace scumble::viewer {

namespace {

std::vector<std::string> whole(const std::vector<std::string>& files) {
  std::vector<std::string> paths;
  for (const std::string& file : files) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
    paths.push_back(error ? file : path.string());
  }
  return paths;
}

// FNV-1a: the same in every run, which std::hash need not be.
std::string numberOf(const std::vector<std::string>& texts) {
  uint64_t hash = 14695981039346656037u;
  for (const std::string& text : texts)
    for (const char c : text + '\0') hash = (hash ^ uint8_t(c)) * 1099511628211u;
  constexpr char kDigits[] = "0123456789abcdef";
  std::string number;
  for (int digit = 60; digit >= 0; digit -= 4) number += kDigits[(hash >> digit) & 15];
  return number;
}

std::string printed(const nlohmann::json& json) {
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string textOfTime(int64_t seconds) {
  const auto time = std::time_t(seconds);
  std::tm parts{};
  localtime_r(&time, &parts);
  char text[64];
  return {text, std::strftime(text, sizeof text, "%H:%M on %e %B", &parts)};
}

}  // namespace

std::string Recovery::fileOf(const std::vector<std::string>& scenes) const {
  return folder_ + "/unsaved-" + numberOf(whole(scenes)) + ".json";
}

Status Recovery::keep(const std::vector<std::string>& scenes, const std::string& look,
                      const Edits& edits) const {
  if (folder_.empty()) return Done{};
  const std::string file = fileOf(scenes);
  std::error_code error;
  if (edits.empty()) {
    std::filesystem::remove(file, error);
    return Done{};
  }
  std::filesystem::create_directories(folder_, error);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const nlohmann::json kept{{"scenes", whole(scenes)},
                            {"look", isLookFile(look) ? whole({look})[0] : look},
                            {"edits", edits},
                            {"seconds", std::chrono::duration_cast<std::chrono::seconds>(now).count()}};
  return writeText(file, printed(kept) + "\n");
}

std::optional<Recovery::Kept> Recovery::find(const std::vector<std::string>& scenes) const {
  if (folder_.empty()) return std::nullopt;
  std::ifstream in(fileOf(scenes));
  const nlohmann::json found = nlohmann::json::parse(in, nullptr, false);
  try {
    // As it was written: names that are not UTF-8 lose something there.
    if (printed(found.at("scenes")) != printed(whole(scenes))) return std::nullopt;
    Kept kept{found.at("look").get<std::string>(), found.at("edits").get<Edits>(),
              textOfTime(found.at("seconds").get<int64_t>())};
    if (kept.edits.empty()) return std::nullopt;
    return kept;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace scumble::viewer
