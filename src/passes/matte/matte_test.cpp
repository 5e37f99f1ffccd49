// Mattes against samples of the geometry, taken on the CPU and interpolated in double precision; and against
// the picture, which they are to fit wherever its edges are torn.
#include <algorithm>
#include <cmath>
#include <map>

#include "tests/support/aov.h"
#include "tests/support/displaced.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"
#include "tests/support/test_device.h"

namespace scumble::passes {
namespace {

using namespace test;

using Coverages = std::map<int, double>;  // by object's number

class MatteTest : public BothEyes {
 protected:
  static constexpr int kWidth = 160, kHeight = 120;

  // What a pixel lists; fails where its order or its sum are not as promised.
  static Coverages listed(const Image& matte, int x, int y) {
    Coverages list;
    double sum = 0, last = 1;
    int lastNumber = 0;
    for (uint32_t rank = 0; rank < 4; ++rank) {
      const float number = matte.at(uint32_t(x), uint32_t(y), 2 * rank);
      const double coverage = matte.at(uint32_t(x), uint32_t(y), 2 * rank + 1);
      EXPECT_EQ(number, std::floor(number));
      EXPECT_EQ(number > 0, coverage > 0);
      EXPECT_LE(coverage, last);
      if (number > 0) {
        if (coverage == last) {
          EXPECT_GT(number, lastNumber);
        }
        EXPECT_TRUE(list.emplace(int(number), coverage).second) << "object " << number << " twice";
      }
      sum += coverage, last = coverage, lastNumber = int(number);
    }
    EXPECT_LE(sum, 1.0);
    return list;
  }

  static double sumOf(const Coverages& list) {
    double sum = 0;
    for (const auto& [number, coverage] : list) sum += coverage;
    return sum;
  }

  // Largest difference of any object's coverage.
  static double difference(const Coverages& a, const Coverages& b) {
    double most = 0;
    const auto of = [](const Coverages& list, int number) {
      const auto it = list.find(number);
      return it == list.end() ? 0.0 : it->second;
    };
    for (const Coverages* list : {&a, &b})
      for (const auto& [number, coverage] : *list)
        most = std::max(most, std::abs(of(a, number) - of(b, number)));
    return most;
  }
};
INSTANTIATE_BOTH_EYES(MatteTest);

TEST_P(MatteTest, channelsAreNumberAndCoverageByRank) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, 16, 12, GetParam());
  const Frame frame = draw(scene, quietLook(), views, sized(16, 12, {"cryptomatte"}));
  const std::vector<std::string> names{"id0", "coverage0", "id1", "coverage1",
                                       "id2", "coverage2", "id3", "coverage3"};
  for (size_t v = 0; v < viewCount(); ++v) EXPECT_EQ(aov(frame, "cryptomatte", v).channels, names);
}

// Nothing is torn: coverage is that of the samples of the geometry.
TEST_P(MatteTest, coverageIsThatOfTheFramesSamples) {
  const TestScene test = stillLife();
  const Scene scene = test.load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  const Look look = quietLook({{"warp.amount", "0"}});
  // Vulkan's standard locations, in quarters of a pixel.
  const glm::ivec2 locations[] = {{1, 0}, {3, 1}, {0, 2}, {2, 3}};
  for (const uint32_t samples : {1u, 4u}) {
    const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"cryptomatte", "id"}, samples));
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t wrong = 0, mixed = 0, open = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          Coverages expected;
          if (samples == 1) {
            if (const double id = texel(aov(frame, "id", v), x, y).x; id > 0) expected[int(id)] = 1;
          } else {
            for (const glm::ivec2& at : locations)
              if (const auto hit =
                      castRay(pixelRay(views[v], 4 * x + at.x, 4 * y + at.y, 4 * kWidth, 4 * kHeight),
                              test.triangles()))
                expected[hit->id] += 0.25;
          }
          const Coverages got = listed(aov(frame, "cryptomatte", v), x, y);
          wrong += difference(got, expected) > 0;
          mixed += got.size() > 1, open += got.empty();
        }
      // Sums in float round another way at an edge here and there.
      EXPECT_LE(wrong, samples == 1 ? 0u : size_t(kWidth * kHeight / 500));
      EXPECT_GE(mixed, samples == 1 ? 0u : 100u);
      EXPECT_GT(open, 500u);
    }
  }
}

