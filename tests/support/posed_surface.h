// What MetaTexture and the inflation of the warp pass know of a posed surface, and where it lies on a screen,
// in double precision: tangents from positions and uv (docs/passes.md, corrections 2 and 3), smooth normals
// from the faces.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scumble/view.h"
#include "tests/support/posed_scene.h"

namespace scumble::test {

struct SurfaceCorner {
  glm::dvec3 position;
  glm::dvec3 smoothNormal;  // unit, shared by all faces that meet here
  glm::dvec3 dPdu, dPdv;    // metres per unit of uv
  glm::dvec2 uv;
  double warpScale;  // the attribute _WARP
};
struct SurfaceTriangle {
  std::array<SurfaceCorner, 3> corners;
  int id = 0;
  double mirror = 1;  // as PosedPrimitive has it
  bool doubleSided = false;
};
// Everything that is drawn, once.
std::vector<SurfaceTriangle> posedSurface(const scene::SceneData& scene, const Moments& moments = {});

// A triangle on the screen of a perspective view: x, y in pixels from the upper left corner, times depth, and
// depth along the view axis in metres.
struct ScreenTriangle {
  std::array<glm::dvec3, 3> corners;
  size_t surface = 0;  // index into the list that it was made from
};
// What `move` makes of a triangle and its corner is added to the corner, in pixels. Triangles that turn their
// back are left out, as are those that reach behind the viewer.
template <class Move>
std::vector<ScreenTriangle> onScreen(const std::vector<SurfaceTriangle>& surface, const View& view, int width,
                                     int height, const Move& move);

struct ScreenHit {
  size_t surface = 0;
  glm::dvec3 barycentric{};  // the shares of its corners, on the surface
  double depth = 0;
};
// The nearest triangle at every pixel's centre moved by `offset`, row by row.
std::vector<std::optional<ScreenHit>> rasterised(const std::vector<ScreenTriangle>& triangles, int width,
                                                 int height, const glm::dvec2& offset = glm::dvec2(0.0));
// Shares of a triangle's corners at any place of the screen, also outside of it.
glm::dvec3 sharesAt(const ScreenTriangle& triangle, const glm::dvec2& at);

// Where a point lies in the picture and how fast that changes as it moves along a direction, in pixels.
glm::dvec2 pixelsAlong(const View& view, const glm::dvec3& point, const glm::dvec3& direction, int width,
                       int height);
// Along the view axis, in metres.
double depthOf(const View& view, const glm::dvec3& point);

// ---- Implementation ----

std::optional<ScreenTriangle> screenTriangle(const SurfaceTriangle& triangle, const View& view, int width,
                                             int height, const std::array<glm::dvec2, 3>& moves);

template <class Move>
std::vector<ScreenTriangle> onScreen(const std::vector<SurfaceTriangle>& surface, const View& view, int width,
                                     int height, const Move& move) {
  std::vector<ScreenTriangle> list;
  for (size_t i = 0; i < surface.size(); ++i) {
    const auto& c = surface[i].corners;
    if (auto one = screenTriangle(surface[i], view, width, height,
                                  {move(surface[i], c[0]), move(surface[i], c[1]), move(surface[i], c[2])})) {
      one->surface = i;
      list.push_back(*one);
    }
  }
  return list;
}

}  // namespace scumble::test
