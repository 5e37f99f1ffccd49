// Fins: what lies across edges is laid flat without gaps, splats come by the shortest way and in order, fins
// go over into each other, nothing bleeds in the atlas; and a bake that was cut off goes on.
#include "scumble/bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "bake/atlas.h"
#include "bake/capture.h"
#include "bake/checkpoint.h"
#include "bake/fins.h"
#include "bake/hull.h"
#include "bake/orders.h"
#include "base/mipmaps.h"
#include "scene/painting.h"
#include "scumble/paint.h"
#include "scumble/scene.h"
#include "tests/support/animated_scene.h"
#include "tests/support/asset_files.h"
#include "tests/support/posed_scene.h"
#include "tests/support/scene_files.h"
#include "tests/support/test_scene.h"

namespace scumble::bake {
namespace {

using namespace test;

std::string contentOf(const std::string& path) {
  std::stringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

TestScene painted(const TestMesh& mesh, const std::vector<TestStroke>& strokes) {
  TestScene s;
  s.add(mesh, s.material(TestScene::colored("Skin", {0.5f, 0.5f, 0.5f, 1})));
  s.paint(strokes);
  return s;
}

// A floor and a wall, whose common edge is the z axis's, from squares of a half.
TestMesh corner(float wallLeansBy = 0) {
  TestMesh mesh = gridMesh({-1, 0, 1}, {1, 0, 0}, {0, 0, -2}, 4);
  const TestMesh wall = gridMesh({0, 0, 1}, {wallLeansBy, -1, 0}, {0, 0, -2}, 4);
  const auto first = uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), wall.positions.begin(), wall.positions.end());
  mesh.normals.insert(mesh.normals.end(), wall.normals.begin(), wall.normals.end());
  mesh.uvs.insert(mesh.uvs.end(), wall.uvs.begin(), wall.uvs.end());
  for (const uint32_t index : wall.indices) mesh.indices.push_back(first + index);
  return mesh;
}

// One mesh with everything up to its captures.
struct Baked {
  Baked(const TestScene& test, float texel, const BakeOptions& given = {})
      : scene(test.load()),
        mesh(scene.data().meshes[0]),
        options(given),
        proxy(makeProxy(mesh)),
        capturedTexel(texel) {
    size_t left = 0;
    splats = hungSplats(*mesh.painting, proxy, options, 10, left);
    shell = makeShell(proxy, splats, std::vector<float>(mesh.primitives.size(), 0.0f));
    fins = makeFins(proxy, shell);
    capture = std::make_unique<Capture>(proxy, shell, splats, options, texel);
  }
  Scene scene;
  const scene::Mesh& mesh;
  BakeOptions options;
  Proxy proxy;
  std::vector<Splat> splats;
  Shell shell;
  std::vector<Fin> fins;
  float capturedTexel;  // metres
  std::unique_ptr<Capture> capture;

