#include "dialogs.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"

namespace scumble::viewer {
namespace {

TEST(Drops, areTakenForWhatTheyAre) {
  const TestFolder folder;
  const std::string look = folder.put("mine.json", "{\"shadow\": {\"threshold\": 0.5}}"),
                    broken = folder.put("broken.look.json", "{"),
                    world = folder.put("harbour.json", "{\"scenes\": [{\"file\": \"boat.glb\"}]}"),
                    tilt = folder.put("owl.tilt/metadata.json", "");
  const Drop drop = sorted({"a.GLB", "b.gltf", look, broken, world, folder.file("owl.tilt"), "p.PNG",
                            "p.jpeg", "q.webp", "notes.txt", "bare"});
  EXPECT_EQ(drop.scenes, (std::vector<std::string>{"a.GLB", "b.gltf", world, folder.file("owl.tilt")}));
  EXPECT_EQ(drop.looks, (std::vector<std::string>{look, broken}));
  EXPECT_EQ(drop.pictures, (std::vector<std::string>{"p.PNG", "p.jpeg", "q.webp"}));
  EXPECT_EQ(drop.others, (std::vector<std::string>{"notes.txt", "bare"}));
}

}  // namespace
}  // namespace scumble::viewer
