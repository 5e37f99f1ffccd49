// Boats of several forms, and things that are none, for tests: metres, y up, the sea at 0.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <string>
#include <vector>

namespace scumble::test {

struct HullShape {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> indices;
  // Whether a place is in the vessel, by at least so many metres from its sides; null: it holds nothing.
  std::function<bool(const glm::vec3&, float)> isInside = nullptr;

  // How far what is found may reach into the body around it, cells.
  float slack = 1.1f;

  void quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    const uint32_t first = uint32_t(positions.size());
    positions.insert(positions.end(), {a, b, c, d});
    for (const uint32_t corner : {0, 1, 2, 0, 2, 3}) indices.push_back(first + corner);
  }
  void box(const glm::vec3& low, const glm::vec3& high) {
    const auto corner = [&](int i) {
      return glm::vec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    };
    const int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& s : sides) quad(corner(s[0]), corner(s[1]), corner(s[2]), corner(s[3]));
  }
  void add(const HullShape& other, const glm::vec3& offset) {
    const uint32_t first = uint32_t(positions.size());
    for (const glm::vec3& p : other.positions) positions.push_back(p + offset);
    for (const uint32_t i : other.indices) indices.push_back(first + i);
  }
  // Points around the y axis: a profile of radii and heights, turned.
  void turned(const std::vector<glm::vec2>& profile, int sectors) {
    const auto at = [&](size_t i, int s) {
      const float angle = glm::two_pi<float>() * float(s) / float(sectors);
      return glm::vec3(profile[i].x * std::cos(angle), profile[i].y, profile[i].x * std::sin(angle));
    };
    for (size_t i = 0; i + 1 < profile.size(); ++i)
      for (int s = 0; s < sectors; ++s) quad(at(i, s), at(i, s + 1), at(i + 1, s + 1), at(i + 1, s));
  }
};

// A hull of straight, flaring sides with a rising sheer. `s`: from -1 at the stern to 1 at the bow.
struct DoryLines {
  float length = 5, beam = 1.9f, bottom = -0.25f;
  float sheer(float s) const { return 0.3f + 0.35f * s * s; }
  float halfTop(float s) const { return 0.5f * beam * (1.0f - 0.85f * s * s); }
  float halfBottom(float s) const { return 0.6f * halfTop(s); }
  // Half the width at a height.
  float half(float s, float y) const {
    return glm::mix(halfBottom(s), halfTop(s), (y - bottom) / (sheer(s) - bottom));
  }
  static constexpr int kStations = 16;
  // The outline between stations is straight.
  template <class Value>
  float between(float x, Value&& value) const {
    const float t = glm::clamp((x / length + 0.5f) * kStations, 0.0f, float(kStations) - 1e-3f);
    const float i = std::floor(t);
    const auto at = [&](float station) { return value(2.0f * station / kStations - 1.0f); };
    return glm::mix(at(i), at(i + 1.0f), t - i);
  }
};

inline HullShape doryShape(const DoryLines& lines = {}) {
  HullShape shape{"dory", {}, {}};
  const auto ring = [&](int i) {
    const float s = 2.0f * float(i) / DoryLines::kStations - 1.0f, x = 0.5f * lines.length * s;
    return std::array{
        glm::vec3(x, lines.sheer(s), -lines.halfTop(s)), glm::vec3(x, lines.bottom, -lines.halfBottom(s)),
        glm::vec3(x, lines.bottom, lines.halfBottom(s)), glm::vec3(x, lines.sheer(s), lines.halfTop(s))};
  };
  for (int i = 0; i < DoryLines::kStations; ++i)
    for (size_t k = 0; k < 3; ++k) shape.quad(ring(i)[k], ring(i + 1)[k], ring(i + 1)[k + 1], ring(i)[k + 1]);
  for (const int end : {0, int(DoryLines::kStations)})
    shape.quad(ring(end)[0], ring(end)[1], ring(end)[2], ring(end)[3]);
  shape.isInside = [lines](const glm::vec3& p, float margin) {
    const float sheer = lines.between(p.x, [&](float s) { return lines.sheer(s); });
    const float low = lines.between(p.x, [&](float s) { return lines.halfBottom(s); }),
                high = lines.between(p.x, [&](float s) { return lines.halfTop(s); });
    const float half = glm::mix(low, high, (p.y - lines.bottom) / (sheer - lines.bottom));
    return std::abs(p.x) < 0.5f * lines.length - margin && p.y > lines.bottom + margin && p.y < sheer &&
           std::abs(p.z) < half - margin;
  };
  return shape;
}

// A round bowl with sides as thick as a hand.
inline HullShape coracleShape() {
  HullShape shape{"coracle", {}, {}};
  std::vector<glm::vec2> profile;
  const auto sweep = [&](float radius, float depth, bool isDown) {
    for (int i = 0; i <= 8; ++i) {
      const float angle = glm::half_pi<float>() * float(isDown ? 8 - i : i) / 8.0f;
      profile.emplace_back(radius * std::sin(angle), 0.3f - depth * std::cos(angle));
    }
  };
  sweep(1.0f, 0.55f, false);
  sweep(0.94f, 0.49f, true);
  shape.turned(profile, 32);
  shape.slack = 2;
  shape.isInside = [](const glm::vec3& p, float margin) {
    const glm::vec3 q((p.x) / 0.935f, (p.y - 0.3f) / 0.485f, p.z / 0.935f);
    return p.y < 0.3f && glm::length(q) < 0.985f - 2.0f * margin;
  };
  return shape;
}

