#include "progress.h"

#include <unistd.h>

#include <cstdio>

namespace scumble::app {

namespace {
constexpr int kBarWidth = 30;
constexpr double kSecondsBetweenLines = 5;
}  // namespace

Progress::Progress(int steps, bool quiet)
    : steps_(steps), shown_(!quiet && steps > 1), terminal_(isatty(STDERR_FILENO)) {}

Progress::~Progress() {
  if (shown_ && terminal_ && done_ > 0) std::fputc('\n', stderr);
}

void Progress::done(const std::string& what) {
  ++done_;
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double left = elapsed / done_ * (steps_ - done_);
  if (terminal_) {
    const std::string full(size_t(kBarWidth * done_ / steps_), '#');
    std::fprintf(stderr, "\rscumble: [%-*s] %d/%d, %.0f s left \033[K", kBarWidth, full.c_str(), done_,
                 steps_, left);
    std::fflush(stderr);
  } else if (done_ == steps_ ||
             std::chrono::duration<double>(now - lastLine_).count() >= kSecondsBetweenLines) {
    std::fprintf(stderr, "scumble: %s, %d of %d, %.0f s left\n", what.c_str(), done_, steps_, left);
    lastLine_ = now;
  }
}

}  // namespace scumble::app
