// A shell of earth and plaster with a thickness, closed but for its openings, so that the sun comes in
// nowhere else.
#include "parts.h"

namespace henry {
namespace {

using namespace meshkit;

struct Side {
  const Shell& shell;
  float outwards;
  std::vector<float> heights;

  glm::vec3 at(size_t row, int column) const {
    const float y = heights[row];
    return shell.center + shell.radiusAt(y, outwards) * towards(float(column) * kColumnDegrees) +
           glm::vec3(0, y, 0);
  }
};

// The walls' rows are of one height on both sides; the vault's go up to each side's own apex.
constexpr float kVaultFrom = 2.42f;
std::vector<float> wallHeights(const Shell& shell) {
  std::vector<float> heights = {-0.05f, 0.25f, 0.5f, kDado};
  for (const Opening& o : shell.openings) {
    heights.push_back(o.top);
    if (o.bottom < kDado) continue;
    for (int i = 0; i <= 10; ++i) heights.push_back(glm::mix(o.bottom, o.top, float(i) / 10.0f));
  }
  for (float y : {1.0f, 1.4f, 1.7f}) heights.push_back(y);
  std::sort(heights.begin(), heights.end());
  const auto last =
      std::unique(heights.begin(), heights.end(), [](float a, float b) { return b - a < 0.03f; });
  heights.erase(last, heights.end());
  return heights;
}

Side makeSide(const Shell& shell, const std::vector<float>& walls, float outwards) {
  Side side{shell, outwards, walls};
  const float from = walls.back(), to = shell.apex + outwards;
  constexpr int kVaultRows = 10;
  for (int i = 1; i <= kVaultRows; ++i)
    side.heights.push_back(glm::mix(from, to, std::sin(0.5f * kPi * float(i) / float(kVaultRows))));
  return side;
}

size_t rowAt(const Side& side, float height) {
  size_t best = 0;
  for (size_t r = 0; r < side.heights.size(); ++r)
    if (std::abs(side.heights[r] - height) < std::abs(side.heights[best] - height)) best = r;
  return best;
}

// The rim of an opening, one point for each mesh point around it, and those points.
struct Rim {
  std::vector<glm::vec3> around, edge;
};

Rim makeRim(const Side& side, const Opening& opening) {
  const size_t low = rowAt(side, opening.bottom), high = rowAt(side, opening.top);
  const int left = opening.column - opening.halfColumns, right = opening.column + opening.halfColumns;
  std::vector<std::pair<size_t, int>> loop;
  for (int c = left; c < right; ++c) loop.push_back({low, c});
  for (size_t r = low; r < high; ++r) loop.push_back({r, right});
  for (int c = right; c > left; --c) loop.push_back({high, c});
  for (size_t r = high; r > low; --r) loop.push_back({r, left});

  Rim rim;
  for (const auto& [row, column] : loop) {
    rim.around.push_back(side.at(row, column));
    const float y = side.heights[row], turn = glm::radians(float(column - opening.column) * kColumnDegrees);
    const glm::vec2 from = {0.0f, opening.middle},
                    to = {side.shell.radiusAt(y, side.outwards) * std::sin(turn), y};
    float inside = 0.0f, outside = 1.0f;
    for (int i = 0; i < 24; ++i) {
      const float t = 0.5f * (inside + outside);
      const glm::vec2 p = glm::mix(from, to, t);
      (opening.inside(p.x, p.y) ? inside : outside) = t;
    }
    const glm::vec2 p = glm::mix(from, to, outside);
    const float radius = side.shell.radiusAt(p.y, side.outwards);
    const float bearing = opening.bearing() + glm::degrees(std::asin(p.x / radius));
    rim.edge.push_back(side.shell.center + radius * towards(bearing) + glm::vec3(0, p.y, 0));
  }
  return rim;
}

Grid band(const std::vector<glm::vec3>& from, const std::vector<glm::vec3>& to) {
  Grid grid(2, from.size());
  for (size_t c = 0; c < from.size(); ++c) {
    grid.at(0, c) = from[c];
    grid.at(1, c) = to[c];
  }
  return grid;
}

}  // namespace

Mesh makeShell(const std::string& name, const Shell& shell, const ShellPaint& paint) {
  MeshBuilder mesh(name);
  const std::vector<float> walls = wallHeights(shell);
  const Side inner = makeSide(shell, walls, 0.0f), outer = makeSide(shell, walls, kThickness);

  auto cellPaint = [&](size_t row, size_t column) -> int {
    const float y = 0.5f * (inner.heights[row] + inner.heights[row + 1]);
    for (const Opening& o : shell.openings) {
      const int across = int(column) - o.column;
      if (y > o.bottom && y < o.top && across >= -o.halfColumns && across < o.halfColumns) return -1;
    }
    if (y < kDado) return paint.wainscot;
    return y < kVaultFrom ? paint.wall : paint.ceiling;
  };
  for (const Side* side : {&inner, &outer}) {
    Grid grid(side->heights.size(), size_t(kColumns));
    for (size_t r = 0; r < grid.rows; ++r)
      for (int c = 0; c < kColumns; ++c) grid.at(r, size_t(c)) = side->at(r, c);
    mesh.grid(
        grid,
        {.shading = Shading::smooth, .closed = true, .flip = side == &outer, .cellMaterial = cellPaint});
  }
  for (const Opening& o : shell.openings) {
    const Rim in = makeRim(inner, o), out = makeRim(outer, o);
    // The wall between mesh and rim; around a passage the wainscot goes on.
    auto wallPaint = [&](size_t, size_t column) -> int {
      const float y = 0.5f * (in.around[column].y + in.around[(column + 1) % in.around.size()].y);
      return y < kDado ? paint.wainscot : paint.wall;
    };
    mesh.grid(band(in.around, in.edge),
              {.shading = Shading::smooth, .closed = true, .cellMaterial = wallPaint});
    mesh.setMaterial(paint.wall);
    mesh.grid(band(out.around, out.edge), {.shading = Shading::smooth, .closed = true, .flip = true});
    mesh.setMaterial(paint.reveal);
    mesh.grid(band(in.edge, out.edge), {.shading = Shading::smooth, .closed = true});
  }
  return mesh.take();
}

}  // namespace henry
