// What is wrong with a mapping, on shapes where it is known; and that patterns run on over a file's seams.
#include "scene/mapping_faults.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scumble/scene.h"
#include "tests/support/loaded_test_gltf.h"

namespace scumble::scene {
namespace {

struct Corner {
  glm::vec3 at;
  glm::vec2 uv;
};

// A unit square of so many cells in the plane z = 0, of which each has corners of its own.
Primitive cells(int count, const std::function<glm::vec2(const glm::vec3& at, int cell)>& uvOf) {
  Primitive p;
  for (int cell = 0; cell < count * count; ++cell) {
    const auto first = uint32_t(p.positions.size());
    for (int corner = 0; corner < 4; ++corner) {
      const glm::vec3 at(float(cell % count + corner % 2) / float(count),
                         float(cell / count + corner / 2) / float(count), 0);
      p.positions.push_back(at), p.uv0.push_back(uvOf(at, cell)), p.normals.push_back({0, 0, 1});
    }
    p.indices.insert(p.indices.end(), {first, first + 1, first + 3, first, first + 3, first + 2});
  }
  return p;
}

// Around the axis y, closed by corners that lie one upon the other; 1 high, `turns` of u around.
Primitive tube(int sides, float turns) {
  Primitive p;
  for (int i = 0; i <= sides; ++i)
    for (const float y : {0.0f, 1.0f}) {
      const float part = float(i) / float(sides), angle = 6.2831853f * part;
      const glm::vec3 normal(std::cos(angle), 0, std::sin(angle));
      p.positions.push_back(0.5f * normal + glm::vec3(0, y, 0));
      p.normals.push_back(normal), p.uv0.push_back({turns * part, y});
    }
  for (uint32_t i = 0; i < uint32_t(sides); ++i)
    p.indices.insert(p.indices.end(), {2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 2, 2 * i + 1, 2 * i + 3});
  return p;
}

TEST(MappingFaults, aPlainMappingHasNone) {
  for (const float size : {1e-6f, 1.0f, 1e6f}) {
    Primitive p = cells(8, [](const glm::vec3& at, int) { return glm::vec2(at); });
    for (glm::vec3& at : p.positions) at *= size;
    const MappingFaults faults = mappingFaults(p, 1 / size);
    EXPECT_EQ(faults.unmapped, 0);
    EXPECT_EQ(faults.uneven, 0);
    EXPECT_EQ(faults.seams, 0);
    EXPECT_FALSE(faults.any());
  }
}

TEST(MappingFaults, seamsAreAsLongAsTheyAre) {
  const auto pieces = [](const glm::vec3& at, int cell) { return glm::vec2(at) + 3.0f * float(cell); };
  EXPECT_NEAR(mappingFaults(cells(8, pieces), 1).seams, 14, 1e-4);
  EXPECT_TRUE(mappingFaults(cells(8, pieces), 1).any());
  // Two halves, of which one lies elsewhere, or is turned.
  EXPECT_NEAR(mappingFaults(cells(8, [](const glm::vec3& at,
                                        int cell) { return glm::vec2(at) + (cell % 8 < 4 ? 0.0f : 5.0f); }),
                            1)
                  .seams,
              1, 1e-4);
  EXPECT_NEAR(mappingFaults(
                  cells(8, [](const glm::vec3& at,
                              int cell) { return cell % 8 < 4 ? glm::vec2(at) : glm::vec2(2 - at.y, at.x); }),
                  1)
                  .seams,
              1, 1e-4);
}

// A mapping that turns back runs on, and its pattern does not.
TEST(MappingFaults, mirrorsAreSeams) {
  for (const bool alongV : {false, true}) {
    const Primitive p = cells(8, [&](const glm::vec3& at, int) {
      return alongV ? glm::vec2(at.x, std::abs(at.y - 0.5f)) : glm::vec2(std::abs(at.x - 0.5f), at.y);
    });
    EXPECT_NEAR(mappingFaults(p, 1).seams, 1, 1e-4);
  }
  // All of it the other way around is none.
  EXPECT_EQ(mappingFaults(cells(8, [](const glm::vec3& at, int) { return glm::vec2(at.x, -at.y); }), 1).seams,
            0);
}

TEST(MappingFaults, closingOnItselfIsNone) {
  Primitive closed = tube(24, 1), open = tube(24, 0.8f);
  closed.wrapsU = true;
  EXPECT_EQ(mappingFaults(closed, 1).seams, 0);
  const double area = 24 * std::sin(3.14159265 / 24);
  EXPECT_NEAR(mappingFaults(open, 1).seams, 1 / std::sqrt(area), 1e-4);
  EXPECT_FALSE(mappingFaults(open, 1).any()) << "one seam is usual";
}

// Where a form breaks off its pattern may, too.
TEST(MappingFaults, creasesAreNone) {
  Primitive p = cells(2, [](const glm::vec3& at, int cell) { return glm::vec2(at) + 3.0f * float(cell); });
  EXPECT_NEAR(mappingFaults(p, 1).seams, 2, 1e-4);
  for (glm::vec3& at : p.positions) at.z = std::abs(at.x - 0.5f);  // a roof: of 90 degrees
  EXPECT_NEAR(mappingFaults(p, 1).seams, std::sqrt(2) / std::sqrt(std::sqrt(2)), 1e-4)
      << "along its slopes alone";
}

TEST(MappingFaults, unevenIsMoreThanFourTimes) {
  const auto denser = [](float by) {
    return mappingFaults(
        cells(8, [=](const glm::vec3& at, int cell) { return glm::vec2(at) * (cell % 8 < 2 ? by : 1.0f); }),
        1);
  };
  EXPECT_EQ(denser(3.5f).uneven, 0);
  EXPECT_NEAR(denser(5).uneven, 0.25, 1e-3);
  EXPECT_NEAR(denser(0.2f).uneven, 0.25, 1e-3);
}

TEST(MappingFaults, linesAreUnmapped) {
  const Primitive p = cells(8, [](const glm::vec3& at, int cell) {
    return cell % 8 < 4 ? glm::vec2(at) : cell % 8 < 6 ? glm::vec2(0.3f) : glm::vec2(at.x);
  });
  const MappingFaults faults = mappingFaults(p, 1);
  EXPECT_NEAR(faults.unmapped, 0.5, 1e-4);
  EXPECT_TRUE(faults.isMissing());
}

TEST(MappingFaults, hostileMeshes) {
  for (const glm::vec3& size : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(1e18f), glm::vec3(1e-30f)}) {
    Primitive p = cells(4, [](const glm::vec3& at, int) { return 1e30f * glm::vec2(at); });
    for (glm::vec3& at : p.positions) at *= size;
    const MappingFaults faults = mappingFaults(p, 1);
    EXPECT_TRUE(std::isfinite(faults.seams) && std::isfinite(faults.uneven) &&
                std::isfinite(faults.unmapped));
  }
  EXPECT_FALSE(mappingFaults(Primitive(), 1).any());
}

// A file's square of 8 x 8 cells, in one piece or in many, or without a mapping.
Scene square(PatternCoordinates which, bool inPieces, bool mapped = true) {
  const Primitive p = cells(8, [&](const glm::vec3& at, int cell) {
    return glm::vec2(at) * 0.5f + (inPieces ? glm::vec2(0.37f, 0.11f) * float(cell) : glm::vec2(0));
  });
  TestGltf g;
  std::vector<float> positions, normals, uvs;
  for (size_t v = 0; v < p.vertexCount(); ++v) {
    positions.insert(positions.end(), {p.positions[v].x, p.positions[v].y, p.positions[v].z});
    normals.insert(normals.end(), {0, 0, 1});
    uvs.insert(uvs.end(), {p.uv0[v].x, p.uv0[v].y});
  }
  nlohmann::json attributes{{"POSITION", g.addFloats(positions, 3)}, {"NORMAL", g.addFloats(normals, 3)}};
  if (mapped) attributes["TEXCOORD_0"] = g.addFloats(uvs, 2);
  g.addMesh(attributes, g.addIndices(std::vector<uint16_t>(p.indices.begin(), p.indices.end())));
  SceneOptions options;
  options.patternCoordinates = which;
  return loaded(g, options);
}

TEST(PatternCoordinates, runOnOverTheSeamsOfAFile) {
  using enum PatternCoordinates;
  const auto patternOf = [](const Scene& scene) {
    return scene.data().meshes[0]->primitives[0].patternCoordinates();
  };
  const auto uvOf = [](const Scene& scene) { return scene.data().meshes[0]->primitives[0].uv0; };
  const std::vector<glm::vec2> made = patternOf(square(automatic, false, false));
  const struct {
    PatternCoordinates which;
    bool inPieces, follows;
  } cases[] = {{automatic, false, true}, {automatic, true, false}, {file, true, true},
               {file, false, true},      {own, true, false},       {own, false, false}};
  for (const auto& [which, inPieces, follows] : cases) {
    const Scene scene = square(which, inPieces);
    EXPECT_EQ(patternOf(scene), follows ? uvOf(scene) : made) << int(which) << inPieces;
    EXPECT_EQ(scene.summary().ownPatterns, follows ? 0u : 1u);
    // Textures stay where they are.
    EXPECT_EQ(uvOf(scene), uvOf(square(file, inPieces)));
  }
}

}  // namespace
}  // namespace scumble::scene