  // Of a coat, square root of colour and opacity, at a place of space over a triangle.
  glm::vec4 coatAt(size_t triangle, const glm::vec3& place) const {
    const ProxyTriangle& t = proxy.triangles[triangle];
    const Chart& chart = proxy.charts[t.chart];
    const Tile tile = capture->coat(t.chart, -INFINITY, INFINITY);
    if (tile.width == 0) return glm::vec4(0);
    const glm::vec3 from = place - proxy.places[t.places[0]];
    const glm::vec2 p = t.flat[0] + glm::vec2(glm::dot(from, t.axisX), glm::dot(from, t.axisY));
    const glm::vec2 texel = (p - chart.low) / capturedTexel;
    const int x = int(std::floor(texel.x)) + kGutter,
              y = int(tile.height) - 1 - kGutter - int(std::floor(texel.y));
    const uint8_t* const c = &tile.rgba[4 * (size_t(y) * tile.width + size_t(x))];
    return {float(c[0]) / 255, float(c[1]) / 255, float(c[2]) / 255, float(c[3]) / 255};
  }
};

TEST(BakeProxy, whatLiesAcrossAnEdgeIsLaidFlatBesideIt) {
  TestScene s;
  s.add(sphereMesh({0, 0, 0}, 1, 16), s.material(TestScene::colored("Skin", {1, 1, 1, 1})));
  const Scene scene = s.load();
  const Proxy proxy = makeProxy(scene.data().meshes[0]);
  size_t crossings = 0, quads = 0;
  for (size_t t = 0; t < proxy.triangles.size(); ++t) {
    const ProxyTriangle& triangle = proxy.triangles[t];
    for (size_t i = 0; i < 3; ++i) {
      // Lengths stay, and so does the side from which it is seen.
      const size_t k = (i + 1) % 3;
      EXPECT_NEAR(glm::distance(triangle.flat[i], triangle.flat[k]),
                  glm::distance(proxy.places[triangle.places[int(i)]], proxy.places[triangle.places[int(k)]]),
                  1e-5f);
      if (triangle.across[i] < 0) continue;
      ++crossings;
      const ProxyTriangle& other = proxy.triangles[size_t(triangle.across[i])];
      for (const size_t end : {i, k})
        for (int c = 0; c < 3; ++c)
          if (other.places[c] == triangle.places[int(end)]) {
            EXPECT_LT(glm::distance(triangle.into[i](triangle.flat[end]), other.flat[size_t(c)]), 1e-5f);
          }
      // The rest of it lies on the other side of the edge.
      const auto side = [&](const glm::vec2& p, const glm::vec2& a, const glm::vec2& b) {
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      };
      const glm::vec2 a = triangle.into[i](triangle.flat[i]), b = triangle.into[i](triangle.flat[k]);
      EXPECT_GT(side(triangle.into[i](triangle.flat[(i + 2) % 3]), a, b), 0);
      for (int c = 0; c < 3; ++c)
        if (other.places[c] != triangle.places[int(i)] && other.places[c] != triangle.places[int(k)]) {
          EXPECT_LT(side(other.flat[size_t(c)], a, b), 0);
        }
    }
    const glm::vec2 u = triangle.flat[1] - triangle.flat[0], v = triangle.flat[2] - triangle.flat[0];
    EXPECT_GT(u.x * v.y - u.y * v.x, 0);
  }
  // Closed: every triangle has three neighbours. Between the poles all are quads.
  EXPECT_EQ(crossings, 3 * proxy.triangles.size());
  for (const Chart& chart : proxy.charts) quads += chart.triangles[1] >= 0;
  EXPECT_GT(2 * quads, proxy.triangles.size() * 4 / 5);
  size_t turned = 0;
  for (const ProxyTriangle& t : proxy.triangles)
    for (size_t e = 0; e < 3; ++e)
      turned += glm::dot(t.into[e].turned(t.field), proxy.triangles[size_t(t.across[e])].field) < 0.5f;
  // A field on a sphere has places where it does not go on; they are few.
  EXPECT_LT(turned, crossings / 20);
}

TEST(BakeProxy, brokenSurfacesAreNone) {
  // Three sheets at one edge, a triangle without area, two wound against each other.
  TestMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {2, 0, 0}};
  mesh.normals.assign(6, {0, 0, 1});
  mesh.uvs.assign(6, {0, 0});
  mesh.indices = {0, 1, 2, 0, 1, 3, 1, 0, 4, 0, 1, 5, 0, 2, 1};
  TestScene s;
  s.add(mesh, s.material(TestScene::colored("Skin", {1, 1, 1, 1})));
  const Scene scene = s.load();
  const Proxy proxy = makeProxy(scene.data().meshes[0]);
  EXPECT_EQ(proxy.triangles.size(), 4u);
  for (size_t t = 0; t < proxy.triangles.size(); ++t)
    for (size_t e = 0; e < 3; ++e) {
      const int other = proxy.triangles[t].across[e];
      if (other < 0) continue;
      const auto& back = proxy.triangles[size_t(other)].across;
      EXPECT_NE(std::find(back.begin(), back.end(), int(t)), back.end());
    }
}

