// Knobs that are turned and not saved: when they are kept (recovery.h), and what was kept before and is
// offered.
#pragma once

#include <optional>

#include "recovery.h"

namespace scumble::viewer {

class Unsaved {
 public:
  static constexpr double kSeconds = 2;  // after a knob was turned, until it is kept

  explicit Unsaved(std::string folder) : recovery_(std::move(folder)) {}

  // Other scenes are there, which may have been left with something unsaved.
  void open(const Document& document);
  // What is to be offered.
  const std::optional<Recovery::Kept>& offered() const { return offered_; }
  // Turned again, or thrown away. Fails with outputNotWritten.
  Status answer(Document& document, bool isTaken);

  // Keeps what is not kept, if it is time (seconds) or `atOnce`; and in how many seconds it will be. Fails
  // with outputNotWritten.
  Status keep(const Document& document, double now, bool atOnce);
  std::optional<double> untilDue(double now) const;

 private:
  const Recovery recovery_;
  std::optional<Recovery::Kept> offered_;
  struct State {
    std::string look;
    Edits edits;
  } kept_;
  std::optional<double> dueAt_;
  uint64_t seen_ = 0;  // Document::version that was looked at last
};

}  // namespace scumble::viewer
