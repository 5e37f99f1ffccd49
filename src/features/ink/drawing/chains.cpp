#include "features/ink/drawing/chains.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace scumble::ink {

namespace {

constexpr uint32_t kNoLink = ~0u;
// Cosine of the angle between two links at their node below which they are a hairpin: a chain ends there.
constexpr float kCosHairpin = 0.9f;

// One end of a link: its number twice, plus which end.
using LinkEnd = uint32_t;

// From the end into the link.
glm::vec2 inward(const std::vector<Link>& links, LinkEnd end) {
  const Link& link = links[end / 2];
  const glm::vec2 way = link.ends[1 - end % 2] - link.ends[end % 2];
  const float length = glm::length(way);
  return length > 0 ? way / length : glm::vec2(0.0f);
}

// What each end goes on to.
std::vector<LinkEnd> partnersOf(const std::vector<Link>& links, uint32_t nodeCount) {
  std::vector<uint32_t> first(nodeCount + 1, 0);
  for (const Link& link : links)
    for (const uint32_t node : link.nodes) ++first[node + 1];
  for (uint32_t n = 0; n < nodeCount; ++n) first[n + 1] += first[n];
  std::vector<LinkEnd> at(2 * links.size());
  std::vector<uint32_t> next = first;
  for (LinkEnd end = 0; end < at.size(); ++end) at[next[links[end / 2].nodes[end % 2]]++] = end;

  std::vector<LinkEnd> partners(2 * links.size(), kNoLink);
  struct Pair {
    float cosine;  // of the angle between them
    LinkEnd a, b;
  };
  std::vector<Pair> pairs;
  for (uint32_t node = 0; node < nodeCount; ++node) {
    pairs.clear();
    for (uint32_t i = first[node]; i < first[node + 1]; ++i)
      for (uint32_t j = i + 1; j < first[node + 1]; ++j) {
        if (links[at[i] / 2].family != links[at[j] / 2].family || at[i] / 2 == at[j] / 2) continue;
        // Links that no direction is known of go on to any.
        const float cosine = glm::dot(inward(links, at[i]), inward(links, at[j]));
        if (cosine <= kCosHairpin) pairs.push_back({cosine, at[i], at[j]});
      }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& x, const Pair& y) { return x.cosine < y.cosine; });
    for (const Pair& pair : pairs)
      if (partners[pair.a] == kNoLink && partners[pair.b] == kNoLink)
        partners[pair.a] = pair.b, partners[pair.b] = pair.a;
  }
  return partners;
}

}  // namespace

std::vector<Chain> chainsOf(const std::vector<Link>& links, uint32_t nodeCount) {
  const std::vector<LinkEnd> partners = partnersOf(links, nodeCount);
  std::vector<bool> isTaken(links.size());
  std::vector<Chain> chains;
  for (uint32_t link = 0; link < links.size(); ++link) {
    if (isTaken[link]) continue;
    // Back to where the chain begins, or once around.
    LinkEnd begin = 2 * link;
    while (partners[begin] != kNoLink && partners[begin] != 2 * link + 1) begin = partners[begin] ^ 1u;
    Chain chain;
    chain.isClosed = partners[begin] != kNoLink;
    for (LinkEnd end = begin; end != kNoLink && !isTaken[end / 2]; end = partners[end ^ 1u]) {
      isTaken[end / 2] = true;
      chain.parts.push_back({end / 2, end % 2 == 1});
    }
    chains.push_back(std::move(chain));
  }
  return chains;
}

}  // namespace scumble::ink