TEST(BakeFins, goOverIntoTheStraightestNeighbour) {
  const Baked baked(
      painted(gridMesh({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 4), {{{{-1.8f, 0.3f, 0}, {1.8f, 0.3f, 0}}}}),
      0.05f);
  const std::vector<bool> all(baked.proxy.edges.size(), true);
  size_t straight = 0;
  for (uint32_t p = 0; p < baked.proxy.places.size(); ++p) {
    std::vector<bool> upright = all;
    for (size_t e = 0; e < all.size(); ++e) upright[e] = !baked.proxy.edges[e].isDiagonal;
    const std::vector<uint32_t> matched = matchedEdges(baked.proxy, p, upright);
    const std::vector<uint32_t>& edges = baked.proxy.edgesAt[p];
    for (size_t i = 0; i < edges.size(); ++i) {
      if (matched[i] == ~0u) continue;
      const auto along = [&](uint32_t e) {
        const ProxyEdge& edge = baked.proxy.edges[e];
        return baked.proxy.places[edge.b] - baked.proxy.places[edge.a];
      };
      // Of a grid's edges all go straight on, and each of two is the other's.
      EXPECT_GT(std::abs(glm::dot(glm::normalize(along(edges[i])), glm::normalize(along(matched[i])))),
                0.999f);
      const size_t k = size_t(std::find(edges.begin(), edges.end(), matched[i]) - edges.begin());
      EXPECT_EQ(matched[k], edges[i]);
      ++straight;
    }
  }
  EXPECT_GT(straight, 40u);
  // Around a ball normals of fins that follow each other are the same where they meet.
  std::vector<TestStroke> strokes;
  for (int i = 0; i < 12; ++i) {
    const float a = float(i) * 0.5236f;
    strokes.push_back(
        {{{1.1f * std::cos(a), -0.5f, 1.1f * std::sin(a)}, {1.2f * std::cos(a), 0.5f, 1.2f * std::sin(a)}}});
  }
  const Baked ball(painted(sphereMesh({0, 0, 0}, 1, 16), strokes), 0.05f);
  std::vector<bool> hasFin(ball.proxy.edges.size());
  std::vector<const Fin*> finOf(ball.proxy.edges.size());
  for (const Fin& fin : ball.fins) hasFin[fin.edge] = true, finOf[fin.edge] = &fin;
  size_t shared = 0;
  for (uint32_t p = 0; p < ball.proxy.places.size(); ++p) {
    const std::vector<uint32_t> matched = matchedEdges(ball.proxy, p, hasFin);
    for (size_t i = 0; i < matched.size(); ++i) {
      const uint32_t e = ball.proxy.edgesAt[p][i];
      if (matched[i] == ~0u) continue;
      const size_t k =
          size_t(std::find(ball.proxy.edgesAt[p].begin(), ball.proxy.edgesAt[p].end(), matched[i]) -
                 ball.proxy.edgesAt[p].begin());
      if (matched[k] != e) continue;
      const auto normalAt = [&](uint32_t edge) {
        return finOf[edge]->matched[ball.proxy.edges[edge].a == p ? 0 : 1];
      };
      EXPECT_GT(std::abs(glm::dot(normalAt(e), normalAt(matched[i]))), 0.9999f);
      ++shared;
    }
  }
  EXPECT_GT(shared, 100u);
}

// (FORMULAS 20.) A stroke over the edge of a wall that hangs down: the part beside it lies around the edge,
// as far from it as the stroke is wide; straight projection would not have it there at all.
TEST(BakeCapture, splatsComeByTheShortestWayOverEdges) {
  const Baked baked(painted(corner(), {{{{-0.05f, 0.0f, 0.8f}, {-0.05f, 0.0f, -0.8f}}, 0.25f, {1, 0, 0, 1}}}),
                    0.01f);
  size_t floorHits = 0, wallHits = 0;
  for (size_t t = 0; t < baked.proxy.triangles.size(); ++t) {
    const ProxyTriangle& triangle = baked.proxy.triangles[t];
    const bool isWall = std::abs(triangle.normal.x) > 0.9f;
    // Beside the edge, at z = 0.1: on the wall down to where 0.25 metres from the stroke's middle are over.
    for (const float away : {0.02f, 0.12f, 0.17f, 0.23f, 0.3f}) {
      const glm::vec3 place = isWall ? glm::vec3(0, -away, 0.1f) : glm::vec3(-away, 0, 0.1f);
      glm::vec2 in;
      const glm::vec3 from = place - baked.proxy.places[triangle.places[0]];
      in = triangle.flat[0] + glm::vec2(glm::dot(from, triangle.axisX), glm::dot(from, triangle.axisY));
      bool isInside = true;
      for (size_t i = 0; i < 3; ++i) {
        const glm::vec2 e = triangle.flat[(i + 1) % 3] - triangle.flat[i], d = in - triangle.flat[i];
        isInside &= e.x * d.y - e.y * d.x > 1e-3f;
      }
      if (!isInside) continue;
      const float distance = isWall ? away + 0.05f : std::abs(away - 0.05f);
      const glm::vec4 color = baked.coatAt(t, place);
      EXPECT_NEAR(color.a,
                  distance < 0.235f   ? 1.0f
                  : distance > 0.265f ? 0.0f
                                      : color.a,
                  0.05f)
          << (isWall ? "wall " : "floor ") << away;
      (isWall ? wallHits : floorHits) += 1;
    }
  }
  EXPECT_GE(wallHits, 4u);
  EXPECT_GE(floorHits, 4u);
}

TEST(BakeCapture, whatIsHigherLiesOnTopAndOfEqualsTheLater) {
  const glm::vec4 red(1, 0, 0, 1), blue(0, 0, 1, 1);
  const auto stroke = [](float height, const glm::vec4& color) {
    return TestStroke{{{-0.5f, height, 0.1f}, {0.5f, height, 0.1f}}, 0.2f, color};
  };
  const auto seen = [&](const std::vector<TestStroke>& strokes) {
    const Baked baked(painted(gridMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 2), strokes), 0.02f);
    for (size_t t = 0; t < baked.proxy.triangles.size(); ++t) {
      const ProxyTriangle& triangle = baked.proxy.triangles[t];
      glm::vec3 middle(0);
      for (int c = 0; c < 3; ++c) middle += baked.proxy.places[triangle.places[c]] / 3.0f;
      if (middle.x > 0 && middle.z > 0) return baked.coatAt(t, {0.2f, 0, 0.12f});
    }
    return glm::vec4(0);
  };
  EXPECT_GT(seen({stroke(0.5f, red), stroke(0.1f, blue)}).r, 0.9f);
  EXPECT_GT(seen({stroke(0.1f, red), stroke(0.5f, blue)}).b, 0.9f);
  EXPECT_GT(seen({stroke(0.3f, red), stroke(0.3f, blue)}).b, 0.9f);
  EXPECT_GT(seen({stroke(0.3f, blue), stroke(0.3f, red)}).r, 0.9f);
}

