#include "features/ink/ink_knobs.h"

#include <algorithm>

namespace scumble::ink {

bool mayShow(const look::LookData& look) {
  if (look.get<InkParams>().shown) return true;
  return std::any_of(look.assignments.begin(), look.assignments.end(), [](const look::Assignment& a) {
    return a.block == &InkParams::block() && std::string_view(a.row->name) == "shown" && a.track;
  });
}

}  // namespace scumble::ink
