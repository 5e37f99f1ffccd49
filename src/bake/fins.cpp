#include "bake/fins.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace scumble::bake {

namespace {

constexpr int kSmoothings = 3;         // of directions
constexpr float kOffsetPart = 0.97f;   // of the splats over a triangle lie within the shell
constexpr float kReach = 0.9f;         // of a splat's radius that counts as paint
constexpr float kLeastOffset = 1e-3f;  // of the proxy's extent: less, and there is no fin

// Means over the edges around each place, which keep what they began with by half.
template <class Value>
std::vector<Value> smoothed(const Proxy& proxy, const std::vector<Value>& values) {
  std::vector<Value> sums(values.size(), Value(0));
  std::vector<float> counts(values.size(), 0);
  for (const ProxyEdge& edge : proxy.edges) {
    sums[edge.a] += values[edge.b], sums[edge.b] += values[edge.a];
    ++counts[edge.a], ++counts[edge.b];
  }
  for (size_t i = 0; i < values.size(); ++i)
    sums[i] = counts[i] > 0 ? 0.5f * values[i] + (0.5f / counts[i]) * sums[i] : values[i];
  return sums;
}

float extentOf(const Proxy& proxy) {
  scene::Bounds box;
  for (const glm::vec3& p : proxy.places) box.add(p);
  return box.radius();
}

}  // namespace

Shell makeShell(const Proxy& proxy, const std::vector<Splat>& splats, const std::vector<float>& fixedOffset) {
  Shell shell;
  shell.directions = proxy.normals;
  for (int i = 0; i < kSmoothings; ++i) {
    shell.directions = smoothed(proxy, shell.directions);
    for (size_t p = 0; p < shell.directions.size(); ++p) {
      // Never so far that it would turn back into the surface.
      const glm::vec3 turned = unitOr(proxy.normals[p], shell.directions[p]);
      shell.directions[p] = glm::dot(turned, proxy.normals[p]) > 0.5f ? turned : proxy.normals[p];
    }
  }
  std::vector<std::vector<float>> heights(proxy.triangles.size());
  for (const Splat& splat : splats)
    heights[size_t(splat.triangle)].push_back(std::max(splat.height, 0.0f) + kReach * splat.radius);
  shell.offsets.assign(proxy.places.size(), 0);
  for (size_t t = 0; t < heights.size(); ++t) {
    std::vector<float>& own = heights[t];
    float offset = 0;
    if (!own.empty()) {
      const auto nth = own.begin() + std::ptrdiff_t(kOffsetPart * float(own.size() - 1));
      std::nth_element(own.begin(), nth, own.end());
      offset = *nth;
    }
    for (int c = 0; c < 3; ++c) {
      float& at = shell.offsets[proxy.triangles[t].places[c]];
      at = std::max(at, offset);
    }
  }
  const std::vector<float> mean = smoothed(proxy, shell.offsets);
  for (size_t p = 0; p < mean.size(); ++p)
    if (shell.offsets[p] > 0) shell.offsets[p] = std::max(shell.offsets[p], mean[p]);
  for (const ProxyTriangle& t : proxy.triangles)
    if (fixedOffset[t.primitive] > 0)
      for (int c = 0; c < 3; ++c) shell.offsets[t.places[c]] = fixedOffset[t.primitive];
  const float least = kLeastOffset * extentOf(proxy);
  for (float& offset : shell.offsets)
    if (offset > 0) offset = std::max(offset, least);
  return shell;
}

