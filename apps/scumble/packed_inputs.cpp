#include "packed_inputs.h"

#include <algorithm>

#include "programs.h"
#include "scumble/image.h"

namespace scumble::app {

namespace fs = std::filesystem;

namespace {

// Links in it stay: what a scene names beside itself lies beside the link.
fs::path wholePath(const std::string& file) {
  return fs::absolute(file).lexically_normal();
}

fs::path commonFolder(const fs::path& a, const fs::path& b) {
  fs::path common;
  for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end() && *x == *y; ++x, ++y) common /= *x;
  return common;
}

}  // namespace

PackedInputs::PackedInputs(const std::vector<std::string>& files) : here_(fs::current_path()), root_(here_) {
  for (const std::string& file : files) root_ = commonFolder(root_, wholePath(file).parent_path());
  inside_ = here_.lexically_relative(root_).string();
  for (const std::string& file : files) files_.push_back(wholePath(file).lexically_relative(root_).string());
  std::sort(files_.begin(), files_.end());
  files_.erase(std::unique(files_.begin(), files_.end()), files_.end());
}

std::string PackedInputs::fromInside(const std::string& file) const {
  const std::string path = wholePath(file).lexically_relative(here_).string();
  return path.starts_with('-') ? "./" + path : path;
}

uint64_t PackedInputs::bytes() const {
  uint64_t bytes = 0;
  std::error_code ignored;
  for (const std::string& file : files_)
    if (const uint64_t size = fs::file_size(root_ / file, ignored); !ignored) bytes += size;
  return bytes;
}

Result<std::string> PackedInputs::pack(const std::string& folder) const {
  const fs::path list = fs::path(folder) / "inputs.list", packed = fs::path(folder) / "inputs.part";
  std::string names;
  for (const std::string& file : files_) names += file + '\0';
  if (const Status written = writeText(list.string(), names); !written) return written.error();
  const Result<std::string> said =
      outputOf({"tar", "--create", "--file=" + packed.string(), "--dereference", "--mtime=@0", "--owner=0",
                "--group=0", "--numeric-owner", "--no-recursion", "--directory=" + root_.string(), "--null",
                "--verbatim-files-from", "--files-from=" + list.string()});
  std::error_code problem;
  fs::remove(list, problem);
  if (!said) return said.error();
  const Result<std::string> sum = outputOf({"sha256sum", "--", packed.string()});
  if (!sum) return sum.error();
  // The sum of a name with a backslash begins with one.
  const size_t first = sum->starts_with('\\') ? 1 : 0;
  constexpr size_t kDigits = 16;
  const std::string name = "inputs." + sum->substr(first, kDigits) + ".tar";
  fs::rename(packed, fs::path(folder) / name, problem);
  if (problem)
    return Error{ErrorKind::outputNotWritten, folder, 0, "", problem.message(), "choose another folder"};
  return name;
}

}  // namespace scumble::app
