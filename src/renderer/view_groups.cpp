#include "renderer/view_groups.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "shading/frame.shared.h"

namespace scumble::renderer {

std::vector<ViewGroup> groupViews(const std::vector<View>& views, glm::uvec2 size) {
  std::vector<ViewGroup> groups;
  for (size_t i = 0; i < views.size(); ++i) {
    const glm::uvec2 own = views[i].size == glm::uvec2(0) ? size : views[i].size;
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const ViewGroup& group) {
      return group.size == own && group.rig == views[i].rig &&
             group.members.size() < size_t(shared::kMaxViews);
    });
    ViewGroup& group = found != groups.end() ? *found : groups.emplace_back(ViewGroup{own, views[i].rig, {}});
    group.members.push_back(i);
  }
  return groups;
}

std::vector<View> viewsOf(const ViewGroup& group, const std::vector<View>& all) {
  std::vector<View> views;
  if (all.empty()) return views;
  for (const size_t member : group.members) views.push_back(all[member]);
  return views;
}

std::vector<View> rigOf(int rig, const std::vector<View>& all) {
  std::vector<View> views;
  std::copy_if(all.begin(), all.end(), std::back_inserter(views),
               [&](const View& view) { return view.rig == rig; });
  return views;
}

bool isParallel(const View& view) {
  return view.eyeToClip[2][3] == 0;
}

View middleOf(const std::vector<View>& views) {
  // Eyes that stand in one place see what one eye sees there, to the bit.
  const View& first = views.front();
  if (std::all_of(views.begin(), views.end(), [&](const View& view) {
        return view.worldToEye == first.worldToEye && view.eyeToClip == first.eyeToClip;
      }))
    return first;
  const float share = 1.0f / float(views.size());
  glm::quat turn(0, 0, 0, 0);
  glm::vec4 place(0.0f);
  glm::mat4 projection(0.0f);
  for (const View& view : views) {
    const glm::mat4 eyeToWorld = glm::inverse(view.worldToEye);
    const glm::quat own = glm::quat_cast(glm::mat3(eyeToWorld));
    // One turn has two quaternions; those of one side add up.
    turn += (glm::dot(turn, own) < 0 ? -share : share) * own;
    place += share * eyeToWorld[3];
    projection += share * view.eyeToClip;
  }
  // Parallel eyes keep their turn to the bit.
  const float length = glm::length(turn);
  if (std::abs(length - 1) > 1e-6f) turn /= length;
  glm::mat4 eyeToWorld = glm::mat4_cast(turn);
  eyeToWorld[3] = place;
  return {glm::inverse(eyeToWorld), projection};
}

namespace {

// A motion of whoever stands at a place and does not tilt with it.
glm::mat4 levelled(const glm::mat4& moved, const glm::vec3& place) {
  const glm::vec3 to = moved * glm::vec4(place, 1);
  // The turn about the vertical that is in a turn: of its quaternion w and y are what it has of it.
  const glm::quat turn = glm::quat_cast(glm::mat3(moved));
  const float angle = 2 * std::atan2(turn.y, turn.w);
  const glm::mat4 none(1);
  return glm::translate(none, to) * glm::rotate(none, angle, glm::vec3(0, 1, 0)) *
         glm::translate(none, -place);
}

}  // namespace

std::vector<View> carriedBy(const std::function<glm::mat4(int node)>& movedBy, std::vector<View> views) {
  std::map<int, glm::vec3> middles;
  for (const View& view : views)
    if (view.node >= 0 && view.isLevel && !middles.count(view.rig))
      middles[view.rig] = glm::vec3(glm::inverse(middleOf(rigOf(view.rig, views)).worldToEye)[3]);
  for (View& view : views) {
    if (view.node < 0) continue;
    const glm::mat4 moved = movedBy(view.node);
    view.worldToEye *= glm::inverse(view.isLevel ? levelled(moved, middles[view.rig]) : moved);
  }
  return views;
}

std::vector<View> countedFrom(const glm::dvec3& origin, std::vector<View> views) {
  for (View& view : views) {
    if (view.origin == origin) continue;
    view.worldToEye = glm::dmat4(view.worldToEye) * glm::translate(glm::dmat4(1.0), origin - view.origin);
    view.origin = origin;
  }
  return views;
}

stage::Viewers viewersOf(const std::vector<View>& all, const std::vector<ViewGroup>& groups,
                         const std::vector<float>& marginPixels) {
  stage::Viewers viewers;
  for (size_t g = 0; g < groups.size(); ++g)
    for (const size_t member : groups[g].members)
      viewers.windows.push_back({all[member].eyeToClip * all[member].worldToEye,
                                 2.0f * marginPixels[g] / glm::vec2(groups[g].size)});
  // The first rig's middle: others look on.
  const std::vector<View> rig = rigOf(all.front().rig, all);
  const float share = 1.0f / float(rig.size());
  for (const View& view : rig) viewers.middle += share * glm::vec3(glm::inverse(view.worldToEye)[3]);
  const View middle = middleOf(rig);
  viewers.ahead = glm::vec3(-middle.worldToEye[0].z, -middle.worldToEye[1].z, -middle.worldToEye[2].z);
  viewers.isParallel = isParallel(middle);
  return viewers;
}

}  // namespace scumble::renderer
