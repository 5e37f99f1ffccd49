// The draw list as the device leaves it, against what the CPU finds of the same boxes: each bucket has its
// own draws, those that a view may see first, the nearest before the others, and nothing of the rest is
// drawn.
// (passes/cull)

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <random>
#include <set>

#include "scumble/scene_editor.h"
#include "stage/visibility.h"
#include "tests/support/draw_list_spy.h"
#include "tests/support/render_test.h"

namespace scumble {
namespace {

using namespace test;
using namespace frame;

class CulledDraws : public BothEyes {
 protected:
  static constexpr uint32_t kWidth = 64, kHeight = 36;

  CulledDraws() {
    // Materials of all kinds; a mesh for each.
    const std::vector<glm::vec3> corners{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0.5f}};
    const std::vector<glm::u8vec4> colors(3, {200, 100, 50, 255});
    for (int m = 0; m < 6; ++m) {
      MaterialDesc material{.name = std::to_string(m)};
      material.alpha = m == 3   ? MaterialDesc::Alpha::mask
                       : m == 4 ? MaterialDesc::Alpha::blend
                                : MaterialDesc::Alpha::opaque;
      material.doubleSided = m % 2 == 1;
      MeshPart part{.positions = corners, .material = take(editor_.addMaterial(material))};
      if (m == 5) part.colors = colors;
      meshes_.push_back(take(editor_.addMesh({part})));
    }
  }
  ~CulledDraws() override { EXPECT_EQ(renderer_.validationMessages(), 0); }

  template <class T>
  static T take(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message());
    return std::move(*result);
  }

  // So many objects around the origin, a fifth of them mirrored.
  void scatter(int count) {
    std::uniform_real_distribution<float> number(-1, 1);
    for (int i = 0; i < count; ++i) {
      const glm::vec3 at(12 * number(random_), 6 * number(random_), 12 * number(random_));
      const glm::mat4 transform =
          glm::scale(glm::translate(glm::mat4(1.0f), at), glm::vec3(i % 5 == 0 ? -0.1f : 0.1f, 0.1f, 0.1f));
      nodes_.push_back(
          take(editor_.addNode({.transform = transform, .mesh = meshes_[size_t(i) % meshes_.size()]})));
    }
  }

  const SeenList& draw(const std::vector<View>& views, const Look& look = quietLook()) {
    renderer_.draw(take(editor_.scene()), look, views, sized(kWidth, kHeight));
    return renderer_.list();
  }
  std::vector<View> aheadOf(const glm::vec3& eye, const glm::vec3& target) {
    return viewsFrom(take(editor_.scene()), {eye, target}, kWidth, kHeight, GetParam());
  }

  // Checks it, and says how many are seen.
  static size_t check(const SeenList& list, size_t viewCount) {
    size_t seen = 0, next = 0;
    std::map<uint32_t, const Draw*> byObject;
    for (const Draw& draw : list.draws) byObject[draw.object] = &draw;
    EXPECT_EQ(list.commands.size(), list.draws.size());
    for (const DrawBucket& bucket : list.buckets) {
      EXPECT_EQ(bucket.first, next);
      next += bucket.count;
      bool hasEnded = false;
      double nearest = -1e30;
      std::set<uint32_t> found;
      for (uint32_t i = bucket.first; i < bucket.first + bucket.count; ++i) {
        const shared::DrawCommand& command = list.commands[i];
        if (!byObject.contains(command.firstInstance)) {
          ADD_FAILURE() << "no object " << command.firstInstance;
          continue;
        }
        const Draw& draw = *byObject[command.firstInstance];
        EXPECT_TRUE(found.insert(draw.object).second) << "twice";
        DrawState state = draw.state;
        state.mirrored = list.mirrored[draw.object];
        EXPECT_EQ(state, bucket.state);
        EXPECT_EQ(command.indexCount, draw.indexCount);
        EXPECT_EQ(command.firstIndex, draw.firstIndex);
        EXPECT_EQ(command.vertexOffset, draw.vertexOffset);

        const scene::Bounds& box = list.bounds[draw.object];
        const auto isSeenWith = [&](float pixels) {
          bool isSeen = false;
          for (size_t v = 0; v < viewCount; ++v)
            isSeen |= stage::mayBeSeen(box, list.uniforms.views[v].worldToClip,
                                       2.0f * pixels / list.uniforms.imageSize);
          return isSeen;
        };
        if (command.instanceCount == 0) {
          hasEnded = true;
          EXPECT_FALSE(isSeenWith(list.inflation + 0.99f));
          continue;
        }
        ++seen;
        EXPECT_EQ(command.instanceCount, 1u);
        EXPECT_FALSE(hasEnded) << "after what is not seen";
        EXPECT_TRUE(isSeenWith(list.inflation + 1.01f));
        const double along = -double((list.uniforms.views[0].worldToEye * glm::vec4(box.center(), 1)).z);
        const double distance = list.uniforms.views[0].orthographic != 0
                                    ? along
                                    : double(glm::length(box.center() - list.uniforms.viewer));
        EXPECT_GE(distance, nearest - 1e-4 * std::abs(nearest) - 1e-5);
        nearest = distance;
      }
    }
    EXPECT_EQ(next, list.draws.size());
    return seen;
  }

