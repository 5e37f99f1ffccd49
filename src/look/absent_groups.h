// Groups of knobs that this program was built without, with their features (cmake -DSCUMBLE_WITHOUT).
#pragma once

#include <string>

namespace scumble::look {

// The feature that a knob or group of such a path belongs to, empty where it is none of theirs.
std::string absentFeatureOf(const std::string& path);

}  // namespace scumble::look