// A deck over all of it, but for a well aft; and a mast.
inline HullShape cockpitShape() {
  HullShape shape{"cockpit", {}, {}};
  const glm::vec3 low(-3, -0.5f, -1), high(3, 0.45f, 1), wellLow(-2, -0.2f, -0.6f), wellHigh(0, 0.45f, 0.6f);
  shape.box(low, {high.x, low.y + 0.02f, high.z});
  shape.quad({low.x, low.y, low.z}, {low.x, high.y, low.z}, {high.x, high.y, low.z}, {high.x, low.y, low.z});
  shape.quad({low.x, low.y, high.z}, {high.x, low.y, high.z}, {high.x, high.y, high.z},
             {low.x, high.y, high.z});
  shape.quad({low.x, low.y, low.z}, {low.x, low.y, high.z}, {low.x, high.y, high.z}, {low.x, high.y, low.z});
  shape.quad({high.x, low.y, low.z}, {high.x, high.y, low.z}, {high.x, high.y, high.z},
             {high.x, low.y, high.z});
  const auto deck = [&](float x0, float x1, float z0, float z1) {
    shape.quad({x0, high.y, z0}, {x0, high.y, z1}, {x1, high.y, z1}, {x1, high.y, z0});
  };
  deck(low.x, wellLow.x, low.z, high.z);
  deck(wellHigh.x, high.x, low.z, high.z);
  deck(wellLow.x, wellHigh.x, low.z, wellLow.z);
  deck(wellLow.x, wellHigh.x, wellHigh.z, high.z);
  const float y0 = wellLow.y, y1 = high.y;
  shape.quad({wellLow.x, y0, wellLow.z}, {wellHigh.x, y0, wellLow.z}, {wellHigh.x, y0, wellHigh.z},
             {wellLow.x, y0, wellHigh.z});
  for (const float z : {wellLow.z, wellHigh.z})
    shape.quad({wellLow.x, y0, z}, {wellLow.x, y1, z}, {wellHigh.x, y1, z}, {wellHigh.x, y0, z});
  for (const float x : {wellLow.x, wellHigh.x})
    shape.quad({x, y0, wellLow.z}, {x, y0, wellHigh.z}, {x, y1, wellHigh.z}, {x, y1, wellLow.z});
  shape.slack = 2.5f;
  shape.box({0.7f, high.y, -0.06f}, {0.82f, 6, 0.06f});
  shape.isInside = [=](const glm::vec3& p, float margin) {
    return glm::all(glm::greaterThan(p, wellLow + margin)) && p.x < wellHigh.x - margin &&
           p.z < wellHigh.z - margin && p.y < wellHigh.y;
  };
  return shape;
}

// Two narrow hulls under a bridge.
inline HullShape catamaranShape() {
  const DoryLines lines{4.5f, 0.9f, -0.3f};
  const HullShape one = doryShape(lines);
  HullShape shape{"catamaran", {}, {}};
  const glm::vec3 apart(0, 0, 0.9f);
  shape.add(one, apart);
  shape.add(one, -apart);
  shape.box({-0.3f, 0.45f, -1.1f}, {0.1f, 0.5f, 1.1f});
  shape.isInside = [=](const glm::vec3& p, float margin) {
    return one.isInside(p - apart, margin) || one.isInside(p + apart, margin);
  };
  return shape;
}

inline std::vector<HullShape> vesselShapes() {
  return {doryShape(), coracleShape(), cockpitShape(), catamaranShape()};
}

// What lets the sea in, or has no opening.
inline std::vector<HullShape> leakyShapes() {
  HullShape ring{"ring", {}, {}}, tube{"tube", {}, {}}, arch{"arch", {}, {}}, table{"table", {}, {}},
      box{"closed box", {}, {}}, bell{"upturned bowl", {}, {}};
  std::vector<glm::vec2> section;
  for (int i = 0; i <= 12; ++i) {
    const float angle = glm::two_pi<float>() * float(i) / 12;
    section.emplace_back(1.2f + 0.3f * std::cos(angle), 0.3f * std::sin(angle));
  }
  ring.turned(section, 24);
  tube.turned({{1, -0.6f}, {1, 0.6f}}, 24);
  arch.box({-1.5f, -1, -0.5f}, {-1, 1, 0.5f});
  arch.box({1, -1, -0.5f}, {1.5f, 1, 0.5f});
  arch.box({-1.5f, 1, -0.5f}, {1.5f, 1.4f, 0.5f});
  table.box({-1, 0.3f, -0.7f}, {1, 0.4f, 0.7f});
  for (const float x : {-0.9f, 0.8f})
    for (const float z : {-0.6f, 0.5f}) table.box({x, -0.6f, z}, {x + 0.1f, 0.3f, z + 0.1f});
  box.box({-1.5f, -0.4f, -0.8f}, {1.5f, 0.5f, 0.8f});
  bell.turned({{0, 0.5f}, {0.8f, 0.4f}, {1, -0.3f}}, 24);
  return {ring, tube, arch, table, box, bell};
}

}  // namespace scumble::test
