#include "panorama_kind.h"

#include "report.h"

namespace scumble::app {

namespace {

constexpr PanoramaKindRow kKinds[] = {
    {"vr180", PanoramaKind::vr180, "side-by-side", "2048x2048", FilmProjection::halfSphere},
    {"ods", PanoramaKind::ods, "over-under", "4096x2048", FilmProjection::sphere},
    {"mono360", PanoramaKind::mono360, "", "4096x2048", FilmProjection::sphere}};

}  // namespace

Result<const PanoramaKindRow*> panoramaKindOf(const std::string& name) {
  if (name.empty()) return nullptr;
  std::vector<std::string> names;
  for (const PanoramaKindRow& row : kKinds) {
    if (name == row.name) return &row;
    names.emplace_back(row.name);
  }
  return usage("'" + name + "' is no kind of panorama", suggestion(name, names, "use vr180, ods or mono360"));
}

}  // namespace scumble::app