  SceneEditor editor_;
  std::vector<MeshId> meshes_;
  std::vector<NodeId> nodes_;
  std::mt19937 random_{7};
  RendererWithSpy renderer_;
};
INSTANTIATE_BOTH_EYES(CulledDraws);

// As many as one workgroup sorts, and more; fewer again, and others in between; edges that reach far.
TEST_P(CulledDraws, eachBucketHasThoseThatAreSeenTheNearestFirst) {
  scatter(300);
  for (const int more : {0, 4200}) {
    scatter(more);
    const size_t all = nodes_.size();
    for (const auto& [eye, target] : {std::pair<glm::vec3, glm::vec3>{{0, 1, 20}, {0, 0, 0}},
                                      {{0.3f, 0.2f, 0.1f}, {5, 1, 2}},
                                      {{-3, 8, -2}, {0, 0, -3}}}) {
      const size_t seen = check(draw(aheadOf(eye, target)), viewCount());
      EXPECT_EQ(renderer_.list().draws.size(), all);
      EXPECT_GT(seen, all / 50);
    }
    EXPECT_LT(check(draw(aheadOf({0.3f, 0.2f, 0.1f}, {5, 1, 2})), viewCount()), all / 2);
    EXPECT_EQ(check(draw(aheadOf({0, 1, 40}, {0, 1, 80})), viewCount()), 0u) << "all lies behind";
  }
  for (size_t i = 0; i < nodes_.size(); i += 3) ASSERT_TRUE(editor_.setVisible(nodes_[i], false).ok());
  EXPECT_GT(check(draw(aheadOf({0, 1, 20}, {0, 0, 0})), viewCount()), 100u);
  EXPECT_EQ(renderer_.list().draws.size(), 3000u);
  const size_t narrow = check(draw(aheadOf({0, 1, 14}, {0, 0, 0})), viewCount());
  const Look torn = quietLook({{"warp.inflationUnit", "percent"}, {"warp.inflation", "30"}});
  const size_t wide = check(draw(aheadOf({0, 1, 14}, {0, 0, 0}), torn), viewCount());
  EXPECT_GT(wide, narrow + 5);
}

TEST_P(CulledDraws, parallelViews) {
  scatter(2500);
  std::vector<View> views(viewCount(), parallelView(3, float(kWidth) / kHeight));
  views.back().worldToEye = glm::translate(views.back().worldToEye, {0.1f, 0, 0});
  const size_t seen = check(draw(views), viewCount());
  EXPECT_GT(seen, 100u);
  EXPECT_LT(seen, 2000u);
}

// What moves is looked for where it is, and what is mirrored now is in another bucket.
TEST_P(CulledDraws, followsWhatMovesAndIsMirrored) {
  scatter(40);
  const std::vector<View> views = aheadOf({0, 1, 20}, {0, 0, 0});
  const size_t before = check(draw(views), viewCount());
  const glm::mat4 away = glm::translate(glm::mat4(1.0f), {0, 0, 500});
  for (const NodeId node : nodes_) ASSERT_TRUE(editor_.setTransform(node, away).ok());
  EXPECT_EQ(check(draw(views), viewCount()), 0u);
  const glm::mat4 inside = glm::scale(glm::mat4(1.0f), {1, -1, 1});
  for (const NodeId node : nodes_) ASSERT_TRUE(editor_.setTransform(node, inside).ok());
  EXPECT_EQ(check(draw(views), viewCount()), 40u);
  for (const DrawBucket& bucket : renderer_.list().buckets) EXPECT_TRUE(bucket.state.mirrored);
  EXPECT_LT(before, 40u);
  // Nothing at all.
  for (const NodeId node : nodes_) ASSERT_TRUE(editor_.setVisible(node, false).ok());
  EXPECT_EQ(check(draw(views), viewCount()), 0u);
}

}  // namespace
}  // namespace scumble
