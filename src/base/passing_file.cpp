#include "base/passing_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>

namespace scumble {
namespace {

// Calls use(name) with passing names until one is not taken. Names are short (the target's may already be as
// long as a name can be), and unique over threads and processes; a name that is taken is one that a killed
// process with our id has left.
template <class Use>
std::string withPassingName(const std::string& folder, const Use& use) {
  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::string name =
        folder + ".scumble-" + std::to_string(getpid()) + "-" + std::to_string(counter.fetch_add(1)) + ".tmp";
    if (use(name)) return name;
    if (errno != EEXIST) break;
  }
  return "";
}

// How linkat finds a file without a name. (AT_EMPTY_PATH would need a privilege.)
std::string pathOfDescriptor(int descriptor) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

}  // namespace

std::string folderOf(const std::string& path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

PassingFile openPassingFile(const std::string& folder) {
  PassingFile file;
#ifdef O_TMPFILE
  file.descriptor = open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
  if (file.descriptor >= 0) {
    // Without /proc it could never get a name.
    if (access(pathOfDescriptor(file.descriptor).c_str(), F_OK) == 0) return file;
    close(file.descriptor);
  }
#endif
  file.name = withPassingName(folder, [&](const std::string& name) {
    file.descriptor = open(name.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
    return file.descriptor >= 0;
  });
  return file;
}

int putInPlace(int descriptor, const std::string& passingName, const std::string& target) {
  if (!passingName.empty()) return rename(passingName.c_str(), target.c_str()) == 0 ? 0 : errno;
  const std::string from = pathOfDescriptor(descriptor);
  const auto linkAs = [&](const std::string& name) {
    return linkat(AT_FDCWD, from.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
  };
  if (linkAs(target)) return 0;
  if (errno != EEXIST) return errno;
  // A link cannot replace a file; a rename can, but needs a name to begin with.
  const std::string name = withPassingName(folderOf(target), linkAs);
  if (name.empty()) return errno;
  if (rename(name.c_str(), target.c_str()) == 0) return 0;
  const int code = errno;
  unlink(name.c_str());
  return code;
}

}  // namespace scumble
