#include "bake/mesh_bake.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

#include "bake/atlas.h"
#include "bake/orders.h"
#include "scene/import_failure.h"
#include "scene/parallel.h"

namespace scumble::bake {

namespace {

constexpr float kFinestTexel = 1.0f / 8;  // of the radius of fine strokes: finer shows nothing
constexpr float kFineStrokes = 0.1f;      // of all splats are finer than fine strokes
constexpr float kLift = 5e-4f;            // of the proxy's radius, by which a coat lies over it
constexpr float kMostReach = 1.0f;        // of that radius: strokes farther away are not the proxy's

// What is captured: a coat of a chart, or a fin.
struct Work {
  int chart = -1, layer = 0;
  size_t fin = 0;
};

class Baker {
 public:
  Baker(const MeshBake& bake, const BakeOptions& options, Checkpoint& checkpoint,
        const std::function<void(double)>& progress, MeshReport& report)
      : bake_(bake), options_(options), checkpoint_(checkpoint), progress_(progress), report_(report) {}

  gltf::PaintedMesh bake() {
    proxy_ = makeProxy(*bake_.mesh);
    scene::Bounds box;
    for (const glm::vec3& p : proxy_.places) box.add(p);
    radius_ = box.radius();
    if (proxy_.triangles.empty()) return {};
    splats_ = hungSplats(*bake_.mesh->painting, proxy_, options_, kMostReach * radius_, report_.left);
    report_.splats = splats_.size();
    if (splats_.empty()) return {};
    std::vector<float> fixedOffset;
    for (const PartOptions& part : bake_.parts)
      fixedOffset.push_back(std::min(part.offset, kMostReach * radius_));
    shell_ = makeShell(proxy_, splats_, fixedOffset);
    fins_ = makeFins(proxy_, shell_);
    listWork();
    chooseTexel();
    capture();
    return assembled();
  }

 private:
  const PartOptions& partOf(uint32_t primitive) const { return bake_.parts[primitive]; }
  uint32_t primitiveOf(const Chart& chart) const {
    return proxy_.triangles[size_t(chart.triangles[0])].primitive;
  }

  void listWork() {
    for (size_t c = 0; c < proxy_.charts.size(); ++c)
      for (int layer = 0; layer < partOf(primitiveOf(proxy_.charts[c])).layers; ++layer)
        work_.push_back({int(c), layer, 0});
    // Nothing stands on fins with no splat over any triangle around them.
    std::vector<bool> isNear(proxy_.places.size());
    for (const Splat& splat : splats_)
      for (int c = 0; c < 3; ++c) isNear[proxy_.triangles[size_t(splat.triangle)].places[c]] = true;
    for (size_t f = 0; f < fins_.size(); ++f) {
      const ProxyEdge& edge = proxy_.edges[fins_[f].edge];
      if (isNear[edge.a] || isNear[edge.b]) work_.push_back({-1, 0, f});
    }
  }

  glm::uvec2 sizeOf(const Work& work, float texel) const {
    return work.chart >= 0 ? tileSize(proxy_.charts[size_t(work.chart)], texel)
                           : tileSize(fins_[work.fin], texel);
  }

  // The finest that fits, or that shows all there is.
  void chooseTexel() {
    std::vector<float> radii;
    for (const Splat& splat : splats_) radii.push_back(splat.radius);
    const auto fine = radii.begin() + std::ptrdiff_t(kFineStrokes * float(radii.size() - 1));
    std::nth_element(radii.begin(), fine, radii.end());
    const auto fits = [&](float texel) {
      std::vector<glm::uvec2> sizes;
      for (const Work& work : work_) sizes.push_back(sizeOf(work, texel));
      return pack(sizes, options_.textureSize, options_.textureSize).has_value();
    };
    texel_ = std::max(*fine * kFinestTexel, 1e-6f * radius_);
    if (fits(texel_)) return;
    float coarse = 2 * texel_;
    for (; !fits(coarse); coarse *= 2)
      if (coarse > radius_)
        scene::fail({}, "its triangles do not fit into the texture",
                    "ask for a larger one (--texture), or for fewer layers");
    for (int i = 0; i < 8; ++i) {
      const float middle = std::sqrt(texel_ * coarse);
      (fits(middle) ? coarse : texel_) = middle;
    }
    texel_ = coarse;
  }