// Bars thinner than a pixel, torn: the four greatest of all objects whose samples a pixel's colour comes
// from.
TEST_P(MatteTest, ranksOfInterpolatedSamples) {
  NOT_WITH_SANITIZERS();
  NEEDS_FINE_RASTER();
  TestScene s;
  const int material = s.material(TestScene::unlit("Bar", {0.5f, 0.5f, 0.5f, 1}));
  for (int i = -50; i < 50; ++i)
    s.add(gridMesh({0.012f * float(i), -1.2f, 0.004f * float(i)}, {0.01f, 0, 0}, {0.3f, 2.4f, 0}, 4),
          material);
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 5}, {0, 0, 0}}, kWidth, kHeight, GetParam());
  for (const uint32_t samples : {1u, 4u}) {
    // What is not torn lists all that a pixel has.
    const Frame still = draw(scene, quietLook({{"warp.amount", "0"}, {"final.ripple", "paper"}}), views,
                             sized(kWidth, kHeight, {"cryptomatte"}, samples));
    const Frame torn = draw(scene, quietLook({{"warp.amount", "30"}, {"final.ripple", "paper"}}), views,
                            sized(kWidth, kHeight, {"cryptomatte", "warp"}, samples));
    for (size_t v = 0; v < viewCount(); ++v) {
      size_t many = 0, wrong = 0;
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
          Coverages expected;
          if (samples == 4) {
            // Single samples, which rays find.
            for (const glm::dvec2& place : displacedSamples(aov(torn, "warp", v), x, y)) {
              const glm::ivec2 at(4.0 * place);
              if (const auto hit =
                      castRay(pixelRay(views[v], at.x, at.y, 4 * kWidth, 4 * kHeight), s.triangles()))
                expected[hit->id] += 0.25;
            }
            const Coverages got = listed(aov(torn, "cryptomatte", v), x, y);
            wrong += difference(got, expected) > 0;
            many += got.size() > 2;
            continue;
          }
          for (const glm::dvec2& place : displacedPlaces(aov(torn, "warp", v), x, y)) {
            const glm::dvec2 low = glm::floor(place - 0.5), f = place - 0.5 - low;
            for (int i = 0; i < 4; ++i) {
              const double weight = 0.25 * (i & 1 ? f.x : 1 - f.x) * (i >> 1 ? f.y : 1 - f.y);
              const glm::ivec2 there =
                  glm::min(glm::ivec2(low) + glm::ivec2(i & 1, i >> 1), glm::ivec2(kWidth - 1, kHeight - 1));
              for (const auto& [number, coverage] : listed(aov(still, "cryptomatte", v), there.x, there.y))
                expected[number] += weight * coverage;
            }
          }
          std::vector<double> greatest;
          for (const auto& [number, coverage] : expected) greatest.push_back(coverage);
          std::sort(greatest.rbegin(), greatest.rend());
          many += greatest.size() > 4 && greatest[4] > 0.01;
          greatest.resize(4);
          // Weights are in steps of 1/256 along x and y.
          constexpr double kTolerance = 2.0 / 512 + 1e-6;
          const Image& matte = aov(torn, "cryptomatte", v);
          for (const auto& [number, coverage] : listed(matte, x, y))
            wrong += !expected.count(number) || std::abs(expected[number] - coverage) > kTolerance;
          for (uint32_t rank = 0; rank < 4; ++rank)
            wrong += std::abs(matte.at(uint32_t(x), uint32_t(y), 2 * rank + 1) - greatest[rank]) > kTolerance;
        }
      // Rays and samples right at an edge may be on either side of it.
      EXPECT_LE(wrong, samples == 1 ? 0u : size_t(kWidth * kHeight / 100)) << samples << " samples";
      EXPECT_GE(many, samples == 1 ? 0u : 500u);
    }
  }
}

