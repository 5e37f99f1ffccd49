// Pictures whose measures are known: a wall and a board before it with nothing around them, painted with
// waves by a draw of its own in double precision. What is asked for stands in the look, as for the renderer.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "measure/measurer.h"
#include "tests/support/render_test.h"
#include "tests/support/test_scene.h"

namespace scumble::measuring::test {

constexpr double kPi = std::numbers::pi;

struct Wall {
  const char* material;
  double z, left, right, bottom, top;  // metres
  std::array<double, 2> exponents;     // what MetaTexture chooses
};
constexpr std::array<Wall, 2> kWalls{
    {{"Wall", 0, -2.6, 2.6, -1.6, 1.6, {2, 1}}, {"Board", 2, -1.5, -0.9, -0.6, 0.6, {4, 3}}}};
constexpr double kUntorn = 1.45;    // metres: nothing is torn above that
constexpr float kSeaNumber = 1000;  // of what stands below the walls, and is none of the scene's nodes
constexpr double kEyeDistance = 6, kHalfFov = 20 * kPi / 180;  // from the wall's middle; vertically

inline Scene wallScene() {
  scumble::test::TestScene scene;
  for (const Wall& wall : kWalls) {
    scumble::test::Json material = scumble::test::TestScene::unlit(wall.material, {1, 1, 1, 1});
    scene.add(scumble::test::gridMesh(glm::vec3(float(wall.left), float(wall.bottom), float(wall.z)),
                                      glm::vec3(float(wall.right - wall.left), 0, 0),
                                      glm::vec3(0, float(wall.top - wall.bottom), 0)),
              scene.material(material));
  }
  return scene.load();
}

inline glm::dmat4 worldToClip(const View& view) {
  return glm::dmat4(view.eyeToClip) * glm::dmat4(view.worldToEye);
}

inline glm::dvec2 placeIn(const View& view, const glm::dvec3& point, const glm::dvec2& size) {
  const glm::dvec4 clip = worldToClip(view) * glm::dvec4(point, 1);
  return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size;
}

// What a view shows at a place: number 0 where there is nothing, else of a wall, from 1.
struct Seen {
  int number = 0;
  glm::dvec3 point{0.0};
  double depth = 0;
};
inline Seen seenAt(const View& view, const glm::dmat4& clipToWorld, const glm::dvec2& place,
                   const glm::dvec2& size) {
  const glm::dvec2 ndc = place / size * 2.0 - 1.0;
  const glm::dvec4 near = clipToWorld * glm::dvec4(ndc, 1, 1), far = clipToWorld * glm::dvec4(ndc, 0.5, 1);
  const glm::dvec3 from = glm::dvec3(near) / near.w, along = glm::dvec3(far) / far.w - from;
  Seen seen;
  for (size_t i = 0; i < kWalls.size(); ++i) {
    const Wall& wall = kWalls[i];
    const double t = (wall.z - from.z) / along.z;
    const glm::dvec3 point = from + t * along;
    const double depth = -(glm::dmat4(view.worldToEye) * glm::dvec4(point, 1)).z;
    if (!(t > 0) || point.x < wall.left || point.x > wall.right || point.y < wall.bottom ||
        point.y > wall.top || (seen.number && depth > seen.depth))
      continue;
    seen = {int(i) + 1, point, depth};
  }
  return seen;
}

constexpr double kMiddle = 0.5;  // metres to either side, somewhat more than the greatest zoom shows

// How waves stand on the screen at a zoom: cycles a pixel, and their height.
struct Pattern {
  double frequency, height;
};
// Of the vectors: MetaTexture goes to the next level at each doubling, ordinary mapping grows with the
// surface, the shower door stays as it is, and the octaves' contrast falls. Marks do otherwise.
inline Pattern patternOf(const std::string& mode, bool marks, double zoom) {
  const double octave = std::log2(zoom);
  if (mode == "metatexture")
    return marks
               ? Pattern{0.04 * std::exp2(octave - 2 * std::floor((octave + 0.25) / 2)), zoom < 0.9 ? 1.1 : 1}
               : Pattern{0.07 * std::exp2(octave - std::floor(octave + 0.25)), 1};
  if (mode == "object") return marks ? Pattern{0.025 / zoom, 0.9} : Pattern{0.03 / zoom, 1};
  if (mode == "screen") return {marks ? 0.06 : 0.09, 1};
  return marks ? Pattern{0.05, 1} : Pattern{0.075 * std::pow(zoom, 1.0 / 6), zoom > 1.1 ? 0.5 : 1};
}

// The vector (x right, y down) and the mark that waves have at a place given in pixels of the framing; half
// of the vectors' variance is in each channel, and seeds shift the waves by quarters.
inline glm::dvec3 wavesAt(const glm::dvec2& place, const std::array<Pattern, 2>& patterns, uint32_t seed) {
  const uint32_t half = seed / 2;
  const glm::dvec2 shift(0.5 * kPi * seed, 0.5 * kPi * half);
  const auto turns = [&](const Pattern& pattern) { return 2 * kPi * pattern.frequency * place + shift; };
  const glm::dvec2 a = turns(patterns[0]), b = turns(patterns[1]);
  return {patterns[0].height * std::cos(a.x) * std::cos(a.y),
          patterns[0].height * std::sin(a.x) * std::sin(a.y),
          0.5 + 0.3 * patterns[1].height * std::cos(b.x) * std::cos(b.y)};
}

// Where x of the walls goes on the screen (y down): by how much the camera's roll turns it clockwise.
inline double turnOf(const View& view) {
  const glm::dvec3 right = glm::dvec3(view.worldToEye[0]);
  return std::atan2(-right.y, right.x);
}
inline glm::dvec2 turned(const glm::dvec2& v, double by) {
  return {std::cos(by) * v.x - std::sin(by) * v.y, std::sin(by) * v.x + std::cos(by) * v.y};
}

inline glm::dvec3 paintAt(const std::string& mode, const View& view, const Seen& seen,
                          const glm::dvec2& place, const glm::dvec2& size, uint32_t seed) {
  if (mode == "screen") return wavesAt(place, {patternOf(mode, false, 1), patternOf(mode, true, 1)}, seed);
  const double zoom = std::abs(double(view.eyeToClip[1][1])) * std::tan(kHalfFov);
  // Pixels of the framing a metre, with the eye before the middle: on both walls the waves look alike there.
  const double perMetre = 0.5 * size.y / ((kEyeDistance - seen.point.z) * std::tan(kHalfFov));
  const glm::dvec2 at = perMetre * glm::dvec2(seen.point) + glm::dvec2(31.7, 11.3) * double(seen.number - 1);
  std::array<Pattern, 2> patterns{patternOf(mode, false, zoom), patternOf(mode, true, zoom)};
  for (Pattern& pattern : patterns) pattern.frequency *= zoom;
  glm::dvec3 waves = wavesAt(at, patterns, seed);
  // Marks of the octaves are twice as wide to either side of the middle: in a place with other uv.
  const double middle = perMetre * kMiddle;
  if (mode == "fractal" && std::abs(at.x) > middle) {
    const double x = std::copysign(middle + 0.5 * (std::abs(at.x) - middle), at.x);
    waves.z = wavesAt({x, at.y}, patterns, seed).z;
  }
  return {turned(glm::dvec2(waves), turnOf(view)), waves.z};
}

// What differs between the eyes beside the fields.
constexpr double kShadowStep = 0.1;
constexpr std::array<double, 3> kColorStep{0.1, 0.2, 0.2}, kFinalStep{0, 0.6, 0};

// One call of draw.
struct Drawn {
  std::string mode;
  Look look;
  std::vector<View> views, previous;
  std::vector<std::string> aovs;
  uint32_t seed;
  bool isSheet;
  std::array<bool, 2> tears{};  // by wall