  // Files may say anything.
  bool isOf(const Piece& piece, const Work& work) const {
    const glm::uvec2 most = sizeOf(work, texel_);
    const Tile& tile = piece.tile;
    return (tile.width == 0 && tile.height == 0) ||
           (tile.width == most.x && tile.height > 2 * uint32_t(kGutter) && tile.height <= most.y &&
            piece.top > 0 && piece.top <= 1);
  }

  void capture() {
    const Capture capture(proxy_, shell_, splats_, options_, texel_);
    pieces_.resize(work_.size());
    std::atomic<size_t> done{0}, resumed{0};
    scene::parallelFor(work_.size(), scene::threadCount(options_.threads), [&](size_t i) {
      const Piece* const known = checkpoint_.find(bake_.firstPiece + i);
      if (known && isOf(*known, work_[i])) {
        pieces_[i] = *known;
        ++resumed;
      } else {
        const Work& work = work_[i];
        if (work.chart >= 0) {
          const int layers = partOf(primitiveOf(proxy_.charts[size_t(work.chart)])).layers;
          // The first one takes what is sunken, the last one what reaches beyond the shell.
          const float low = work.layer == 0 ? -INFINITY : float(work.layer) / float(layers);
          const float high = work.layer + 1 == layers ? INFINITY : float(work.layer + 1) / float(layers);
          pieces_[i].tile = capture.coat(uint32_t(work.chart), low, high);
        } else {
          pieces_[i].tile = capture.fin(fins_[work.fin], pieces_[i].top);
        }
        checkpoint_.add(bake_.firstPiece + i, pieces_[i]);
      }
      progress_(double(++done) / double(work_.size()));
    });
    report_.resumed = resumed;
  }

  gltf::PaintedMesh assembled() {
    std::vector<Tile> tiles;
    std::vector<glm::uvec2> sizes;
    for (Piece& piece : pieces_) {
      sizes.emplace_back(piece.tile.width, piece.tile.height);
      tiles.push_back(std::move(piece.tile));
    }
    // No tile is larger than it was to be; but rows of others may be, and then they stay where those would
    // have been.
    if (std::optional<Packing> packed = pack(sizes, options_.textureSize, options_.textureSize)) {
      packing_ = std::move(*packed);
    } else {
      std::vector<glm::uvec2> planned;
      for (const Work& work : work_) planned.push_back(sizeOf(work, texel_));
      packing_ = pack(planned, options_.textureSize, options_.textureSize).value();
    }
    if (packing_.width == 0) return {};
    report_.width = packing_.width, report_.height = packing_.height;
    gltf::PaintedMesh painted;
    painted.picture = pngOf(assemble(packing_, tiles));
    std::map<std::pair<uint32_t, bool>, gltf::PaintPart> parts;  // coats first
    for (size_t i = 0; i < work_.size(); ++i) {
      if (sizes[i].x == 0) continue;
      const Work& work = work_[i];
      const bool isFin = work.chart < 0;
      const uint32_t primitive =
          isFin ? fins_[work.fin].primitive : primitiveOf(proxy_.charts[size_t(work.chart)]);
      gltf::PaintPart& part = parts[{primitive, isFin}];
      if (isFin)
        addFin(fins_[work.fin], i, sizes[i], part);
      else
        addCoat(work, i, sizes[i], part);
    }
    for (auto& [key, part] : parts) {
      const auto& [primitive, isFin] = key;
      part.primitive = primitive;
      part.name = bake_.names[primitive] + (isFin ? " fins" : " coat");
      part.layer.fades = isFin;
      part.isDoubleSided = isFin || bake_.isAlone;
      part.layer.fadeStart = partOf(primitive).fadeStart, part.layer.fadeEnd = partOf(primitive).fadeEnd;
      report_.triangles += part.indices.size() / 3;
      if (isFin) report_.fins += part.indices.size() / 6;
      painted.parts.push_back(std::move(part));
    }
    for (const glm::vec3& toViewer : orderDirections(options_.orders))
      painted.orders.push_back({toViewer, orderedTowards(painted.parts, toViewer)});
    return painted;
  }

