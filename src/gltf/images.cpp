#include <cstring>
#include <filesystem>

#include "base/image_decode.h"
#include "gltf/import.h"
#include "gltf/uri.h"
#include "scene/parallel.h"

namespace scumble::gltf {

namespace {

// Pixels that images may have without bytes to show for them (a plain colour compresses to nothing), shared
// by all of a file, and those that every byte allows.
constexpr uint64_t kFreePixels = 64ull << 20, kPixelsPerByte = 1024;

struct Task {
  TextureImage* image;
  Bytes bytes;
  Buffers::Holder holder;
  std::string path, problem;
  bool usable = false;
};

void findBytes(const Import& import, Task& task) {
  const JsonView images = import.document.list("images");
  const int64_t number = std::stoll(task.image->name);
  task.image->name.clear();
  if (number < 0) return;  // the warning is out already
  const JsonView json = images.at(static_cast<size_t>(number));
  task.path = json.path();
  task.image->name = json.text("name");
  const int64_t view = json.index("bufferView", import.buffers.viewCount(), "buffer view");
  if (view >= 0) {
    task.bytes = import.buffers.view(view);
  } else {
    task.path = json.pathOf("uri");
    if (!json.has("uri")) fail(task.path, "is missing");
    const Json& uri = json.json()["uri"];
    if (!uri.is_string()) fail(task.path, "is not a string");
    const std::string& text = uri.get_ref<const std::string&>();
    if (task.image->name.empty() && text.size() < 300 && !isDataUri(text))
      task.image->name = std::filesystem::path(text).filename().string();
    if (!import.buffers.imageFile(text, task.path, task.holder, task.bytes, task.problem)) return;
  }
  task.usable = true;
}

// The visible pattern for what cannot be used: a checker of magenta and grey.
void makeStandIn(TextureImage& image) {
  constexpr uint32_t kSide = 64, kCell = 8;
  image.width = image.height = kSide;
  image.standIn = true;
  image.rgba.resize(kSide * kSide * 4);
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) {
      const bool magenta = ((x / kCell) + (y / kCell)) % 2 == 0;
      const uint8_t pixel[4] = {uint8_t(magenta ? 255 : 96), uint8_t(magenta ? 0 : 96),
                                uint8_t(magenta ? 255 : 96), 255};
      std::memcpy(&image.rgba[(y * kSide + x) * 4], pixel, 4);
    }
}

}  // namespace

void readImages(const Import& import, SceneData& scene) {
  std::vector<Task> tasks(scene.images.size());
  uint64_t freePixels = kFreePixels;
  for (size_t i = 0; i < tasks.size(); ++i) {
    Task& task = tasks[i];
    task.image = &scene.images[i].own();
    try {
      findBytes(import, task);
    } catch (const ImportFailure& failure) {
      task.path = failure.error.jsonPath;
      task.problem = failure.error.problem;
    }
    uint32_t width = 0, height = 0;
    if (!task.usable || !readImageSize(task.bytes, width, height, task.problem)) {
      task.usable = false;
      continue;
    }
    const uint64_t pixels = uint64_t(width) * height, backed = kPixelsPerByte * task.bytes.size();
    if (pixels > backed && pixels - backed > freePixels) {
      task.usable = false;
      task.problem = "it claims to be " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels, far more than its bytes can hold";
    } else if (pixels > backed) {
      freePixels -= pixels - backed;
    }
  }

  import.progress.expect(tasks.size(), 0.95);
  parallelFor(tasks.size(), import.threads, [&](size_t i) {
    Task& task = tasks[i];
    if (!task.usable || !decodeImage(task.bytes, *task.image, task.problem)) makeStandIn(*task.image);
    task.holder = {};
    import.progress.step();
  });

  for (const Task& task : tasks) {
    if (task.problem.empty()) continue;
    const char* outcome = task.image->standIn ? "an image is drawn as a magenta checker: "
                                              : "an image is shown as far as it goes: ";
    import.warnings.add(task.path, outcome + task.problem);
  }
}

}  // namespace scumble::gltf
