#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace scumble::app {

namespace {
constexpr int kBarWidth = 30;
constexpr double kSecondsBetweenLines = 5;
}  // namespace

Progress::Progress(int steps, bool quiet) : steps_(steps), quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {}

Progress::~Progress() {
  if (isOpen_) std::fputc('\n', stderr);
}

void Progress::part(double of) {
  const std::lock_guard lock(mutex_);
  if (of > 0) show(done_ + of, "frame");
}

void Progress::done(const std::string& what) {
  const std::lock_guard lock(mutex_);
  ++done_;
  if (steps_ > 1) show(done_, what);
}

void Progress::show(double done, const std::string& what) {
  if (quiet_) return;
  const Clock::time_point now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::optional<double> seconds = timeLeft_.after(done, elapsed);
  const std::string left = seconds ? fmt::format(", {:.0f} s left", *seconds) : "";
  // Of a single step its parts count.
  const std::string count =
      steps_ > 1 ? std::to_string(int(done)) + (terminal_ ? "/" : " of ") + std::to_string(steps_)
                 : std::to_string(int(100 * done)) + " %";
  if (terminal_) {
    const std::string full(size_t(kBarWidth * done / steps_), '#');
    std::fprintf(stderr, "\rscumble: [%-*s] %s%s \033[K", kBarWidth, full.c_str(), count.c_str(),
                 left.c_str());
    std::fflush(stderr);
    isOpen_ = true;
  } else if ((done == steps_ && steps_ > 1) ||
             std::chrono::duration<double>(now - lastLine_).count() >= kSecondsBetweenLines) {
    std::fprintf(stderr, "scumble: %s, %s%s\n", what.c_str(), count.c_str(), left.c_str());
    lastLine_ = now;
  }
}

}  // namespace scumble::app
