// Every way in which numbers can lie in a buffer, seen from the outside: the positions, colours and indices
// that come out of a scene.
#include <gtest/gtest.h>

#include <functional>

#include "scene/scene_data.h"
#include "tests/support/loaded_test_gltf.h"

namespace scumble::scene {
namespace {

const Primitive& first(const Scene& scene) {
  static const Primitive none;
  return scene.data().meshes.empty() ? none : scene.data().meshes[0]->primitives[0];
}

const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

template <class T>
std::vector<T> convert(const std::vector<float>& values, float scale, size_t padFrom3To = 3) {
  std::vector<T> result;
  for (size_t i = 0; i < values.size(); ++i) {
    result.push_back(static_cast<T>(values[i] * scale));
    if (i % 3 == 2) result.resize(result.size() + padFrom3To - 3);
  }
  return result;
}

template <class T>
void expectTriangle(int componentType, float scale, bool normalized, float expected) {
  TestGltf g;
  const int view = g.addView(convert<T>(kTriangle, scale, 4), 4 * sizeof(T));
  g.addMesh({{"POSITION", g.addAccessor(view, componentType, "VEC3", 3, normalized)}});
  const Scene scene = loaded(g.glb());
  ASSERT_EQ(first(scene).vertexCount(), 3u);
  EXPECT_FLOAT_EQ(first(scene).positions[1].x, expected);
  EXPECT_FLOAT_EQ(first(scene).positions[2].y, expected);
}

TEST(GltfAccessor, readsEveryComponentTypeAndNormalisation) {
  expectTriangle<int8_t>(5120, 127, false, 127);
  expectTriangle<int8_t>(5120, -128, true, -1);
  expectTriangle<uint8_t>(5121, 255, true, 1);
  expectTriangle<uint8_t>(5121, 7, false, 7);
  expectTriangle<int16_t>(5122, -32767, true, -1);
  expectTriangle<int16_t>(5122, -300, false, -300);
  expectTriangle<uint16_t>(5123, 65535, true, 1);
  expectTriangle<uint16_t>(5123, 1000, false, 1000);
  expectTriangle<float>(5126, 2.5f, false, 2.5f);
}

TEST(GltfAccessor, readsInterleavedVertices) {
  TestGltf g;
  const std::vector<float> both = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1};
  const int view = g.addView(both, 24);
  g.addMesh({{"POSITION", g.addAccessor(view, 5126, "VEC3", 3)},
             {"NORMAL", g.addAccessor(view, 5126, "VEC3", 3, false, 12)}});
  const Scene scene = loaded(g.gltf());
  EXPECT_EQ(first(scene).positions[2], glm::vec3(0, 1, 0));
  EXPECT_EQ(first(scene).normals[1], glm::vec3(0, 0, 1));
  EXPECT_FALSE(first(scene).generatedNormals);
}

TEST(GltfAccessor, sparseValuesReplaceElementsAlsoWithoutABase) {
  for (const bool withBase : {true, false}) {
    for (const int type : {5121, 5123, 5125}) {
      TestGltf g;
      const int position = withBase ? g.addFloats(kTriangle, 3) : g.addAccessor(-1, 5126, "VEC3", 3);
      const int indices = type == 5121   ? g.addView<uint8_t>({1, 2})
                          : type == 5123 ? g.addView<uint16_t>({1, 2})
                                         : g.addView<uint32_t>({1, 2});
      const int values = g.addView<float>({5, 0, 0, 0, 6, 0});
      g.json["accessors"][position]["sparse"] = {
          {"count", 2},
          {"indices", {{"bufferView", indices}, {"componentType", type}}},
          {"values", {{"bufferView", values}}}};
      g.addMesh({{"POSITION", position}});
      const Scene scene = loaded(g.gltf());
      ASSERT_EQ(first(scene).vertexCount(), 3u) << type;
      EXPECT_EQ(first(scene).positions[1], glm::vec3(5, 0, 0)) << type;
      EXPECT_EQ(first(scene).positions[2], glm::vec3(0, 6, 0)) << type;
    }
  }
}

TEST(GltfAccessor, readsEveryIndexType) {
  const std::vector<float> square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  for (const int type : {5121, 5123, 5125}) {
    TestGltf g;
    const int indices = type == 5121   ? g.add(std::vector<uint8_t>{0, 1, 2, 0, 2, 3}, type, "SCALAR", 1)
                        : type == 5123 ? g.add(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, type, "SCALAR", 1)
                                       : g.add(std::vector<uint32_t>{0, 1, 2, 0, 2, 3}, type, "SCALAR", 1);
    g.addMesh({{"POSITION", g.addFloats(square, 3)}}, indices);
    EXPECT_EQ(loaded(g.glb()).summary().triangles, 2u);
  }
}

TEST(GltfAccessor, coloursOfEveryKind) {
  const auto colorOf = [](const std::function<int(TestGltf&)>& add) {
    TestGltf g;
    const int position = g.addFloats(kTriangle, 3);
    g.addMesh({{"POSITION", position}, {"COLOR_0", add(g)}});
    const Scene scene = loaded(g.glb());
    return first(scene).colors.empty() ? glm::u8vec4(0) : first(scene).colors[0];
  };
  EXPECT_EQ(colorOf([](TestGltf& g) {
              return g.addFloats({1, 0, 0.5f, 0, 0, 0, 0, 0, 0}, 3);
            }),
            glm::u8vec4(255, 0, 128, 255));
  EXPECT_EQ(
      colorOf([](TestGltf& g) {
        return g.add(std::vector<uint8_t>{10, 20, 30, 40, 0, 0, 0, 0, 0, 0, 0, 0}, 5121, "VEC4", 4, true);
      }),
      glm::u8vec4(10, 20, 30, 40));
  EXPECT_EQ(colorOf([](TestGltf& g) {
              return g.add(std::vector<uint16_t>{65535, 0, 257, 65535, 0, 0, 0, 0, 0, 0, 0, 0}, 5123, "VEC4",
                           4, true);
            }),
            glm::u8vec4(255, 0, 1, 255));
}

TEST(GltfAccessor, stripsAndFansBecomeLists) {
  const std::vector<float> square = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  TestGltf strip;
  strip.addMesh({{"POSITION", strip.addFloats(square, 3)}})["mode"] = 5;
  const Scene stripped = loaded(strip.glb());
  EXPECT_EQ(stripped.summary().triangles, 2u);
  for (const glm::vec3& normal : first(stripped).normals) EXPECT_GT(normal.z, 0.99f);

  TestGltf fan;
  fan.addMesh({{"POSITION", fan.addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3)}})["mode"] = 6;
  const Scene fanned = loaded(fan.glb());
  EXPECT_EQ(fanned.summary().triangles, 2u);
  for (const glm::vec3& normal : first(fanned).normals) EXPECT_GT(normal.z, 0.99f);
}

TEST(GltfAccessor, onlyVerticesInUseAreKept) {
  TestGltf g;
  std::vector<float> many(3 * 1000, 100.0f);
  std::copy(kTriangle.begin(), kTriangle.end(), many.begin() + 3 * 500);
  const std::vector<float> normals = [] {
    std::vector<float> n;
    for (int i = 0; i < 1000; ++i) n.insert(n.end(), {0, 0, 1});
    return n;
  }();
  const int position = g.addFloats(many, 3), normal = g.addFloats(normals, 3);
  g.addMesh({{"POSITION", position}, {"NORMAL", normal}}, g.addIndices({500, 501, 502}));
  const Scene scene = loaded(g.glb());
  EXPECT_EQ(first(scene).vertexCount(), 3u);
  EXPECT_LT(scene.summary().max[0], 2.0);
}

}  // namespace
}  // namespace scumble::scene