TEST_P(MatteTest, sumsToOneWhereAllIsCovered) {
  TestScene s;
  s.add(gridMesh({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}, 8, {9, 9}),
        s.material(TestScene::unlit("Wall", {1, 1, 1, 1})));
  s.add(sphereMesh({0, 0, 0}, 1), s.material(TestScene::unlit("Ball", {1, 0, 0, 1})));
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0.3f, 0.2f, 5}, {0, 0, 0}}, kWidth, kHeight, GetParam());
  for (const char* ripple : {"paper", "depth-aware", "layered"})
    for (const uint32_t samples : {1u, 4u}) {
      const Look look =
          quietLook({{"warp.amount", "40"}, {"warp.inflation", "30"}, {"final.ripple", ripple}});
      const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"cryptomatte"}, samples));
      for (size_t v = 0; v < viewCount(); ++v)
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x)
            ASSERT_EQ(sumOf(listed(aov(frame, "cryptomatte", v), x, y)), 1.0)
                << ripple << ' ' << x << ", " << y;
    }
}

// Colours of unlit objects, laid together by their mattes, are the picture: with torn edges, holes, things
// behind things, and sky.
TEST_P(MatteTest, fitsThePicture) {
  // Finer than the picture's pixels, so that holes depend on how much of its detail is left out.
  Image leaf{128, 128, {"R", "G", "B", "A"}, {}};
  for (int i = 0; i < 128 * 128; ++i) {
    const int x = i % 128, y = i / 128;
    leaf.pixels.insert(leaf.pixels.end(), {1, 1, 1, x % 40 < 16 || (x * x + 3 * y) % 7 < 3 ? 1.0f : 0.0f});
  }
  for (const uint32_t samples : {1u, 4u}) {
    // Four samples are averaged as roots of colours, from which the colours below must not be too far.
    const bool strong = samples == 1;
    const std::vector<glm::vec4> colors = strong ? std::vector<glm::vec4>{{0.9f, 0.8f, 0.1f, 1},
                                                                          {0.8f, 0.05f, 0.1f, 1},
                                                                          {0.05f, 0.2f, 0.9f, 1},
                                                                          {0.1f, 0.8f, 0.2f, 1}}
                                                 : std::vector<glm::vec4>{{0.5f, 0.45f, 0.2f, 1},
                                                                          {0.45f, 0.2f, 0.2f, 1},
                                                                          {0.2f, 0.26f, 0.5f, 1},
                                                                          {0.26f, 0.5f, 0.26f, 1}};
    TestScene s;
    std::vector<int> materials;
    s.json()["samplers"] = Json::array({{{"magFilter", 9729}, {"minFilter", 9987}}});
    const int texture = s.texture(leaf);
    for (size_t i = 0; i < colors.size(); ++i) {
      Json json = TestScene::unlit("Flat" + std::to_string(i), colors[i]);
      if (i == 3) {
        json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
        json["alphaMode"] = "MASK";
      }
      materials.push_back(s.material(json));
    }
    s.add(gridMesh({-2.6f, -1.0f, -1.5f}, {4, 0, 0}, {0, 2.2f, 0}, 8, {4, 2}), materials[0]);
    s.add(sphereMesh({-0.6f, 0, 0}, 0.9f, 48), materials[1]);
    s.add(boxMesh({0.2f, -1.2f, -0.6f}, {1.1f, 0.7f, 0.4f}), materials[2]);
    s.add(gridMesh({-0.2f, -0.9f, 1}, {1.5f, 0, 0}, {0, 1.4f, 0}, 4), materials[3]);
    const Scene scene = s.load();
    const auto views = viewsFrom(scene, {{0.4f, 0.3f, 5}, {0, 0, 0}, 36}, kWidth, kHeight, GetParam());
    for (const char* ripple : {"paper", "depth-aware", "layered"}) {
      const Look look = quietLook({{"warp.amount", "36"},
                                   {"warp.inflation", "30"},
                                   {"final.ripple", ripple},
                                   {"background.horizon", "#808080"},
                                   {"background.zenith", "#808080"}});
      const Frame frame = draw(scene, look, views, sized(kWidth, kHeight, {"cryptomatte", "id"}, samples));
      // Colours as the targets hold them.
      const auto stored = [](double c) {
        const double root = std::round(std::sqrt(c) * 255) / 255;
        return root * root;
      };
      const double sky = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
      for (size_t v = 0; v < viewCount(); ++v) {
        size_t wrong = 0, torn = 0;
        Difference difference(1);
        for (int y = 0; y < kHeight; ++y)
          for (int x = 0; x < kWidth; ++x) {
            const Coverages list = listed(aov(frame, "cryptomatte", v), x, y);
            const glm::dvec4 picture = texel(aov(frame, "", v), x, y);
            const int id = int(texel(aov(frame, "id", v), x, y).x);
            bool fits = true, isTorn = false;
            for (int c = 0; c < 3; ++c) {
              double sum = (1 - sumOf(list)) * sky, low = sky, high = sky, lowRoot = 1, highRoot = 0;
              for (const auto& [number, coverage] : list) {
                const double color = stored(colors[size_t(number - 1)][c]);
                sum += coverage * color;
                low = std::min(low, color), high = std::max(high, color);
                lowRoot = std::min(lowRoot, std::sqrt(color)),
                highRoot = std::max(highRoot, std::sqrt(color));
              }
              // Filters weigh in steps of 1/256 along x and y, and so do mattes.
              double tolerance = 2e-3 + (high - low) * 4 / 256;
              if (samples > 1 && !list.empty()) {
                const double range = highRoot - lowRoot;
                tolerance += 0.25 * range * range;       // the mean of squares is not the square of the mean
                if (sumOf(list) < 1) tolerance += 8e-3;  // parts of roots in 8 bits
              }
              fits &= std::abs(picture[c] - sum) <= tolerance;
              difference.add(picture[c], sum);
              isTorn |= std::abs(picture[c] - (id > 0 ? stored(colors[size_t(id - 1)][c]) : sky)) > 0.15;
            }
            wrong += !fits;
            torn += isTorn;
          }
        EXPECT_EQ(wrong, 0u) << ripple << ", " << samples << " samples, " << difference.text();
        EXPECT_LT(difference.mean(), 1e-3) << ripple << ", " << samples << " samples";
        EXPECT_GT(torn, 450u) << "mattes of the plain geometry would do";
      }
    }
  }
}

