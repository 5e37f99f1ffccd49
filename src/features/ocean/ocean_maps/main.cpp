// ocean_maps OUT_FOLDER: writes the ocean's maps as PNG, to paint one's own over them.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "base/stroke_maps.h"
#include "features/ocean/waves/maps.h"
#include "scumble/image.h"

namespace {

using namespace scumble;

// writePng takes linear light; the files shall hold the maps' bytes.
Image linearImage(const Pixels& pixels) {
  Image image{pixels.width, pixels.height, {"R", "G", "B", "A"}, {}};
  for (size_t i = 0; i < pixels.rgba.size(); ++i) {
    const double encoded = pixels.rgba[i] / 255.0;
    const bool isAlpha = i % 4 == 3;
    image.pixels.push_back(float(isAlpha              ? encoded
                                 : encoded <= 0.04045 ? encoded / 12.92
                                                      : std::pow((encoded + 0.055) / 1.055, 2.4)));
  }
  return image;
}

bool write(const std::filesystem::path& path, const Pixels& pixels) {
  const Status written = writePng(path.string(), linearImage(pixels));
  if (!written) std::fprintf(stderr, "ocean_maps: %s\n", written.error().message().c_str());
  return bool(written);
}

bool writeAll(const std::filesystem::path& folder) {
  if (!write(folder / "dither.png", seaStrokes()) || !write(folder / "foam.png", foamStrokes())) return false;
  for (const ocean::Mood mood : ocean::kMoods) {
    const std::string name = ocean::nameOf(mood);
    if (!write(folder / ("bathic-" + name + ".png"), ocean::bathic(mood)) ||
        !write(folder / ("sky-" + name + ".png"), ocean::sky(mood)))
      return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    std::fprintf(stderr, "usage: ocean_maps OUT_FOLDER\n");
    return 2;
  }
  std::error_code problem;
  std::filesystem::create_directories(argv[1], problem);
  if (problem) {
    std::fprintf(stderr, "ocean_maps: %s: %s\n", argv[1], problem.message().c_str());
    return 5;
  }
  return writeAll(argv[1]) ? 0 : 5;
}
