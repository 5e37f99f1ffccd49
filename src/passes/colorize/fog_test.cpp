// FORMULAS 16: the closed forms of fog.shared.h, as C++ compiles them, against quadrature in double
// precision.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <random>

#include "passes/colorize/fog.shared.h"

namespace scumble::passes {
namespace {

using Density = std::function<double(const glm::dvec3&)>;
using Fog = std::function<float(const glm::vec3& eye, const glm::vec3& ray, float way)>;

double sphereAt(const glm::dvec3& q) {
  return std::max(1 - glm::dot(q, q), 0.0);
}
double boxAt(const glm::dvec3& q) {
  double density = 1;
  for (int i = 0; i < 3; ++i) density *= std::max(1 - q[i] * q[i], 0.0);
  return density;
}
double capsuleAt(const glm::dvec3& q, double axis) {
  return sphereAt({q.x, q.y - std::clamp(q.y, -axis, axis), q.z});
}

class FogTest : public ::testing::Test {
 protected:
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  glm::dvec3 direction() {
    const double z = number(-1, 1), angle = number(0, glm::two_pi<double>()), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

  // The midpoint rule, where a ray is within `reach` of the origin. Densities have kinks; halving the steps
  // divides its error by four.
  static double quadrature(const Density& density, const glm::dvec3& eye, const glm::dvec3& ray, double way,
                           double reach) {
    const double nearest = -glm::dot(eye, ray);
    const double from = std::max(0.0, nearest - reach), to = std::min(way, nearest + reach);
    if (to <= from) return 0;
    constexpr int kSteps = 1000;
    const double step = (to - from) / kSteps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) sum += density(eye + (from + (i + 0.5) * step) * ray);
    return sum * step;
  }

  // Rays from inside and outside, towards the volume and past it, and away from it; cut short, or endless;
  // along axes and nearly so.
  void expectSame(const Density& density, const Fog& fog, double reach) {
    size_t inside = 0, cut = 0, none = 0, through = 0;
    for (int i = 0; i < 6000; ++i) {
      const glm::dvec3 target = number(0, reach) * direction();
      const double distance = i % 3 == 0 ? number(0, 0.8) : number(0, 8);
      glm::dvec3 ray = direction();
      if (i % 7 == 0) {
        ray = glm::dvec3(0);
        ray[i % 3] = i % 2 ? 1 : -1;
        if (i % 5 == 0) ray = glm::normalize(ray + 1e-5 * direction());
      }
      const glm::vec3 rayAsFloat(ray), eyeAsFloat(target - (i % 11 == 0 ? -1 : 1) * distance * ray);
      const glm::dvec3 eye(eyeAsFloat);
      const double way = i % 4 == 0 ? 1e15 : number(0, 2 * distance + 1);
      const double expected =
          0.75 * quadrature(density, eye, glm::normalize(glm::dvec3(rayAsFloat)), way, reach + 0.01);
      const double got = fog(eyeAsFloat, rayAsFloat, float(way));
      ASSERT_NEAR(got, expected, 3e-5) << "eye " << eye.x << " " << eye.y << " " << eye.z << ", ray " << ray.x
                                       << " " << ray.y << " " << ray.z << ", way " << way;
      if (expected == 0) {
        ++none;
        ASSERT_LE(got, 1e-6);
      }
      inside += density(eye) > 0;
      cut += way < 1e15 && density(eye + way * ray) > 0;
      through += expected > 0 && way == 1e15 && density(eye) == 0;
    }
    for (const size_t count : {inside, cut, none, through}) EXPECT_GT(count, 300u);
  }

