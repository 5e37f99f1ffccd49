// Transparent surfaces of several objects: every pixel shows all that lies on its ray, composited from the
// farthest to the nearest, whichever object, material or texture it is of.
#include "passes/order/order.h"

#include <algorithm>
#include <cmath>

#include "scumble/scene_editor.h"
#include "tests/support/aov.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble::passes {
namespace {

using namespace test;

// Colours are composited as square roots, since that is what targets hold; straight colour and coverage.
struct Composite {
  glm::dvec3 sum{0.0};
  double coverage = 0;
  void over(const glm::dvec3& root, double alpha) {
    sum = glm::mix(sum, root, alpha);
    coverage += alpha * (1 - coverage);
  }
  void over(const glm::dvec4& texel) { over(glm::sqrt(glm::dvec3(texel)), texel.w); }
  glm::dvec3 root() const { return coverage > 0 ? sum / coverage : glm::dvec3(0.0); }
};

class OrderTest : public BothEyes {
 protected:
  static constexpr int kWidth = 96, kHeight = 72;
  static constexpr double kByte = 1.0 / 255;

  static Json blended(Json json, bool doubleSided = true) {
    json["alphaMode"] = "BLEND";
    json["doubleSided"] = doubleSided;
    return json;
  }
  static Image solid(const glm::vec4& c) { return {1, 1, {"R", "G", "B", "A"}, {c.r, c.g, c.b, c.a}}; }
  static void expectComposite(const glm::dvec4& got, const Composite& expected, Difference& colors,
                              Difference& coverage) {
    coverage.add(got.w, expected.coverage);
    if (expected.coverage < 0.05) return;
    for (int c = 0; c < 3; ++c) colors.add(std::sqrt(got[c]), expected.root()[c]);
  }
};
INSTANTIATE_BOTH_EYES(OrderTest);

// Shell within shell, and an opaque ball in the middle: what counts is the order of triangles of two objects,
// for the inner one lies between the outer one's far side and its near side.
TEST_P(OrderTest, shellsWithinShells) {
  const glm::vec4 colors[] = {{0.9f, 0.2f, 0.1f, 0.4f}, {0.1f, 0.3f, 0.9f, 0.6f}, {0.2f, 0.8f, 0.2f, 1}};
  const float radii[] = {1.0f, 0.7f, 0.3f};
  for (const bool innerFirst : {false, true}) {
    TestScene s;
    std::vector<glm::vec4> colorOf{glm::vec4(0.0f)};  // by id
    for (const int i : innerFirst ? std::vector{1, 0, 2} : std::vector{0, 1, 2}) {
      const Json json = TestScene::unlit("Shell " + std::to_string(i), colors[i]);
      s.add(sphereMesh({0, 0, 0}, radii[i], 24), s.material(i < 2 ? blended(json) : json));
      colorOf.push_back(colors[i]);
    }
    const Scene scene = s.load();
    for (const glm::vec3& eye : {glm::vec3(0, 0, 4), glm::vec3(2.2f, 1.5f, -2)}) {
      const auto views = viewsFrom(scene, {eye}, kWidth, kHeight, GetParam());
      const Frame frame =
          draw(scene, quietLook({{"light.shadowWarp", "0"}}), views, sized(kWidth, kHeight, {"lit"}));
      for (size_t v = 0; v < viewCount(); ++v) {
        Difference rgb(3 * kByte), coverage(3 * kByte);
        for (int y = 1; y < kHeight; y += 3)
          for (int x = 1; x < kWidth; x += 3) {
            std::vector<int> seen;
            Ray ray = pixelRay(views[v], x, y, kWidth, kHeight);
            while (const auto hit = castRay(ray, s.triangles(), true)) {
              seen.push_back(hit->id);
              if (colorOf[size_t(hit->id)].a == 1) break;
              ray.origin = hit->position + 1e-7 * ray.direction;
            }
            Composite composite;
            for (auto id = seen.rbegin(); id != seen.rend(); ++id) {
              const glm::dvec4 color(colorOf[size_t(*id)]);
              composite.over(glm::sqrt(glm::dvec3(color)), color.a);
            }
            expectComposite(texel(aov(frame, "lit", v), x, y), composite, rgb, coverage);
          }
        EXPECT_LT(rgb.beyondPart(), 0.01) << rgb.text();
        EXPECT_LT(coverage.beyondPart(), 0.01) << coverage.text();
      }
    }
  }
}

// Panes of every kind between each other: whatever else they are, each lies over those behind it as it would
// alone. What they are alone is drawn one by one.
TEST_P(OrderTest, panesOfEveryKindOverEachOther) {
  struct Pane {
    const char* name;
    float z;
    std::function<void(TestScene&, float)> add;
  };
  const auto grid = [](float z) { return gridMesh({-1, -1, z}, {2, 0, 0}, {0, 2, 0}, 2); };
  const std::vector<Pane> panes{
      {"plain", 0.9f,
       [&](TestScene& s, float z) {
         s.add(grid(z), s.material(blended(TestScene::colored("Plain", {0.8f, 0.2f, 0.1f, 0.4f}))));
       }},
      {"one mesh, before and behind others", 0,
       [&](TestScene& s, float) {
         TestMesh both;
         append(both, grid(0.6f), {0.2f, 0.7f, 0.3f, 0.5f});
         append(both, grid(-0.6f), {0.9f, 0.8f, 0.1f, 0.7f});
         s.add(both, s.material(blended(TestScene::colored("Colours", {1, 1, 1, 1}))));
       }},
      {"textured", 0.3f,
       [&](TestScene& s, float z) {
         Json json = TestScene::colored("Textured", {1, 1, 1, 0.6f});
         json["pbrMetallicRoughness"]["baseColorTexture"]["index"] =
             s.texture(solid({0.1f, 0.3f, 0.9f, 0.8f}));
         s.add(grid(z), s.material(blended(json)));
       }},
      {"glowing", 0.1f,
       [&](TestScene& s, float z) {
         Json json = TestScene::colored("Glowing", {0.3f, 0.3f, 0.3f, 0.5f});
         json["emissiveFactor"] = {0.4, 0.1, 0.3};
         json["emissiveTexture"]["index"] = s.texture(solid({1, 0.2f, 0.6f, 1}));
         s.add(grid(z), s.material(blended(json)));
       }},
      {"seen from behind only", -0.1f,
       [&](TestScene& s, float z) {
         s.add(gridMesh({1, -1, z}, {-2, 0, 0}, {0, 2, 0}, 2),
               s.material(blended(TestScene::colored("Hidden", {0, 0, 0, 0.9f}), false)));
       }},
      {"mirrored", -0.3f,
       [&](TestScene& s, float z) {
         glm::mat4 mirror(1.0f);
         mirror[0][0] = -1;
         s.add(gridMesh({1, -1, z}, {-2, 0, 0}, {0, 2, 0}, 2),
               s.material(blended(TestScene::colored("Mirrored", {0.6f, 0.1f, 0.7f, 0.5f}), false)), mirror);
       }},
      {"painted by the look", -0.45f,
       [&](TestScene& s, float z) {
         s.add(grid(z), s.material(blended(TestScene::colored("Painted", {0.5f, 0.6f, 0.2f, 0.5f}))));
       }},
      {"painted otherwise", -0.75f,
       [&](TestScene& s, float z) {
         s.add(grid(z), s.material(blended(TestScene::colored("Painted too", {0.3f, 0.2f, 0.9f, 0.5f}))));
       }},
  };
  // Two that the look paints alike are in one order with all others; one that is painted otherwise comes in a
  // draw of its own after them, so it is left out where it lies behind.
  for (const bool paintsOtherwise : {false, true}) {
    // Nothing is in shadow: blended surfaces have their light and shadow side in their colours.
    Knobs knobs{{"light.shadowWarp", "0"},
                {"light.terminator", "-0.9"},
                {"shadowMap.cast", "off"},
                {"materials.Painted*.texture.amount", "0.8"}};
    if (paintsOtherwise) knobs.push_back({"materials.Painted too.texture.blend", "multiply"});
    const Look look = quietLook(knobs);
    const auto drawn = [&](const std::vector<size_t>& which) {
      TestScene s;
      for (const size_t i : which) panes[i].add(s, paintsOtherwise && i == 7 ? 1.2f : panes[i].z);
      const Scene scene = s.load();
      return draw(scene, look, viewsFrom(scene, {{0, 0, 5}}, kWidth, kHeight, GetParam()),
                  sized(kWidth, kHeight, {"lit"}));
    };
    std::vector<Frame> alone;
    for (size_t i = 0; i < panes.size(); ++i) alone.push_back(drawn({i}));
    const Frame all = drawn({3, 6, 1, 0, 4, 7, 5, 2});
    // The second pane's two halves alone.
    std::vector<std::pair<float, Frame>> order;
    for (size_t i = 0; i < panes.size(); ++i)
      if (i != 1) order.emplace_back(paintsOtherwise && i == 7 ? 1.2f : panes[i].z, alone[i]);
    for (const float z : {0.6f, -0.6f}) {
      TestScene s;
      TestMesh half;
      append(half, grid(z), z > 0 ? glm::vec4(0.2f, 0.7f, 0.3f, 0.5f) : glm::vec4(0.9f, 0.8f, 0.1f, 0.7f));
      s.add(half, s.material(blended(TestScene::colored("Colours", {1, 1, 1, 1}))));
      const Scene scene = s.load();
      order.emplace_back(z, draw(scene, look, viewsFrom(scene, {{0, 0, 5}}, kWidth, kHeight, GetParam()),
                                 sized(kWidth, kHeight, {"lit"})));
    }
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (size_t v = 0; v < viewCount(); ++v) {
      Difference rgb(8 * kByte), coverage(4 * kByte);
      for (int y = 8; y < kHeight - 8; ++y)
        for (int x = 20; x < kWidth - 20; ++x) {
          Composite composite;
          for (const auto& [z, frame] : order) composite.over(texel(aov(frame, "lit", v), x, y));
          expectComposite(texel(aov(all, "lit", v), x, y), composite, rgb, coverage);
        }
      EXPECT_LT(rgb.beyondPart(), 0.002) << rgb.text();
      EXPECT_LT(coverage.beyondPart(), 0.002) << coverage.text();
    }
  }
}

// What counts of a triangle is its middle, whichever corner its list begins with: of two long ones that lead
// away from the eye, one has it behind a small one between their ends, one before that.
TEST_P(OrderTest, trianglesCountByTheirMiddles) {
  const glm::vec4 longColor(0.9f, 0.2f, 0.1f, 0.5f), smallColor(0.1f, 0.3f, 0.9f, 0.5f);
  for (const bool isBehind : {true, false})
    for (uint32_t first = 0; first < 3; ++first) {
      // In the plane x = z / 8 nearly, seen from its side; one end alone lies on the other side of the small
      // one.
      const float near = 2, far = -2;
      TestMesh leads, square = gridMesh({-0.4f, -0.4f, 0}, {0.8f, 0, 0}, {0, 0.8f, 0}, 1);
      leads.positions =
          isBehind ? std::vector<glm::vec3>{{0.1f, 0.02f, near}, {-1.2f, -1.2f, far}, {1.4f, -1.2f, far}}
                   : std::vector<glm::vec3>{{0.1f, 0.02f, far}, {-0.5f, -0.6f, near}, {0.6f, -0.6f, near}};
      leads.normals.assign(3, {0, 0, 1});
      leads.uvs.assign(3, {0, 0});
      for (uint32_t i = 0; i < 3; ++i) leads.indices.push_back((first + i) % 3);
      TestScene s;
      s.add(leads, s.material(blended(TestScene::unlit("Long", longColor))));
      s.add(square, s.material(blended(TestScene::unlit("Small", smallColor))));
      const Scene scene = s.load();
      const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
      const Frame frame =
          draw(scene, quietLook({{"light.shadowWarp", "0"}}), views, sized(kWidth, kHeight, {"lit"}));
      Composite both;
      for (const bool isLong : {isBehind, !isBehind}) {
        const glm::dvec4 color(isLong ? longColor : smallColor);
        both.over(glm::sqrt(glm::dvec3(color)), color.a);
      }
      size_t covered = 0;
      Difference rgb(3 * kByte), coverage(3 * kByte);
      for (size_t v = 0; v < viewCount(); ++v)
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) {
            const glm::dvec4 there = texel(aov(frame, "lit", v), x, y);
            if (there.w < 0.7) continue;  // both
            ++covered;
            expectComposite(there, both, rgb, coverage);
          }
      EXPECT_GT(covered, 40 * viewCount());
      EXPECT_LT(rgb.beyondPart(), 0.01) << isBehind << ", from corner " << first << ": " << rgb.text();
    }
}

