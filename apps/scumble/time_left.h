// How long work will still take, from how much of it was done when.
#pragma once

#include <optional>

namespace scumble::app {

class TimeLeft {
 public:
  // Number of steps of the whole work.
  explicit TimeLeft(double steps) : steps_(steps) {}

  // `done`: steps so far, in parts too; `elapsed`: seconds since the beginning. Seconds; nothing until there
  // is a pace to go by and three percent are done, or five seconds over. What came before the first call does
  // not count for the pace: pipelines are compiled then.
  std::optional<double> after(double done, double elapsed) {
    if (done >= steps_) return 0.0;
    if (!begun_) {
      if (done > 0) begun_ = {done, elapsed};
      return std::nullopt;
    }
    if (!(done > begun_->done) || !(elapsed > begun_->elapsed)) return std::nullopt;
    if (done < 0.03 * steps_ && elapsed < 5) return std::nullopt;
    return (elapsed - begun_->elapsed) / (done - begun_->done) * (steps_ - done);
  }

 private:
  struct Moment {
    double done, elapsed;
  };
  double steps_;
  std::optional<Moment> begun_;
};

}  // namespace scumble::app
