#include "features/ocean/decorations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/tileable_noise.h"
#include "scene/find_node.h"

namespace scumble::ocean {

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
    const glm::dvec4 at(decoration_.params.at.value, 1.0f);
    const glm::dvec4 place = (decoration_.node ? scene::worldAt(scene_, clips_, *decoration_.node, time)
                                               : scene::worldToOrigin(scene_)) *
                             at;
    return glm::dvec2(place.x, place.z) - origin_ + travelled_(time) - travelledNow_;
  }

 private:
  const Decoration& decoration_;
  const scene::SceneData& scene_;
  std::span<const scene::PlayedClip> clips_;
  glm::dvec2 origin_;
  const Travelled& travelled_;
  glm::dvec2 travelledNow_;
};

// The time since which what makes a wake has not jumped, as it does where a clip that repeats begins anew at
// another place than it ended at.
double withoutJumpSince(const Maker& maker, const scene::SceneData& scene,
                        std::span<const scene::PlayedClip> clips, double from, double to) {
  constexpr double kMoment = 1e-3;
  constexpr int kMostTurns = 1000;  // a clip that begins anew more often is not asked what was before
  double since = from;
  for (const scene::PlayedClip& played : clips) {
    const double duration = double(scene.clips[size_t(played.clip)].duration) / std::abs(played.speed);
    if (played.repeat != scene::Repeat::loop || !(duration > 0) || !std::isfinite(duration)) continue;
    // It begins anew whenever this is whole.
    const double phase = played.start / (played.speed * duration);
    double turn = std::floor(to / duration + phase);
    int asked = 0;
    for (; asked < kMostTurns && (turn - phase) * duration > since; ++asked, --turn) {
      const double begins = (turn - phase) * duration;
      const glm::dvec2 before = maker.at(begins - kMoment), after = maker.at(begins + kMoment);
      const double moves = glm::length(maker.at(begins + 2 * kMoment) - after) +
                           glm::length(before - maker.at(begins - 2 * kMoment));
      if (glm::length(after - before) > 0.05 + 2 * moves) since = begins;
    }
    if (asked == kMostTurns) since = std::max(since, (turn - phase) * duration);
  }
  return since;
}

void placeWake(WaterDecoration& wake, const DecorationParams& params, const Maker& maker,
               const scene::SceneData& scene, std::span<const scene::PlayedClip> clips, double time) {
  constexpr int kPlaces = shared::kDecorationPoints - 1;
  const double step = double(params.lasts) / (kPlaces - 1);
  constexpr double kAfter = 1e-3;
  const double since = withoutJumpSince(maker, scene, clips, time - double(params.lasts), time) + kAfter;
  // As it comes now, or after a jump, as it goes on.
  constexpr double kMoment = 0.02;
  const glm::dvec2 here = maker.at(time);
  const auto velocityAt = [&](double when) {
    const double a = std::max(when - kMoment, since), b = a + kMoment;
    return (maker.at(b) - maker.at(a)) / kMoment;
  };
  const glm::dvec2 velocity = velocityAt(time);
  const double speed = glm::length(velocity);

  std::array<glm::dvec2, kPlaces> places{here};
  std::array<double, kPlaces> speeds{speed};
  glm::dvec2 ahead(0.0);
  // Before a jump it has come straight on, as it went on after.
  const glm::dvec2 first = maker.at(since), came = velocityAt(since);
  for (size_t i = 1; i < kPlaces; ++i) {
    const double when = time - double(i) * step;
    places[i] = when > since ? maker.at(when) : first - came * (since - when);
    const glm::dvec2 way = (places[i - 1] - places[i]) / step;
    speeds[i] = glm::length(way);
    if (ahead == glm::dvec2(0.0) && speeds[i] > 1e-3) ahead = way / speeds[i];
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

std::vector<Decoration> decorationsOf(const scene::SceneData& scene, const look::LookData& look,
                                      std::span<const FloatingNode> floating) {
  std::vector<Decoration> decorations;
  for (const std::string& name : look.declared(look::kDecorations)) {
    Decoration& one = decorations.emplace_back();
    one.params = look.getFor<DecorationParams>(look::kDecorations, name);
    const std::string& node = look.text(one.params.node);
    if (node.empty()) continue;
    const int found = scene::findNode(scene, node);
    if (found >= 0) one.node = size_t(found);
    one.isThere = found >= 0;
  }
  for (const FloatingNode& rides : floating) {
    const auto isItsWake = [&](const Decoration& one) {
      return one.params.kind == shared::kWake && one.node == rides.node;
    };
    const FloatParams& params = rides.params;
    if (!params.wake || params.length == 0 || params.beam == 0 ||
        decorations.size() >= size_t(shared::kMaxDecorations) ||
        std::any_of(decorations.begin(), decorations.end(), isItsWake))
      continue;
    Decoration& wake = decorations.emplace_back();
    wake.params.kind = shared::kWake;
    wake.params.length = params.length, wake.params.beam = params.beam;
    wake.node = rides.node;
  }
  return decorations;
}

scene::Primitive makeDecorationMesh(int kind) {
  const bool isWake = kind == shared::kWake;
  const uint32_t along = isWake ? 48 : 52, across = isWake ? 22 : 96;
  scene::Primitive mesh;
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
      placeWake(one, params, maker, scene, clips, time);
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

}  // namespace scumble::ocean
