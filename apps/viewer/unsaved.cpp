#include "unsaved.h"

#include <algorithm>
#include <utility>

namespace scumble::viewer {

void Unsaved::open(const Document& document) {
  kept_.clear();
  dueAt_.reset();
  offered_ = recovery_.find(document.opened().scenes);
}

Status Unsaved::answer(Document& document, bool isTaken) {
  const std::optional<Recovery::Kept> kept = std::exchange(offered_, std::nullopt);
  if (!kept) return Done{};
  if (!isTaken) return recovery_.keep(document.opened(), document.edits());
  if (kept->look != document.opened().look) document.openLook(kept->look);
  document.take(kept->edits);
  return Done{};
}

Status Unsaved::keep(const Document& document, double now, bool atOnce) {
  if (document.edits() == kept_) {
    dueAt_.reset();
    return Done{};
  }
  if (!dueAt_) dueAt_ = now + kSeconds;
  if (!atOnce && now < *dueAt_) return Done{};
  kept_ = document.edits();
  dueAt_.reset();
  return recovery_.keep(document.opened(), kept_);
}

std::optional<double> Unsaved::untilDue(double now) const {
  return dueAt_ ? std::optional(std::max(*dueAt_ - now, 0.0)) : std::nullopt;
}

}  // namespace scumble::viewer
