// How the interface looks: neutral grey, so that it takes no part in the picture's colours.
#pragma once

namespace scumble::viewer {

// Sets letters and colours of ImGui's present context. `scale`: the monitor's.
void setStyle(float scale);

}  // namespace scumble::viewer
