// Projections and the constants that shaders take apart again what a projection did: checked against the
// projection itself, for any off-centre one, since headsets have nothing else.
#include "renderer/uniforms.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace scumble::renderer {
namespace {

class Numbers {
 public:
  explicit Numbers(uint32_t seed) : random_(seed) {}
  float operator()(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random_);
  }

 private:
  std::mt19937 random_;
};

glm::vec3 ndcOf(const glm::mat4& projection, const glm::vec3& eyeSpace) {
  const glm::vec4 clip = projection * glm::vec4(eyeSpace, 1);
  return glm::vec3(clip) / clip.w;
}

float eyeDepth(const shared::ViewUniforms& u, float depth) {
  return (u.depthToEye.x + u.depthToEye.y * depth) / (u.depthToEye.z + u.depthToEye.w * depth);
}

// Perspective, with the axis anywhere, and with a far plane in every other case.
glm::mat4 randomPerspective(Numbers& number, bool finite) {
  const float near = number(0.01f, 1);
  glm::mat4 p = perspectiveProjection(number(0.2f, 2.5f), number(0.3f, 3), near);
  p[2][0] = number(-0.7f, 0.7f);
  p[2][1] = number(-0.7f, 0.7f);
  if (finite) {  // reversed: d = near (far - z) / (z (far - near)) for a distance z
    const float far = near * number(50, 5000);
    p[2][2] = near / (far - near);
    p[3][2] = near * far / (far - near);
  }
  return p;
}

TEST(ViewUniforms, raysAndDepthsOfPerspectives) {
  Numbers number(1);
  for (int i = 0; i < 200; ++i) {
    View view;
    view.eyeToClip = randomPerspective(number, i % 2);
    const shared::ViewUniforms u = viewUniforms(view, view);
    EXPECT_EQ(u.orthographic, 0.0f);
    for (int k = 0; k < 10; ++k) {
      const float distance = number(1, 40);
      const glm::vec3 point(number(-2, 2) * distance, number(-2, 2) * distance, -distance);
      const glm::vec3 ndc = ndcOf(view.eyeToClip, point);
      const glm::vec2 ray = glm::vec2(ndc) * glm::vec2(u.ndcToEyeRay.x, u.ndcToEyeRay.y) +
                            glm::vec2(u.ndcToEyeRay.z, u.ndcToEyeRay.w);
      EXPECT_NEAR(ray.x, point.x / distance, 2e-5f);
      EXPECT_NEAR(ray.y, point.y / distance, 2e-5f);
      EXPECT_NEAR(eyeDepth(u, ndc.z), distance, 1e-3f * distance * distance) << "depth " << ndc.z;
    }
  }
}

TEST(ViewUniforms, pointsAndDepthsOfParallelProjections) {
  Numbers number(2);
  for (int i = 0; i < 100; ++i) {
    View view;
    view.eyeToClip = orthographicProjection(number(0.5f, 20), number(0.3f, 3), number(0, 1), number(20, 200));
    view.eyeToClip[3][0] = number(-0.5f, 0.5f);
    view.eyeToClip[3][1] = number(-0.5f, 0.5f);
    const shared::ViewUniforms u = viewUniforms(view, view);
    EXPECT_EQ(u.orthographic, 1.0f);
    const glm::vec3 point(number(-5, 5), number(-5, 5), -number(1, 20));
    const glm::vec3 ndc = ndcOf(view.eyeToClip, point);
    const glm::vec2 at = glm::vec2(ndc) * glm::vec2(u.ndcToEyeRay.x, u.ndcToEyeRay.y) +
                         glm::vec2(u.ndcToEyeRay.z, u.ndcToEyeRay.w);
    EXPECT_NEAR(at.x, point.x, 1e-4f);
    EXPECT_NEAR(at.y, point.y, 1e-4f);
    EXPECT_NEAR(eyeDepth(u, ndc.z), -point.z, 1e-3f);
  }
}

TEST(ViewUniforms, eyeAndMatricesOfNowAndBefore) {
  View now, before;
  now.worldToEye = glm::lookAt(glm::vec3(3, 4, 5), glm::vec3(0, 1, 0), glm::vec3(0, 1, 0));
  now.eyeToClip = perspectiveProjection(0.7f, 1.5f, 0.1f);
  before = now;
  before.worldToEye = glm::translate(now.worldToEye, glm::vec3(1, 0, 0));
  const shared::ViewUniforms u = viewUniforms(now, before);
  EXPECT_NEAR(glm::length(u.eye - glm::vec3(3, 4, 5)), 0, 1e-5f);
  const glm::vec4 point(0.3f, 0.2f, -0.4f, 1);
  EXPECT_NEAR(glm::length(u.worldToClip * point - now.eyeToClip * (now.worldToEye * point)), 0, 1e-5f);
  EXPECT_NEAR(glm::length(u.previousWorldToClip * point - before.eyeToClip * (before.worldToEye * point)), 0,
              1e-5f);
}

// -- Vulkan's convention: y down, depth 1 at the near plane and 0 far away

TEST(Projection, perspective) {
  const glm::mat4 p = perspectiveProjection(glm::radians(60.0f), 2, 0.5f);
  const float edge = std::tan(glm::radians(30.0f));
  const glm::vec3 corner = ndcOf(p, glm::vec3(2 * edge, edge, -1) * 7.0f);
  EXPECT_NEAR(corner.x, 1, 1e-5f);
  EXPECT_NEAR(corner.y, -1, 1e-5f);
  EXPECT_NEAR(ndcOf(p, {0, 0, -0.5f}).z, 1, 1e-6f);
  EXPECT_NEAR(ndcOf(p, {0, 0, -1e6f}).z, 0, 1e-6f);
  EXPECT_GT(ndcOf(p, {0, 0, -2}).z, ndcOf(p, {0, 0, -3}).z);
}

TEST(Projection, orthographic) {
  const glm::mat4 p = orthographicProjection(3, 2, 1, 11);
  const glm::vec3 corner = ndcOf(p, {6, 3, -4});
  EXPECT_NEAR(corner.x, 1, 1e-6f);
  EXPECT_NEAR(corner.y, -1, 1e-6f);
  EXPECT_NEAR(ndcOf(p, {0, 0, -1}).z, 1, 1e-6f);
  EXPECT_NEAR(ndcOf(p, {0, 0, -11}).z, 0, 1e-6f);
}

}  // namespace
}  // namespace scumble::renderer
