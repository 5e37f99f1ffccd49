// Point and spot lights as shaders get them, against the formulas of KHR_lights_punctual in double precision.
#include "stage/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace scumble::stage {
namespace {

scene::SceneData lampScene(const std::vector<scene::Light>& lights) {
  scene::SceneData scene;
  scene.lights = lights;
  for (size_t i = 0; i < lights.size(); ++i) {
    scene::Node node;
    node.light = int(i);
    scene.nodes.push_back(node);
  }
  return scene;
}

std::vector<bool> allShown(const scene::SceneData& scene) {
  return std::vector<bool>(scene.nodes.size(), true);
}

scene::Light lamp(scene::LightKind kind, float intensity) {
  scene::Light light;
  light.kind = kind, light.intensity = intensity;
  return light;
}

TEST(PunctualLights, onlyPointsAndSpotsInTheOrderOfNodes) {
  using enum scene::LightKind;
  const auto scene = lampScene({lamp(directional, 1), lamp(point, 2), lamp(spot, 3)});
  EXPECT_EQ(punctualLightCount(scene), 2u);
  LightParams params;
  params.punctualUnit = 1.0, params.punctual = 0.5f;
  const std::vector<glm::dmat4> world{glm::dmat4(1), glm::translate(glm::dmat4(1), {1, 2, 3}),
                                      glm::rotate(glm::dmat4(7), 1.5707963, {0, 1, 0})};
  const auto lights = punctualLights(scene, params, world, allShown(scene), 10);
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0].position, glm::vec3(1, 2, 3));
  EXPECT_EQ(lights[0].strength, 1);
  EXPECT_EQ(lights[1].strength, 1.5f);
  // Along -Z, turned by a quarter around Y; scales do not count.
  EXPECT_NEAR(glm::length(lights[1].direction - glm::vec3(-1, 0, 0)), 0, 1e-6);
  params.punctual = 0;
  EXPECT_TRUE(punctualLights(scene, params, world, allShown(scene), 10).empty());
}

// Shaders multiply strengths by what may be 0.
TEST(PunctualLights, areFinite) {
  for (const double unit : {0.0, 1.0})
    for (const float intensity : {1e30f, 3e38f}) {
      LightParams params;
      params.punctual = 100, params.punctualUnit = unit;
      const auto lights = punctualLights(lampScene({lamp(scene::LightKind::point, intensity)}), params,
                                         {glm::mat4(1)}, {true}, 3);
      EXPECT_TRUE(std::isfinite(lights[0].strength * 1e10f)) << unit << ", " << intensity;
      if (unit == 0) {
        EXPECT_NEAR(lights[0].strength, 100 * 0.5 * 1.2 * 1.2, 1e-3);
      }
    }
}

// Whatever unit a file counts in, what is nearer than 0.4 radii to all lights is more light than shadow.
TEST(PunctualLights, autoFollowsTheScenesSize) {
  for (const float intensity : {1.0f, 8.0f, 5435.0f})
    for (const float radius : {0.1f, 3.0f, 200.0f}) {
      const auto scene =
          lampScene({lamp(scene::LightKind::point, intensity), lamp(scene::LightKind::point, 3 * intensity)});
      const auto lights = punctualLights(scene, {}, {glm::mat4(1), glm::mat4(1)}, allShown(scene), radius);
      const double d = 0.4 * double(radius);
      EXPECT_NEAR((lights[0].strength + lights[1].strength) / (d * d), 0.5, 1e-5);
      EXPECT_NEAR(lights[1].strength / lights[0].strength, 3, 1e-5);
    }
}

TEST(PunctualLights, lightsWithoutStrengthAndTooManyLights) {
  const auto dark = lampScene({lamp(scene::LightKind::point, 0)});
  EXPECT_EQ(punctualLights(dark, {}, {glm::dmat4(1)}, {true}, 1)[0].strength, 0);
  const std::vector<scene::Light> many(300, lamp(scene::LightKind::point, 1));
  EXPECT_EQ(punctualLightCount(lampScene(many)), scene::kMaxPunctualLights);
  EXPECT_EQ(punctualLights(lampScene(many), {}, std::vector<glm::dmat4>(300, glm::dmat4(1)),
                           std::vector<bool>(300, true), 1)
                .size(),
            scene::kMaxPunctualLights);
}

// Range and cone, from the fields as the shader uses them.
TEST(PunctualLights, rangeAndCone) {
  scene::Light light = lamp(scene::LightKind::spot, 1);
  light.range = 4, light.innerCone = 0.3f, light.outerCone = 0.8f;
  const auto lights = punctualLights(lampScene({light}), {}, {glm::mat4(1)}, {true}, 1);
  EXPECT_NEAR(lights[0].inverseRangeSquared, 1.0 / 16, 1e-7);
  for (double angle = 0; angle < 1.5; angle += 0.05) {
    const double inner = std::cos(double(light.innerCone)), outer = std::cos(double(light.outerCone));
    const double expected = std::clamp((std::cos(angle) - outer) / (inner - outer), 0.0, 1.0);
    EXPECT_NEAR(std::clamp(lights[0].coneOffset + lights[0].coneScale * std::cos(angle), 0.0, 1.0), expected,
                1e-5);
  }
}

// -- The key light

// The scene's own shines along -Z of its node, whatever that node's scale.
TEST(KeyLight, ofTheSceneComesFromItsNodesZ) {
  auto scene = lampScene({lamp(scene::LightKind::point, 1), lamp(scene::LightKind::directional, 1)});
  const glm::mat4 turned = glm::rotate(glm::scale(glm::mat4(1), glm::vec3(3)), 0.6f, {1, 0, 0});
  const glm::vec3 got = keyLightDirection(scene, {}, {glm::mat4(1), turned}, allShown(scene));
  // Z turned about X by 0.6: towards -y.
  EXPECT_LT(glm::length(got - glm::vec3(0, -std::sin(0.6f), std::cos(0.6f))), 1e-6f);
  // The look's where the look says so.
  LightParams look;
  look.source = 1.0;
  EXPECT_GT(glm::length(keyLightDirection(scene, look, {glm::mat4(1), turned}, allShown(scene)) - got), 0.1f);
}

// Azimuth from the scene's default view, positive to its right, and elevation, in degrees.
TEST(KeyLight, ofTheLookIsMeasuredFromTheDefaultView) {
  LightParams look;
  look.azimuth = 40, look.elevation = 25;
  const double elevation = glm::radians(25.0);
  for (const double camera : {0.0, 70.0, 200.0}) {
    scene::SceneData scene;
    scene.cameras.resize(1);
    scene::Node node;
    node.camera = 0;
    node.local.rotation = glm::angleAxis(float(glm::radians(camera)), glm::vec3(0, 1, 0));
    scene.nodes.push_back(node);
    // It looks along its -Z: the eye is on the side of its Z.
    const double azimuth = glm::radians(camera + 40);
    const glm::dvec3 expected(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                              std::cos(azimuth) * std::cos(elevation));
    const glm::dvec3 got(keyLightDirection(scene, look, {node.local.matrix()}, {true}));
    EXPECT_LT(glm::length(got - expected), 1e-5) << "camera turned by " << camera;
  }
}

}  // namespace
}  // namespace scumble::stage
