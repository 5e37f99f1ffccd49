#include "scene/seen.h"

#include <algorithm>
#include <cmath>

#include "scene/painting.h"
#include "scene/posed_bounds.h"
#include "scene/texels.h"

namespace scumble::scene {

namespace {

// The greatest alpha in any rectangle of an image: an image pyramid of maxima.
class AlphaMaxima {
 public:
  explicit AlphaMaxima(const TextureImage& image) {
    Level level{image.width, image.height, {}};
    level.alpha.resize(size_t(image.width) * image.height);
    for (size_t i = 0; i < level.alpha.size(); ++i) level.alpha[i] = image.rgba[4 * i + 3];
    levels_.push_back(std::move(level));
    while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(halved(levels_.back()));
  }

  uint8_t greatest() const { return levels_.back().alpha[0]; }

  // Within a box of texels, both corners included; what lies outside of the image repeats, which is taken as
  // all of it.
  uint8_t greatestIn(const glm::dvec2& low, const glm::dvec2& high) const {
    const Level& whole = levels_[0];
    if (!(low.x >= 0 && low.y >= 0 && high.x <= whole.width - 1 && high.y <= whole.height - 1))
      return greatest();
    const double size = std::max(high.x - low.x, high.y - low.y);
    const size_t l =
        std::min(size_t(std::max(0.0, std::ceil(std::log2(std::max(size, 1.0))))), levels_.size() - 1);
    const Level& level = levels_[l];
    uint8_t most = 0;
    const auto cell = [&](double t, uint32_t cells) { return std::min(uint32_t(t) >> l, cells - 1); };
    for (uint32_t y = cell(low.y, level.height); y <= cell(high.y, level.height); ++y)
      for (uint32_t x = cell(low.x, level.width); x <= cell(high.x, level.width); ++x)
        most = std::max(most, level.alpha[size_t(y) * level.width + x]);
    return most;
  }

 private:
  struct Level {
    uint32_t width, height;
    std::vector<uint8_t> alpha;
  };
  static Level halved(const Level& from) {
    Level to{(from.width + 1) / 2, (from.height + 1) / 2, {}};
    to.alpha.assign(size_t(to.width) * to.height, 0);
    for (uint32_t y = 0; y < from.height; ++y)
      for (uint32_t x = 0; x < from.width; ++x) {
        uint8_t& most = to.alpha[size_t(y / 2) * to.width + x / 2];
        most = std::max(most, from.alpha[size_t(y) * from.width + x]);
      }
    return to;
  }
  std::vector<Level> levels_;
};

// The least alpha of what is drawn at all.
float leastAlpha(const Material& material) {
  return material.alphaMode == AlphaMode::mask ? material.alphaCutoff : 0.5f / 255;
}

// Null where a material shows none.
const TextureImage* imageOf(const SceneData& scene, const TextureUse& use) {
  if (use.image < 0) return nullptr;
  const TextureImage& image = scene.images[size_t(use.image)];
  return image.rgba.empty() ? nullptr : &image;
}

class Finder {
 public:
  explicit Finder(const SceneData& scene) : scene_(scene) {}

  SeenPart of(const Primitive& primitive) {
    SeenPart part;
    const Material& material = scene_.materials[size_t(primitive.material)];
    if (material.alphaMode == AlphaMode::opaque || primitive.indices.empty()) return part;
    const float least = leastAlpha(material);
    if (least <= 0) return part;
    const TextureUse& use = material.baseColorTexture;
    const TextureImage* const image = imageOf(scene_, use);
    if (primitive.colors.empty() && !image) {
      part.isSeen = material.baseColor.a >= least;
      return part;
    }
    const AlphaMaxima* const maxima = image ? &maximaOf(use.image) : nullptr;
    const std::vector<glm::vec2>& uvs = coordinatesOf(primitive, use);
    const auto isSeen = [&](const uint32_t* corners) {
      float alpha = material.baseColor.a, vertexAlpha = primitive.colors.empty() ? 1.0f : 0.0f;
      for (int c = 0; c < 3 && !primitive.colors.empty(); ++c)
        vertexAlpha = std::max(vertexAlpha, float(primitive.colors[corners[c]].a) / 255);
      alpha *= vertexAlpha;
      if (maxima) {
        glm::dvec2 low(1e300), high(-1e300);
        for (int c = 0; c < 3; ++c) {
          const glm::vec3 at = use.transform * glm::vec3(uvs[corners[c]], 1.0f);
          const glm::dvec2 texel = glm::dvec2(at) * glm::dvec2(image->width, image->height);
          low = glm::min(low, texel), high = glm::max(high, texel);
        }
        // Filtering reaches to the next texel.
        alpha *= float(maxima->greatestIn(low - 1.0, high + 1.0)) / 255;
      }
      return alpha >= least;
    };
    std::vector<uint32_t> seen;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
      if (isSeen(&primitive.indices[i]))
        seen.insert(seen.end(), &primitive.indices[i], &primitive.indices[i] + 3);
    if (seen.size() == primitive.indices.size()) return part;
    part.isSeen = !seen.empty();
    if (!part.isSeen) return part;
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    part.extent = std::make_shared<const PrimitiveExtent>(extentOf(primitive, seen));
    part.vertices = std::move(seen);
    return part;
  }

