// Memory over many frames: what a frame takes it gives back, and a driver that makes shaders of its own for
// the values of uniforms is given none that move (tests/shader_rules_test.py says where that would be).
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/animated_scene.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

constexpr int kManyWidth = 32, kManyHeight = 24;

double residentMegabytes() {
  long pages = 0, resident = 0;
  FILE* file = std::fopen("/proc/self/statm", "r");
  if (!file) return 0;
  const int read = std::fscanf(file, "%ld %ld", &pages, &resident);
  std::fclose(file);
  return read == 2 ? double(resident) * 4096 / (1 << 20) : 0;
}

// Something that moves, and something transparent.
Scene everyday() {
  AnimatedScene s;
  Json glass = TestScene::colored("Glass", {0.4f, 0.6f, 0.7f, 0.4f});
  glass["alphaMode"] = "BLEND";
  const int box = s.mesh({boxMesh({-0.6f, -0.4f, -0.3f}, {0.6f, 0.4f, 0.3f}), 0, {}, {}, {}, {}},
                         s.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1})));
  const int pane = s.mesh({gridMesh({-1, 0, 1}, {2, 0, 0}, {0, 1, 0}), 0, {}, {}, {}, {}}, s.material(glass));
  const int node = s.node({{"name", "Box"}, {"mesh", box}});
  s.node({{"name", "Pane"}, {"mesh", pane}});
  s.channel(s.clip("Goes"), node, "translation", "LINEAR", {0, 100}, {-0.5f, 0, 0, 0.5f, 0, 0});
  return s.load();
}

struct Frames {
  Renderer& renderer;
  const Scene& scene;
  const Look& look;
  Stereo stereo;
  std::vector<std::string> aovs{};
  void operator()(int from, int to) const {
    for (int i = from; i < to; ++i) {
      const double angle = 0.003 * i;
      const auto views = viewsFrom(scene, {{float(4 * std::sin(angle)), 1.5f, float(4 * std::cos(angle))}},
                                   kManyWidth, kManyHeight, stereo);
      const Result<Frame> frame =
          renderer.render(scene, look, i / 24.0, views, sized(kManyWidth, kManyHeight, aovs));
      ASSERT_TRUE(frame.ok()) << frame.error().message();
    }
  }
};

class Memory : public ::testing::TestWithParam<Stereo> {
 protected:
  // Megabytes by which 24 frames grow, after those that make and warm everything: a shader a frame would
  // be 24.
  static double growth(const Frames& frames) {
    frames(0, 8);
    const double before = residentMegabytes();
    frames(8, 32);
    return residentMegabytes() - before;
  }
  static std::unique_ptr<Renderer> made(ImagePassKind kind = ImagePassKind::automatic) {
    RendererOptions options;  // without validation layers, which keep notes of their own
    options.imagePasses = kind;
    options.device = testDevice();
    return std::move(Renderer::create(options)).value();
  }
};
INSTANTIATE_TEST_SUITE_P(Views, Memory, ::testing::Values(Stereo::mono, Stereo::stereo), stereoName);

TEST_P(Memory, doesNotGrowWithAnyLook) {
  if (kSanitized) GTEST_SKIP() << "AddressSanitizer keeps what is freed";
  const Scene scene = everyday();
  const auto renderer = made();
  // Every second look for one eye, the others for two.
  bool isMonos = false;
  for (const ShippedLook& shipped : Look::shipped()) {
    isMonos = !isMonos;
    if (isMonos != (GetParam() == Stereo::mono)) continue;
    const Look look = std::move(Look::load(shipped.name)).value();
    EXPECT_LT(growth({*renderer, scene, look, GetParam()}), 8) << shipped.name;
  }
}