// A stroke that is seen along itself is as many splats upon each other as its length has, of which those
// count that a sine of 0.15 leaves: no more than lie over each other elsewhere by as much.
TEST(BakeCapture, strokesThatStandUpAreNoDenserThanTheyAreDrawn) {
  const float opacity = 0.5f, radius = 0.12f, length = 1.5f;
  const auto seen = [&](const glm::vec3& direction) {
    BakeOptions options;
    const Baked baked(painted(gridMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 2),
                              {{{{0.2f, 0.02f, 0.12f}, glm::vec3(0.2f, 0.02f, 0.12f) + length * direction},
                                radius,
                                {1, 0, 0, opacity}}}),
                      0.01f, options);
    for (size_t t = 0; t < baked.proxy.triangles.size(); ++t) {
      const ProxyTriangle& triangle = baked.proxy.triangles[t];
      glm::vec3 middle(0);
      for (int c = 0; c < 3; ++c) middle += baked.proxy.places[triangle.places[c]] / 3.0f;
      if (middle.x > 0 && middle.z > 0)
        return std::pair(
            baked.coatAt(t, glm::vec3(0.2f, 0, 0.12f) + 0.25f * glm::vec3(direction.x, 0, direction.z)),
            options.spacing);
    }
    return std::pair(glm::vec4(0), 0.0f);
  };
  const auto [lying, spacing] = seen({1, 0, 0});
  EXPECT_NEAR(lying.a, opacity, 0.04);
  // Two radii of it are as opaque as the stroke; of one that stands, a splat counts in 1 / 0.15 of its
  // length.
  const float between = spacing / 0.15f;  // radii
  const float expected = 1 - std::pow(1 - opacity, 0.5f * spacing * (length / radius / between));
  const float standing = seen({0, 1, 0}).first.a;
  EXPECT_NEAR(standing, expected, 0.12);
  EXPECT_LT(standing, 0.8f * (1 - std::pow(1 - opacity, 0.5f * length / radius)));
}

