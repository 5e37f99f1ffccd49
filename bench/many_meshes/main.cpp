// many_meshes OUT.glb [--spheres] [--triangles N] [--meshes N]: writes the scenes that the speed goals are
// measured on.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "harbour.h"
#include "mesh_kit/glb_writer.h"
#include "spheres.h"

namespace {

int usage() {
  std::fprintf(
      stderr,
      "usage: many_meshes OUT.glb [--spheres] [--triangles N] [--meshes N]   (default 800000 and 250)\n");
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::string path;
  size_t triangles = 800000, meshes = 250;
  bool areSpheres = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--spheres") {
      areSpheres = true;
    } else if (word == "--triangles" || word == "--meshes") {
      if (i + 1 >= argc) return usage();
      const long number = std::strtol(argv[++i], nullptr, 10);
      if (number < 2 || number > 100000000) return usage();
      (word == "--meshes" ? meshes : triangles) = size_t(number);
    } else if (word.starts_with('-') || !path.empty()) {
      return usage();
    } else {
      path = word;
    }
  }
  if (path.empty()) return usage();
  const meshkit::Document document =
      areSpheres ? spheres::makeSpheres(triangles, meshes) : harbour::makeHarbour(triangles, meshes);
  const std::string problem = meshkit::writeGlb(document, path, "scumble many_meshes");
  if (!problem.empty()) {
    std::fprintf(stderr, "many_meshes: error: %s\n", problem.c_str());
    return 5;
  }
  std::printf("%s: %zu triangles, %zu meshes, %zu materials\n", path.c_str(), document.triangleCount(),
              document.meshes.size(), document.materials.size());
  return 0;
}