// More textures than a shader has take several draws.
TEST_P(OrderTest, manyTextures) {
  constexpr int kPanes = 30;
  const auto colorOf = [](int i) {
    const int row = i / 4 % 4, block = i / 16;
    return glm::vec4(float(i % 4) / 3, float(row) / 3, float(block) / 2, 0.7f);
  };
  TestScene s;
  for (int i = 0; i < kPanes; ++i) {
    Json json = TestScene::unlit("Pane " + std::to_string(i), {1, 1, 1, 1});
    const glm::vec4 c = colorOf(i);
    json["pbrMetallicRoughness"]["baseColorTexture"]["index"] = s.texture(solid(c));
    const int row = i / 6;
    s.add(gridMesh({-1.5f + 0.5f * float(i % 6), -1 + 0.4f * float(row), 0}, {0.45f, 0, 0}, {0, 0.35f, 0}),
          s.material(blended(json)));
  }
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 5}}, kWidth, kHeight, GetParam());
  const Frame frame = draw(scene, quietLook(), views, sized(kWidth, kHeight, {"lit"}));
  for (size_t v = 0; v < viewCount(); ++v)
    for (int i = 0; i < kPanes; ++i) {
      const int row = i / 6;
      const glm::dvec3 middle(-1.275 + 0.5 * (i % 6), -0.825 + 0.4 * row, 0);
      const glm::ivec2 at(pixelOf(views[v], middle, kWidth, kHeight));
      const glm::dvec4 got = texel(aov(frame, "lit", v), at.x, at.y);
      const glm::vec4 expected = colorOf(i);
      EXPECT_NEAR(got.w, expected.a, 2 * kByte) << i;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(std::sqrt(got[c]), std::sqrt(expected[c]), 6 * kByte) << i;
    }
}