// A blade that stands on an edge is in its fin, where it stands and as high.
TEST(BakeCapture, finsShowWhatStandsOnThem) {
  const Baked baked(painted(gridMesh({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 2),
                            {{{{-0.5f, 0.05f, 0}, {-0.5f, 0.8f, 0}}, 0.06f, {0, 1, 0, 1}}}),
                    0.01f);
  size_t found = 0;
  for (const Fin& fin : baked.fins) {
    const ProxyEdge& edge = baked.proxy.edges[fin.edge];
    const glm::vec3 &a = baked.proxy.places[edge.a], &b = baked.proxy.places[edge.b];
    if (std::abs(a.z) > 0.1f || std::abs(b.z) > 0.1f || std::min(a.x, b.x) > -0.6f) continue;
    float top = 1;
    const Tile tile = baked.capture->fin(fin, top);
    ASSERT_GT(tile.width, 0u);
    const float height = top * baked.shell.offsets[edge.a];
    EXPECT_GT(height, 0.7f);
    const auto opaqueAt = [&](float s, float y) {
      const int x = kGutter + int(s * float(tile.width - 2 * kGutter));
      const int row = int(tile.height) - 1 - kGutter - int(y / height * float(tile.height - 2 * kGutter));
      return tile.rgba[4 * (size_t(row) * tile.width + size_t(x)) + 3];
    };
    EXPECT_GT(opaqueAt(0.5f, 0.1f), 240);
    EXPECT_GT(opaqueAt(0.5f, 0.5f), 240);
    EXPECT_EQ(opaqueAt(0.3f, 0.3f), 0);
    EXPECT_EQ(opaqueAt(0.7f, 0.5f), 0);
    ++found;
  }
  EXPECT_EQ(found, 1u);
}

TEST(BakeAtlas, tilesNeitherOverlapNorBleed) {
  std::vector<glm::uvec2> sizes;
  for (uint32_t i = 0; i < 200; ++i) sizes.emplace_back(5 + i * 7 % 40, 3 + i * 13 % 60);
  sizes[17] = {0, 0};
  const std::optional<Packing> packing = pack(sizes, 256, 2048);
  ASSERT_TRUE(packing);
  std::vector<uint8_t> taken(size_t(packing->width) * packing->height);
  for (size_t i = 0; i < sizes.size(); ++i)
    for (uint32_t y = 0; y < sizes[i].y; ++y)
      for (uint32_t x = 0; x < sizes[i].x; ++x) {
        uint8_t& here = taken[size_t(packing->at[i].y + y) * packing->width + packing->at[i].x + x];
        EXPECT_EQ(here, 0);
        here = 1;
      }
  EXPECT_FALSE(pack(sizes, 32, 2048));
  EXPECT_FALSE(pack(sizes, 256, 64));

  // Red and blue ones, the first halves of which are empty: down to an eighth of the size no level has
  // violet, nor any colour of what is not there.
  std::vector<Tile> tiles;
  for (size_t i = 0; i < sizes.size(); ++i) {
    Tile tile{sizes[i].x, sizes[i].y, std::vector<uint8_t>(size_t(sizes[i].x) * sizes[i].y * 4)};
    for (uint32_t y = 0; y < sizes[i].y; ++y)
      for (uint32_t x = sizes[i].x / 2; x < sizes[i].x; ++x) {
        uint8_t* const texel = &tile.rgba[4 * (size_t(y) * sizes[i].x + x)];
        texel[i % 2 ? 0 : 2] = 255, texel[3] = 255;
      }
    tiles.push_back(std::move(tile));
  }
  const Pixels atlas = assemble(*packing, tiles);
  const auto levels = makeMipmaps(atlas.rgba, atlas.width, atlas.height);
  for (size_t level = 0; level < 3; ++level)
    for (size_t i = 0; i < tiles.size(); ++i)
      for (uint32_t y = 0; y < sizes[i].y >> (level + 1); ++y)
        for (uint32_t x = 0; x < sizes[i].x >> (level + 1); ++x) {
          const size_t at = size_t((packing->at[i].y >> (level + 1)) + y) * (atlas.width >> (level + 1)) +
                            (packing->at[i].x >> (level + 1)) + x;
          const uint8_t* const texel = &levels[level][4 * at];
          EXPECT_GT(texel[i % 2 ? 0 : 2], 250) << level;
          EXPECT_LT(texel[i % 2 ? 2 : 0], 5) << level;
        }
  // Up to the grid a tile's border goes on, so that no level has anything else beside it.
  const auto upToGrid = [](uint32_t texels) { return (texels + kAtlasGrid - 1) / kAtlasGrid * kAtlasGrid; };
  for (size_t i = 0; i < tiles.size(); ++i)
    for (uint32_t y = 0; y < upToGrid(sizes[i].y); ++y)
      for (uint32_t x = 0; x < upToGrid(sizes[i].x); ++x) {
        if (x < sizes[i].x && y < sizes[i].y) continue;
        const auto texelAt = [&](uint32_t column, uint32_t row) {
          return &atlas.rgba[4 * (size_t(packing->at[i].y + row) * atlas.width + packing->at[i].x + column)];
        };
        const uint8_t* const border = texelAt(std::min(x, sizes[i].x - 1), std::min(y, sizes[i].y - 1));
        EXPECT_TRUE(std::equal(border, border + 4, texelAt(x, y))) << i << ": " << x << ", " << y;
      }
  // It is a picture.
  EXPECT_GT(pngOf(atlas).size(), 100u);
}

// Around a shell of strokes lies one closed surface, close to them; a single sheet has two sides.
TEST(BakeOrders, areFromFarToNearOfAllTriangles) {
  gltf::PaintPart coat, fins;
  for (int i = 0; i < 30; ++i) {
    const auto at = [&](int c) {
      return glm::vec3((7 * i + c) % 11, (5 * i + 3 * c) % 13, (3 * i + c) % 17);
    };
    gltf::PaintPart& part = i % 3 == 0 ? fins : coat;
    for (int c = 0; c < 3; ++c)
      part.indices.push_back(uint32_t(part.positions.size())), part.positions.push_back(at(c));
  }
  const std::vector<gltf::PaintPart> parts{coat, fins};
  std::vector<glm::vec3> all = coat.positions;
  all.insert(all.end(), fins.positions.begin(), fins.positions.end());
  for (const int count : {0, 6, 8, 14}) {
    const std::vector<glm::vec3> directions = orderDirections(count);
    ASSERT_EQ(directions.size(), size_t(count));
    for (size_t i = 0; i < directions.size(); ++i) {
      EXPECT_NEAR(glm::length(directions[i]), 1, 1e-6);
      for (size_t j = 0; j < i; ++j) EXPECT_LT(glm::dot(directions[i], directions[j]), 0.6f);
      const std::vector<uint32_t> order = orderedTowards(parts, directions[i]);
      ASSERT_EQ(order.size(), 90u);
      std::vector<uint32_t> seen = order;
      std::sort(seen.begin(), seen.end());
      float last = -1e9f;
      for (uint32_t t = 0; t < 30; ++t) {
        for (uint32_t c = 0; c < 3; ++c) EXPECT_EQ(seen[3 * t + c], 3 * t + c);
        EXPECT_EQ(order[3 * t + 1], order[3 * t] + 1) << "triangles stay whole";
        float nearness = 0;
        for (uint32_t c = 0; c < 3; ++c) nearness += glm::dot(all[order[3 * t + c]], directions[i]);
        EXPECT_GE(nearness, last);
        last = nearness;
      }
    }
  }
  EXPECT_TRUE(orderDirections(7).empty());
}

TEST(BakeHull, liesOnTheOutsideOfStrokes) {
  std::vector<TestStroke> around;
  for (int i = 0; i < 24; ++i) {
    TestStroke ring{{}, 0.2f};
    for (int k = 0; k <= 32; ++k) {
      const float a = 0.19635f * float(k), h = std::sin(0.129f * (float(i) - 11.5f)),
                  r = std::sqrt(1 - h * h);
      ring.points.push_back({r * std::cos(a), h, r * std::sin(a)});
    }
    around.push_back(ring);
  }
  TestScene s;
  s.addStrokes(around);
  const Scene scene = s.load();
  scene::Mesh mesh;
  mesh.primitives.push_back(hullOf(*scene.data().meshes[0]->painting, 24));
  const scene::Primitive& hull = mesh.primitives[0];
  ASSERT_GT(hull.indices.size(), 3000u);
  for (const glm::vec3& p : hull.positions) EXPECT_NEAR(glm::length(p), 1, 0.3f);
  const Proxy proxy = makeProxy(mesh);
  size_t open = 0;
  double volume = 0;
  for (const ProxyTriangle& t : proxy.triangles) {
    for (const int other : t.across) open += other < 0;
    volume +=
        glm::dot(glm::dvec3(proxy.places[t.places[0]]),
                 glm::cross(glm::dvec3(proxy.places[t.places[1]]), glm::dvec3(proxy.places[t.places[2]]))) /
        6;
  }
  EXPECT_LT(double(open), 0.02 * double(proxy.triangles.size()));
  // Of a ball, from outside, and not of a shell.
  EXPECT_GT(volume, 3.3);
  EXPECT_LT(volume, 7.0);
}

TestScene furryBall() {
  TestScene s;
  s.add(sphereMesh({0, 0, 0}, 1, 12), s.material(TestScene::colored("Fur", {0.7f, 0.3f, 0.1f, 1})));
  return s;
}

TEST(Bake, aCutOffBakeGoesOnAndEndsTheSame) {
  const SceneFiles files(furryBall().text());
  PaintOptions paint;
  paint.style = "fur", paint.splats = 4000;
  const std::string painting = files.folder.file("painted.glb");
  ASSERT_TRUE(paintScene(files.scene, painting, paint));
  BakeOptions options;
  options.textureSize = 512;
  const Result<BakeReport> whole = bakeFins(painting, files.out, options);
  ASSERT_TRUE(whole) << whole.error().message();
  EXPECT_EQ(whole->meshes, 1u);
  EXPECT_EQ(whole->resumed, 0u);
  EXPECT_GT(whole->fins, 50u);
  EXPECT_LE(whole->textureWidth, 512u);
  const std::string expected = contentOf(files.out);

  const std::string again = files.folder.file("again.glb");
  options.threads = 1;
  ASSERT_TRUE(bakeFins(painting, again, options));
  EXPECT_EQ(contentOf(again), expected);
  options.threads = 0;
  std::filesystem::remove(again);
  options.progress = [](double part) { return part < 0.5; };
  const Result<BakeReport> cut = bakeFins(painting, again, options);
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().kind, ErrorKind::cancelled);
  EXPECT_FALSE(std::filesystem::exists(again));
  ASSERT_TRUE(std::filesystem::exists(again + ".part"));
  // Cut off in the middle of a piece, and of other options: neither harms.
  std::filesystem::resize_file(again + ".part", std::filesystem::file_size(again + ".part") - 7);
  options.progress = {};
  const std::string kept = contentOf(again + ".part");
  const Result<BakeReport> resumed = bakeFins(painting, again, options);
  ASSERT_TRUE(resumed) << resumed.error().message();
  EXPECT_GT(resumed->resumed, 20u);
  EXPECT_EQ(contentOf(again), expected);
  EXPECT_FALSE(std::filesystem::exists(again + ".part"));
  // Somebody else's file of that name stays.
  std::ofstream(again + ".part", std::ios::binary) << "a letter";
  ASSERT_TRUE(bakeFins(painting, again, options));
  EXPECT_EQ(contentOf(again + ".part"), "a letter");
  std::ofstream(again + ".part", std::ios::binary) << kept;
  options.variation = 0.5f;
  const Result<BakeReport> other = bakeFins(painting, again, options);
  ASSERT_TRUE(other);
  EXPECT_EQ(other->resumed, 0u);
  EXPECT_NE(contentOf(again), expected);
}

