#include "look/shipped_looks.h"

namespace scumble::look {

const std::vector<ShippedLookFile>& shippedLookFiles() {
  static const std::vector<ShippedLookFile> files{
#include "look/shipped_looks.inc"
  };
  return files;
}

}  // namespace scumble::look
