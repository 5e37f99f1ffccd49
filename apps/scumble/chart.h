// The chart of `scumble measure --plot`.
#pragma once

#include <string>

#include "scumble/measure.h"

namespace scumble::app {

// Draws the measurements of the warp vectors (and of the breakup marks, where a panel says so) as a PNG.
// `title` names the scene, `subtitle` what was rendered. Fails with ErrorKind::outputNotWritten.
Status writeChart(const std::string& path, const Measurements& measured, const std::string& title,
                  const std::string& subtitle);

}  // namespace scumble::app
