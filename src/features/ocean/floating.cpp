#include "features/ocean/floating.h"

#include "features/ocean/extras.h"

namespace scumble::ocean {

namespace {

// What the scene says, and over that what the look does.
FloatParams floatParams(const scene::Node& node, const look::LookData& look) {
  FloatParams params;
  if (const std::optional<Floats> floats = floatsOf(node)) {
    params.rides = true;
    params.length = floats->length.value_or(params.length);
    params.beam = floats->beam.value_or(params.beam);
    params.bow = floats->bowAlongZ ? 1 : 0;
  }
  look.fillFor(FloatParams::block(), look::kNodes, node.name, &params);
  return params;
}

}  // namespace

std::vector<FloatingNode> floatingNodes(const scene::SceneData& scene, const look::LookData& look,
                                        int ocean) {
  const bool maySet = look.setsAny(FloatParams::block(), "rides", look::kNodes);
  std::vector<FloatingNode> floating;
  std::vector<bool> rides(scene.nodes.size(), false);
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const scene::Node& node = scene.nodes[n];
    rides[n] = node.parent >= 0 && rides[size_t(node.parent)];
    if (rides[n] || int(n) == ocean || !(maySet || !node.extras.empty())) continue;
    const FloatParams params = floatParams(node, look);
    rides[n] = params.rides;
    if (rides[n]) floating.push_back({n, params});
  }
  return floating;
}

}  // namespace scumble::ocean
