#include <array>
#include <cmath>

#include "harbour.h"

namespace harbour {
namespace {

using namespace meshkit;

// Rows and columns of cells for about this many triangles; `aspect` is columns to rows.
struct Cells {
  size_t rows, columns;
};
Cells cellsFor(size_t triangles, float aspect) {
  const float cells = std::max(0.5f * float(triangles), 24.0f);
  const size_t columns = std::max<size_t>(size_t(std::lround(std::sqrt(cells * aspect))), 6);
  return {std::max<size_t>(size_t(std::lround(cells / float(columns))), 4), columns};
}

// Smooth noise in about [-1, 1]: a few waves in random directions.
class Lumps {
 public:
  Lumps(Random& random, float frequency) {
    for (Wave& w : waves_) {
      w = {random.direction() * frequency, random.between(0.0f, 6.28f)};
      frequency *= 1.45f;
    }
  }
  float operator()(glm::vec3 p) const {
    float sum = 0.0f, weight = 0.5f;
    for (const Wave& w : waves_) {
      sum += weight * std::sin(glm::dot(p, w.direction) + w.phase);
      weight *= 0.66f;
    }
    return sum;
  }

 private:
  struct Wave {
    glm::vec3 direction;
    float phase;
  };
  std::array<Wave, 6> waves_;
};

// A ball of latitudes and longitudes, moved by `place`.
Grid ball(size_t triangles, const std::function<glm::vec3(glm::vec3 direction)>& place) {
  const Cells cells = cellsFor(triangles, 1.8f);
  Grid grid(cells.rows + 1, cells.columns);
  for (size_t r = 0; r < grid.rows; ++r) {
    const float polar = kPi * (1.0f - float(r) / float(cells.rows));
    for (size_t c = 0; c < grid.columns; ++c) {
      const float angle = 2.0f * kPi * float(c) / float(cells.columns);
      grid.at(r, c) =
          place({std::sin(polar) * std::cos(angle), std::cos(polar), -std::sin(polar) * std::sin(angle)});
    }
  }
  return grid;
}

}  // namespace

Mesh makeRock(const std::string& name, size_t triangles, Random& random) {
  MeshBuilder mesh(name);
  const Paint stone = std::array{kGranite, kSandstone, kBasalt}[size_t(random.below(3))];
  const Lumps lumps(random, random.between(1.5f, 2.6f));
  const glm::vec3 size = {random.between(0.75f, 1.0f), random.between(0.5f, 1.1f),
                          random.between(0.7f, 1.0f)};
  std::array<glm::vec4, 9> cuts;
  for (glm::vec4& cut : cuts) cut = {random.direction(), random.between(0.6f, 0.85f)};
  const Grid grid = ball(triangles, [&](glm::vec3 d) {
    glm::vec3 p = d * (1.0f + 0.16f * lumps(d));
    for (const glm::vec4& cut : cuts) {
      const float over = glm::dot(p, glm::vec3(cut)) - cut.w;
      if (over > 0.0f) p -= 0.9f * over * glm::vec3(cut);
    }
    return p * size + glm::vec3(0, 0.55f * size.y, 0);
  });
  mesh.grid(grid,
            {.shading = Shading::smooth, .closed = true, .cellMaterial = [&](size_t r, size_t c) -> int {
               return r > grid.rows * 3 / 4 && lumps(grid.at(r, c) * 1.7f) > 0.05f ? kMoss : stone;
             }});
  return mesh.take();
}

Mesh makeHull(const std::string& name, size_t triangles, Random& random) {
  MeshBuilder mesh(name);
  const Paint paint = std::array{kHullRed, kHullBlue, kHullGreen, kHullCream}[size_t(random.below(4))];
  const float beam = random.between(0.30f, 0.42f), sheer = random.between(0.12f, 0.26f),
              full = random.between(1.8f, 3.2f), strakes = float(6 + random.below(5));
  auto width = [&](float s) { return beam * (1.0f - std::pow(std::abs(2.0f * s - 0.92f) / 1.08f, full)); };
  auto rail = [&](float s) { return 0.30f + sheer * (2.0f * s - 0.8f) * (2.0f * s - 0.8f); };
  // Section by section from stern to stem: port rail, keel, starboard rail; planks stand off a little.
  const Cells cells = cellsFor(triangles * 85 / 100, 0.7f);
  Grid skin(cells.rows + 1, cells.columns + 1);
  for (size_t r = 0; r < skin.rows; ++r) {
    const float s = float(r) / float(cells.rows);
    for (size_t c = 0; c < skin.columns; ++c) {
      const float t = 2.0f * float(c) / float(cells.columns) - 1.0f, up = std::abs(t);
      const float plank = 0.014f * (1.0f - (up * strakes - std::floor(up * strakes)));
      const float half = std::max(width(s), 0.012f) * std::pow(up, 0.55f) + (s < 0.97f ? plank : 0.0f);
      skin.at(r, c) = {(t < 0 ? -half : half), glm::mix(-0.14f, rail(s), std::pow(up, 1.2f)),
                       glm::mix(-1.0f, 1.0f + 0.10f * up, s)};
    }
  }
  mesh.grid(skin, {.shading = Shading::smooth, .cellMaterial = [&](size_t, size_t c) -> int {
                     const float up = std::abs(2.0f * (float(c) + 0.5f) / float(cells.columns) - 1.0f);
                     return up > 1.0f - 1.0f / strakes ? kHullCream : paint;
                   }});
  const Cells deckCells = cellsFor(triangles * 11 / 100, 0.3f);
  Grid deck(deckCells.rows + 1, deckCells.columns + 1);
  for (size_t r = 0; r < deck.rows; ++r) {
    const float s = float(r) / float(deckCells.rows);
    for (size_t c = 0; c < deck.columns; ++c) {
      const float t = 2.0f * float(c) / float(deckCells.columns) - 1.0f;
      deck.at(r, c) = {0.97f * t * std::max(width(s), 0.012f), rail(s) - 0.05f + 0.02f * (1.0f - t * t),
                       glm::mix(-0.99f, 1.06f, s)};
    }
  }
  mesh.setMaterial(kPlanks);
  mesh.grid(deck, {.shading = Shading::smooth, .flip = true});
  mesh.quad(skin.at(0, 0), skin.at(0, cells.columns / 4), skin.at(0, cells.columns * 3 / 4),
            skin.at(0, cells.columns));
  mesh.box({0, rail(0.35f) + 0.06f, -0.35f}, {0.6f * beam, 0.26f, 0.42f}, 0.9f);
  mesh.setMaterial(kSpar);
  mesh.tube({{0, 0.1f, 0.25f}, {0, random.between(1.1f, 1.7f), 0.22f}}, {0.035f, 0.022f}, 8);
  return mesh.take();
}

Mesh makeBarrel(const std::string& name, size_t triangles, Random& random) {
  MeshBuilder mesh(name);
  const Cells cells = cellsFor(triangles, 1.6f);
  const float belly = random.between(0.08f, 0.22f), height = random.between(1.3f, 1.9f);
  const float staves = float(14 + random.below(8)), hoops = float(3 + random.below(3));
  Grid side(cells.rows + 1, cells.columns);
  // The outermost rows close the ends.
  auto along = [&](size_t r) { return std::clamp((float(r) - 2.0f) / float(cells.rows - 4), 0.0f, 1.0f); };
  auto onHoop = [&](float v) {
    const float w = v * hoops - 0.5f;
    return std::abs(w - std::round(w)) < 0.14f;
  };
  for (size_t r = 0; r < side.rows; ++r) {
    const float v = along(r);
    const size_t fromEnd = std::min(r, cells.rows - r);
    const float close = fromEnd == 0 ? 0.0f : fromEnd == 1 ? 0.9f : 1.0f;
    const float sink = r + 1 >= cells.rows ? 0.05f : 0.0f;
    for (size_t c = 0; c < side.columns; ++c) {
      const float angle = 2.0f * kPi * float(c) / float(cells.columns);
      const float groove = onHoop(v) ? 0.025f : 0.016f * std::abs(std::cos(0.5f * staves * angle)) - 0.01f;
      const float radius = close * (0.6f + belly * std::sin(kPi * v) + groove);
      side.at(r, c) = {radius * std::cos(angle), height * v - sink, -radius * std::sin(angle)};
    }
  }
  mesh.grid(side, {.shading = Shading::smooth, .closed = true, .cellMaterial = [&](size_t r, size_t) -> int {
                     return onHoop(along(r)) ? kHoop : kOak;
                   }});
  return mesh.take();
}

Mesh makeHouse(const std::string& name, size_t triangles, Random& random) {
  MeshBuilder mesh(name);
  const Paint wall = std::array{kWallWhite, kWallOchre, kWallRose}[size_t(random.below(3))];
  const Paint roof = random.below(2) ? kRoofSlate : kRoofTile;
  const float halfX = random.between(0.7f, 0.95f), halfZ = random.between(0.45f, 0.65f),
              eaves = random.between(0.8f, 1.5f), ridge = eaves + random.between(0.45f, 0.8f);
  const Lumps relief(random, 9.0f);
  const Cells cells = cellsFor(triangles, 1.6f);
  const size_t wallRows = cells.rows * 55 / 100, floors = eaves > 1.15f ? 2 : 1;
  Grid shell(cells.rows + 1, cells.columns);
  for (size_t r = 0; r < shell.rows; ++r) {
    const bool onWall = r <= wallRows;
    const float v =
        onWall ? float(r) / float(wallRows) : float(r - wallRows - 1) / float(cells.rows - wallRows - 1);
    for (size_t c = 0; c < shell.columns; ++c) {
      const float angle = 2.0f * kPi * float(c) / float(cells.columns);
      auto boxy = [](float x) { return x < 0 ? -std::pow(-x, 0.16f) : std::pow(x, 0.16f); };
      const glm::vec2 plan = {boxy(std::cos(angle)), -boxy(std::sin(angle))};
      if (onWall) {
        const glm::vec3 p = {halfX * plan.x, eaves * v, halfZ * plan.y};
        const float stone = 1.0f + 0.008f * relief(p);
        shell.at(r, c) = {p.x * stone, p.y, p.z * stone};
      } else {
        // From the overhang to the ridge; courses of tiles step outward.
        const float course = v * 9.0f, step = 0.02f * (1.0f - (course - std::floor(course)));
        const float x = glm::mix(halfX + 0.12f, halfX * 0.62f, v) * plan.x,
                    z = glm::mix(halfZ + 0.12f, 0.004f, v) * plan.y;
        shell.at(r, c) = {x, glm::mix(eaves - 0.05f, ridge, v) + step, z};
      }
    }
  }
  mesh.grid(shell,
            {.shading = Shading::smooth, .closed = true, .cellMaterial = [&](size_t r, size_t c) -> int {
               if (r >= wallRows) return roof;
               const glm::vec3 p = shell.at(r, c);
               const float level = p.y / eaves * float(floors), high = level - std::floor(level);
               const float spacing = 0.42f, at = p.x / spacing - std::floor(p.x / spacing);
               const bool window = high > 0.42f && high < 0.78f && at > 0.3f && at < 0.7f;
               return window && std::abs(p.x) < halfX * 0.85f ? kWindow : wall;
             }});
  mesh.setMaterial(wall);
  mesh.box({0.4f * halfX, ridge - 0.05f, 0.1f}, {0.18f, 0.5f, 0.18f});
  return mesh.take();
}

Mesh makeTree(const std::string& name, size_t triangles, Random& random) {
  MeshBuilder mesh(name);
  mesh.setMaterial(kSpar);
  mesh.tube({{0, -0.1f, 0}, {0.03f, 0.4f, 0}, {0, 0.9f, 0.03f}}, {0.13f, 0.10f, 0.07f}, 8);
  const Lumps lumps(random, random.between(3.0f, 4.5f));
  const float tall = random.between(0.8f, 1.5f), wide = random.between(0.62f, 0.85f);
  const Grid crown = ball(triangles - std::min<size_t>(triangles, 48), [&](glm::vec3 d) {
    const glm::vec3 p = d * (1.0f + 0.22f * lumps(d));
    return glm::vec3(p.x * wide, 0.55f + tall * 0.9f + p.y * tall * 0.8f, p.z * wide);
  });
  mesh.grid(crown, {.shading = Shading::smooth, .closed = true, .cellMaterial = [&](size_t r, size_t) -> int {
                      return r < crown.rows / 3 ? kLeafDark : kLeaf;
                    }});
  return mesh.take();
}

}  // namespace harbour