// The same over each other: groups lie over each other as what is in them does.
TEST_P(OrderTest, manyTexturesOverEachOther) {
  constexpr int kPanes = 20;
  for (const bool nearestFirst : {false, true}) {
    TestScene s;
    Composite composite;
    std::vector<glm::vec4> colors;
    for (int i = 0; i < kPanes; ++i) {
      const int row = i / 4 % 4, block = i / 16;
      colors.push_back({float(i % 4) / 3, float(row) / 3, float(block) / 2, 0.4f});
    }
    for (int i = 0; i < kPanes; ++i) {
      Json json = TestScene::unlit("Pane " + std::to_string(i), {1, 1, 1, 1});
      json["pbrMetallicRoughness"]["baseColorTexture"]["index"] = s.texture(solid(colors[size_t(i)]));
      const float z = 0.1f * float(nearestFirst ? kPanes - i : i);
      s.add(gridMesh({-1, -1, z}, {2, 0, 0}, {0, 2, 0}), s.material(blended(json)));
    }
    for (int i = 0; i < kPanes; ++i) {
      const glm::dvec4 c(colors[size_t(nearestFirst ? kPanes - 1 - i : i)]);
      composite.over(glm::sqrt(glm::dvec3(c)), c.a);
    }
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0, 0, 6}}, kWidth, kHeight, GetParam());
    const Frame frame =
        draw(scene, quietLook({{"light.shadowWarp", "0"}}), views, sized(kWidth, kHeight, {"lit"}));
    for (size_t v = 0; v < viewCount(); ++v) {
      const glm::dvec4 got = texel(aov(frame, "lit", v), kWidth / 2, kHeight / 2);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(std::sqrt(got[c]), composite.root()[c], 12 * kByte) << nearestFirst;
    }
  }
}

