#include "gltf/write_anew.h"

#include <algorithm>
#include <new>

#include "base/whole_file.h"
#include "scene/import_failure.h"

namespace scumble::gltf {

Status guarded(const std::string& path, const char* doing, const char* remedy,
               const std::function<Status()>& make) {
  try {
    return make();
  } catch (scene::ImportFailure& failure) {
    if (failure.error.kind != ErrorKind::cancelled) failure.error.file = path;
    return failure.error;
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::unusableFile, path, 0, "", "needs more memory than there is", remedy};
  } catch (const std::exception& error) {
    return Error{ErrorKind::internal,      path, 0, "", std::string(doing) + " failed: " + error.what(),
                 "please report this file"};
  }
}

Status putWhole(const std::string& out, const std::vector<uint8_t>& bytes) {
  WholeFile target(out);
  target.write(bytes.data(), bytes.size());
  return target.commit();
}

void addNew(std::vector<std::string>& said, const scene::ImportWarnings& warnings, const std::string& path) {
  for (const std::string& line : warnings.lines(path))
    if (std::find(said.begin(), said.end(), line) == said.end()) said.push_back(line);
}

}  // namespace scumble::gltf
