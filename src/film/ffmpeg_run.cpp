#include "film/ffmpeg_run.h"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/passing_file.h"
#include "film/ffmpeg.h"
#include "film/film_format.h"

namespace scumble::film {
namespace {

std::string passedName(size_t index) {
  return fmt::format("file:/proc/self/fd/{}", ChildProcess::kPassed + index);
}

}  // namespace

FfmpegRun::FfmpegRun(std::string path, FilmFormat format) : path_(std::move(path)), format_(format) {}

FfmpegRun::~FfmpegRun() {
  if (scratch_ >= 0) close(scratch_);
}

// The first is the output.
std::string FfmpegRun::inputName(size_t index) {
  return passedName(1 + index);
}

std::string FfmpegRun::writeSequence() const {
  return "write " + std::filesystem::path(path_).stem().string() + ".####.png";
}

const char* FfmpegRun::encoder() const {
  return factsOf(format_).encoder;
}

Error FfmpegRun::lost(std::string problem, std::string advice) const {
  return {ErrorKind::outputNotWritten, path_, 0, "", std::move(problem), std::move(advice)};
}

Error FfmpegRun::failed(const std::string& how) const {
  const std::string& said = process_.said();
  // The last one is how the signal is called that ends a child beyond a limit.
  for (const char* reason : {"No space left on device", "Disk quota exceeded", "File too large",
                             static_cast<const char*>(strsignal(SIGXFSZ))})
    if ((said + how).find(reason) != std::string::npos)
      return lost(std::string("cannot be written: ") + reason,
                  "make room on the disk or choose another place");
  if (said.find("Unknown encoder") != std::string::npos)
    return lost(fmt::format("this ffmpeg has no {0}, which films are encoded with", encoder()),
                fmt::format("install an ffmpeg with {0}, or {1}", encoder(), writeSequence()));
  const std::string line = lastLine(said);
  return lost("cannot be written: ffmpeg " + how + (line.empty() ? "" : ": " + line),
              writeSequence() + " instead");
}

Status FfmpegRun::start(const std::vector<std::string>& words, const std::vector<int>& inputs) {
  PassingFile passing = openPassingFile(folderOf(path_));
  const int code = passing.descriptor < 0 ? errno : 0;
  if (!passing.name.empty()) unlink(passing.name.c_str());
  scratch_ = passing.descriptor;
  if (code != 0)
    return lost("cannot be written: " + std::generic_category().message(code),
                "choose another place for the output");

  std::vector<std::string> command{"ffmpeg",    "-hide_banner", "-nostdin", "-nostats",
                                   "-loglevel", "error",        "-y"};
  command.insert(command.end(), words.begin(), words.end());
  command.push_back(passedName(0));
  std::vector<int> passed{scratch_};
  passed.insert(passed.end(), inputs.begin(), inputs.end());
  const int problem = process_.start(command, passed);
  if (problem == ENOENT)
    return lost("films need the program ffmpeg, which is not installed",
                "install ffmpeg, or " + writeSequence());
  if (problem != 0)
    return lost("ffmpeg cannot be started: " + std::generic_category().message(problem),
                "repair that, or " + writeSequence());
  return Done{};
}

Status FfmpegRun::send(const void* bytes, size_t size) {
  if (process_.send(bytes, size)) return Done{};
  const std::string how = process_.finish();
  return failed(how.empty() ? "ended too early" : how);
}

Status FfmpegRun::finish() {
  const std::string how = process_.finish();
  return how.empty() ? Status(Done{}) : Status(failed(how));
}

}  // namespace scumble::film
