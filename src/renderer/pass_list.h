// The passes of a frame, in order. To add a pass: a folder under src/passes, and one line here.
#pragma once

#include <memory>
#include <vector>

#include "frame/pass.h"

namespace scumble::renderer {

using namespace frame;

std::vector<std::unique_ptr<Pass>> makePasses(const Configuration& configuration);

// How far outside of its silhouette any surface tears edges under a look, in pixels.
float largestInflation(const look::LookData& look, const SceneOnGpu& scene, float imageHeight);

// Whether the look needs what lies behind the first surfaces (Configuration::layered).
bool wantsLayers(const look::LookData& look);

// Whether anything may act on the lens at any time (Configuration::glows).
bool glows(const scene::SceneData& scene, const look::LookData& look);
// Whether the look limits the picture to few colours (Configuration::limit).
bool wantsLimit(const look::LookData& look);
// Whether the look declares colorizers (Configuration::colorize).
bool wantsColorizers(const look::LookData& look);

// Which materials cast shadows under a look; the ground, if there is one, is no material of the scene's.
std::vector<bool> shadowCasters(const scene::SceneData& scene, const look::LookData& look);

}  // namespace scumble::renderer