// What no look that ships uses.
TEST_P(Memory, doesNotGrowWithUnusualKnobs) {
  if (kSanitized) GTEST_SKIP() << "AddressSanitizer keeps what is freed";
  const Scene scene = everyday();
  const auto renderer = made();
  for (const Knobs& knobs : std::vector<Knobs>{
           {{"warp.metatexture.mode", "screen"}, {"warp.metatexture.skip", "0.1"}, {"final.ripple", "paper"}},
           {{"warp.metatexture.gradients", "fragment"},
            {"warp.metatexture.radial", "on"},
            {"warp.metatexture.base", "3"},
            {"warp.metatexture.levelRotation", "20"},
            {"final.ripple", "layered"}},
           {{"texture.amount", "0.5"},
            {"texture.metatexture.mode", "fractal"},
            {"texture.blend", "overlay"}}}) {
    Look look;
    for (const auto& [path, value] : knobs) ASSERT_TRUE(look.set(path, value).ok()) << path;
    EXPECT_LT(growth({*renderer, scene, look, GetParam(), {"metatexture", "cryptomatte"}}), 8)
        << knobs[0].first << " " << knobs[0].second;
  }
}

TEST_P(Memory, doesNotGrowWithImagePassesAsCompute) {
  if (kSanitized) GTEST_SKIP() << "AddressSanitizer keeps what is freed";
  const Scene scene = everyday();
  EXPECT_LT(growth({*made(ImagePassKind::compute), scene, Look(), GetParam()}), 8);
}

// Two scenes in turns: each is uploaded once, as long as the budget holds both.
TEST_P(Memory, scenesStayWhileThereIsRoom) {
  const Scene a = everyday(), b = stillLife().load();
  const Look look;
  const auto drawnWith = [&](uint64_t budget) {
    RendererOptions options;
    options.sceneBudget = budget;
    options.device = testDevice();
    const auto renderer = std::move(Renderer::create(options)).value();
    std::vector<Frame> frames;
    for (const Scene* scene : {&a, &b, &a, &b, &a})
      frames.push_back(renderer
                           ->render(*scene, look, 0.5,
                                    viewsFrom(*scene, {}, kManyWidth, kManyHeight, GetParam()),
                                    sized(kManyWidth, kManyHeight))
                           .value());
    return frames;
  };
  const std::vector<Frame> kept = drawnWith(uint64_t(1) << 29), anew = drawnWith(0);
  EXPECT_GT(kept[1].stats.deviceBytes, kept[0].stats.deviceBytes);
  for (size_t i = 2; i < kept.size(); ++i) EXPECT_EQ(kept[i].stats.deviceBytes, kept[1].stats.deviceBytes);
  EXPECT_LT(anew[1].stats.deviceBytes, kept[1].stats.deviceBytes);
  EXPECT_EQ(anew[2].stats.deviceBytes, anew[0].stats.deviceBytes);
  for (size_t i = 0; i < kept.size(); ++i)
    for (size_t v = 0; v < kept[i].layers[0].views.size(); ++v)
      EXPECT_EQ(kept[i].layers[0].views[v].pixels, anew[i].layers[0].views[v].pixels);
  EXPECT_EQ(kept[4].layers[0].views[0].pixels, kept[0].layers[0].views[0].pixels);
}

// Frames of two scenes may be under way together.
TEST_P(Memory, framesOfTwoScenesAreUnderWay) {
  const Scene a = everyday(), b = stillLife().load();
  const auto renderer = made();
  const auto views = viewsFrom(a, {}, kManyWidth, kManyHeight, GetParam());
  const RenderOptions options = sized(kManyWidth, kManyHeight, {"depth"});
  const Frame aAlone = renderer->render(a, Look(), 0, views, options).value(),
              bAlone = renderer->render(b, Look(), 0, views, options).value();
  ASSERT_TRUE(renderer->begin(a, Look(), 0, views, options).ok());
  ASSERT_TRUE(renderer->begin(b, Look(), 0, views, options).ok());
  const Frame first = renderer->finish().value(), second = renderer->finish().value();
  for (size_t layer = 0; layer < 2; ++layer) {
    EXPECT_EQ(first.layers[layer].views[0].pixels, aAlone.layers[layer].views[0].pixels);
    EXPECT_EQ(second.layers[layer].views[0].pixels, bAlone.layers[layer].views[0].pixels);
  }
}

}  // namespace
}  // namespace scumble
