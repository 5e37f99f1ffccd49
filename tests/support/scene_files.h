// A scene as a file in a folder of its own, and where what is made of it goes.
#pragma once

#include <string>

#include "base/test_folder.h"

namespace scumble::test {

struct SceneFiles {
  explicit SceneFiles(const std::string& text) : scene(folder.put("scene.gltf", text)) {}
  TestFolder folder;
  std::string scene, out = folder.file("out.glb");
};

}  // namespace scumble::test
