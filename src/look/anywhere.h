// Questions to a look that are asked before it is known what its patterns match.
#pragma once

#include <algorithm>

#include "look/look_data.h"

namespace scumble::look {

// Whether a number may be above 0: for the scene, or for any material or node that a pattern names.
template <class Params>
bool mayBeAboveZero(const LookData& look, float Params::*member) {
  const Params params = look.get<Params>();
  const auto offset =
      size_t(reinterpret_cast<const char*>(&(params.*member)) - reinterpret_cast<const char*>(&params));
  return params.*member > 0 ||
         std::any_of(look.assignments.begin(), look.assignments.end(), [&](const Assignment& a) {
           return a.block == &Params::block() && a.row->offset == offset && !a.pattern.empty() &&
                  a.value.number > 0;
         });
}

}  // namespace scumble::look
