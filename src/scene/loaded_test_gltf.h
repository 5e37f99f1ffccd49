// Tests only: a small glTF through the importer.
#pragma once

#include <gtest/gtest.h>

#include "scene/test_gltf.h"
#include "scumble/scene.h"

namespace scumble::scene {

// Fails the test where it cannot be loaded; the scene is empty then.
inline Scene loaded(const TestGltf& g) {
  const std::string text = g.glb();
  const Result<Scene> scene = Scene::loadFromMemory(text.data(), text.size(), "test.glb", "");
  EXPECT_TRUE(scene.ok()) << scene.error().message();
  return scene.ok() ? scene.value() : Scene::combine({});
}

}  // namespace scumble::scene