  std::mt19937 random_{11};
};

TEST_F(FogTest, sphere) {
  expectSame(sphereAt, shared::sphereFog, 1);
  EXPECT_NEAR(shared::sphereFog({3, 0, 0}, {-1, 0, 0}, 1e15f), 1, 1e-6);
}

TEST_F(FogTest, box) {
  expectSame(boxAt, shared::boxFog, std::sqrt(3.0));
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 ray(0.0f);
    ray[axis] = 1;
    EXPECT_NEAR(shared::boxFog(-3.0f * ray, ray, 1e15f), 1, 1e-6);
  }
}

TEST_F(FogTest, capsule) {
  for (const double axis : {0.0, 0.3, 1.0, 4.0})
    expectSame([&](const glm::dvec3& q) { return capsuleAt(q, axis); },
               [&](const glm::vec3& eye, const glm::vec3& ray, float way) {
                 return shared::capsuleFog(eye, ray, way, float(axis));
               },
               1 + axis);
  EXPECT_NEAR(shared::capsuleFog({3, 0.5f, 0}, {-1, 0, 0}, 1e15f, 1), 1, 1e-6);
  EXPECT_NEAR(shared::capsuleFog({0.2f, 1, 0.1f}, {0, 1, 0}, 1e15f, 0),
              shared::sphereFog({0.2f, 1, 0.1f}, {0, 1, 0}, 1e15f), 1e-6);
}

TEST_F(FogTest, halfSpace) {
  const Density density = [](const glm::dvec3& q) { return std::max(-q.y, 0.0); };
  for (int i = 0; i < 6000; ++i) {
    const glm::vec3 eye(direction() * number(0, 3)), ray(direction());
    const float way = float(number(0, 6));
    const double depth = quadrature(density, glm::dvec3(eye), glm::normalize(glm::dvec3(ray)), way, 1e3);
    ASSERT_NEAR(shared::halfSpaceFog(eye, ray, way), 1 - std::exp(-depth), 2e-5);
  }
  // All the way to the sky.
  EXPECT_EQ(shared::halfSpaceFog({0, 1, 0}, {0, -1, 0}, 1e15f), 1);
  EXPECT_EQ(shared::halfSpaceFog({0, 1, 0}, {0, 1, 0}, 1e15f), 0);
  EXPECT_EQ(shared::halfSpaceFog({0, 1, 0}, {1, 0, 0}, 1e15f), 0);
  EXPECT_EQ(shared::halfSpaceFog({0, -1, 0}, {1, 0, 0}, 1e15f), 1);
  EXPECT_NEAR(shared::halfSpaceFog({0, -1, 0}, {0, 1, 0}, 1e15f), 1 - std::exp(-0.5), 1e-6);
}

// From a thousand radii away; the text's own formula is off by a tenth there.
TEST_F(FogTest, smallAndFarAway) {
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 towards = direction();
    const glm::vec3 eye(-1000.0 * towards),
        ray(glm::normalize(1000.0 * towards + direction() * number(0, 1.2)));
    const glm::dvec3 exact = glm::normalize(glm::dvec3(ray));
    ASSERT_NEAR(shared::sphereFog(eye, ray, 1e15f),
                0.75 * quadrature(sphereAt, glm::dvec3(eye), exact, 1e15, 1.01), 2e-3);
    ASSERT_NEAR(shared::capsuleFog(eye, ray, 1e15f, 0),
                0.75 * quadrature(sphereAt, glm::dvec3(eye), exact, 1e15, 1.01), 2e-3);
  }
}

TEST_F(FogTest, densities) {
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 at(direction() * number(0, 3));
    const glm::dvec3 q(at);
    EXPECT_NEAR(shared::sphereDensity(at), sphereAt(q), 1e-6);
    EXPECT_NEAR(shared::boxDensity(at), boxAt(q), 1e-6);
    EXPECT_NEAR(shared::capsuleDensity(at, 0.7f), capsuleAt(q, 0.7f), 1e-6);
    EXPECT_NEAR(shared::halfSpaceDensity(at), 1 - std::exp(-std::max(-q.y, 0.0)), 1e-6);
  }
  // What lies behind everything is in no volume.
  for (const glm::vec3& far : {glm::vec3(1e18f), glm::vec3(0, -1e18f, 3)}) {
    EXPECT_EQ(shared::sphereDensity(far), 0);
    EXPECT_EQ(shared::boxDensity(far), 0);
    EXPECT_EQ(shared::capsuleDensity(far, 4), 0);
  }
}

}  // namespace
}  // namespace scumble::passes
