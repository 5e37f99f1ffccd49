// Meshes as broken files have them, in looks that draw their edges and spread points over them: a picture,
// and a warning.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scumble/look.h"
#include "tests/support/aov.h"
#include "tests/support/loaded_test_gltf.h"
#include "tests/support/render_test.h"

namespace scumble::test {
namespace {

class BadMeshes : public BothEyes {
 protected:
  // Of every such look: something is drawn, of finite numbers, the same again.
  void expectPictures(const scene::TestGltf& file, bool warns) {
    const Scene scene = scene::loaded(file);
    EXPECT_EQ(!scene.warnings().empty(), warns);
    const auto views = viewsFrom(scene, {{1.5f, 1.2f, 3}, {0.3f, 0.2f, 0}, 40, 0, 0.05f}, 96, 72, GetParam());
    for (const ShippedLook& shipped : Look::shipped()) {
      if (shipped.name != "ink-wash" && shipped.name != "technical" && shipped.name != "watercolour")
        continue;
      Look look = Look::load(shipped.name).value();
      ASSERT_TRUE(look.set("ground.mode", "off"));
      const Frame frame = draw(scene, look, views, sized(96, 72));
      expectSame(frame, draw(scene, look, views, sized(96, 72)), shipped.name);
      for (size_t v = 0; v < viewCount(); ++v) {
        const Image& picture = aov(frame, "", v);
        double least = 1e9, most = 0;
        for (const float value : picture.pixels) {
          ASSERT_TRUE(std::isfinite(value)) << shipped.name;
          least = std::min(least, double(value)), most = std::max(most, double(value));
        }
        EXPECT_GT(most - least, 0.1) << shipped.name;
      }
    }
  }
};

TEST_P(BadMeshes, manyTrianglesAtAnEdge) {
  scene::TestGltf g;
  // Five around one edge, one of them three times and once the other way around; some without area.
  std::vector<float> places = {0, -0.5f, 0, 0, 0.7f, 0, 0, 0.1f, 0};
  std::vector<uint16_t> indices;
  for (int i = 0; i < 5; ++i) {
    places.insert(places.end(), {float(std::cos(i * 1.2)), 0.1f, float(std::sin(i * 1.2))});
    indices.insert(indices.end(), {0, 1, uint16_t(3 + i)});
  }
  indices.insert(indices.end(), {0, 1, 3, 0, 1, 3, 1, 0, 3, 0, 1, 2, 4, 4, 4, 0, 0, 5});
  g.addMesh({{"POSITION", g.addFloats(places, 3)}}, g.addIndices(indices));
  expectPictures(g, false);
}

TEST_P(BadMeshes, numbersThatAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  scene::TestGltf g;
  const int position = g.addFloats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3);
  g.addMesh({{"POSITION", position},
             {"NORMAL", g.addFloats({nan, 0, 0, 0, inf, 0, 0, 0, 0, 0, 0, -nan}, 3)},
             {"TEXCOORD_0", g.addFloats({nan, 0, 1, inf, -inf, 1, 0, 1}, 2)},
             {"COLOR_0", g.addFloats({nan, 0, 1, inf, -inf, 1, 0, 1, 1, 0, 0, 1}, 3)},
             {"_ROUND", g.addFloats({nan, inf, -1, 7}, 1)}},
            g.addIndices({0, 1, 2, 0, 2, 3}));
  expectPictures(g, true);
}

TEST_P(BadMeshes, texturesThatAreMissing) {
  scene::TestGltf g = scene::quad();
  g.json["images"] = {{{"uri", "missing.png"}}};
  g.json["textures"] = {{{"source", 0}}};
  g.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                          {"extensions",
                           {{"VRMC_materials_mtoon",
                             {{"outlineWidthMode", "worldCoordinates"},
                              {"outlineWidthFactor", 0.05},
                              {"outlineWidthMultiplyTexture", {{"index", 0}}}}}}}}};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  expectPictures(g, true);
}

TEST_P(BadMeshes, manyIslands) {
  scene::TestGltf g;
  std::vector<float> places;
  std::vector<uint16_t> indices;
  for (int i = 0; i < 3000; ++i)
    for (int corner = 0; corner < 3; ++corner) {
      const double turn = i * 2.4, height = i / 1500.0 - 1;
      places.insert(places.end(), {float(std::cos(turn) + 0.05 * (corner == 1)),
                                   float(height + 0.05 * (corner == 2)), float(std::sin(turn))});
      indices.push_back(uint16_t(3 * i + corner));
    }
  g.addMesh({{"POSITION", g.addFloats(places, 3)}}, g.addIndices(indices));
  expectPictures(g, false);
}

INSTANTIATE_BOTH_EYES(BadMeshes);

}  // namespace
}  // namespace scumble::test
