#include "base/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "base/file_size_signal.h"
#include "base/passing_file.h"

namespace scumble {
namespace {

std::string resolveLinks(const std::string& path) {
  char* resolved = realpath(path.c_str(), nullptr);
  if (!resolved) return path;  // it does not exist yet
  std::string result = resolved;
  free(resolved);
  return result;
}

std::string adviceFor(int code) {
  switch (code) {
    case ENOENT:
    case ENOTDIR:
      return "create the folder first";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place that you may write to";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "make room on the disk or choose another place";
    case EISDIR:
      return "name a file, not a folder";
    case EINVAL:
      return "name an ordinary file";
    default:
      return "choose another place for the output";
  }
}

}  // namespace

WholeFile::WholeFile(const std::string& path)
    : path_(path), target_(resolveLinks(path)), errno_(openPassing()) {}

// Returns 0 or the reason why not.
int WholeFile::openPassing() {
  if (path_.empty()) return ENOENT;
  if (path_.find('\0') != std::string::npos) return EINVAL;
  if (target_.back() == '/') return EISDIR;

  // A rename would silently replace things that a plain open would respect: folders, devices, protected
  // files.
  struct stat old = {};
  const bool exists = stat(target_.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) return EISDIR;
  if (exists && !S_ISREG(old.st_mode)) return EINVAL;
  if (exists && access(target_.c_str(), W_OK) != 0) return errno;

  PassingFile passing = openPassingFile(folderOf(target_));
  if (passing.descriptor < 0) return errno;
  passing_ = std::move(passing.name);
  if (exists && fchmod(passing.descriptor, old.st_mode & 0777) != 0) {
    // Some file systems know no modes; the content matters more.
  }
  file_ = fdopen(passing.descriptor, "wb");
  if (file_) return 0;
  const int code = errno;
  close(passing.descriptor);
  return code;
}

WholeFile::~WholeFile() {
  const FileSizeSignalHeld held;  // closing writes what is left
  if (file_) fclose(file_);
  if (!passing_.empty()) unlink(passing_.c_str());
}

void WholeFile::write(const void* bytes, size_t size) {
  if (!ok() || size == 0) return;
  const FileSizeSignalHeld held;
  errno = 0;
  if (fwrite(bytes, 1, size, file_) != size) return fail(errno);
  position_ += size;
}

void WholeFile::seek(uint64_t position) {
  if (!ok() || position == position_) return;
  const FileSizeSignalHeld held;
  errno = 0;
  if (fseeko(file_, off_t(position), SEEK_SET) != 0) return fail(errno);
  position_ = position;
}

Status WholeFile::commit() {
  if (file_) {
    const FileSizeSignalHeld held;
    // A full disk may show only here, when the last buffer goes out. The second descriptor keeps a file
    // without a name alive.
    const int descriptor = fcntl(fileno(file_), F_DUPFD_CLOEXEC, 0);
    if (descriptor < 0) fail(errno);
    errno = 0;
    if (fclose(file_) != 0) fail(errno);
    file_ = nullptr;
    if (ok()) {
      if (const int code = putInPlace(descriptor, passing_, target_); code != 0) fail(code);
    }
    if (descriptor >= 0) close(descriptor);
  }
  if (ok()) {
    passing_.clear();
    return Done{};
  }
  Error error;
  error.kind = ErrorKind::outputNotWritten;
  error.file = path_;
  error.problem = errno_ == EINVAL ? "cannot be written: it is not an ordinary file"
                                   : "cannot be written: " + std::generic_category().message(errno_);
  error.advice = adviceFor(errno_);
  return error;
}

// Keeps the first failure: later ones are its consequences.
void WholeFile::fail(int code) {
  if (errno_ == 0) errno_ = code != 0 ? code : EIO;
}

}  // namespace scumble
