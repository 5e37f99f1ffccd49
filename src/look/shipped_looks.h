// The looks that ship, compiled into the library so that they are found wherever it runs. The build writes
// the table from looks/*.json (src/look/CMakeLists.txt).
#pragma once

#include <string_view>
#include <vector>

namespace scumble::look {

struct ShippedLookFile {
  std::string_view name, text;
};

const std::vector<ShippedLookFile>& shippedLookFiles();

}  // namespace scumble::look