// As in the facts: a blended surface counts as a whole where its opacity is a half or more.
TEST_P(MatteTest, panesCountFromAHalf) {
  TestScene s;
  s.add(gridMesh({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}), s.material(TestScene::colored("Wall", {1, 1, 1, 1})));
  for (const float opacity : {0.4f, 0.6f}) {
    Json json = TestScene::colored("Pane", {0.5f, 0.5f, 0.5f, opacity});
    json["alphaMode"] = "BLEND";
    s.add(gridMesh({opacity < 0.5f ? -1.0f : 0.2f, -1, 0}, {0.8f, 0, 0}, {0, 2, 0}), s.material(json));
  }
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{0, 0, 4}, {0, 0, 0}}, kWidth, kHeight, GetParam());
  const Frame frame =
      draw(scene, quietLook({{"warp.amount", "0"}}), views, sized(kWidth, kHeight, {"cryptomatte"}, 4));
  for (size_t v = 0; v < viewCount(); ++v) {
    const glm::ivec2 thin(pixelOf(views[v], {-0.6, 0, 0}, kWidth, kHeight)),
        thick(pixelOf(views[v], {0.6, 0, 0}, kWidth, kHeight));
    EXPECT_EQ(listed(aov(frame, "cryptomatte", v), thin.x, thin.y), (Coverages{{1, 1.0}}));
    EXPECT_EQ(listed(aov(frame, "cryptomatte", v), thick.x, thick.y), (Coverages{{3, 1.0}}));
  }
}