TEST(Bake, whatComesOutHoldsWhatMoves) {
  // Joints and morph targets go along.
  const SceneFiles files(troupe().text());
  PaintOptions paint;
  paint.splats = 3000;
  const std::string painting = files.folder.file("painted.glb");
  const Result<PaintReport> report = paintScene(files.scene, painting, paint);
  ASSERT_TRUE(report) << report.error().message();
  BakeOptions options;
  options.textureSize = 512;
  options.layers = 2;
  const Result<BakeReport> baked = bakeFins(painting, files.out, options);
  ASSERT_TRUE(baked) << baked.error().message();
  const Result<Scene> before = Scene::load(painting), after = Scene::load(files.out);
  ASSERT_TRUE(after) << after.error().message();
  EXPECT_TRUE(after->warnings().empty()) << after->warnings().front();
  size_t layers = 0;
  for (size_t m = 0; m < after->data().meshes.size(); ++m) {
    const scene::Mesh &mesh = after->data().meshes[m], &own = before->data().meshes[m];
    EXPECT_FALSE(mesh.painting);
    for (const scene::Primitive& p : mesh.primitives) {
      const scene::Material& material = after->data().materials[size_t(p.material)];
      if (!material.paint) continue;
      ++layers;
      EXPECT_TRUE(material.unlit);
      EXPECT_EQ(material.alphaMode, scene::AlphaMode::blend);
      EXPECT_EQ(material.paint->fades, material.doubleSided);
      EXPECT_EQ(p.influences, own.primitives[0].influences);
      EXPECT_EQ(p.morphTargets.size(), own.primitives[0].morphTargets.size());
    }
  }
  EXPECT_GE(layers, 2u);
}