 private:
  const AlphaMaxima& maximaOf(int image) {
    const auto [entry, isNew] = maxima_.try_emplace(image);
    if (isNew) entry->second = std::make_unique<AlphaMaxima>(*scene_.images[size_t(image)]);
    return *entry->second;
  }

  const SceneData& scene_;
  std::map<int, std::unique_ptr<AlphaMaxima>> maxima_;
};

std::vector<bool> shownWhere(const SceneData& scene, const std::vector<bool>& isAnimated) {
  std::vector<bool> shown(scene.nodes.size());
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    shown[i] = (node.visible || (!isAnimated.empty() && isAnimated[i])) &&
               (node.parent < 0 || shown[size_t(node.parent)]);
  }
  return shown;
}

}  // namespace

SurfaceAlpha::SurfaceAlpha(const SceneData& scene, const Primitive& primitive)
    : primitive_(primitive),
      material_(scene.materials[size_t(primitive.material)]),
      image_(imageOf(scene, material_.baseColorTexture)),
      uvs_(coordinatesOf(primitive, material_.baseColorTexture)) {
  isWhole_ = material_.alphaMode == AlphaMode::opaque ||
             (material_.baseColor.a == 1 && !image_ && primitive.colors.empty());
}

float SurfaceAlpha::at(const glm::uvec3& corners, const glm::vec3& weights) const {
  if (isWhole_) return 1;
  float alpha = material_.baseColor.a;
  if (!primitive_.colors.empty()) {
    float sum = 0;
    for (int c = 0; c < 3; ++c) sum += weights[c] * float(primitive_.colors[corners[c]].a) / 255;
    alpha *= sum;
  }
  if (image_) {
    glm::vec2 uv(0.0f);
    for (int c = 0; c < 3; ++c) uv += weights[c] * uvs_[corners[c]];
    alpha *= float(texelAt(*image_, material_.baseColorTexture, uv).a);
  }
  return alpha;
}

float SurfaceAlpha::texelsBetween(uint32_t vertex, uint32_t other) const {
  if (!image_) return 0;
  const glm::vec3 way = material_.baseColorTexture.transform * glm::vec3(uvs_[other] - uvs_[vertex], 0.0f);
  return glm::length(glm::vec2(way) * glm::vec2(image_->width, image_->height));
}

float SurfaceAlpha::least() const {
  return leastAlpha(material_);
}

bool keepsArea(const glm::mat4& matrix) {
  const glm::dvec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
  // Of rank two or three: some two of its columns span an area.
  const double most = std::max({glm::dot(x, x), glm::dot(y, y), glm::dot(z, z)});
  const auto area2 = [](const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 normal = glm::cross(a, b);
    return glm::dot(normal, normal);
  };
  return std::max({area2(x, y), area2(y, z), area2(z, x)}) > 1e-24 * most * most;
}

std::vector<bool> shownNodes(const SceneData& scene) {
  return shownWhere(scene, {});
}

std::vector<bool> everShownNodes(const SceneData& scene) {
  std::vector<bool> isAnimated(scene.nodes.size());
  for (const Clip& clip : scene.clips)
    for (const Channel& channel : clip.channels)
      if (channel.property == AnimatedProperty::visible) isAnimated[size_t(channel.node)] = true;
  return shownWhere(scene, isAnimated);
}

void findSeen(SceneData& scene) {
  Finder finder(scene);
  scene.seen.clear();
  for (const Mesh& mesh : scene.meshes) {
    std::vector<SeenPart>& parts = scene.seen.emplace_back();
    for (const Primitive& primitive : mesh.primitives) parts.push_back(finder.of(primitive));
  }
}

const SeenPart& seenOf(const SceneData& scene, int mesh, size_t p) {
  static const SeenPart kAll;
  if (size_t(mesh) >= scene.seen.size() || p >= scene.seen[size_t(mesh)].size()) return kAll;
  return scene.seen[size_t(mesh)][p];
}

const PrimitiveExtent& seenExtent(const SceneData& scene, int mesh, size_t p) {
  const SeenPart& part = seenOf(scene, mesh, p);
  return part.extent ? *part.extent : scene.meshes[size_t(mesh)]->primitives[p].extent;
}

std::vector<bool> seenNodes(const SceneData& scene, std::span<const int> clips) {
  std::vector<bool> seen(scene.nodes.size());
  forEachPose(scene, clips, [&](const Pose& pose, std::span<const std::vector<glm::mat4>> joints) {
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
      const Node& node = scene.nodes[n];
      if (seen[n] || node.mesh < 0 || !pose.shown[n]) continue;
      const Mesh& mesh = scene.meshes[size_t(node.mesh)];
      bool hasSeenParts = mesh.painting != nullptr;
      for (size_t p = 0; p < mesh.primitives.size(); ++p) hasSeenParts |= seenOf(scene, node.mesh, p).isSeen;
      if (!hasSeenParts) continue;
      if (node.skin >= 0)
        seen[n] = std::any_of(joints[size_t(node.skin)].begin(), joints[size_t(node.skin)].end(), keepsArea);
      else
        for (size_t i = 0; i < instanceCount(node) && !seen[n]; ++i)
          seen[n] = keepsArea(instanceToWorld(node, pose.world[n], i));
    }
  });
  return seen;
}

}  // namespace scumble::scene
