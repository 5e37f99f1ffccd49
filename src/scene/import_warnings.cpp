#include "scene/import_warnings.h"

namespace scumble::scene {

namespace {
// Texts quote names from the file; a hostile one could hold any number of them.
constexpr size_t kMaxKinds = 100;
constexpr size_t kMaxLength = 400;
}  // namespace

void ImportWarnings::add(const std::string& jsonPath, const std::string& text) {
  addCounted(jsonPath, text, 1);
}

void ImportWarnings::addCounted(const std::string& jsonPath, const std::string& text, size_t count) {
  const auto found = byText_.find(text);
  if (found != byText_.end()) {
    entries_[found->second].count += count;
    return;
  }
  if (entries_.size() >= kMaxKinds) {
    leftOut_ += count;
    return;
  }
  byText_.emplace(text, entries_.size());
  entries_.push_back({jsonPath, text, count});
}

void ImportWarnings::merge(const ImportWarnings& other) {
  for (const Entry& entry : other.entries_) addCounted(entry.path, entry.text, entry.count);
  leftOut_ += other.leftOut_;
}

std::vector<std::string> ImportWarnings::lines(const std::string& file) const {
  std::vector<std::string> lines;
  for (const Entry& entry : entries_) {
    std::string line = file;
    if (!entry.path.empty()) line.append(" (").append(entry.path, 0, kMaxLength).append(")");
    line.append(": ").append(entry.text, 0, kMaxLength);
    if (entry.count > 1)
      line.append(" (and ").append(std::to_string(entry.count - 1)).append(" more like it)");
    for (char& c : line)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    lines.push_back(std::move(line));
  }
  if (leftOut_ > 0) lines.push_back(file + ": " + std::to_string(leftOut_) + " more warnings");
  return lines;
}

}  // namespace scumble::scene
