#include "tests/support/posed_scene.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace scumble::test {

namespace {

using scene::AnimatedProperty;
using scene::ChannelInterpolation;

using Numbers = std::vector<double>;

Numbers scaled(const Numbers& a, double by) {
  Numbers result = a;
  for (double& x : result) x *= by;
  return result;
}
Numbers plus(const Numbers& a, const Numbers& b) {
  Numbers result = a;
  for (size_t i = 0; i < a.size(); ++i) result[i] += b[i];
  return result;
}
double dot(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Appendix C.4: along the shorter arc.
Numbers slerp(const Numbers& a, const Numbers& b, double t) {
  const double d = dot(a, b), angle = std::acos(std::min(std::abs(d), 1.0)), side = d < 0 ? -1 : 1;
  if (angle < 1e-6) return plus(scaled(a, 1 - t), scaled(b, side * t));
  return plus(scaled(a, std::sin((1 - t) * angle) / std::sin(angle)),
              scaled(b, side * std::sin(t * angle) / std::sin(angle)));
}

// Average of what clips say of a property, filled up by what it is at rest.
Numbers mixed(const scene::SceneData& scene, const Moments& moments, size_t node, AnimatedProperty property,
              const Numbers& rest) {
  Numbers sum(rest.size(), 0.0);
  double shares = 0;
  for (const ClipMoment& moment : moments)
    for (const scene::Channel& channel : scene.clips[moment.clip].channels) {
      if (channel.node != int(node) || channel.property != property) continue;
      const Numbers value = channelAt(channel, moment.seconds);
      const bool turned = property == AnimatedProperty::rotation && dot(value, rest) < 0;
      sum = plus(sum, scaled(value, turned ? -moment.share : moment.share));
      shares += moment.share;
    }
  return plus(sum, scaled(rest, 1 - shares));
}

glm::dvec3 vector(const Numbers& v) {
  return {v[0], v[1], v[2]};
}
Numbers numbers(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

glm::dmat4 localMatrix(const scene::SceneData& scene, const Moments& moments, size_t n) {
  const scene::Node& node = scene.nodes[n];
  if (node.localMatrix) return glm::dmat4(*node.localMatrix);
  const glm::quat& turn = node.local.rotation;
  const Numbers q = mixed(scene, moments, n, AnimatedProperty::rotation, {turn.x, turn.y, turn.z, turn.w});
  const auto of = [&](AnimatedProperty property, const glm::vec3& rest) {
    return vector(mixed(scene, moments, n, property, numbers(rest)));
  };
  // 3.5.2: scale, then rotation, then translation.
  return glm::translate(glm::dmat4(1.0), of(AnimatedProperty::translation, node.local.translation)) *
         glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2]))) *
         glm::scale(glm::dmat4(1.0), of(AnimatedProperty::scale, node.local.scale));
}

// A vertex at rest with its morph targets (3.7.2.2).
struct Vertex {
  glm::dvec3 position, normal;
};
Vertex morphed(const scene::Primitive& p, size_t v, const Numbers& weights) {
  Vertex result{glm::dvec3(p.positions[v]), glm::dvec3(p.normals[v])};
  for (size_t t = 0; t < p.morphTargets.size(); ++t) {
    const scene::MorphTarget& target = p.morphTargets[t];
    if (!target.positions.empty()) result.position += weights[t] * glm::dvec3(target.positions[v]);
    if (!target.normals.empty()) result.normal += weights[t] * glm::dvec3(target.normals[v]);
  }
  return result;
}

// 3.7.3.3: joints alone place a skinned vertex, in the world.
glm::dmat4 skinMatrix(const scene::Primitive& p, const scene::Skin& skin, size_t v,
                      const std::vector<glm::dmat4>& world) {
  glm::dmat4 sum(0.0);
  for (size_t k = 0; k < size_t(p.influences); ++k) {
    const size_t i = v * size_t(p.influences) + k, joint = p.joints[i];
    sum += double(p.weights[i]) *
           (world[size_t(skin.joints[joint])] * glm::dmat4(skin.inverseBindMatrices[joint]));
  }
  return sum;
}

Vertex placed(const Vertex& vertex, const glm::dmat4& matrix) {
  return {glm::dvec3(matrix * glm::dvec4(vertex.position, 1)),
          glm::normalize(glm::inverse(glm::transpose(glm::dmat3(matrix))) * vertex.normal)};
}

}  // namespace

