// Chains of links, and contours: what meets is passed in one go, and nothing twice.
#include "features/ink/drawing/chains.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "features/ink/drawing/contours.h"

namespace scumble::ink {
namespace {

// Nodes in a row, and links between some of them.
std::vector<Link> linksBetween(const std::vector<glm::vec2>& nodes, const std::vector<glm::uvec2>& pairs,
                               uint32_t family = 0) {
  std::vector<Link> links;
  for (const glm::uvec2 pair : pairs)
    links.push_back({{pair.x, pair.y}, family, {nodes[pair.x], nodes[pair.y]}});
  return links;
}

// That every link is passed once, and parts meet.
void expectWhole(const std::vector<Chain>& chains, const std::vector<Link>& links) {
  std::set<uint32_t> passed;
  for (const Chain& chain : chains) {
    const auto node = [&](size_t part, bool isEnd) {
      const Chain::Part& p = chain.parts[part % chain.parts.size()];
      return links[p.link].nodes[p.isReversed != isEnd ? 1 : 0];
    };
    for (size_t i = 0; i < chain.parts.size(); ++i) {
      EXPECT_TRUE(passed.insert(chain.parts[i].link).second);
      if (i + 1 < chain.parts.size() || chain.isClosed) {
        EXPECT_EQ(node(i, true), node(i + 1, false));
      }
    }
  }
  EXPECT_EQ(passed.size(), links.size());
}

TEST(Chains, goOnWhereLinksMeet) {
  const std::vector<glm::vec2> row{{0, 0}, {1, 0}, {2, 1}, {3, 1}};
  // In any order, either way round.
  const std::vector<Link> links = linksBetween(row, {{3, 2}, {0, 1}, {2, 1}});
  const std::vector<Chain> chains = chainsOf(links, 4);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_FALSE(chains[0].isClosed);
  expectWhole(chains, links);
}

TEST(Chains, closeAroundARing) {
  std::vector<glm::vec2> ring;
  std::vector<glm::uvec2> pairs;
  for (uint32_t i = 0; i < 12; ++i) {
    ring.push_back(glm::vec2(std::cos(0.5236f * float(i)), std::sin(0.5236f * float(i))));
    pairs.push_back(i % 3 ? glm::uvec2(i, (i + 1) % 12) : glm::uvec2((i + 1) % 12, i));
  }
  const std::vector<Link> links = linksBetween(ring, pairs);
  const std::vector<Chain> chains = chainsOf(links, 12);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].isClosed);
  expectWhole(chains, links);
}

TEST(Chains, crossStraightAndKeepToTheirFamilies) {
  // Two lines cross in node 0.
  const std::vector<glm::vec2> cross{{0, 0}, {-1, 0.1f}, {1, 0}, {0, -1}, {0.1f, 1}};
  std::vector<Link> links = linksBetween(cross, {{0, 1}, {0, 3}, {0, 2}, {0, 4}});
  std::vector<Chain> chains = chainsOf(links, 5);
  ASSERT_EQ(chains.size(), 2u);
  expectWhole(chains, links);
  EXPECT_EQ(chains[0].parts[0].link + chains[0].parts[1].link, 2u);
  // Another family goes by itself, and a hairpin ends.
  links[2].family = 1;
  EXPECT_EQ(chainsOf(links, 5).size(), 3u);
  const std::vector<glm::vec2> hairpin{{0, 0}, {5, 0.2f}, {5, -0.2f}};
  EXPECT_EQ(chainsOf(linksBetween(hairpin, {{0, 1}, {0, 2}}), 3).size(), 2u);
  // A link to its own node, and two that are of no length.
  links = linksBetween({{0, 0}, {0, 0}, {1, 0}}, {{0, 0}, {0, 1}, {1, 2}});
  expectWhole(chainsOf(links, 3), links);
}

TEST(Contours, levelsAreWhereTheNumberPassesThem) {
  constexpr uint32_t kSide = 40;
  const auto cone = [](uint32_t x, uint32_t y) -> std::optional<float> {
    return 10 - std::hypot(float(x) + 0.5f - 18, float(y) + 0.5f - 20);
  };
  const Contours contours = levelContours(kSide, kSide, cone, 0);
  const std::vector<Chain> chains = chainsOf(contours.links, contours.nodeCount);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].isClosed);
  expectWhole(chains, contours.links);
  for (const Link& link : contours.links)
    for (const glm::vec2 end : link.ends) EXPECT_NEAR(std::hypot(end.x - 18, end.y - 20), 10, 0.05);
  // Nothing beside what has no number, and saddles are cut in two, one way or the other.
  const auto half = [&](uint32_t x, uint32_t y) { return x < 18 ? cone(x, y) : std::nullopt; };
  const Contours open = levelContours(kSide, kSide, half, 0);
  const std::vector<Chain> arcs = chainsOf(open.links, open.nodeCount);
  ASSERT_EQ(arcs.size(), 1u);
  EXPECT_FALSE(arcs[0].isClosed);
  for (const float middle : {-0.1f, 0.1f}) {
    const auto saddle = [&](uint32_t x, uint32_t y) -> std::optional<float> {
      return (x == y ? 1.0f : -1.0f) + middle;
    };
    const Contours two = levelContours(2, 2, saddle, 0);
    ASSERT_EQ(two.links.size(), 2u);
    // What is up is joined where the middle is up: neither link cuts its corner (0, 0) off.
    for (const Link& link : two.links) {
      const float sum = link.ends[0].x + link.ends[0].y + link.ends[1].x + link.ends[1].y;
      EXPECT_EQ(std::abs(sum - 4) > 0.6f, middle < 0) << sum;
    }
  }
}

TEST(Contours, bordersGoAroundPixels) {
  const auto inside = [](uint32_t x, uint32_t y) { return x >= 2 && x < 5 && y >= 3 && y < 7; };
  const Contours contours =
      borderContours(8, 9, [&](uint32_t x, uint32_t y, uint32_t otherX, uint32_t otherY) {
        return inside(x, y) != inside(otherX, otherY);
      });
  EXPECT_EQ(contours.links.size(), 14u);
  const std::vector<Chain> chains = chainsOf(contours.links, contours.nodeCount);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].isClosed);
  for (const Link& link : contours.links)
    for (const glm::vec2 end : link.ends) EXPECT_TRUE(end.x >= 2 && end.x <= 5 && end.y >= 3 && end.y <= 7);
}

}  // namespace
}  // namespace scumble::ink
