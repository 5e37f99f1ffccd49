// How a sphere is cut into parts that frames with perspective show, and how those are put together: each
// place is a mix of those that lie around it, whose shares add up to one.
//
// Longitudes grow to the right from straight ahead, latitudes upwards; both in radians.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scumble/panorama.h"

namespace scumble::panorama {

constexpr float kTurn = 6.2831853f;  // radians

// Parts of one latitude, side by side.
struct Band {
  float latitude = 0;          // of their middles
  float below = 0, above = 0;  // to the next bands' middles; 0: there is none
  int parts = 1;               // all around; 1: at a pole
  float eyes = 0;              // half of the distance between the eyes there, metres
  glm::uvec2 size{0};          // of a frame, pixels
  float spacing() const;       // between the middles of neighbours
  float longitudeOf(int part) const;
};

struct Tiling {
  std::vector<Band> bands;   // from down to up
  float pixelsOfRadian = 0;  // in a frame's middle, and along the panorama's equator
};

// How far apart eyes are at a latitude: a part of their usual distance.
float easing(float latitude);

Tiling tilingOf(const Panorama& panorama, uint32_t height);

// How much a part has of a place, `offset` from its middle towards a neighbour that is `spacing` away.
float shareAt(float offset, float spacing);
// Where no share is left: this part of the spacing.
constexpr float kShareEnds = 0.75f;

// Of a part's eye space: turns directions to the sphere's axes, x right, y up, -z ahead.
glm::mat3 turnOf(float longitude, float latitude);
// Where an eye is, by the sphere's axes; `aside`: metres to the right of who looks that way.
glm::vec3 placeOf(float longitude, float aside);

}  // namespace scumble::panorama
