// A watercolour for tests: with every knob at nothing, so that each may be tried by itself.
#pragma once

#include "tests/support/render_test.h"

namespace scumble::test {

// White paper that leaves the picture as it is; then the given knobs.
inline Knobs plainWash(const Knobs& more = {}) {
  Knobs knobs{{"watercolor.shown", "on"},        {"watercolor.white", "#FFFFFF"},
              {"watercolor.relief", "0"},        {"watercolor.wobble", "0"},
              {"watercolor.edges", "0"},         {"watercolor.granulation", "0"},
              {"watercolor.dryBrush", "0"},      {"watercolor.bleeding", "0"},
              {"watercolor.bare", "0"},          {"watercolor.margin", "0"},
              {"watercolor.turbulence", "0"},    {"watercolor.hue", "0"},
              {"watercolor.glazing", "0"},       {"warp.amount", "0"},
              {"background.horizon", "#FFFFFF"}, {"background.zenith", "#FFFFFF"}};
  knobs.insert(knobs.end(), more.begin(), more.end());
  return knobs;
}

}  // namespace scumble::test
