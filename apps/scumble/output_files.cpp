#include "output_files.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace scumble::app {

namespace fs = std::filesystem;

namespace {

// The same for every spelling of a file's name; links lead to what writers would replace.
std::string identityOf(const std::string& path) {
  std::error_code ignored;
  const fs::path known = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  return known.empty() ? path : known.string();
}

Status checkWritable(const std::string& path, const std::vector<std::string>& inputs) {
  const auto fail = [&](std::string problem, std::string advice) {
    return Error{ErrorKind::outputNotWritten, path, 0, "", std::move(problem), std::move(advice)};
  };
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return fail("the folder does not exist", "make it first");
  if (access(folder.c_str(), W_OK) != 0)
    return fail(std::string("the folder cannot be written: ") + std::strerror(errno), "choose another one");
  if (fs::is_directory(path, ignored)) return fail("this is a folder", "give a file's name");
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
    return fail("it is not an ordinary file", "give another name");
  if (fs::exists(path, ignored) && access(path.c_str(), W_OK) != 0)
    return fail(std::string("the file cannot be written: ") + std::strerror(errno), "choose another name");
  for (const std::string& input : inputs)
    if (fs::equivalent(path, input, ignored)) return fail("this is one of the inputs", "give another name");
  return Done{};
}

}  // namespace

Status OutputFiles::check(const std::string& path, const std::string& what) const {
  if (path.empty()) return Done{};
  if (const Status status = checkWritable(path, inputs_); !status) return status;
  if (added_.empty()) return Done{};
  const std::string file = identityOf(path);
  for (const Added& other : added_)
    if (other.file == file)
      return Error{ErrorKind::usage,
                   path,
                   0,
                   "",
                   "two outputs would go there, " + other.what + " and " + what,
                   "give them different names"};
  return Done{};
}

Status OutputFiles::add(const std::string& path, const std::string& what) {
  if (path.empty()) return Done{};
  if (const Status status = check(path, what); !status) return status;
  added_.push_back({identityOf(path), what});
  return Done{};
}

}  // namespace scumble::app