// Pictures that the look paints on them, or gives them as colours, are those that an opaque surface gets.
TEST_P(OrderTest, looksPaintAndColorThem) {
  const auto drawn = [&](bool isBlended, const Knobs& knobs) {
    TestScene s;
    Json json = TestScene::colored("Pane", {0.4f, 0.5f, 0.2f, isBlended ? 0.6f : 1.0f});
    s.add(gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 2), s.material(isBlended ? blended(json) : json));
    const Scene scene = s.load();
    return draw(scene, quietLook(knobs), viewsFrom(scene, {{0, 0, 5}}, kWidth, kHeight, GetParam()),
                sized(kWidth, kHeight, {"lit"}));
  };
  const Frame plain = drawn(true, {});
  const Knobs painted{{"materials.Pane.texture.amount", "1"}, {"materials.Pane.texture.blend", "replace"}};
  const Frame got = drawn(true, painted), expected = drawn(false, painted);
  for (size_t v = 0; v < viewCount(); ++v) {
    Difference same(4 * kByte);
    double changed = 0;
    for (int y = 20; y < kHeight - 20; ++y)
      for (int x = 30; x < kWidth - 30; ++x)
        for (int c = 0; c < 3; ++c) {
          const double root = std::sqrt(texel(aov(got, "lit", v), x, y)[c]);
          same.add(root, std::sqrt(texel(aov(expected, "lit", v), x, y)[c]));
          changed += std::abs(root - std::sqrt(texel(aov(plain, "lit", v), x, y)[c]));
        }
    EXPECT_EQ(same.beyond, 0u) << same.text();
    EXPECT_GT(changed, 1) << "nothing is painted";
  }
}

