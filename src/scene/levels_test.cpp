// Levels of detail against shapes whose distance is known: a sphere, and planes whose attributes bend.
#include "scene/levels.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace scumble::scene {
namespace {

// A unit square of so many cells in the plane z = 0.
Primitive grid(int cells) {
  Primitive p;
  for (int y = 0; y <= cells; ++y)
    for (int x = 0; x <= cells; ++x) {
      p.positions.push_back({float(x) / float(cells), float(y) / float(cells), 0});
      p.normals.push_back({0, 0, 1});
      p.uv0.push_back(glm::vec2(p.positions.back()));
    }
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const uint32_t i = uint32_t(y * (cells + 1) + x), up = i + uint32_t(cells) + 1;
      p.indices.insert(p.indices.end(), {i, i + 1, up + 1, i, up + 1, up});
    }
  return p;
}

// A unit sphere, by wrapping a grid around it.
Primitive sphere(int cells) {
  Primitive p = grid(cells);
  for (size_t v = 0; v < p.positions.size(); ++v) {
    const float phi = 6.2831853f * p.uv0[v].x, theta = 3.1415926f * (0.02f + 0.96f * p.uv0[v].y);
    p.positions[v] = {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
    p.normals[v] = p.positions[v];
  }
  return p;
}

std::vector<uint32_t> indicesOf(const Primitive& p, const DetailLevel& level) {
  return {p.levelIndices.begin() + level.firstIndex,
          p.levelIndices.begin() + level.firstIndex + level.indexCount};
}

void expectValid(const Primitive& p) {
  size_t before = p.indices.size(), next = 0;
  float error = 0, textureError = 0, shadowError = 0;
  EXPECT_LE(p.levels.size(), kMaxLevels);
  for (const DetailLevel& level : p.levels) {
    EXPECT_EQ(level.firstIndex, next);
    EXPECT_EQ(level.indexCount % 3, 0u);
    EXPECT_LE(level.indexCount, before * 3 / 4);
    EXPECT_GT(level.indexCount, 0u);
    EXPECT_GE(level.error, error);
    EXPECT_GE(level.textureError, textureError);
    EXPECT_GE(level.shadowError, shadowError);
    EXPECT_GE(level.error, level.shadowError);
    float longest = 0;
    const std::vector<uint32_t> indices = indicesOf(p, level);
    for (size_t i = 0; i < indices.size(); ++i) {
      ASSERT_LT(indices[i], p.vertexCount());
      longest = std::max(
          longest, glm::distance(p.positions[indices[i]], p.positions[indices[i - i % 3 + (i + 1) % 3]]));
    }
    EXPECT_FLOAT_EQ(level.longestEdge, longest);
    next = level.firstIndex + level.indexCount, before = level.indexCount;
    error = level.error, textureError = level.textureError, shadowError = level.shadowError;
  }
  EXPECT_EQ(next, p.levelIndices.size());
}

TEST(DetailLevels, ofASphereSayHowFarTheyLieInside) {
  Primitive p = sphere(96);
  makeLevels(p);
  expectValid(p);
  ASSERT_GE(p.levels.size(), 3u);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> number(0, 1);
  for (const DetailLevel& level : p.levels) {
    const std::vector<uint32_t> indices = indicesOf(p, level);
    std::vector<float> depths;
    for (size_t t = 0; t < indices.size(); t += 3)
      for (int sample = 0; sample < 8; ++sample) {
        float u = number(random), v = number(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const glm::vec3 point = (1 - u - v) * p.positions[indices[t]] + u * p.positions[indices[t + 1]] +
                                v * p.positions[indices[t + 2]];
        depths.push_back(1 - glm::length(point));
      }
    std::sort(depths.begin(), depths.end());
    EXPECT_LT(depths[depths.size() * 95 / 100], level.shadowError) << level.indexCount;
  }
  // Nor are they said to be many times worse than they are.
  EXPECT_LT(p.levels[0].error, 0.02f);
  EXPECT_LT(p.levels[1].error, 0.1f);
}

// Each level is made of the one before it, and strays from that: what it strays from the mesh may be the sum.
TEST(DetailLevels, errorsAddUp) {
  Primitive p = sphere(128);
  for (glm::vec3& at : p.positions) at *= 1 + 0.05f * std::sin(9 * at.x) * std::sin(7 * at.y + 2 * at.z);
  makeLevels(p);
  ASSERT_GE(p.levels.size(), 3u);
  const float scale = meshopt_simplifyScale(&p.positions[0].x, p.positions.size(), sizeof(glm::vec3));
  std::vector<uint32_t> before = p.indices;
  float sum = 0, last = 0;
  for (const DetailLevel& level : p.levels) {
    std::vector<uint32_t> now(before.size());
    float error = 0;
    meshopt_simplify(now.data(), before.data(), before.size(), &p.positions[0].x, p.positions.size(),
                     sizeof(glm::vec3), level.indexCount, 1.0f, meshopt_SimplifyLockBorder, &error);
    if (error > 0.1f) break;  // a shape that hardly is one any more
    sum += last = error * scale;
    EXPECT_GE(level.shadowError, 0.9f * sum) << level.indexCount;
    EXPECT_GE(level.error, 0.9f * sum) << level.indexCount;
    before = indicesOf(p, level);
  }
  EXPECT_GT(sum, 1.2f * last) << "the sum says more than its last part";
}

// Another primitive may go on where one has an open border: no vertex of that may go.
TEST(DetailLevels, leaveBordersAlone) {
  constexpr int kCells = 64;
  Primitive p = grid(kCells);
  for (glm::vec3& at : p.positions) at.x += 1e-3f * std::sin(40 * at.y), at.z = 1e-3f * std::sin(30 * at.x);
  makeLevels(p);
  expectValid(p);
  ASSERT_FALSE(p.levels.empty());
  for (const DetailLevel& level : p.levels) {
    std::vector<bool> isUsed(p.vertexCount());
    for (const uint32_t v : indicesOf(p, level)) isUsed[v] = true;
    for (uint32_t v = 0; v < p.vertexCount(); ++v) {
      const uint32_t x = v % (kCells + 1), y = v / (kCells + 1);
      if (x == 0 || y == 0 || x == kCells || y == kCells) {
        EXPECT_TRUE(isUsed[v]) << x << ", " << y;
      }
    }
  }
}

// Of what is painted by vertices the smallest spot counts.
TEST(DetailLevels, leaveOutNoSpotOfColour) {
  for (uint32_t spot = 0; spot < 65 * 65; spot += 271) {
    Primitive p = grid(64);
    p.colors.assign(p.vertexCount(), {200, 200, 180, 255});
    p.colors[spot] = {120, 20, 20, 255};
    makeLevels(p);
    for (const DetailLevel& level : p.levels) {
      const std::vector<uint32_t> indices = indicesOf(p, level);
      if (std::find(indices.begin(), indices.end(), spot) != indices.end()) continue;
      EXPECT_GT(level.error, 0.01f) << spot;
      EXPECT_LT(level.shadowError, 0.01f) << spot;
    }
  }
}

// A vertex that all triangles share, and triangles that are all the same: finding fewer would take as long as
// the square of their number.
TEST(DetailLevels, ofFansThereAreNone) {
  Primitive fan = grid(4);
  const glm::vec3 normal = fan.normals[0];
  for (uint32_t i = 0; i < 100'000; ++i) {
    const float angle = 6e-5f * float(i);
    fan.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    fan.normals.push_back(normal);
    fan.uv0.emplace_back(fan.positions.back());
  }
  const auto last = uint32_t(fan.positions.size() - 1);
  fan.smoothNormals.assign(fan.positions.size(), normal);
  Primitive same = fan;
  fan.indices.clear(), same.indices.clear();
  for (uint32_t v = 30; v < last; ++v) {
    fan.indices.insert(fan.indices.end(), {0, v, v + 1});
    same.indices.insert(same.indices.end(), {0, 40, 90});
  }
  for (Primitive* p : {&fan, &same}) {
    makeLevels(*p);
    EXPECT_TRUE(p->levels.empty());
  }
}

TEST(DetailLevels, ofAPlaneAreOffByNothing) {
  Primitive p = grid(64);
  makeLevels(p);
  expectValid(p);
  ASSERT_FALSE(p.levels.empty());
  EXPECT_LT(p.levels.back().error, 1e-3f);
}

// What lies on a plane counts, though the plane is where it was: half of it is mapped twice as densely.
TEST(DetailLevels, countWhatIsDrawnOnTheSurface) {
  const auto bend = [](float x) { return x < 0.5f ? x : 2 * x - 0.5f; };
  const auto levelsWith = [](const std::function<void(Primitive&)>& change) {
    Primitive p = grid(64);
    change(p);
    makeLevels(p);
    expectValid(p);
    return p.levels;
  };
  // Textures count where there are any; patterns by an eighth of their slide.
  const auto uv = levelsWith([&](Primitive& p) {
    for (glm::vec2& at : p.uv0) at.x = bend(at.x);
  });
  EXPECT_GT(uv.back().textureError, 0.05f);
  EXPECT_NEAR(uv.back().error, 0.125f * uv.back().textureError, 1e-3f);
  EXPECT_LT(uv.back().shadowError, 1e-3f);
  const auto pattern = levelsWith([&](Primitive& p) {
    for (const glm::vec2& at : p.uv0) p.patternUv.push_back({bend(at.x), at.y});
  });
  EXPECT_GT(pattern.back().error, 0.125f * 0.05f);
  EXPECT_LT(pattern.back().textureError, 1e-3f);
  EXPECT_LT(pattern.back().shadowError, 1e-3f);
  const auto colors = levelsWith([&](Primitive& p) {
    for (const glm::vec2& at : p.uv0)
      p.colors.push_back(at.x < 0.4f ? glm::u8vec4(255) : glm::u8vec4(0, 0, 0, 255));
  });
  EXPECT_GT(colors.back().error, 0.02f);
  EXPECT_LT(colors.back().shadowError, 1e-3f);
  // Light moves by sixteen times as much before it counts as much.
  const auto light = levelsWith([&](Primitive& p) {
    for (size_t v = 0; v < p.normals.size(); ++v) {
      const float turn = 3 * bend(p.uv0[v].x);
      p.normals[v] = {std::sin(turn), 0, std::cos(turn)};
    }
  });
  EXPECT_GT(light.back().error, 0.02f);
  EXPECT_LT(light.back().error, 0.0625f * std::sqrt(2.0f) + 1e-3f);
  EXPECT_LT(light.back().shadowError, 1e-3f);
}

// What bends is off by where joints and targets take it, as well as by where it rests.
TEST(DetailLevels, countWhatJointsAndTargetsDo) {
  const auto levelsWith = [](const std::function<void(Primitive&)>& change) {
    Primitive p = grid(64);
    p.extent.box.add(glm::vec3(0)), p.extent.box.add(glm::vec3(1, 1, 0));
    change(p);
    makeLevels(p);
    expectValid(p);
    EXPECT_FALSE(p.levels.empty());
    return p.levels;
  };
  // Two joints, of which the second takes over at a place: at once, or evenly all along.
  const auto skinned = [&](const std::function<float(float)>& share) {
    return levelsWith([&](Primitive& p) {
      p.influences = 4;
      for (const glm::vec3& at : p.positions) {
        p.joints.insert(p.joints.end(), {3, 7, 0, 0});
        p.weights.insert(p.weights.end(), {1 - share(at.x), share(at.x), 0, 0});
      }
    });
  };
  const auto even = skinned([](float x) { return x; });
  EXPECT_LT(even.back().error, 1e-3f);
  EXPECT_LT(even.back().shadowError, 1e-3f);
  const auto sudden = skinned([](float x) { return x < 0.4f ? 0.0f : 1.0f; });
  EXPECT_GT(sudden.back().error, 0.05f);
  EXPECT_GT(sudden.back().shadowError, 0.05f);
  // The same for who numbers joints otherwise, and has some twice.
  const auto twice = levelsWith([](Primitive& p) {
    p.influences = 8;
    for (size_t v = 0; v < p.positions.size(); ++v) {
      const bool turned = v % 2 == 1;
      for (int k = 0; k < 8; ++k) p.joints.push_back(uint16_t(turned ? 9 - k : 2 + k));
      for (int k = 0; k < 8; ++k) p.weights.push_back(0.125f);
    }
  });
  EXPECT_LT(twice.back().error, 1e-3f);

  const auto morphed = [&](const std::function<float(const glm::vec3&)>& up) {
    return levelsWith([&](Primitive& p) {
      p.morphTargets.resize(2);  // of which one has nothing to say of positions
      for (const glm::vec3& at : p.positions) p.morphTargets[1].positions.push_back({0, 0, up(at)});
    });
  };
  EXPECT_LT(morphed([](const glm::vec3& at) { return 2 * at.x; }).back().error, 1e-3f);
  const auto bumps =
      morphed([](const glm::vec3& at) { return 0.2f * std::sin(12 * at.x) * std::sin(9 * at.y); });
  EXPECT_GT(bumps.back().error, 0.05f);
  EXPECT_GT(bumps.back().shadowError, 0.05f);
}

TEST(DetailLevels, areForWhatHasMany) {
  Primitive few = grid(11);
  makeLevels(few);
  EXPECT_TRUE(few.levels.empty());
  // Made anew, not added to.
  Primitive p = sphere(32);
  makeLevels(p);
  const std::vector<uint32_t> before = p.levelIndices;
  makeLevels(p);
  EXPECT_EQ(p.levelIndices, before);
}

// Hostile: all vertices in one place, triangles without area, vertices that no triangle has.
TEST(DetailLevels, degenerateMeshes) {
  for (const glm::vec3 size : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(1e-20f), glm::vec3(1e18f)}) {
    Primitive p = grid(40);
    for (glm::vec3& position : p.positions) position *= size;
    makeLevels(p);
    for (const DetailLevel& level : p.levels) {
      EXPECT_TRUE(std::isfinite(level.error) && level.error >= 0);
      EXPECT_TRUE(std::isfinite(level.longestEdge));
    }
  }
  // A ribbon that nearly all goes away.
  Primitive ribbon;
  for (uint32_t i = 0; i < 200000; ++i) {
    const uint32_t column = i / 2;
    ribbon.positions.push_back(
        {0.01f * float(column), float(i % 2), i < 100000 ? 0.0f : 0.1f * float(i % 3)});
    ribbon.normals.push_back({0, 0, 1}), ribbon.uv0.push_back({0, 0});
    if (i >= 2) ribbon.indices.insert(ribbon.indices.end(), {i - 2, i - 1, i});
  }
  makeLevels(ribbon);
  Primitive p = grid(40);
  for (int i = 0; i < 5000; ++i)
    p.positions.push_back({5, 5, 5}), p.normals.push_back({0, 0, 1}), p.uv0.push_back({0, 0});
  makeLevels(p);
  for (const DetailLevel& level : p.levels) EXPECT_TRUE(std::isfinite(level.error));
}

}  // namespace
}  // namespace scumble::scene