TEST_P(MatteTest, changesNothingElseAndIsTheSameHoweverItRuns) {
  const Scene scene = stillLife().load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {0, 0.8f, 0}}, kWidth, kHeight, GetParam());
  for (const char* ripple : {"depth-aware", "layered"})
    for (const uint32_t samples : {1u, 4u}) {
      const Look look = quietLook({{"final.ripple", ripple}, {"warp.amount", "30"}});
      const Frame without =
          draw(scene, look, views, sized(kWidth, kHeight, {"warp", "id", "color"}, samples));
      const RenderOptions options = sized(kWidth, kHeight, {"warp", "id", "color", "cryptomatte"}, samples);
      const Frame with = draw(scene, look, views, options);
      Result<Frame> compute = otherRenderer().render(scene, look, 0, views, options);
      ASSERT_TRUE(compute.ok()) << compute.error().message();
      for (size_t v = 0; v < viewCount(); ++v) {
        for (const char* name : {"", "warp", "id", "color"})
          EXPECT_TRUE(sameBytes(aov(with, name, v), aov(without, name, v))) << "layer '" << name << "'";
        if (sameBytes(aov(with, "warp", v), aov(*compute, "warp", v))) {
          EXPECT_TRUE(sameBytes(aov(with, "cryptomatte", v), aov(*compute, "cryptomatte", v)));
        } else {
          // Vectors that round another way move weights by a step.
          size_t apart = 0;
          for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
              apart += difference(listed(aov(with, "cryptomatte", v), x, y),
                                  listed(aov(*compute, "cryptomatte", v), x, y)) > 0.02;
          EXPECT_LT(apart, size_t(kWidth * kHeight / 200));
        }
      }
    }
}

TEST_F(MatteTest, numbersHaveNames) {
  TestScene s = stillLife();
  s.json()["nodes"][1]["name"] = "Ball";
  const Scene scene = s.load();
  const auto views = viewsFrom(scene, {{2, 2.5f, 6}, {-0.7f, 0.8f, 0.4f}}, kWidth, kHeight);
  const Frame frame = draw(scene, quietLook({{"warp.amount", "0"}, {"ground.mode", "on"}}), views,
                           sized(kWidth, kHeight, {"cryptomatte"}));
  const std::vector<std::string>& names = frame.objects;
  const size_t nodes = scene.summary().nodes;
  ASSERT_GT(names.size(), nodes);
  EXPECT_EQ(names[0], "node 1");
  EXPECT_EQ(names[1], "Ball");
  EXPECT_EQ(names[nodes], "Ground");
  for (size_t i = nodes + 1; i < names.size(); ++i) EXPECT_EQ(names[i], "") << "features that are not there";

  const auto nameAt = [&](int x, int y) {
    const Coverages list = listed(aov(frame, "cryptomatte"), x, y);
    return list.empty() ? "" : names.at(size_t(list.begin()->first - 1));
  };
  EXPECT_EQ(nameAt(kWidth / 2, kHeight / 2), "Ball");
  EXPECT_EQ(nameAt(0, kHeight - 1), "Ground");

  const Frame bare = draw(scene, quietLook(), views, sized(kWidth, kHeight, {"id"}));
  EXPECT_EQ(bare.objects[nodes], "");
  EXPECT_TRUE(draw(scene, quietLook(), views, sized(kWidth, kHeight)).objects.empty());
}

}  // namespace
}  // namespace scumble::passes
