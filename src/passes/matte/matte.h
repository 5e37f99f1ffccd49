// Mattes of objects with the coverage of the picture: the numbers of the objects whose samples a pixel's
// colour comes from, wherever edges are torn, and how much of it each has. Drawn only when asked for.
#pragma once

#include "frame/pass.h"
#include "shading/displacement.shared.h"

namespace scumble::passes {

// What other passes say, whose knobs decide what the picture shows.
struct PictureFacts {
  shared::Displacement (*displacement)(const look::LookData& look, const world::SceneOnGpu& scene,
                                       float imageHeight);
  int (*ripple)(const look::LookData& look);  // of shading/displacement.shared.h
  // Of a material's textures, in mip levels.
  float (*simplify)(const look::LookData& look, const world::SceneOnGpu& scene, size_t material);
};

std::unique_ptr<frame::Pass> makeMatte(const PictureFacts& picture);

}  // namespace scumble::passes
