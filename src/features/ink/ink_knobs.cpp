#include "features/ink/ink_knobs.h"

#include <algorithm>

namespace scumble::ink {

namespace {

// Whether a toggle is on at any time.
bool mayBeOn(const look::LookData& look, const look::ParamBlock& block, bool isOn) {
  return isOn ||
         std::any_of(look.assignments.begin(), look.assignments.end(), [&](const look::Assignment& a) {
           return a.block == &block && std::string_view(a.row->name) == "shown" && a.track;
         });
}

}  // namespace

bool mayShow(const look::LookData& look) {
  return mayBeOn(look, InkParams::block(), look.get<InkParams>().shown);
}
bool mayShowShadows(const look::LookData& look) {
  return mayShow(look) && mayBeOn(look, ShadowShapeParams::block(), look.get<ShadowShapeParams>().shown);
}

}  // namespace scumble::ink
