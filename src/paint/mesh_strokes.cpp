#include "paint/mesh_strokes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/tileable_noise.h"
#include "paint/direction_field.h"
#include "scene/import_warnings.h"
#include "scene/nearest_place.h"
#include "scene/parallel.h"
#include "scene/splat_places.h"
#include "scene/surface_anchors.h"
#include "scene/texels.h"

namespace scumble::paint {

namespace {

constexpr int kSegments = 7;             // of a stroke
constexpr float kSplatsOfRadius = 4.0f;  // along a stroke: the feature's least spacing, a quarter of a radius
constexpr float kSecondsOfStroke = 0.04f;

// Numbers of one stroke's own, 0 to 1.
class Chance {
 public:
  explicit Chance(uint32_t seed) : state_(hash(seed)) {}
  float next() {
    state_ = hash(state_ + 0x9E3779B9u);
    return float(state_ >> 8) / float(1 << 24);
  }
  float around() { return 2 * next() - 1; }  // -1 to 1

 private:
  uint32_t state_;
};

class Surface {
 public:
  Surface(const scene::SceneData& scene, const scene::Mesh& mesh, const MeshPaint& paint)
      : scene_(scene), colors_(paint.colors), posed_(paint.posed) {
    for (const scene::Primitive& p : mesh.primitives)
      if (!p.isPaint) primitives_.push_back(&p);
    places_ = std::make_unique<scene::NearestPlaces>(primitives_);
    if (places_->isEmpty()) return;
    field_ = paint.flow == PaintFlow::curvature ? alongCurvature(primitives_, paint.towards)
                                                : alongDirection(primitives_, paint.towards);
  }
  bool isEmpty() const { return places_->isEmpty(); }
  const std::vector<const scene::Primitive*>& primitives() const { return primitives_; }

  struct Place {
    glm::vec3 position, normal, along;
    scene::NearestPlaces::Place at;
  };
  Place to(const glm::vec3& point) const {
    Place place;
    place.at = places_->to(point);
    const scene::Primitive& p = *primitives_[place.at.primitive];
    place.position = place.at.mixed(p.positions);
    place.normal = glm::normalize(place.at.mixed(p.smoothNormals) + 1e-6f * p.normals[place.at.vertices.x]);
    const glm::vec3 along = place.at.mixed(field_[place.at.primitive]);
    const glm::vec3 laid = along - place.normal * glm::dot(place.normal, along);
    place.along =
        glm::length(laid) > 1e-6f ? glm::normalize(laid) : field_[place.at.primitive][place.at.vertices.x];
    return place;
  }

  // Square root of what the look makes of it, or else of what the material has there.
  glm::vec3 rootAt(const scene::NearestPlaces::Place& at) const {
    if (colors_)
      if (const std::optional<glm::vec3> seen = colors_->rootAt(at.mixed(posed_->positions[at.primitive]),
                                                                at.mixed(posed_->normals[at.primitive])))
        return *seen;
    const scene::Primitive& p = *primitives_[at.primitive];
    const scene::Material& material = scene_.materials[size_t(p.material)];
    glm::vec3 root = glm::sqrt(glm::clamp(glm::vec3(material.baseColor), 0.0f, 1.0f));
    if (!p.colors.empty()) {
      glm::vec3 sum(0.0f);
      const float weights[] = {1 - at.at.x - at.at.y, at.at.x, at.at.y};
      for (int i = 0; i < 3; ++i) sum += weights[i] * glm::vec3(p.colors[at.vertices[i]]) / 255.0f;
      root *= glm::sqrt(glm::max(sum, glm::vec3(0.0f)));
    }
    const scene::TextureUse& use = material.baseColorTexture;
    if (use.image >= 0) {
      const std::vector<glm::vec2>& uvs = scene::coordinatesOf(p, use);
      root *= glm::vec3(glm::dvec3(scene::texelAt(scene_.images[size_t(use.image)], use, at.mixed(uvs))));
    }
    return root;
  }

