// The splats of a painting, evenly spaced in space, each hung on the proxy (paper 003, section 3.2).
#pragma once

#include "bake/proxy.h"
#include "scene/painting.h"
#include "scumble/bake.h"

namespace scumble::bake {

struct Splat {
  glm::vec3 position{0}, along{1, 0, 0};  // mesh space; the stroke's direction, unit length
  glm::vec3 facing{0, 0, 1};              // where its brush faced, unit length
  float radius = 0;                       // metres
  glm::vec3 root{0};                      // the square root of its colour, linear
  float opacity = 1, spacing = 0;         // radii to the next one that counts at least as much
  float from = 0, to = 0;                 // of the stroke: to its beginning and its end, radii
  float chance = 0;                       // of the stroke, from 0 to 1
  int brush = 0;
  // Its place on the proxy: what part of it each corner of a triangle has, and metres above it.
  int triangle = -1;
  glm::vec3 parts{0};
  float height = 0;
  // What is laid down first lies below: by height, and later strokes come forward by a part of their radius.
  float order = 0;
};

// Of all strokes in painting order, on no surface: so many radii apart, or more where there are too many.
std::vector<Splat> splatsOf(const scene::Painting& painting, const BakeOptions& options, float least);

// In the order in which they are laid down. What lies deeper below the surface than its radius, or farther
// from it than `reach`, is left out; `left` counts that.
std::vector<Splat> hungSplats(const scene::Painting& painting, const Proxy& proxy, const BakeOptions& options,
                              float reach, size_t& left);

}  // namespace scumble::bake