std::vector<uint32_t> matchedEdges(const Proxy& proxy, uint32_t place, const std::vector<bool>& hasFin) {
  const std::vector<uint32_t>& edges = proxy.edgesAt[place];
  std::vector<uint32_t> matched(edges.size(), ~0u);
  const auto away = [&](uint32_t e) {
    const ProxyEdge& edge = proxy.edges[e];
    return unitOr({0, 0, 0}, proxy.places[edge.a == place ? edge.b : edge.a] - proxy.places[place]);
  };
  std::vector<std::tuple<float, size_t, size_t>> pairs;  // how far from straight, and which
  for (size_t i = 0; i < edges.size(); ++i)
    for (size_t k = i + 1; k < edges.size(); ++k) {
      const float bend = glm::dot(away(edges[i]), away(edges[k]));
      if (bend < 0 && hasFin[edges[i]] && hasFin[edges[k]]) pairs.emplace_back(bend, i, k);
    }
  std::sort(pairs.begin(), pairs.end());
  // The straightest pair of all are each other's best; without them, the next one; and so on.
  for (const auto& [bend, i, k] : pairs)
    if (matched[i] == ~0u && matched[k] == ~0u) matched[i] = edges[k], matched[k] = edges[i];
  for (const auto& [bend, i, k] : pairs) {
    if (matched[i] == ~0u) matched[i] = edges[k];
    if (matched[k] == ~0u) matched[k] = edges[i];
  }
  return matched;
}

std::vector<Fin> makeFins(const Proxy& proxy, const Shell& shell) {
  std::vector<bool> hasFin(proxy.edges.size());
  std::vector<glm::vec3> normals(proxy.edges.size());
  for (size_t e = 0; e < proxy.edges.size(); ++e) {
    const ProxyEdge& edge = proxy.edges[e];
    const glm::vec3 along = proxy.places[edge.b] - proxy.places[edge.a];
    const glm::vec3 normal = glm::cross(along, shell.directions[edge.a] + shell.directions[edge.b]);
    hasFin[e] = !edge.isDiagonal && (shell.offsets[edge.a] > 0 || shell.offsets[edge.b] > 0) &&
                glm::length(normal) > 1e-3f * glm::length(along) && glm::length(along) > 0;
    normals[e] = unitOr({0, 0, 1}, normal);
  }
  std::vector<Fin> fins;
  std::vector<std::array<glm::vec3, 2>> matched(proxy.edges.size());
  for (size_t e = 0; e < matched.size(); ++e) matched[e] = {normals[e], normals[e]};
  for (uint32_t p = 0; p < proxy.places.size(); ++p) {
    const std::vector<uint32_t> others = matchedEdges(proxy, p, hasFin);
    for (size_t i = 0; i < others.size(); ++i) {
      if (others[i] == ~0u) continue;
      const uint32_t e = proxy.edgesAt[p][i];
      const glm::vec3& own = normals[e];
      const glm::vec3& next = normals[others[i]];
      matched[e][proxy.edges[e].a == p ? 0 : 1] = unitOr(own, own + (glm::dot(own, next) < 0 ? -next : next));
    }
  }
  for (uint32_t e = 0; e < proxy.edges.size(); ++e) {
    if (!hasFin[e]) continue;
    const ProxyEdge& edge = proxy.edges[e];
    Fin fin;
    fin.edge = e;
    fin.primitive = proxy.triangles[size_t(edge.triangles[0])].primitive;
    const glm::vec3 &a = proxy.places[edge.a], &b = proxy.places[edge.b];
    fin.corners = {a, b, b + shell.offsets[edge.b] * shell.directions[edge.b],
                   a + shell.offsets[edge.a] * shell.directions[edge.a]};
    fin.normal = normals[e];
    fin.matched = matched[e];
    // (Section 3.2: the volume spanned by the triangles beside it.) Of a chart, both.
    for (const int t : edge.triangles)
      if (t >= 0)
        for (const int of : proxy.charts[proxy.triangles[size_t(t)].chart].triangles)
          if (of >= 0)
            for (int c = 0; c < 3; ++c)
              fin.depth = std::max(
                  fin.depth,
                  std::abs(glm::dot(proxy.places[proxy.triangles[size_t(of)].places[c]] - a, fin.normal)));
    fins.push_back(fin);
  }
  return fins;
}

}  // namespace scumble::bake
