// Chains of lines: those that meet end to end, one after the other.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace scumble::ink {

// A line between two nodes, which it may share with others. Only those of one family are chained.
struct Link {
  uint32_t nodes[2];
  uint32_t family;
  glm::vec2 ends[2];  // pixels
};

struct Chain {
  struct Part {
    uint32_t link;
    bool isReversed;  // it is passed from its second node to the first one
  };
  std::vector<Part> parts;
  bool isClosed = false;
};

// Every link is in one chain. Where more than two of a family meet, those go on that turn least; a hairpin
// ends a chain. In the order of their first links.
std::vector<Chain> chainsOf(const std::vector<Link>& links, uint32_t nodeCount);

}  // namespace scumble::ink