  // `texels`: from the tile's upper left corner.
  glm::vec2 uvOf(size_t piece, const glm::vec2& texels) const {
    return (glm::vec2(packing_.at[piece]) + texels) / glm::vec2(packing_.width, packing_.height);
  }

  void addCoat(const Work& work, size_t piece, const glm::uvec2& size, gltf::PaintPart& part) const {
    const Chart& chart = proxy_.charts[size_t(work.chart)];
    std::map<uint32_t, uint32_t> numbers;  // by the primitive's vertex
    for (const int number : chart.triangles) {
      if (number < 0) continue;
      const ProxyTriangle& t = proxy_.triangles[size_t(number)];
      const float height = float(work.layer) / float(partOf(t.primitive).layers);
      for (int c = 0; c < 3; ++c) {
        const auto [known, isNew] = numbers.try_emplace(t.vertices[c], uint32_t(part.positions.size()));
        part.indices.push_back(known->second);
        if (!isNew) continue;
        const uint32_t place = t.places[c];
        part.carriers.push_back(t.vertices[c]);
        part.positions.push_back(proxy_.primitives[t.primitive]->positions[t.vertices[c]] +
                                 (height * shell_.offsets[place] + kLift * radius_) *
                                     shell_.directions[place]);
        part.normals.push_back(proxy_.normals[place]);
        const glm::vec2 in = (t.flat[size_t(c)] - chart.low) / texel_;
        part.uvs.push_back(uvOf(piece, {float(kGutter) + in.x, float(size.y) - float(kGutter) - in.y}));
      }
    }
  }

  void addFin(const Fin& fin, size_t piece, const glm::uvec2& size, gltf::PaintPart& part) const {
    const ProxyEdge& edge = proxy_.edges[fin.edge];
    const ProxyTriangle& t = proxy_.triangles[size_t(edge.triangles[0])];
    const auto carrier = [&](uint32_t place) {
      for (int c = 0; c < 3; ++c)
        if (t.places[c] == place) return t.vertices[c];
      return t.vertices[0];
    };
    const uint32_t ends[] = {carrier(edge.a), carrier(edge.b)};
    const auto first = uint32_t(part.positions.size());
    const float top = pieces_[piece].top, g = float(kGutter);
    for (int c = 0; c < 4; ++c) {
      const bool atB = c == 1 || c == 2, isTop = c >= 2;
      const glm::vec3 &foot = fin.corners[atB ? 1 : 0], &tip = fin.corners[atB ? 2 : 3];
      part.carriers.push_back(ends[atB]);
      part.positions.push_back(isTop ? glm::mix(foot, tip, top) : foot);
      part.normals.push_back(fin.matched[atB]);
      part.uvs.push_back(uvOf(piece, {atB ? float(size.x) - g : g, isTop ? g : float(size.y) - g}));
    }
    for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) part.indices.push_back(first + corner);
  }

  const MeshBake& bake_;
  const BakeOptions& options_;
  Checkpoint& checkpoint_;
  const std::function<void(double)>& progress_;
  MeshReport& report_;
  Proxy proxy_;
  float radius_ = 1, texel_ = 0;
  std::vector<Splat> splats_;
  Shell shell_;
  std::vector<Fin> fins_;
  std::vector<Work> work_;
  std::vector<Piece> pieces_;
  Packing packing_;
};

}  // namespace

gltf::PaintedMesh bakeMesh(const MeshBake& bake, const BakeOptions& options, Checkpoint& checkpoint,
                           const std::function<void(double)>& progress, MeshReport& report) {
  return Baker(bake, options, checkpoint, progress, report).bake();
}

}  // namespace scumble::bake