std::vector<double> channelAt(const scene::Channel& channel, double seconds) {
  const size_t n = size_t(channel.componentsPerKey), count = channel.times.size();
  const bool cubic = channel.interpolation == ChannelInterpolation::cubicSpline;
  // `part`: of a cubic key, 0 the in-tangent, 1 the value, 2 the out-tangent.
  const auto at = [&](size_t key, size_t part) {
    const float* first = &channel.values[cubic ? (3 * key + part) * n : key * n];
    return Numbers(first, first + n);
  };
  size_t key = 0;
  while (key + 1 < count && double(channel.times[key + 1]) <= seconds) ++key;
  if (seconds <= double(channel.times[0]) || key + 1 == count ||
      channel.interpolation == ChannelInterpolation::step)
    return at(key, 1);
  const double length = double(channel.times[key + 1]) - double(channel.times[key]),
               t = (seconds - double(channel.times[key])) / length;
  const bool rotates = channel.property == AnimatedProperty::rotation;
  if (!cubic)
    return rotates ? slerp(at(key, 1), at(key + 1, 1), t)
                   : plus(scaled(at(key, 1), 1 - t), scaled(at(key + 1, 1), t));
  // Appendix C.5.
  const double t2 = t * t, t3 = t2 * t;
  Numbers value =
      plus(plus(scaled(at(key, 1), 2 * t3 - 3 * t2 + 1), scaled(at(key, 2), length * (t3 - 2 * t2 + t))),
           plus(scaled(at(key + 1, 1), -2 * t3 + 3 * t2), scaled(at(key + 1, 0), length * (t3 - t2))));
  return rotates ? scaled(value, 1 / std::sqrt(dot(value, value))) : value;
}

std::vector<glm::dmat4> posedNodes(const scene::SceneData& scene, const Moments& moments) {
  std::vector<glm::dmat4> world;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    world.push_back(localMatrix(scene, moments, n));
    if (const int parent = scene.nodes[n].parent; parent >= 0) world[n] = world[size_t(parent)] * world[n];
  }
  return world;
}

std::vector<PosedPrimitive> posedPrimitives(const scene::SceneData& scene, const Moments& moments) {
  const std::vector<glm::dmat4> world = posedNodes(scene, moments);
  std::vector<PosedPrimitive> posed;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const scene::Node& node = scene.nodes[n];
    if (node.mesh < 0) continue;
    const scene::Mesh& mesh = scene.meshes[size_t(node.mesh)];
    const std::vector<float>& rest = node.morphWeights.empty() ? mesh.morphWeights : node.morphWeights;
    PosedPrimitive one;
    one.mesh = &mesh;
    one.id = int(n) + 1;
    one.morphWeights = mixed(scene, moments, n, AnimatedProperty::weights, Numbers(rest.begin(), rest.end()));
    for (const scene::Primitive& p : mesh.primitives) {
      one.primitive = &p;
      one.mirror = 1;
      if (node.skin >= 0 && p.influences > 0) {
        one.toWorld.clear();
        for (size_t v = 0; v < p.vertexCount(); ++v)
          one.toWorld.push_back(skinMatrix(p, scene.skins[size_t(node.skin)], v, world));
        posed.push_back(one);
        continue;
      }
      const std::vector<glm::mat4> here{glm::mat4(1.0f)};
      for (const glm::mat4& instance : node.instances.empty() ? here : node.instances) {
        one.toWorld.assign(p.vertexCount(), world[n] * glm::dmat4(instance));
        one.mirror = glm::determinant(glm::dmat3(world[n] * glm::dmat4(instance))) < 0 ? -1 : 1;
        posed.push_back(one);
      }
    }
  }
  return posed;
}

std::vector<WorldTriangle> posedTriangles(const scene::SceneData& scene, const Moments& moments) {
  std::vector<WorldTriangle> triangles;
  for (const PosedPrimitive& posed : posedPrimitives(scene, moments)) {
    const scene::Primitive& p = *posed.primitive;
    std::vector<Vertex> vertices;
    for (size_t v = 0; v < p.vertexCount(); ++v)
      vertices.push_back(placed(morphed(p, v, posed.morphWeights), posed.toWorld[v]));
    for (size_t i = 0; i < p.indices.size(); i += 3) {
      WorldTriangle t;
      t.id = posed.id;
      for (size_t k = 0; k < 3; ++k) {
        const Vertex& vertex = vertices[p.indices[i + k]];
        t.positions[k] = vertex.position, t.normals[k] = vertex.normal;
      }
      t.outward = posed.mirror * glm::cross(t.positions[1] - t.positions[0], t.positions[2] - t.positions[0]);
      triangles.push_back(t);
      if (!scene.materials[size_t(p.material)].doubleSided) continue;
      t.outward = -t.outward;
      for (glm::dvec3& normal : t.normals) normal = -normal;
      triangles.push_back(t);
    }
  }
  return triangles;
}

}  // namespace scumble::test
