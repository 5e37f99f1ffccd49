// Fins: quads that stand on the edges of the proxy (paper 003, sections 3.1 and 3.3).
#pragma once

#include <array>
#include <vector>

#include "bake/splats.h"

namespace scumble::bake {

struct Fin {
  uint32_t edge = 0;       // of the proxy
  uint32_t primitive = 0;  // of its first triangle
  // Bottom at a and b, top at b and a, mesh space.
  std::array<glm::vec3, 4> corners;
  glm::vec3 normal{0, 0, 1};  // unit length
  // At a and at b: those of the fin and of its neighbour there, so that a fin goes over into the next one;
  // unit length.
  std::array<glm::vec3, 2> matched;
  float depth = 0;  // metres on both sides that it shows
};

// The shell around the proxy: which way and how far each place moves outwards.
struct Shell {
  std::vector<glm::vec3> directions;  // unit length, smoothed
  std::vector<float> offsets;         // metres
};

// `fixedOffset`: by primitive; above 0: that far. Else as far as strokes reach there.
Shell makeShell(const Proxy& proxy, const std::vector<Splat>& splats, const std::vector<float>& fixedOffset);

// On every edge that is no diagonal of a chart and at which the shell has a height.
std::vector<Fin> makeFins(const Proxy& proxy, const Shell& shell);

// Which edge goes on where one of a place's ends, by edge in the order of Proxy::edgesAt; ~0u: none makes an
// angle above 90 degrees with it. First those that are each other's best are paired, then what is left over
// takes its best.
std::vector<uint32_t> matchedEdges(const Proxy& proxy, uint32_t place, const std::vector<bool>& hasFin);

}  // namespace scumble::bake
