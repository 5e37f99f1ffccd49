// Knobs written into the text of a look's file, which stays as it is everywhere else: order, spaces,
// comments.
#pragma once

#include <optional>
#include <string>

#include "document.h"

namespace scumble::viewer {

// The text with knobs set to what the edits say. What stands there for them is replaced, tracks too; what
// does not stand there is added at the end of the group that it belongs to. Nothing where the text is no JSON
// object (with comments), or where a group that a knob belongs to is something else than an object. An empty
// text is an empty object.
std::optional<std::string> withKnobs(const std::string& text, const Edits& edits);

}  // namespace scumble::viewer