// Where all vertices of a primitive are in a pose.
std::vector<glm::dvec3> placesOf(const PosedPrimitive& posed) {
  std::vector<glm::dvec3> places;
  for (size_t v = 0; v < posed.primitive->positions.size(); ++v) {
    glm::dvec3 place(posed.primitive->positions[v]);
    for (size_t t = 0; t < posed.morphWeights.size() && t < posed.primitive->morphTargets.size(); ++t)
      if (const auto& moved = posed.primitive->morphTargets[t].positions; !moved.empty())
        place += posed.morphWeights[t] * glm::dvec3(moved[v]);
    places.emplace_back(posed.toWorld[v] * glm::dvec4(place, 1));
  }
  return places;
}

// Coats and the feet of fins lie close to vertices of the surface. Whatever the pose, they stay as close to
// the same ones. Gives how far these have moved at the most.
double expectPaintStays(const scene::SceneData& data, const Moments& moments, const std::string& what) {
  const std::vector<PosedPrimitive> atRest = posedPrimitives(data, {}),
                                    posed = posedPrimitives(data, moments);
  double most = 0;
  size_t feet = 0, strays = 0;
  for (size_t p = 0; p < atRest.size(); ++p) {
    const scene::Material& material = data.materials[size_t(atRest[p].primitive->material)];
    if (!material.paint) continue;
    std::vector<glm::dvec3> surface, moved;
    for (size_t q = 0; q < atRest.size(); ++q) {
      if (atRest[q].id != atRest[p].id || data.materials[size_t(atRest[q].primitive->material)].paint)
        continue;
      for (const glm::dvec3& place : placesOf(atRest[q])) surface.push_back(place);
      for (const glm::dvec3& place : placesOf(posed[q])) moved.push_back(place);
    }
    const std::vector<glm::dvec3> paint = placesOf(atRest[p]), paintMoved = placesOf(posed[p]);
    for (size_t v = 0; v < paint.size(); ++v) {
      if (material.isFin() && v % 4 >= 2) continue;  // its upper corners
      double before = 1e9, after = 1e9;
      for (const glm::dvec3& place : surface) before = std::min(before, glm::distance(place, paint[v]));
      // Several vertices may lie in one place, and go to several.
      for (size_t q = 0; q < surface.size(); ++q)
        if (glm::distance(surface[q], paint[v]) <= 1.01 * before + 1e-6) {
          after = std::min(after, glm::distance(moved[q], paintMoved[v]));
          most = std::max(most, glm::distance(moved[q], surface[q]));
        }
      ++feet, strays += after > 1.5 * before + 1e-4;
    }
  }
  EXPECT_GT(feet, 10u) << what;
  // Where forms touch, a vertex of another one may lie as close.
  EXPECT_LE(strays, feet / 40) << what;
  return most;
}