  bool has(const char* aov) const {
    for (const std::string& name : aovs)
      if (name == aov) return true;
    return false;
  }
};

// Draws the walls, or the sheet that fills the picture, and keeps what it was asked.
class WallPainter {
 public:
  std::vector<Drawn> calls;

  Result<Frame> draw(const Scene& scene, const Look& look, const std::vector<View>& views,
                     const RenderOptions& options) {
    calls.push_back({scumble::test::settingOf(look, "warp.metatexture.mode"), look, views,
                     options.previousViews, options.aovs, options.seed, scene.summary().triangles == 1});
    for (size_t i = 0; i < kWalls.size(); ++i)
      calls.back().tears[i] =
          std::get<double>(*look.get(std::string("materials.") + kWalls[i].material + ".warp.amount")) > 0;
    Frame frame;
    std::vector<std::string> names{""};
    names.insert(names.end(), options.aovs.begin(), options.aovs.end());
    for (const std::string& name : names) {
      Frame::Layer layer{name, {}};
      for (size_t view = 0; view < views.size(); ++view)
        layer.views.push_back(image(name, calls.back(), view, options.width, options.height));
      frame.layers.push_back(std::move(layer));
    }
    return frame;
  }

 private:
  static Image image(const std::string& name, const Drawn& call, size_t index, uint32_t width,
                     uint32_t height) {
    Image image{width, height, {"R", "G", "B", "A"}, {}};
    const View& view = call.views[index];
    const glm::dmat4 clipToWorld = glm::inverse(worldToClip(view));
    const glm::dvec2 size(width, height);
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x) {
        const glm::dvec2 place(x + 0.5, y + 0.5);
        const Seen seen = call.isSheet ? Seen{1, glm::dvec3(0.0), 1} : seenAt(view, clipToWorld, place, size);
        // Nobody must ever look at what stands where nothing is.
        const glm::dvec4 value =
            seen.number ? valueOf(name, call, index, seen, place, size) : glm::dvec4(1e6, -1e6, 1e6, 0);
        for (int c = 0; c < 4; ++c) image.pixels.push_back(float(value[c]));
        if (!seen.number && name == "id") *(image.pixels.end() - 4) = y > 0.9 * height ? kSeaNumber : 0;
      }
    return image;
  }