// An editor's textures come and go while the same materials stay. Without the validation layers, whose
// handles are never used again.
TEST_P(OrderTest, texturesThatAreReplaced) {
  RendererOptions options;
  options.device = testDevice();
  const auto renderer = Renderer::create(options);
  ASSERT_TRUE(renderer.ok());
  SceneEditor editor("panes");
  std::vector<uint8_t> texels;
  const auto paint = [&](int i) {
    const uint32_t size = 8u << (3 * i) % 5;
    texels.assign(size_t(size) * size * 4, 255);
    for (size_t t = 0; t < texels.size(); t += 4)
      texels[t] = uint8_t(40 * i), texels[t + 1] = uint8_t(255 - 40 * i), texels[t + 3] = 200;
    return TextureDesc{"t", size, size, texels};
  };
  const Result<TextureId> texture = editor.addTexture(paint(0));
  ASSERT_TRUE(texture.ok());
  MaterialDesc material;
  material.name = "Pane";
  material.alpha = MaterialDesc::Alpha::blend;
  material.doubleSided = material.unlit = true;
  material.baseColorTexture.texture = *texture;
  const Result<MaterialId> pane = editor.addMaterial(material);
  ASSERT_TRUE(pane.ok());
  const TestMesh grid = gridMesh({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  const Result<MeshId> mesh = editor.addMesh({{.positions = grid.positions,
                                               .indices = grid.indices,
                                               .normals = grid.normals,
                                               .uv0 = grid.uvs,
                                               .material = *pane}});
  ASSERT_TRUE(mesh.ok());
  ASSERT_TRUE(editor.addNode({.name = "Pane", .mesh = *mesh}).ok());
  for (int i = 0; i < 6; ++i) {
    ASSERT_TRUE(editor.setTexture(*texture, paint(i)).ok());
    const Result<Scene> scene = editor.scene();
    ASSERT_TRUE(scene.ok());
    const auto views = viewsFrom(*scene, {{0, 0, 5}}, kWidth, kHeight, GetParam());
    for (int again = 0; again < 2; ++again) {
      const Result<Frame> frame =
          (*renderer)->render(*scene, quietLook(), 0, views, sized(kWidth, kHeight, {"lit"}));
      ASSERT_TRUE(frame.ok());
      for (size_t v = 0; v < viewCount(); ++v) {
        const glm::dvec4 got = texel(aov(*frame, "lit", v), kWidth / 2, kHeight / 2);
        EXPECT_NEAR(srgbCode(got.r), 40 * i, 6) << i;
        EXPECT_NEAR(srgbCode(got.g), 255 - 40 * i, 6) << i;
      }
    }
  }
}

// Frames of one scene, alone and after others from elsewhere, are the same to the byte.
TEST_P(OrderTest, sameBytesWhateverWasDrawnBefore) {
  TestScene s;
  for (int i = 0; i < 3; ++i)
    s.add(sphereMesh({0.3f * float(i), 0, 0}, 1 - 0.2f * float(i), 16),
          s.material(
              blended(TestScene::unlit("Shell " + std::to_string(i), {0.3f * float(i), 0.5f, 0.8f, 0.5f}))));
  const Scene scene = s.load();
  const auto from = [&](const glm::vec3& eye) {
    return draw(scene, quietLook(), viewsFrom(scene, {eye}, kWidth, kHeight, GetParam()),
                sized(kWidth, kHeight));
  };
  const Frame first = from({0, 1, 4});
  (void)from({4, 0, -1});
  const Frame again = from({0, 1, 4});
  for (size_t v = 0; v < viewCount(); ++v)
    EXPECT_TRUE(sameBytes(first.layers[0].views[v], again.layers[0].views[v]));
}

}  // namespace
}  // namespace scumble::passes
