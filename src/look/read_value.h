// Reading the value of a knob, with the picture that it may name.
#pragma once

#include "look/look_data.h"

namespace scumble::look {

// A value as text; a picture's file, relative to `folder`, is loaded into `data`. Fails like parseValue, or
// with ErrorKind::unusableFile and the picture's file.
Result<Value> readValue(const ParamRow& row, const std::string& text, const std::string& folder,
                        LookData& data);

}  // namespace scumble::look