 private:
  const scene::SceneData& scene_;
  const LookColors* colors_;
  const PosedMesh* posed_;
  std::vector<const scene::Primitive*> primitives_;
  std::unique_ptr<scene::NearestPlaces> places_;
  DirectionField field_;
};

float differ(const glm::vec3& a, const glm::vec3& b) {
  return glm::length(a - b);
}

// What a stroke of a width covers where it begins, as square roots of colours: the mean of some places, how
// far they are from it at most, and how much the surface turns there, as a cosine.
struct Covered {
  glm::vec3 root{0.0f};
  float spread = 0, turn = 1;
};
Covered coveredBy(const Surface& surface, const Surface::Place& place, float radius) {
  constexpr int kLooks = 6;
  glm::vec3 roots[kLooks + 1] = {surface.rootAt(place.at)};
  Covered covered{roots[0]};
  const glm::vec3 side = glm::cross(place.normal, place.along);
  for (int i = 0; i < kLooks; ++i) {
    const float around = 2 * std::numbers::pi_v<float> * float(i) / kLooks;
    const Surface::Place beside = surface.to(
        place.position + 0.8f * radius * (std::cos(around) * place.along + std::sin(around) * side));
    roots[i + 1] = surface.rootAt(beside.at);
    covered.root += roots[i + 1];
    covered.turn = std::min(covered.turn, glm::dot(beside.normal, place.normal));
  }
  covered.root /= float(kLooks + 1);
  for (const glm::vec3& root : roots) covered.spread = std::max(covered.spread, differ(root, covered.root));
  return covered;
}

// Beyond these, colours and turns are more than one stroke can show; smaller ones can, down to a part of its
// size.
constexpr float kMostSpread = 0.09f, kLeastTurn = 0.55f, kSmallest = 0.16f;
// Where the surface goes over to another colour than its own, or to many, a stroke ends.
constexpr float kOtherColor = 0.16f;
// How much of a step's direction is that of the step before.
constexpr float kInertia = 0.6f;

std::vector<scene::StrokePoint> strokeFrom(const Surface& surface, const glm::vec3& start,
                                           const StrokeLayer& layer, const MeshPaint& paint, uint32_t seed) {
  Chance chance(seed);
  const float vary = paint.variation;
  float radius = paint.size * layer.width * (1 + 0.5f * vary * chance.around());
  const float radii = layer.length * (1 + 0.6f * vary * chance.around());
  const float turn = vary * layer.wanders * 2 * chance.around(),
              bend = vary * layer.wanders * chance.around();
  const float lift = 1 + 0.5f * vary * chance.around();
  const float lighter = layer.lighter + vary * 0.1f * chance.around(),
              warmer = layer.warmer + vary * 0.06f * chance.around();
  Surface::Place place = surface.to(start);

  // As small as what it is to show.
  Covered covered = coveredBy(surface, place, radius);
  float size = 1;
  while (size > kSmallest && (covered.spread > kMostSpread || covered.turn < kLeastTurn)) {
    size *= 0.7f;
    covered = coveredBy(surface, place, radius * size);
  }
  radius *= size;
  const float step = radius * radii / kSegments;

  // Along the surface, until that has another colour.
  std::vector<Surface::Place> places{place};
  std::vector<glm::vec3> away{glm::vec3(0.0f)};  // how far it stands off
  glm::vec3 before = place.along;
  for (int i = 0; i < kSegments; ++i) {
    const float angle = turn + bend * float(i) / kSegments;
    glm::vec3 along = std::cos(angle) * place.along + std::sin(angle) * glm::cross(place.normal, place.along);
    if (i > 0) along = glm::mix(along, before, kInertia);
    along -= place.normal * glm::dot(place.normal, along);
    const float length = glm::length(along);
    if (!(length > 1e-6f)) break;
    before = along / length;
    const Surface::Place next = surface.to(place.position + (1 - layer.stands) * step * before);
    if (i > 0 && (differ(surface.rootAt(next.at), covered.root) > kOtherColor ||
                  coveredBy(surface, next, radius).spread > kMostSpread))
      break;
    away.push_back(away.back() + layer.stands * step * place.normal);
    places.push_back(place = next);
  }
  if (places.size() < 2) return {};

  const glm::vec3 root = glm::clamp(covered.root + lighter + warmer * glm::vec3(1, 0.15f, -1), 0.02f, 0.98f);
  std::vector<scene::StrokePoint> points;
  for (size_t i = 0; i < places.size(); ++i) {
    const float t = float(i) / float(places.size() - 1);
    const float height = size * paint.height * lift * glm::mix(layer.from, layer.to, t * t * (3 - 2 * t));
    scene::StrokePoint& point = points.emplace_back();
    point.position = places[i].position + places[i].normal * height + away[i];
    const float tapers =
        std::min(t / std::max(layer.tapersIn, 1e-3f), (1 - t) / std::max(layer.tapersOut, 1e-3f));
    point.radius = radius * std::clamp(0.12f + 0.88f * std::sqrt(std::min(tapers, 1.0f)), 0.12f, 1.0f);
    point.orientation = glm::quat_cast(
        glm::mat3(places[i].along, glm::cross(places[i].normal, places[i].along), places[i].normal));
    point.color = {root * root, layer.opacity};
  }
  // A hand draws no corners.
  for (int round = 0; round < 2; ++round) {
    std::vector<glm::vec3> smooth;
    for (size_t i = 1; i + 1 < points.size(); ++i)
      smooth.push_back(0.25f * points[i - 1].position + 0.5f * points[i].position +
                       0.25f * points[i + 1].position);
    for (size_t i = 0; i < smooth.size(); ++i) points[i + 1].position = smooth[i];
  }
  return points;
}

}  // namespace

double areaOf(const scene::Mesh& mesh) {
  double area = 0;
  for (const scene::Primitive& p : mesh.primitives)
    if (!p.isPaint) area += scene::areaOf(p);
  return area;
}

namespace {

// `strokesOfSplats`: how many strokes for each splat that was asked for, of what the layers' lengths say.
scene::Painting lay(const Surface& surface, const scene::Mesh& mesh, const MeshPaint& paint,
                    double strokesOfSplats) {
  scene::Painting painting;
  const double area = areaOf(mesh);
  float shares = 0;
  for (const StrokeLayer& layer : paint.style->layers) shares += layer.share;

  scene::ImportWarnings warnings;
  float time = paint.begin;
  for (size_t l = 0; l < paint.style->layers.size(); ++l) {
    const StrokeLayer& layer = paint.style->layers[l];
    // How many strokes: each is about as long as the style says.
    const double splatsOfStroke = double(kSplatsOfRadius) * layer.length + 2;
    const double strokes = strokesOfSplats * double(paint.splats) * layer.share / shares / splatsOfStroke;
    // Evenly spread over the surface, the widest apart first; every primitive has its part by area.
    struct Start {
      glm::vec3 position;
      uint32_t seed;
    };
    std::vector<Start> starts;
    for (size_t p = 0; p < surface.primitives().size(); ++p) {
      const scene::Primitive& primitive = *surface.primitives()[p];
      const size_t wanted = size_t(std::llround(strokes * scene::areaOf(primitive) / std::max(area, 1e-30)));
      if (wanted == 0) continue;
      const uint32_t own = hash(paint.seed + 977u * uint32_t(l) + 131071u * uint32_t(p));
      // About a twentieth of the candidates are anchors, or half of that.
      std::vector<scene::SurfaceAnchor> anchors;
      for (uint32_t candidates = uint32_t(std::min<size_t>(wanted * 24 + 64, 1u << 24));; candidates *= 2) {
        anchors = scene::anchorsOf(primitive, candidates, own);
        if (anchors.size() >= wanted || candidates >= 1u << 24) break;
      }
      anchors.resize(std::min(anchors.size(), wanted));
      for (const scene::SurfaceAnchor& a : anchors) {
        const glm::vec3 &base = primitive.positions[a.a], &b = primitive.positions[a.b],
                        &c = primitive.positions[a.c];
        starts.push_back({base + a.toB * (b - base) + a.toC * (c - base), hash(a.seed ^ own)});
      }
    }
    // In no order, as one paints here and there.
    std::stable_sort(starts.begin(), starts.end(),
                     [](const Start& a, const Start& b) { return a.seed < b.seed; });
    std::vector<std::vector<scene::StrokePoint>> laid(starts.size());
    scene::parallelFor(starts.size(), scene::threadCount(0), [&](size_t i) {
      laid[i] = strokeFrom(surface, starts[i].position, layer, paint, starts[i].seed);
    });
    for (std::vector<scene::StrokePoint>& points : laid) {
      if (points.empty()) continue;
      for (size_t i = 0; i < points.size(); ++i)
        points[i].time = time + kSecondsOfStroke * float(i) / float(points.size());
      time += kSecondsOfStroke;
      painting.add(layer.brush, std::move(points), mesh.name, warnings);
    }
    const char* const name = scene::nameOf(layer.brush);
    if (std::find(painting.brushes.begin(), painting.brushes.end(), name) == painting.brushes.end())
      painting.brushes.emplace_back(name);
  }
  painting.finish();
  return painting;
}

}  // namespace

scene::Painting strokesOver(const scene::SceneData& scene, const scene::Mesh& mesh, const MeshPaint& paint) {
  const Surface surface(scene, mesh, paint);
  if (surface.isEmpty()) return {};
  // What strokes are shortened and taper by is known when they are there.
  double factor = 1;
  scene::Painting painting = lay(surface, mesh, paint, factor);
  for (int round = 0; round < 2 && !painting.strokes.empty(); ++round) {
    std::vector<float> along;
    factor *= double(paint.splats) / double(scene::splatPlaces(painting, along).size());
    painting = lay(surface, mesh, paint, factor);
  }
  return painting;
}

}  // namespace scumble::paint
