#include "frame/decorations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/tileable_noise.h"
#include "frame/floating.h"

namespace scumble::frame {

namespace {

using shared::WaterDecoration;

// Where what makes a decoration is at any time, on the water of now: metres from the middle of calm water.
class Maker {
 public:
  Maker(const Decoration& decoration, const scene::SceneData& scene, std::span<const scene::PlayedClip> clips,
        double now, const glm::vec3& origin, const Travelled& travelled)
      : decoration_(decoration),
        scene_(scene),
        clips_(clips),
        origin_(origin.x, origin.z),
        travelled_(travelled),
        travelledNow_(travelled(now)) {}
  glm::dvec2 at(double time) const {
    glm::vec4 place(decoration_.params.at.value, 1.0f);
    if (decoration_.node) place = scene::worldAt(scene_, clips_, *decoration_.node, time) * place;
    return glm::dvec2(double(place.x), double(place.z)) - origin_ + travelled_(time) - travelledNow_;
  }

 private:
  const Decoration& decoration_;
  const scene::SceneData& scene_;
  std::span<const scene::PlayedClip> clips_;
  glm::dvec2 origin_;
  const Travelled& travelled_;
  glm::dvec2 travelledNow_;
};

void placeWake(WaterDecoration& wake, const DecorationParams& params, const Maker& maker, double time) {
  constexpr int kPlaces = shared::kDecorationPoints - 1;
  const double step = double(params.lasts) / (kPlaces - 1);
  // As it comes now; at a jump, as it goes on.
  constexpr double kMoment = 0.02;
  const glm::dvec2 here = maker.at(time);
  glm::dvec2 velocity = (here - maker.at(time - kMoment)) / kMoment;
  const glm::dvec2 next = (maker.at(time + kMoment) - here) / kMoment;
  if (glm::length(next) < glm::length(velocity)) velocity = next;
  const double speed = glm::length(velocity);

  std::array<glm::dvec2, kPlaces> places{here};
  glm::dvec2 ahead(0.0), came = velocity;
  std::array<double, kPlaces> speeds{speed};
  bool jumped = false;
  for (size_t i = 1; i < kPlaces; ++i) {
    const glm::dvec2 there = maker.at(time - double(i) * step), way = (places[i - 1] - there) / step;
    jumped |= glm::length(way) > 3 * std::max(glm::length(came), 0.5) + 2;
    if (!jumped) came = way;
    places[i] = places[i - 1] - came * step;
    speeds[i] = glm::length(came);
    if (ahead == glm::dvec2(0.0) && glm::length(came) > 1e-3) ahead = glm::normalize(came);
  }
  if (speed > 1e-3) ahead = velocity / speed;
  if (ahead == glm::dvec2(0.0)) return;

  const double toBow = 0.5 * double(params.length);
  double behind = 0;
  const auto add = [&](const glm::dvec2& place, double at) {
    wake.points[wake.count++] = {float(place.x), float(place.y), float(behind),
                                 float(glm::smoothstep(0.15, 1.0, at))};
  };
  add(here + ahead * toBow, speed);
  behind = toBow;
  for (size_t i = 0; i < kPlaces; ++i) {
    if (i > 0) behind += glm::length(places[i] - places[i - 1]);
    add(places[i], speeds[i]);
  }
  wake.hull = params.length, wake.halfBeam = 0.5f * params.beam;
  wake.spread = std::tan(glm::radians(float(params.spread)));
  wake.rise = std::min(0.025f * float(speed * speed), 0.1f * params.length);
  wake.reach = wake.halfBeam * 1.4f + (wake.spread + 0.08f) * float(behind);  // at its end it is widest
}

void placeRings(WaterDecoration& rings, const DecorationParams& params, const Maker& maker, double time,
                uint32_t seed) {
  rings.radius = params.radius, rings.crests = float(params.crests);
  rings.reach = (params.kind == shared::kRipples ? 1.3f : 2.3f) * params.radius;
  const double since = time - double(params.start), every = double(params.every);
  if (since < 0) return;
  double begun = every > 0 ? std::floor(since / every) : 0;
  for (; begun >= 0 && rings.count < shared::kDecorationPoints; --begun) {
    const double age = since - begun * every;
    if (age >= double(params.lasts)) return;
    const glm::dvec2 place = maker.at(time - age);
    const uint32_t own = hash(seed ^ hash(uint32_t(uint64_t(begun))));
    rings.points[rings.count++] = {float(place.x), float(place.y), float(age), float(own >> 8) / 16777216.0f};
  }
}

}  // namespace

std::vector<Decoration> decorationsOf(const scene::SceneData& scene, const look::LookData& look, int ocean) {
  std::vector<Decoration> decorations;
  for (const std::string& name : look.declared(look::kDecorations)) {
    Decoration& one = decorations.emplace_back();
    one.params = look.getFor<DecorationParams>(look::kDecorations, name);
    const std::string& node = look.text(one.params.node);
    if (node.empty()) continue;
    for (size_t n = 0; n < scene.nodes.size() && !one.node; ++n)
      if (scene.nodes[n].name == node) one.node = n;
    one.isThere = one.node.has_value();
  }
  for (const FloatingNode& floating : floatingNodes(scene, look, ocean)) {
    const auto isItsWake = [&](const Decoration& one) {
      return one.params.kind == shared::kWake && one.node == floating.node;
    };
    const FloatParams& params = floating.params;
    if (!params.wake || params.length == 0 || params.beam == 0 ||
        decorations.size() >= size_t(shared::kMaxDecorations) ||
        std::any_of(decorations.begin(), decorations.end(), isItsWake))
      continue;
    Decoration& wake = decorations.emplace_back();
    wake.params.kind = shared::kWake;
    wake.params.length = params.length, wake.params.beam = params.beam;
    wake.node = floating.node;
  }
  return decorations;
}

DecorationMesh makeDecorationMesh(int kind) {
  const bool isWake = kind == shared::kWake;
  const uint32_t along = isWake ? 56 : 52, across = isWake ? 30 : 96;
  DecorationMesh mesh;
  for (uint32_t i = 0; i <= along; ++i)
    for (uint32_t j = 0; j <= across; ++j)
      mesh.positions.emplace_back(float(i) / float(along), 2.0f * float(j) / float(across) - 1.0f, 0.0f);
  for (uint32_t i = 0; i < along; ++i)
    for (uint32_t j = 0; j < across; ++j) {
      const auto at = [&](uint32_t a, uint32_t b) { return (i + a) * (across + 1) + j + b; };
      mesh.indices.insert(mesh.indices.end(), {at(0, 0), at(0, 1), at(1, 1), at(0, 0), at(1, 1), at(1, 0)});
    }
  return mesh;
}

std::vector<WaterDecoration> placeDecorations(const std::vector<Decoration>& decorations,
                                              const scene::SceneData& scene,
                                              std::span<const scene::PlayedClip> clips, double time,
                                              const glm::vec3& origin, const Travelled& travelled) {
  std::vector<WaterDecoration> placed;
  for (const Decoration& decoration : decorations) {
    const DecorationParams& params = decoration.params;
    WaterDecoration& one = placed.emplace_back();
    one.kind = params.kind;
    one.amount = params.amount, one.foam = params.foam, one.height = params.height, one.lasts = params.lasts;
    if (!decoration.isThere || params.amount == 0) continue;
    const Maker maker(decoration, scene, clips, time, origin, travelled);
    if (params.kind == shared::kWake)
      placeWake(one, params, maker, time);
    else
      placeRings(one, params, maker, time, uint32_t(placed.size()));

    glm::vec2 least(1e30f), most(-1e30f);
    for (int i = 0; i < one.count; ++i) {
      least = glm::min(least, glm::vec2(one.points[i]));
      most = glm::max(most, glm::vec2(one.points[i]));
    }
    if (one.count > 0) one.center = 0.5f * (least + most), one.reach += 0.5f * glm::length(most - least);
  }
  return placed;
}

float decorationHeight(const WaterDecoration& decoration) {
  return decoration.height * std::max(2.0f * decoration.rise, decoration.radius);
}

}  // namespace scumble::frame
