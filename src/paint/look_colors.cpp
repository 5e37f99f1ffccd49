#include "paint/look_colors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/posed_bounds.h"

namespace scumble::paint {

namespace {

constexpr uint32_t kSize = 480;           // pixels of a picture's edge
constexpr float kCellsOfRadius = 100.0f;  // of a scene

const Image& layer(const Frame& frame, const std::string& name) {
  return std::find_if(frame.layers.begin(), frame.layers.end(),
                      [&](const Frame::Layer& l) { return l.name == name; })
      ->views[0];
}

}  // namespace

PosedMesh posedAtRest(const scene::SceneData& scene, size_t node) {
  const std::vector<glm::dmat4> world = scene::worldMatrices(scene);
  const scene::Node& placed = scene.nodes[node];
  std::vector<glm::mat4> joints;
  if (placed.skin >= 0) joints = scene::jointMatrices(scene.skins[size_t(placed.skin)], world);
  PosedMesh posed;
  for (const scene::Primitive& p : scene.meshes[size_t(placed.mesh)]->primitives) {
    std::vector<glm::vec3>&positions = posed.positions.emplace_back(),
    &normals = posed.normals.emplace_back();
    const bool bends = !joints.empty() && p.influences > 0;
    const glm::mat4 model(world[node]);
    const glm::mat3 turn = glm::transpose(glm::inverse(glm::mat3(model)));
    for (size_t v = 0; v < p.positions.size(); ++v) {
      const auto at = [&](const glm::vec3& position) {
        return bends ? scene::skinnedPosition(p, v, position, joints)
                     : glm::vec3(model * glm::vec4(position, 1));
      };
      positions.push_back(at(p.positions[v]));
      // Of what bends, from a step along the normal.
      const glm::vec3 normal =
          bends ? at(p.positions[v] + 1e-3f * p.normals[v]) - positions.back() : turn * p.normals[v];
      normals.push_back(glm::dot(normal, normal) > 0 ? glm::normalize(normal) : glm::vec3(0, 1, 0));
    }
  }
  return posed;
}

size_t LookColors::Hash::operator()(const Cell& cell) const {
  uint64_t h = 0x9E3779B97F4A7C15ull;
  for (const int n : cell) h = (h ^ uint32_t(n)) * 0xBF58476D1CE4E5B9ull, h ^= h >> 29;
  return size_t(h);
}

LookColors::Cell LookColors::cellOf(const glm::vec3& world, const glm::vec3& normal) const {
  const glm::vec3 size = glm::abs(normal);
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : size.y > size.z ? 1 : 2;
  const glm::ivec3 at(glm::floor(world / cellSize_));
  return {at.x, at.y, at.z, 2 * axis + (normal[axis] > 0)};
}

Result<LookColors> LookColors::make(Renderer& renderer, const Scene& scene, const Look& look) {
  LookColors colors;
  colors.cellSize_ = std::max(scene.data().bounds.radius() / kCellsOfRadius, 1e-9f);
  Look plain = look;
  for (const auto& [path, value] :
       {std::pair{"ground.mode", "off"}, {"warp.amount", "0"}, {"clips.*.play.weight", "0"}})
    if (const Status set = plain.set(path, value); !set) return set.error();
  RenderOptions options;
  options.width = options.height = kSize;
  options.samples = 1;
  options.aovs = {"position", "normal", "depth"};
  options.positionsFrom = scene.origin();
  for (const float elevation : {-60.0f, -15.0f, 20.0f, 60.0f})
    for (int i = 0; i < 6; ++i) {
      Viewpoint from;
      from.orbit = true;
      from.azimuth = 60 * float(i) + elevation, from.elevation = elevation;
      const Result<std::vector<View>> views = makeViews(scene, from, 1, Stereo::mono, 0, plain);
      if (!views) return views.error();
      const Result<Frame> frame = renderer.render(scene, plain, 0, *views, options);
      if (!frame) return frame.error();
      const Image &picture = layer(*frame, ""), &position = layer(*frame, "position"),
                  &normal = layer(*frame, "normal"), &depth = layer(*frame, "depth");
      const size_t channels = picture.channels.size(), pixels = size_t(picture.width) * picture.height;
      for (size_t p = 0; p < pixels; ++p) {
        if (!std::isfinite(depth.pixels[p * depth.channels.size()])) continue;
        const auto at = [&](const Image& image, size_t stride) {
          const float* const pixel = &image.pixels[p * stride];
          return glm::vec3(pixel[0], pixel[1], pixel[2]);
        };
        const glm::vec3 root = glm::sqrt(glm::clamp(at(picture, channels), 0.0f, 1.0f));
        colors.cells_[colors.cellOf(at(position, position.channels.size()),
                                    at(normal, normal.channels.size()))] += glm::vec4(root, 1);
      }
    }
  return colors;
}

std::optional<glm::vec3> LookColors::rootAt(const glm::vec3& world, const glm::vec3& normal) const {
  const Cell middle = cellOf(world, normal);
  glm::vec4 sum(0.0f);
  for (int reach = 0; reach <= 2 && sum.w == 0; ++reach)
    for (int z = -reach; z <= reach; ++z)
      for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
          const auto found = cells_.find({middle[0] + x, middle[1] + y, middle[2] + z, middle[3]});
          if (found != cells_.end()) sum += found->second;
        }
  if (sum.w == 0) return std::nullopt;
  return glm::vec3(sum) / sum.w;
}

}  // namespace scumble::paint
