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

Error notWritten(const std::string& path, std::string problem, std::string advice) {
  return {ErrorKind::outputNotWritten, path, 0, "", std::move(problem), std::move(advice)};
}

Status checkInputs(const std::string& path, const std::vector<std::string>& inputs) {
  std::error_code ignored;
  for (const std::string& input : inputs)
    if (fs::equivalent(path, input, ignored))
      return notWritten(path, "this is one of the inputs", "give another name");
  return Done{};
}

Status checkWritable(const std::string& path) {
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    return notWritten(path, "the folder does not exist", "make it first");
  if (access(folder.c_str(), W_OK) != 0)
    return notWritten(path, std::string("the folder cannot be written: ") + std::strerror(errno),
                      "choose another one");
  if (fs::is_directory(path, ignored)) return notWritten(path, "this is a folder", "give a file's name");
  if (!fs::exists(path, ignored)) return Done{};
  if (!fs::is_regular_file(path, ignored))
    return notWritten(path, "it is not an ordinary file", "give another name");
  if (access(path.c_str(), W_OK) != 0)
    return notWritten(path, std::string("the file cannot be written: ") + std::strerror(errno),
                      "choose another name");
  return Done{};
}

}  // namespace

Status OutputFiles::check(const std::string& path, const std::string& what) const {
  if (path.empty()) return Done{};
  if (Status status = checkWritable(path); !status) return status;
  if (Status status = checkInputs(path, inputs_); !status) return status;
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
  if (Status status = check(path, what); !status) return status;
  added_.push_back({path, identityOf(path), what});
  return Done{};
}

Status OutputFiles::addInputs(const std::vector<std::string>& files) {
  for (const Added& output : added_)
    if (Status status = checkInputs(output.path, files); !status) return status;
  inputs_.insert(inputs_.end(), files.begin(), files.end());
  return Done{};
}

}  // namespace scumble::app
