#include "world/ground.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace scumble::world {

namespace {

constexpr float kGap = 0.002f;  // below the scene, in radii; strokes lie in its lower half

// A number in 0 to 1 that is another one for each stroke and purpose, evenly spread over strokes: multiples
// of numbers that are far from fractions (powers of 0.8192, 1 over the root of x^4 = x + 1).
float spread(int stroke, int purpose) {
  constexpr double kSteps[] = {0.8191725134, 0.6710436067, 0.5497004779, 0.4503, 0.3689};
  const double at = 0.5 + (stroke + 1) * kSteps[purpose];
  return float(at - std::floor(at));
}

class Ground {
 public:
  explicit Ground(const scene::Bounds& bounds)
      : radius_(std::max(bounds.radius(), 1e-6f)),
        middle_(bounds.center().x, groundHeight(bounds), bounds.center().z) {}

  // Rings that widen, so that it is fine near the scene and reaches far.
  void addDisc() {
    constexpr int kSectors = 48, kRings = 9;
    constexpr float kReach = 40.0f;
    const auto angle = [](int s) { return glm::two_pi<float>() * float(s) / kSectors; };
    const uint32_t first = addVertex({0, 0}, 0);
    for (int ring = 1; ring <= kRings; ++ring)
      for (int s = 0; s < kSectors; ++s)
        addVertex(
            kReach * std::pow(float(ring) / kRings, 2.5f) * glm::vec2(std::cos(angle(s)), std::sin(angle(s))),
            0);
    const auto at = [&](int ring, int s) {
      return ring == 0 ? first : first + uint32_t(1 + (ring - 1) * kSectors + s % kSectors);
    };
    for (int ring = 0; ring < kRings; ++ring)
      for (int s = 0; s < kSectors; ++s) {
        made_.indices.insert(made_.indices.end(), {at(ring, s), at(ring + 1, s), at(ring + 1, s + 1)});
        if (ring > 0)
          made_.indices.insert(made_.indices.end(), {at(ring, s), at(ring + 1, s + 1), at(ring, s + 1)});
      }
  }

  // Strokes that from all sides lie across what is seen. The farther, the broader: on the screen they are
  // then about as broad everywhere. Topmost first.
  void addStrokes(int tone) {
    constexpr int kStrokes = 16;
    for (int stroke = tone - 1; stroke < kStrokes; stroke += kGroundTones - 1) {
      const float far = 0.6f * std::exp2(4.0f * spread(stroke, 0));
      addStroke({stroke, far, glm::two_pi<float>() * spread(stroke, 1),
                 far * (0.10f + 0.10f * spread(stroke, 2)), far * (0.4f + 0.4f * spread(stroke, 3)),
                 0.3f * (spread(stroke, 4) - 0.5f), 0.5f * kGap * (1 - float(stroke) / kStrokes)});
    }
  }

  scene::Primitive take() { return std::move(made_); }

 private:
  // Lengths in scene radii.
  struct Stroke {
    int number;
    float far, angle;       // where its middle is
    float breadth, length;  // half of both
    float turn;             // how far it runs outwards, over its length
    float above;            // the ground
  };

  // As some hairs of a brush leave it: bands beside one another, each of its own length.
  void addStroke(const Stroke& stroke) {
    constexpr int kBands = 6, kSteps = 8;
    constexpr float kOverlap = 0.04f;  // their steps do not meet: cracks would be torn
    for (int band = 0; band < kBands; ++band) {
      const float low = 2.0f * float(band) / kBands - 1, high = 2.0f * float(band + 1) / kBands - 1;
      // Round ends, of which each hair strays a little.
      const float across = 0.5f * (low + high), round = 0.6f * (1 - std::sqrt(1 - across * across));
      const int hair = stroke.number * kBands + band;
      const float from = -1 + round + 0.25f * spread(hair, 1), to = 1 - round - 0.25f * spread(hair, 2);
      for (int i = 0; i <= kSteps; ++i) {
        const float along = from + (to - from) * float(i) / kSteps;
        const auto add = [&](float at) {
          // A little bent around the scene.
          const glm::vec2 local(
              stroke.far + stroke.breadth * at + stroke.length * along * (stroke.turn - 0.15f * along),
              stroke.length * along);
          const float c = std::cos(stroke.angle), s = std::sin(stroke.angle);
          return addVertex({c * local.x - s * local.y, s * local.x + c * local.y}, stroke.above);
        };
        const uint32_t here = add(band > 0 ? low - kOverlap : low);
        add(high);
        if (i < kSteps)
          made_.indices.insert(made_.indices.end(), {here, here + 1, here + 3, here, here + 3, here + 2});
      }
    }
  }

  // `at`: seen from above, north up, in scene radii.
  uint32_t addVertex(glm::vec2 at, float above) {
    made_.positions.push_back(middle_ + radius_ * glm::vec3(at.x, above, -at.y));
    made_.uv0.push_back({at.x, -at.y});
    made_.normals.push_back({0, 1, 0});
    made_.smoothNormals.push_back({0, 1, 0});
    made_.dPdu.push_back({radius_, 0, 0});
    made_.dPdv.push_back({0, 0, radius_});
    return uint32_t(made_.vertexCount()) - 1;
  }

  float radius_;
  glm::vec3 middle_;
  scene::Primitive made_;
};

}  // namespace

float groundHeight(const scene::Bounds& bounds) {
  return bounds.min.y - kGap * std::max(bounds.radius(), 1e-6f);
}

scene::Primitive makeGround(const scene::Bounds& bounds) {
  Ground ground(bounds);
  ground.addDisc();
  return ground.take();
}

scene::Primitive makeGroundStrokes(const scene::Bounds& bounds, int tone) {
  Ground ground(bounds);
  ground.addStrokes(tone);
  return ground.take();
}

glm::vec3 groundTone(int tone, float amount) {
  // Its own, a warmer and a cooler one.
  constexpr glm::vec3 kTones[kGroundTones] = {
      {1.0f, 1.0f, 1.0f}, {0.92f, 0.88f, 0.84f}, {0.83f, 0.88f, 0.90f}};
  return glm::mix(glm::vec3(1.0f), kTones[tone], amount);
}

}  // namespace scumble::world
