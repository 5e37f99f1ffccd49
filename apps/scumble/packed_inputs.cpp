#include "packed_inputs.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "programs.h"

namespace scumble::app {

namespace fs = std::filesystem;

namespace {

// As it is spelt, without "..": what a scene names beside itself is found by such names on the nodes too.
// Where a folder on the way is a link, another file may have that name here: contents are taken from `file`
// itself.
fs::path spelt(const std::string& file) {
  return fs::absolute(file).lexically_normal();
}

fs::path commonFolder(const fs::path& a, const fs::path& b) {
  fs::path common;
  for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end() && *x == *y; ++x, ++y) common /= *x;
  return common;
}

}  // namespace

Result<PackedInputs> PackedInputs::of(const std::vector<std::string>& files) {
  PackedInputs inputs;
  inputs.here_ = fs::current_path();
  fs::path root = inputs.here_;
  for (const std::string& file : files) root = commonFolder(root, spelt(file).parent_path());
  inputs.inside_ = inputs.here_.lexically_relative(root).string();
  std::error_code ignored;
  for (const std::string& file : files) {
    const auto [place, isNew] =
        inputs.files_.try_emplace(spelt(file).lexically_relative(root).string(), fs::absolute(file));
    if (!isNew && !fs::equivalent(place->second, file, ignored))
      return Error{ErrorKind::usage,
                   file,
                   0,
                   "",
                   "another input has the same name once '..' is taken out, since a folder is a link",
                   "name it without '..'"};
  }
  return inputs;
}

std::string PackedInputs::fromInside(const std::string& file) const {
  const std::string path = spelt(file).lexically_relative(here_).string();
  return path.starts_with('-') ? "./" + path : path;
}

std::vector<std::string> PackedInputs::files() const {
  std::vector<std::string> places;
  for (const auto& [place, file] : files_) places.push_back(place);
  return places;
}

uint64_t PackedInputs::bytes() const {
  uint64_t bytes = 0;
  std::error_code problem;
  for (const auto& [place, file] : files_)
    if (const uint64_t size = fs::file_size(file, problem); !problem) bytes += size;
  return bytes;
}

Result<std::string> PackedInputs::pack(const std::string& folder) const {
  // A tree of links of its own, so that two calls into one folder do not meet.
  std::string passing = (fs::path(folder) / "inputs.XXXXXX").string();
  const auto failed = [&](const std::string& problem) {
    return Error{ErrorKind::outputNotWritten, folder, 0, "", problem, "choose another folder"};
  };
  if (!mkdtemp(passing.data())) return failed(std::string("cannot be written: ") + std::strerror(errno));
  struct Remover {
    std::string path;
    ~Remover() {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
  } const remover{passing};
  const fs::path tree = fs::path(passing) / "tree", packed = fs::path(passing) / "packed";
  std::error_code problem;
  for (const auto& [place, file] : files_) {
    fs::create_directories((tree / place).parent_path(), problem);
    if (!problem) fs::create_symlink(file, tree / place, problem);
    if (problem) return failed(problem.message());
  }
  const Result<std::string> said =
      outputOf({"tar", "--create", "--file=" + packed.string(), "--dereference", "--sort=name", "--mtime=@0",
                "--owner=0", "--group=0", "--numeric-owner", "--mode=u+rwX,go+rX",
                "--directory=" + tree.string(), "."});
  if (!said) return said.error();
  const Result<std::string> sum = outputOf({"sha256sum", "--", packed.string()});
  if (!sum) return sum.error();
  // The sum of a name with a backslash begins with one.
  const size_t first = sum->starts_with('\\') ? 1 : 0;
  constexpr size_t kDigits = 16;
  const std::string name = "inputs." + sum->substr(first, kDigits) + ".tar";
  fs::rename(packed, fs::path(folder) / name, problem);
  if (problem) return failed(problem.message());
  return name;
}

}  // namespace scumble::app
