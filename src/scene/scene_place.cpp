#include "scene/scene_place.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <set>

#include "scene/find_node.h"
#include "scene/import_failure.h"
#include "scene/scene_bounds.h"
#include "scumble/nearest.h"

namespace scumble::scene {

namespace {

constexpr double kFarthest = 1e7;                    // metres: a planet's radius and more
constexpr float kSmallest = 1e-6f, kLargest = 1e6f;  // factors
constexpr float kMostDegrees = 36000;
// What each copy of a scene has for itself: worlds within worlds multiply.
constexpr size_t kMostNodes = 1 << 20, kMostClipNumbers = size_t(1) << 28;

// What a scene stands on: a node of another one, or that one itself.
struct Support {
  int scene = -1;  // -1: the world
  int node = -1;   // -1: the node that carries that scene
};

void nameApart(std::vector<PlacedScene>& scenes) {
  std::set<std::string> taken;
  for (PlacedScene& one : scenes) {
    std::string name = one.name.empty() ? one.scene.data().name : one.name;
    const std::string plain = name;
    for (int number = 2; !taken.insert(name).second; ++number) name = plain + "-" + std::to_string(number);
    one.name = name;
  }
}

bool isWithin(const glm::dvec3& v, double most) {
  return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;
}

bool checkNumbers(const PlacedScene& one, PlacementProblem& problem) {
  const auto wrong = [&](const char* member, std::string what, std::string advice) {
    problem.member = member, problem.problem = std::move(what), problem.advice = std::move(advice);
    return false;
  };
  if (!isWithin(one.at, kFarthest))
    return wrong("at", "its place is out of range", "give metres, ten million at most");
  if (!isWithin(one.turn, kMostDegrees))
    return wrong("turn", "its turn is out of range", "give degrees, 36000 at most");
  if (one.scale == 0) return wrong("scale", "a scale of 0 leaves nothing of it", "give one above 0");
  if (!(one.scale >= kSmallest && one.scale <= kLargest))
    return wrong("scale", "its scale is out of range", "give one above 0, a million at most");
  return true;
}

// The node that `on` means in a scene of this name; -1: none.
int nodeIn(const PlacedScene& one, const std::string& on) {
  const int node = findNode(one.scene.data(), on);
  if (node >= 0 || !on.starts_with(one.name + "/")) return node;
  return findNode(one.scene.data(), on.substr(one.name.size() + 1));
}

bool findSupport(const std::vector<PlacedScene>& scenes, size_t which, Support& support,
                 PlacementProblem& problem) {
  const std::string& on = scenes[which].on;
  if (on.empty()) return true;
  problem.member = "on";
  std::vector<size_t> found;
  for (size_t i = 0; i < scenes.size(); ++i)
    if (i != which && nodeIn(scenes[i], on) >= 0) found.push_back(i);
  if (found.size() > 1) {
    problem.problem = "several scenes have a node '" + on + "'";
    problem.advice =
        "write '" + scenes[found[0]].name + "/" + on + "' or '" + scenes[found[1]].name + "/" + on + "'";
    return false;
  }
  if (!found.empty()) {
    support = {int(found[0]), nodeIn(scenes[found[0]], on)};
    return true;
  }
  for (size_t i = 0; i < scenes.size(); ++i)
    if (i != which && scenes[i].name == on) {
      support = {int(i), -1};
      return true;
    }
  if (on == scenes[which].name || nodeIn(scenes[which], on) >= 0) {
    problem.problem = "it cannot stand on itself ('" + on + "')";
    problem.advice = "name a node of another scene";
    return false;
  }
  std::vector<std::string> known;
  for (size_t i = 0; i < scenes.size(); ++i) {
    if (i == which) continue;
    known.push_back(scenes[i].name);
    for (const Node& node : scenes[i].scene.data().nodes) {
      known.push_back(node.name);
      known.push_back(scenes[i].name + "/" + node.name);
    }
  }
  const std::string meant = nearest(on, known);
  problem.problem = "no other scene has a node '" + on + "' to stand on";
  problem.advice = meant.empty() ? "`scumble info` lists a scene's nodes" : "did you mean '" + meant + "'?";
  return false;
}

// The scenes in an order in which each comes after what it stands on; empty where they stand in a circle.
std::vector<size_t> orderOf(const std::vector<PlacedScene>& scenes, const std::vector<Support>& supports,
                            PlacementProblem& problem) {
  std::vector<size_t> order;
  std::vector<bool> isPlaced(scenes.size(), false);
  for (size_t i = 0; i < scenes.size(); ++i) {
    std::vector<size_t> way;  // down to the ground
    for (int at = int(i); at >= 0 && !isPlaced[size_t(at)]; at = supports[size_t(at)].scene) {
      if (const auto again = std::find(way.begin(), way.end(), size_t(at)); again != way.end()) {
        std::string circle;
        for (auto one = again; one != way.end(); ++one) circle += "'" + scenes[*one].name + "' on ";
        problem = {*again, "on",
                   "scenes stand on each other in a circle: " + circle + "'" + scenes[*again].name + "'",
                   "let one stand in the world"};
        return {};
      }
      way.push_back(size_t(at));
    }
    for (auto one = way.rbegin(); one != way.rend(); ++one) {
      isPlaced[*one] = true;
      order.push_back(*one);
    }
  }
  return order;
}

glm::dquat turned(const glm::vec3& degrees) {
  const auto about = [](float angle, const glm::dvec3& axis) {
    return glm::angleAxis(glm::radians(std::remainder(double(angle), 360.0)), axis);
  };
  return about(degrees.z, {0, 0, 1}) * about(degrees.y, {0, 1, 0}) * about(degrees.x, {1, 0, 0});
}

// What takes a node's own axes and scale at rest away: exporters give nodes a scale of 100, and lay them on
// their backs. Nothing where the node is flat.
std::optional<glm::dmat4> uprightOn(const PlacedScene& support, int node) {
  const glm::dmat3 rest(worldMatrices(support.scene.data())[size_t(node)]);
  const double size = glm::length(rest[0]) * glm::length(rest[1]) * glm::length(rest[2]);
  if (!(std::abs(glm::determinant(rest)) > 1e-9 * size)) return std::nullopt;
  return glm::dmat4(glm::inverse(rest));
}

// Everything that can be known before anything is copied.
struct Plan {
  std::vector<Support> supports;
  std::vector<size_t> order;  // in which each scene comes after what it stands on
};

std::optional<Plan> planOf(std::vector<PlacedScene>& scenes, PlacementProblem& problem) {
  for (size_t i = 0; i < scenes.size(); ++i)
    if (scenes[i].scene.empty()) {
      problem = {i, "", "the scene is empty", "load one with Scene::load"};
      return std::nullopt;
    }
  nameApart(scenes);
  Plan plan;
  plan.supports.resize(scenes.size());
  for (size_t i = 0; i < scenes.size(); ++i) {
    problem.scene = i;
    if (!checkNumbers(scenes[i], problem) || !findSupport(scenes, i, plan.supports[i], problem))
      return std::nullopt;
  }
  plan.order = orderOf(scenes, plan.supports, problem);
  if (plan.order.size() < scenes.size()) return std::nullopt;
  return plan;
}

}  // namespace

std::optional<PlacementProblem> problemWith(std::vector<PlacedScene> scenes) {
  PlacementProblem problem;
  if (planOf(scenes, problem)) return std::nullopt;
  return problem;
}

std::shared_ptr<SceneData> placeScenes(std::vector<PlacedScene>& scenes, PlacementProblem& problem) {
  const std::optional<Plan> plan = planOf(scenes, problem);
  if (!plan) return nullptr;
  const auto& [supports, order] = *plan;

  // Nodes lie in that order, parents before children; all else as given.
  auto all = std::make_shared<SceneData>();
  all->keepsVertices = false;  // unless one of them does
  std::vector<size_t> carrier(scenes.size());
  std::vector<float> scales(scenes.size(), 1.0f);
  size_t nodes = 0;
  for (const size_t i : order) {
    carrier[i] = nodes;
    nodes += 1 + scenes[i].scene.data().nodes.size();
    scales[i] = scenes[i].scale * (supports[i].scene >= 0 ? scales[size_t(supports[i].scene)] : 1.0f);
  }
  // Not more than there may be.
  size_t clipNumbers = 0;
  for (const PlacedScene& one : scenes)
    for (const Clip& clip : one.scene.data().clips)
      for (const Channel& channel : clip.channels)
        clipNumbers += channel.times.size() + channel.values.size();
  if (nodes > kMostNodes || clipNumbers > kMostClipNumbers) {
    problem = {scenes.size(), "", "the scenes have too many nodes or keys of clips together", "place fewer"};
    return nullptr;
  }
  // One after the other, each below the node that carries it.
  all->nodes.resize(nodes);
  std::map<const SceneData*, Appended> appended;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const SceneData& one = scenes[i].scene.data();
    if (i == 0) all->name = one.name;
    const size_t cameras = all->cameras.size();
    const auto [shared, isNew] =
        appended.try_emplace(&one, Appended{all->images.size(), all->materials.size(), all->meshes.size()});
    appendScene(*all, one, carrier[i] + 1, isNew ? nullptr : &shared->second);
    Node& node = all->nodes[carrier[i]];
    node.name = scenes[i].name;
    node.local = {scenes[i].at, turned(scenes[i].turn), glm::dvec3(double(scenes[i].scale))};
    if (supports[i].scene >= 0) node.parent = int(carrier[size_t(supports[i].scene)]) + 1 + supports[i].node;
    if (supports[i].node >= 0) {
      const std::optional<glm::dmat4> upright =
          uprightOn(scenes[size_t(supports[i].scene)], supports[i].node);
      if (!upright) {
        problem = {i, "on", "nothing can stand on '" + scenes[i].on + "', which has no extent",
                   "name another node"};
        return nullptr;
      }
      node.localMatrix = *upright * node.local.matrix();
    }
    for (size_t n = carrier[i] + 1; n <= carrier[i] + one.nodes.size(); ++n) {
      Node& own = all->nodes[n];
      if (own.parent < 0) own.parent = int(carrier[i]);
      // What is written in metres is of the scene's own size.
      own.extrasScale *= scales[i];
    }
    for (size_t c = cameras; c < all->cameras.size(); ++c)
      for (float* metres : {&all->cameras[c].halfHeight, &all->cameras[c].near, &all->cameras[c].far})
        *metres *= scales[i];
  }
  // What the world takes up.
  if (all->materials.empty()) all->materials.resize(1);
  try {
    ImportWarnings warnings;
    placeScene(*all, warnings);
    requireMeshes(*all);
    for (std::string& line : warnings.lines(all->name)) all->warnings.push_back(std::move(line));
  } catch (const ImportFailure& failure) {
    problem = {scenes.size(), "", failure.error.problem, failure.error.advice};
    return nullptr;
  }
  return all;
}

}  // namespace scumble::scene
