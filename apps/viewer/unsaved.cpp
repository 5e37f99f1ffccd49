#include "unsaved.h"

#include <algorithm>
#include <utility>

namespace scumble::viewer {

void Unsaved::open(const Document& document) {
  dueAt_.reset();
  seen_ = 0;
  offered_ = recovery_.find(document.opened().scenes);
  kept_ = offered_ ? State{offered_->look, offered_->edits} : State();
}

Status Unsaved::answer(Document& document, bool isTaken) {
  const std::optional<Recovery::Kept> kept = std::exchange(offered_, std::nullopt);
  if (!kept) return Done{};
  if (!isTaken) {
    kept_ = {document.lookName(), document.edits()};
    return recovery_.keep(document.opened().scenes, kept_.look, kept_.edits);
  }
  if (kept->look != document.lookName()) document.openLook(kept->look);
  document.take(kept->edits);
  return Done{};
}

Status Unsaved::keep(const Document& document, double now, bool atOnce) {
  // Which look is there is asked of the disk, and the window asks in every frame.
  if (document.scene().empty() || (document.version() == seen_ && !dueAt_)) return Done{};
  seen_ = document.version();
  // What is offered is not lost before somebody has answered.
  State state{document.lookName(), document.edits()};
  if (offered_) {
    state.edits.insert(offered_->edits.begin(), offered_->edits.end());
    if (document.edits().empty()) state.look = offered_->look;
  }
  if (state.edits == kept_.edits && (state.edits.empty() || state.look == kept_.look)) {
    dueAt_.reset();
    return Done{};
  }
  if (!dueAt_) dueAt_ = now + kSeconds;
  if (!atOnce && now < *dueAt_) return Done{};
  kept_ = std::move(state);
  dueAt_.reset();
  return recovery_.keep(document.opened().scenes, kept_.look, kept_.edits);
}

std::optional<double> Unsaved::untilDue(double now) const {
  return dueAt_ ? std::optional(std::max(*dueAt_ - now, 0.0)) : std::nullopt;
}

}  // namespace scumble::viewer
