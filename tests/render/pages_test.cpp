// Vertices lie in pages as large as storage buffers may be bound: a device that binds little draws the same.
#include "renderer/impl.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

class Pages : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 96, kHeight = 64;

  static std::unique_ptr<Renderer> rendererOf(uint32_t storageRange) {
    RendererOptions options;
    options.device = testDevice();
    options.validation = true;
    auto made = Renderer::create(options);
    if (!made) throw std::runtime_error(made.error().message());
    if (storageRange > 0) RendererAccess::device(**made).limitStorageRange(storageRange);
    return std::move(*made);
  }
};
INSTANTIATE_BOTH_EYES(Pages);

TEST_P(Pages, drawTheSameWhateverTheDeviceBinds) {
  TestScene s = stillLife();
  // Finer than pages are large, moving, transparent, and many times the same vertices at rest.
  s.add(sphereMesh({0, 2, 0}, 0.6f, 64), s.material(TestScene::colored("Ball", {0.7f, 0.3f, 0.2f, 1})));
  s.clip("Hop", {0, 1}, {{0, 0, 0}, {0.4f, 0.5f, 0.2f}});
  Json pane = TestScene::colored("Pane", {0.2f, 0.6f, 0.8f, 0.5f});
  pane["alphaMode"] = "BLEND";
  s.add(sphereMesh({-1, 1, 1}, 0.7f, 40), s.material(pane));
  s.addInstances(sphereMesh({0, 0, 0}, 0.3f, 24),
                 s.material(TestScene::colored("Beads", {0.8f, 0.7f, 0.1f, 1})),
                 {{1, 0.3f, 2}, {1.5f, 0.3f, 2}, {2, 0.3f, 2}},
                 std::vector<glm::quat>(3, glm::quat(1, 0, 0, 0)), std::vector<glm::vec3>(3, glm::vec3(1)));
  const Scene scene = s.load();
  Look look;
  for (const auto& [path, value] :
       thoseThere({{"ocean.mode", "on"}, {"ocean.level", "-0.6"}, {"ocean.grid", "32"}}))
    ASSERT_TRUE(look.set(path, value).ok());
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  RenderOptions options = sized(kWidth, kHeight, {"motion", "normal", "uv", "warp", "lit"});
  std::vector<Frame> whole;
  const auto plain = rendererOf(0), paged = rendererOf(160 << 10);
  for (const double time : {0.0, 0.4, 0.9}) {
    options.previousTime = time - 0.1;
    const Result<Frame> a = plain->render(scene, look, time, views, options),
                        b = paged->render(scene, look, time, views, options);
    ASSERT_TRUE(a.ok()) << a.error().message();
    ASSERT_TRUE(b.ok()) << b.error().message();
    expectSame(*a, *b, "at " + std::to_string(time));
  }
  EXPECT_EQ(paged->validationMessages(), 0);
}

}  // namespace
}  // namespace scumble
