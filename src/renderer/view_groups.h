// Views that are drawn together: of one size and one rig, at most as many as shaders know at once.
#pragma once

#include <functional>
#include <vector>

#include "scumble/view.h"
#include "stage/viewers.h"

namespace scumble::renderer {

struct ViewGroup {
  glm::uvec2 size;
  int rig;
  std::vector<size_t> members;  // indices of views, rising
};

// In the order of their first views. `size`: of views that have none of their own.
std::vector<ViewGroup> groupViews(const std::vector<View>& views, glm::uvec2 size);

// The views of a group; of nothing, nothing.
std::vector<View> viewsOf(const ViewGroup& group, const std::vector<View>& all);
// All views of a rig.
std::vector<View> rigOf(int rig, const std::vector<View>& all);

// The view between all eyes: what decides where marks lie is seen from there.
View middleOf(const std::vector<View>& views);

// Views that hang on nodes, with what moves those in the world. Level ones do not tilt with it, and all of a
// rig go the way of its middle.
std::vector<View> carriedBy(const std::function<glm::mat4(int node)>& movedBy, std::vector<View> views);

// The same views relative to another origin.
std::vector<View> countedFrom(const glm::dvec3& origin, std::vector<View> views);

// Whether depth and size do not depend on the distance.
bool isParallel(const View& view);

// What all views see, and `marginPixels` beside each of its size.
stage::Viewers viewersOf(const std::vector<View>& all, const std::vector<ViewGroup>& groups,
                         const std::vector<float>& marginPixels);

}  // namespace scumble::renderer