  static glm::dvec4 valueOf(const std::string& name, const Drawn& call, size_t index, const Seen& seen,
                            const glm::dvec2& place, const glm::dvec2& size) {
    const View& view = call.views[index];
    const double step = index == 1 ? 1 : 0;  // of what the right eye sees otherwise
    if (name == "warp") {
      glm::dvec3 paint = paintAt(call.mode, view, seen, place, size, call.seed);
      if (seen.point.y > kUntorn || !call.tears[size_t(seen.number - 1)]) paint.x = paint.y = 0;
      return {paint, seen.depth};
    }
    if (name == "position") return {seen.point, 0};
    if (name == "depth") return glm::dvec4(seen.depth);
    if (name == "id") return glm::dvec4(seen.number);
    if (name == "metatexture") {
      const std::array<double, 2>& exponents = kWalls[size_t(seen.number - 1)].exponents;
      return {exponents[0], exponents[1], 0, 1};
    }
    if (name == "motion") {
      const View& before = call.previous.empty() ? view : call.previous[index];
      return {place - placeIn(before, seen.point, size), 0, 0};
    }
    const double attached = 0.4 + 0.1 * std::sin(0.5 * seen.point.x);
    if (name == "final-shadow") return {attached + step * kShadowStep, 7 + step, 7, 1};
    const std::array<double, 3>& of = name == "color" ? kColorStep : kFinalStep;
    return {attached + step * of[0], attached + step * of[1], attached + step * of[2], 1 + step};
  }
};

}  // namespace scumble::measuring::test