TEST(Bake, paintMovesWithTheSurface) {
  const auto baked = [](const std::string& scene, uint32_t splats) {
    const TestFolder folder;
    PaintOptions paint;
    paint.style = "fur", paint.splats = splats;
    const Result<PaintReport> report = paintScene(scene, folder.file("painted.glb"), paint);
    if (!report) throw std::runtime_error(report.error().message());
    BakeOptions options;
    options.textureSize = 2048;
    const Result<BakeReport> done = bakeFins(folder.file("painted.glb"), folder.file("fins.glb"), options);
    if (!done) throw std::runtime_error(done.error().message());
    return Scene::load(folder.file("fins.glb")).value();
  };
  const SceneFiles files(troupe().text());
  const Scene players = baked(files.scene, 3000);
  double most = 0;
  for (size_t clip = 0; clip < players.data().clips.size(); ++clip)
    for (const double part : {0.3, 0.7})
      most = std::max(most, expectPaintStays(players.data(),
                                             {{clip, part * double(players.data().clips[clip].duration), 1}},
                                             "clip " + std::to_string(clip)));
  EXPECT_GT(most, 0.1);

  // Real ones: the bee with its own clips; the cat and the panda with those that were made for their
  // skeleton.
  const auto asset = [](const char* name) { return kAssets / "gltf/characters" / name; };
  if (!std::filesystem::exists(asset("m2m-fox-animations.glb")))
    GTEST_SKIP() << "no characters below " << kAssets;
  const Scene actions = Scene::load(asset("m2m-fox-animations.glb").string()).value();
  for (const char* name : {"q-Bee.glb", "m2m-fox-cat.glb", "m2m-fox-panda.glb"}) {
    scene::SceneData data = baked(asset(name).string(), 20000).data();
    if (data.clips.empty()) {
      data.clips = actions.data().clips;
      for (scene::Clip& clip : data.clips) {
        std::vector<scene::Channel> known;
        for (scene::Channel& channel : clip.channels) {
          const std::string& node = actions.data().nodes[channel.node].name;
          const auto found = std::find_if(data.nodes.begin(), data.nodes.end(),
                                          [&](const scene::Node& n) { return n.name == node; });
          if (found == data.nodes.end()) continue;
          channel.node = uint32_t(found - data.nodes.begin());
          known.push_back(channel);
        }
        clip.channels = known;
      }
    }
    double moves = 0;
    for (const size_t clip : {size_t(0), data.clips.size() / 2})
      moves =
          std::max(moves, expectPaintStays(data, {{clip, 0.4 * double(data.clips[clip].duration), 1}}, name));
    EXPECT_GT(moves, 0.1) << name;
  }
}

TEST(Bake, whatCannotBeBakedSaysWhy) {
  const auto problemOf = [](const std::string& text, const BakeOptions& options = {}) {
    const SceneFiles files(text);
    const Result<BakeReport> report = bakeFins(files.scene, files.out, options);
    EXPECT_FALSE(std::filesystem::exists(files.out) && !report);
    return report ? std::string() : report.error().problem;
  };
  EXPECT_NE(problemOf(furryBall().text()).find("no strokes"), std::string::npos);
  // In the empty air; and far away from a surface.
  TestScene air;
  air.addStrokes({{{{0, 0, 0}, {1, 0, 0}}}});
  EXPECT_EQ(problemOf(air.text()), "");  // gets a hull
  const TestScene far = painted(sphereMesh({0, 0, 0}, 1, 8), {{{{0, 900, 0}, {1, 900, 0}}}});
  EXPECT_NE(problemOf(far.text()).find("no surface"), std::string::npos);
  const TestScene good = painted(sphereMesh({0, 0, 0}, 1, 8), {{{{0, 1, 0}, {0.2f, 1, 0}}}});
  EXPECT_EQ(problemOf(good.text()), "");
  // A million splats of one point, and none of a stroke without length.
  std::vector<TestStroke> heap(300, TestStroke{{{0, 1, 0}}});
  EXPECT_EQ(problemOf(painted(sphereMesh({0, 0, 0}, 1, 8), heap).text()), "");
  BakeOptions options;
  options.textureSize = 63;
  EXPECT_NE(problemOf(good.text(), options).find("size"), std::string::npos);
  options = {};
  options.layers = 17;
  EXPECT_NE(problemOf(good.text(), options).find("layers"), std::string::npos);
  options = {};
  options.fadeStart = 0.2f, options.fadeEnd = 0.3f;
  EXPECT_NE(problemOf(good.text(), options).find("fade"), std::string::npos);
  options = {};
  options.orders = 7;
  EXPECT_NE(problemOf(good.text(), options).find("orders"), std::string::npos);
  options = {};
  options.parts = {{"Nobody"}};
  EXPECT_NE(problemOf(good.text(), options).find("Nobody"), std::string::npos);
}

}  // namespace
}  // namespace scumble::bake
