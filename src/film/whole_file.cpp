#include "film/whole_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace scumble::film {
namespace {

std::string folderOf(const std::string& path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

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
  if (target_.empty()) return ENOENT;
  if (target_.back() == '/') return EISDIR;

  // A rename would silently replace things that a plain open would respect: folders, devices, protected
  // files.
  struct stat old = {};
  const bool exists = stat(target_.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) return EISDIR;
  if (exists && !S_ISREG(old.st_mode)) return EINVAL;
  if (exists && access(target_.c_str(), W_OK) != 0) return errno;

  // The passing name is short (the target's may already be as long as a name can be), and unique over threads
  // and processes; O_EXCL catches what a killed process with our id has left.
  static std::atomic<unsigned> counter{0};
  int descriptor = -1;
  for (int attempt = 0; attempt < 100 && descriptor < 0; ++attempt) {
    passing_ = folderOf(target_) + ".scumble-" + std::to_string(getpid()) + "-" +
               std::to_string(counter.fetch_add(1)) + ".tmp";
    descriptor = open(passing_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) break;
  }
  if (descriptor < 0) {
    const int code = errno;
    passing_.clear();
    return code;
  }
  if (exists && fchmod(descriptor, old.st_mode & 0777) != 0) {
    // Some file systems know no modes; the content matters more.
  }
  file_ = fdopen(descriptor, "wb");
  if (file_) return 0;
  const int code = errno;
  close(descriptor);
  return code;
}

WholeFile::~WholeFile() {
  if (file_) fclose(file_);
  if (!passing_.empty()) unlink(passing_.c_str());
}

void WholeFile::write(const void* bytes, size_t size) {
  if (!ok() || size == 0) return;
  errno = 0;
  if (fwrite(bytes, 1, size, file_) != size) return fail(errno);
  position_ += size;
}

void WholeFile::seek(uint64_t position) {
  if (!ok() || position == position_) return;
  errno = 0;
  if (fseeko(file_, off_t(position), SEEK_SET) != 0) return fail(errno);
  position_ = position;
}

Status WholeFile::commit() {
  if (file_) {
    // A full disk may show only here, when the last buffer goes out.
    errno = 0;
    if (fclose(file_) != 0) fail(errno);
    file_ = nullptr;
  }
  if (ok() && rename(passing_.c_str(), target_.c_str()) != 0) fail(errno);
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

}  // namespace scumble::film
