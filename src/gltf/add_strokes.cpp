#include "gltf/add_strokes.h"

#include <algorithm>
#include <limits>

#include "gltf/rewrite.h"
#include "scene/nearest_place.h"

namespace scumble::gltf {

namespace {

class StrokeWriter {
 public:
  explicit StrokeWriter(Rewrite& file) : file_(file) {}

  void add(Json& mesh, const Mesh& own, const Painting& painting) {
    // A skinned mesh has joints for all that it is made of: those of the nearest vertex.
    std::vector<const Primitive*> skinned;
    for (const Primitive& p : own.primitives)
      if (p.influences > 0) skinned.push_back(&p);
    const NearestPlaces places(skinned);
    size_t targets = 0;
    for (const Json& other : mesh["primitives"])
      if (other.contains("targets")) targets = std::max(targets, other["targets"].size());
    for (const Stroke& stroke : painting.strokes) {
      Json primitive = {{"mode", 3}, {"extras", {{"scumble_brush", nameOf(stroke.brush)}}}};
      glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
      for (uint32_t i = stroke.firstPoint; i < stroke.firstPoint + stroke.pointCount; ++i) {
        const StrokePoint& point = painting.points[i];
        low = glm::min(low, point.position), high = glm::max(high, point.position);
        positions_.put(point.position);
        for (int c = 0; c < 4; ++c) colors_.put(uint16_t(std::lround(65535 * double(point.color[c]))));
        radii_.put(point.radius);
        const glm::quat& q = point.orientation;
        turns_.put(glm::vec4(q.x, q.y, q.z, q.w));
        times_.put(point.time);
        if (!places.isEmpty()) addSkin(skinned, places.to(point.position));
      }
      const size_t count = stroke.pointCount;
      Json& position = positions_.addTo(file_, primitive, count);
      position["min"] = {low.x, low.y, low.z}, position["max"] = {high.x, high.y, high.z};
      colors_.addTo(file_, primitive, count);
      radii_.addTo(file_, primitive, count);
      turns_.addTo(file_, primitive, count);
      times_.addTo(file_, primitive, count);
      if (!places.isEmpty()) {
        joints_.addTo(file_, primitive, count);
        weights_.addTo(file_, primitive, count);
      }
      // All primitives of a mesh have its morph targets; what they would do to strokes the mesh does.
      if (targets > 0) {
        const size_t zeros = file_.add("accessors", {{"componentType", 5126},
                                                     {"type", "VEC3"},
                                                     {"count", count},
                                                     {"min", {0, 0, 0}},
                                                     {"max", {0, 0, 0}}});
        for (size_t t = 0; t < targets; ++t) primitive["targets"].push_back({{"POSITION", zeros}});
      }
      mesh["primitives"].push_back(std::move(primitive));
    }
  }

  void addSkin(const std::vector<const Primitive*>& skinned, const NearestPlaces::Place& place) {
    const Primitive& p = *skinned[place.primitive];
    const float parts[] = {1 - place.at.x - place.at.y, place.at.x, place.at.y};
    const uint32_t vertex = place.vertices[int(std::max_element(parts, parts + 3) - parts)];
    const size_t n = size_t(p.influences);
    std::vector<std::pair<float, uint16_t>> most;
    for (size_t k = 0; k < n; ++k) most.emplace_back(p.weights[vertex * n + k], p.joints[vertex * n + k]);
    std::stable_sort(most.begin(), most.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    most.resize(4);
    float sum = 0;
    for (const auto& [weight, joint] : most) sum += weight;
    for (const auto& [weight, joint] : most) {
      joints_.put(uint16_t(weight > 0 ? joint : 0));
      weights_.put(sum > 0 ? weight / sum : 0.0f);
    }
  }

  void finish() {
    for (const AttributeWriter* attribute :
         {&positions_, &colors_, &radii_, &turns_, &times_, &joints_, &weights_})
      attribute->finish(file_);
  }

 private:
  Rewrite& file_;
  AttributeWriter positions_{"POSITION", 5126, "VEC3", 12}, colors_{"COLOR_0", 5123, "VEC4", 8, true},
      radii_{"_RADIUS", 5126, "SCALAR", 4}, turns_{"_ORIENTATION", 5126, "VEC4", 16},
      times_{"_TIME", 5126, "SCALAR", 4}, joints_{"JOINTS_0", 5123, "VEC4", 8},
      weights_{"WEIGHTS_0", 5126, "VEC4", 16};
};

}  // namespace

std::vector<uint8_t> withStrokes(const std::string& path, const SceneOptions& options, const SceneData& scene,
                                 const std::vector<std::shared_ptr<const Painting>>& paintings,
                                 ImportWarnings& warnings) {
  Rewrite file(path, options, warnings);
  StrokeWriter strokes(file);
  for (size_t m = 0; m < file.meshes().size(); ++m) {
    const int own = file.meshes()[m];
    if (own < 0 || size_t(own) >= paintings.size() || !paintings[size_t(own)]) continue;
    strokes.add(file.root()["meshes"][m], scene.meshes[size_t(own)], *paintings[size_t(own)]);
  }
  strokes.finish();
  return file.glb("ask for fewer splats");
}

}  // namespace scumble::gltf
