// Tests only: small glTFs through the importer.
#pragma once

#include <gtest/gtest.h>

#include "scumble/scene.h"
#include "tests/support/test_gltf.h"

namespace scumble::scene {

// Fails the test where it cannot be loaded; the scene is empty then.
inline Scene loaded(const std::string& text, const SceneOptions& options = {}) {
  const Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "folder/test.glb", "", options);
  EXPECT_TRUE(scene.ok()) << scene.error().message();
  return scene.ok() ? scene.value() : Scene::combine({});
}
inline Scene loaded(const TestGltf& g, const SceneOptions& options = {}) {
  return loaded(g.glb(), options);
}

inline TestGltf quad() {
  TestGltf g;
  g.addQuad();
  return g;
}

}  // namespace scumble::scene
