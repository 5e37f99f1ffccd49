#include "base/whole_file.h"
#include "scumble/image.h"

namespace scumble {

Status writeText(const std::string& path, const std::string& text) {
  WholeFile file(path);
  file.write(text.data(), text.size());
  return file.commit();
}

}  // namespace scumble
