// A feature to start from (docs/features.md): a beacon that hangs above the scene and sways. Copy the folder,
// and replace what it plans, what it is at a moment, and its knobs.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "frame/feature_parts.h"
#include "scene/posed_bounds.h"
#include "world/geometry.h"

namespace scumble::sample {

using namespace world;

namespace {

#define PARAMS_STRUCT SampleParams
#define PARAMS_FILE "features/sample/sample.params"
#define PARAMS_PATH "sample"
#define PARAMS_TARGETS kScene
#include "look/define_params.h"

// Two pyramids, base to base, around the origin; one metre high.
scene::Primitive makeBeacon() {
  scene::Primitive mesh;
  const auto face = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (const glm::vec3& corner : {a, b, c}) {
      mesh.indices.push_back(uint32_t(mesh.positions.size()));
      mesh.positions.push_back(corner);
      mesh.normals.push_back(normal);
      mesh.smoothNormals.push_back(glm::normalize(corner));
      mesh.uv0.push_back(glm::vec2(corner.x, corner.y));
      // Metres for one unit of u and of v, along the face.
      mesh.dPdu.push_back(glm::normalize(b - a));
      mesh.dPdv.push_back(glm::cross(normal, glm::normalize(b - a)));
    }
  };
  const glm::vec3 top(0, 0.5f, 0), bottom(0, -0.5f, 0);
  const glm::vec3 around[] = {{0.3f, 0, 0}, {0, 0, -0.3f}, {-0.3f, 0, 0}, {0, 0, 0.3f}};
  for (int i = 0; i < 4; ++i) {
    face(around[i], around[(i + 1) % 4], top);
    face(around[(i + 1) % 4], around[i], bottom);
  }
  return mesh;
}

// What it is at a time: a pure function of that, of scene and look.
class Beacon : public FeatureMoment {
 public:
  bool follow(const scene::SceneData&, const FeaturePlan&) override { return true; }
  void pose(const look::LookData&, const KnobTable& now, double time, const FeatureMoment*) override {
    const double phase = std::fmod(time / 4, 1.0) * 2 * std::numbers::pi;
    offset_ = {0, now.scene<SampleParams>().sways * float(std::sin(phase)), 0};
  }
  Place placeOf(uint32_t) const override { return {offset_, glm::vec2(0.0f)}; }

 private:
  glm::vec3 offset_{0.0f};
};

// What is built: it is built anew where this is not equal to what was.
class BeaconPlan : public FeaturePlan {
 public:
  BeaconPlan(const glm::vec3& place, float size) : place_(place), size_(size) {}
  bool equals(const FeaturePlan& other) const override {
    const auto& plan = static_cast<const BeaconPlan&>(other);
    return place_ == plan.place_ && size_ == plan.size_;
  }
  void addItems(const GeometryItem& common, MadePrimitives& made, Geometry& geometry) const override {
    GeometryItem item = common;
    item.primitive = &made.get("sample beacon", {}, makeBeacon);
    item.extent = &item.primitive->extent;
    item.casts = true;
    item.instance = item.model = glm::scale(glm::translate(glm::mat4(1.0f), place_), glm::vec3(size_));
    item.reach = scene::posedBounds(*item.extent, item.model, {}, {});
    geometry.items.push_back(item);
  }
  std::unique_ptr<FeatureMoment> makeMoment(gpu::Device&, const scene::SceneData&) const override {
    return std::make_unique<Beacon>();
  }

 private:
  glm::vec3 place_;  // world
  float size_;       // metres
};

class Sample : public Feature {
 public:
  const char* name() const override { return "sample"; }
  std::string_view material() const override { return "Beacon"; }
  std::shared_ptr<const FeaturePlan> plan(const scene::SceneData& scene,
                                          const look::LookData& look) const override {
    const SampleParams params = look.get<SampleParams>();
    if (!params.shown) return nullptr;
    const float radius = scene.bounds.radius();
    const glm::vec3 center = scene.bounds.center();
    return std::make_shared<BeaconPlan>(
        glm::vec3(center.x, scene.bounds.max.y + params.height * radius, center.z), 0.25f * radius);
  }
  Switch onOff() const override {
    return {&SampleParams::block(), "shown", "there is no beacon; --set sample.shown=on hangs one up"};
  }
};

}  // namespace

frame::FeatureParts makeFeature() {
  return {std::make_unique<Sample>(), {}, {&SampleParams::block()}, {}};
}

}  // namespace scumble::sample
