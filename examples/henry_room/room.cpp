// The room itself: shell, ribs, rails, floor, windows and their light, the arch's trim and the kitchen door.
#include "mesh_kit/random.h"
#include "parts.h"

namespace henry {
namespace {

using namespace meshkit;

// Roots that hold the vault: from the floor to the crown, between the openings.
Mesh makeRibs() {
  MeshBuilder mesh("Ribs");
  mesh.setMaterial(kBeam);
  for (float column : {55.5f, 62.0f, 69.6f, 84.4f, 93.5f, 4.0f, 14.0f, 24.0f, 34.0f, 44.0f}) {
    std::vector<glm::vec3> path;
    for (int i = 0; i <= 14; ++i) {
      // Even steps of the angle from the middle follow wall and vault alike.
      const float t = float(i) / 14.0f;
      const float y = i == 0 ? 0.0f : glm::mix(0.0f, room().apex - 0.05f, std::sin(0.5f * kPi * t));
      path.push_back(room().at(column * kColumnDegrees, y, 0.015f));
    }
    path.push_back(0.2f * towards(column * kColumnDegrees) + glm::vec3(0, room().apex - 0.04f, 0));
    const glm::vec3 along = glm::normalize(glm::cross(towards(column * kColumnDegrees), {0, 1, 0}));
    for (size_t i = 0; i + 1 < path.size(); ++i) {
      // A root is thicker at its foot.
      const float width = glm::mix(0.15f, 0.07f, float(i) / 14.0f);
      mesh.bar({path[i], path[i + 1] + 0.02f * glm::normalize(path[i + 1] - path[i])}, 0.09f, width, along);
    }
  }
  mesh.lathe({{0.0f, room().apex - 0.14f}, {0.24f, room().apex - 0.12f}, {0.27f, room().apex + 0.02f}}, 20);
  return mesh.take();
}

// A rail that follows the wall between two columns of the mesh.
void addRail(MeshBuilder& mesh, float from, float to, float height, float deep, float high) {
  const int pieces = std::max(int(std::ceil(to - from)), 2);
  Grid rail(5, size_t(pieces) + 1);
  for (int c = 0; c <= pieces; ++c) {
    const float bearing = glm::mix(from, to, float(c) / float(pieces)) * kColumnDegrees;
    const float in[] = {-0.03f, deep, deep, -0.03f, -0.03f};
    const float up[] = {-0.5f, -0.5f, 0.5f, 0.5f, -0.5f};
    for (size_t r = 0; r < 5; ++r) {
      const glm::vec3 wall = room().at(bearing, height, in[r]);
      rail.at(r, size_t(c)) = wall + glm::vec3(0, up[r] * high, 0);
    }
  }
  mesh.grid(rail);
}

Mesh makeRails() {
  MeshBuilder mesh("Rails");
  mesh.setMaterial(kBeam);
  const float arch = float(kArchColumn), door = float(kDoorColumn);
  const std::pair<float, float> spans[] = {{arch + 3.9f, door - 2.6f}, {door + 2.6f, 100.0f + arch - 3.9f}};
  for (const auto& [from, to] : spans) {
    addRail(mesh, from, to, kDado, 0.035f, 0.07f);
    addRail(mesh, from, to, 0.06f, 0.03f, 0.13f);
  }
  return mesh.take();
}

// A trim around a passage, on the wall.
void addTrim(MeshBuilder& mesh, const Shell& shell, int column, float halfWidth, float height, float width) {
  const float bearing = float(column) * kColumnDegrees;
  std::vector<glm::vec2> outline = {{-halfWidth, 0.0f}, {-halfWidth, 0.5f}};
  for (int i = 0; i <= 16; ++i) {
    const float a = kPi * (1.0f - float(i) / 16.0f);
    outline.push_back(glm::vec2(0, height - halfWidth) + halfWidth * glm::vec2(std::cos(a), std::sin(a)));
  }
  outline.push_back({halfWidth, 0.5f});
  outline.push_back({halfWidth, 0.0f});
  Grid trim(4, outline.size());
  for (size_t i = 0; i < outline.size(); ++i) {
    const glm::vec2 before = outline[i == 0 ? 0 : i - 1],
                    after = outline[std::min(i + 1, outline.size() - 1)];
    const glm::vec2 along = glm::normalize(after - before), away = {-along.y, along.x};
    for (size_t r = 0; r < 4; ++r) {
      const glm::vec2 p = outline[i] + away * (r == 0 || r == 1 ? width : -0.012f);
      const float radius = shell.radiusAt(p.y);
      const float place = bearing + glm::degrees(std::asin(p.x / radius));
      trim.at(r, i) = shell.center + (radius - (r == 0 || r == 3 ? -0.05f : 0.045f)) * towards(place) +
                      glm::vec3(0, p.y, 0);
    }
  }
  mesh.grid(trim, {.flip = true});
}

}  // namespace

void addBall(MeshBuilder& mesh, glm::vec3 center, glm::vec3 halfSize, int levels) {
  std::vector<glm::vec3> points;
  std::vector<glm::uvec3> faces;
  icosphere(levels, points, faces);
  for (glm::vec3& p : points) p = center + p * halfSize;
  mesh.indexed(points, faces, Shading::smooth);
}

void addWindow(Document& document, int parent, const std::string& name, const Shell& shell,
               const Opening& opening, const Oval& oval) {
  MeshBuilder mesh(name);
  mesh.setMaterial(kFrame);
  // The ring in the hole, then the cross: bars broad enough to be drawn by the sun.
  constexpr int kSides = 40;
  Grid ring(5, kSides);
  for (int c = 0; c < kSides; ++c) {
    const float a = 2.0f * kPi * float(c) / float(kSides);
    const float grow[] = {0.03f, -0.04f, -0.04f, 0.03f, 0.03f};
    const float z[] = {0.05f, 0.05f, -0.05f, -0.05f, 0.05f};
    for (size_t r = 0; r < 5; ++r)
      ring.at(r, size_t(c)) = {(oval.halfWidth + grow[r]) * std::cos(a),
                               (oval.halfHeight + grow[r]) * std::sin(a), z[r]};
  }
  mesh.grid(ring, {.closed = true, .flip = true});
  mesh.box({0, 0, 0}, {0.06f, 2.0f * oval.halfHeight - 0.04f, 0.05f});
  mesh.box({0, 0, 0}, {2.0f * oval.halfWidth - 0.04f, 0.05f, 0.04f});
  // A hand behind the wall at the sill; the vault leans over it.
  const float middle = shell.radiusAt(oval.height - oval.halfHeight) + 0.10f;
  const glm::vec3 place = shell.center + middle * towards(opening.bearing()) + glm::vec3(0, oval.height, 0);
  document.addMesh(mesh.take(), parent, place, onWall(opening.bearing()));
}

void addShafts(Document& document, int parent) {
  constexpr float kBar = 0.03f, kOutside = 0.3f,
                  kBelowFloor = 0.3f;  // metres; the bar's half width, the ends
  const float halfPane = 0.5f * (kWindow.halfWidth - kBar);
  // The pane's own height at its middle, which is that of an ellipse halfway out.
  const float halfHeight = 0.87f * kWindow.halfHeight;
  int number = 1;
  for (int column : kWindowColumns) {
    const float bearing = float(column) * kColumnDegrees;
    const glm::vec3 across = onWall(bearing) * glm::vec3(1, 0, 0);
    const float slant = std::cos(glm::radians(bearing - kSunBearing));
    for (float side : {-1.0f, 1.0f}) {
      const glm::vec3 pane = room().at(bearing, kWindow.height) + side * (halfPane + kBar) * across;
      const float inside = pane.y / towardsSun().y + kBelowFloor;
      Node shaft{"Shaft " + std::to_string(number++), parent, pane, lookAlong(-towardsSun())};
      shaft.translation -= 0.5f * (inside - kOutside) * towardsSun();
      shaft.scale = {halfPane * slant, halfHeight * std::cos(glm::radians(kSunElevation)),
                     0.5f * (inside + kOutside)};
      document.addNode(std::move(shaft));
    }
  }
}

void addFloor(Document& document, int parent) {
  MeshBuilder mesh("Floor");
  Random random(3);
  // Planks run towards the parlour, from before the near wall to behind the far one.
  constexpr float kPlank = 0.36f;
  for (int i = -11; i <= 11; ++i) {
    const float x = float(i) * kPlank;
    float z = 4.0f - random.between(0.0f, 2.0f);
    float front = 4.2f;
    while (front > -3.5f) {
      z = std::max(z, -3.5f);
      mesh.setMaterial(random.unit() < 0.35f ? kFloorDark : kFloor);
      mesh.box({x, -0.02f, 0.5f * (front + z)}, {kPlank, 0.04f, front - z});
      front = z;
      z -= random.between(1.6f, 2.6f);
    }
  }
  mesh.setMaterial(kParlourFloor);
  mesh.box({0.7f, -0.02f, -5.9f}, {6.0f, 0.04f, 4.8f});
  // Under the floor: nothing shines up from below.
  mesh.setMaterial(kFloorDark);
  mesh.box({0.3f, -0.12f, -2.0f}, {9.0f, 0.12f, 13.0f});
  document.addMesh(mesh.take(), parent);
}

void addRoom(Document& document, int parent) {
  document.addMesh(makeShell("Shell", room(), {kWall, kWainscot, kCeiling, kReveal}), parent);
  document.addMesh(makeRibs(), parent);
  document.addMesh(makeRails(), parent);
  MeshBuilder trim("Trim");
  trim.setMaterial(kFrame);
  addTrim(trim, room(), kArchColumn, kArchHalfWidth, kArchHeight, 0.11f);
  addTrim(trim, room(), kDoorColumn, kDoorHalfWidth, kDoorHeight, 0.09f);
  document.addMesh(trim.take(), parent);
  int number = 1;
  for (const Opening& opening : room().openings)
    if (number <= int(std::size(kWindowColumns)))
      addWindow(document, parent, "Window " + std::to_string(number++), room(), opening, kWindow);
}

void addKitchenDoor(Document& document, int parent) {
  MeshBuilder mesh("Kitchen door");
  // The leaf fills the hole: boards with a round head, and two bands across.
  auto outline = [](float halfWidth, float low, float height) {
    std::vector<glm::vec2> points = {{-halfWidth, low}, {halfWidth, low}};
    for (int i = 0; i <= 14; ++i) {
      const float a = kPi * float(i) / 14.0f;
      points.push_back(glm::vec2(0, height - halfWidth) + halfWidth * glm::vec2(std::cos(a), std::sin(a)));
    }
    return points;
  };
  mesh.setMaterial(kDoor);
  mesh.extrude(outline(kDoorHalfWidth + 0.02f, 0.0f, kDoorHeight + 0.02f), -0.06f, 0.0f);
  mesh.setMaterial(kDoorPanel);
  for (float x : {-0.215f, 0.215f}) mesh.box({x, 0.76f, 0.004f}, {0.22f, 1.40f, 0.02f});
  mesh.setMaterial(kBeam);
  for (float y : {0.35f, 1.1f}) mesh.box({-0.06f, y, 0.02f}, {0.76f, 0.09f, 0.03f});
  mesh.setMaterial(kBrass);
  addBall(mesh, {0.33f, 0.78f, 0.06f}, glm::vec3(0.045f), 2);
  const float bearing = float(kDoorColumn) * kColumnDegrees;
  document.addMesh(mesh.take(), parent, (room().radius + 0.03f) * towards(bearing), onWall(bearing));
}

}  // namespace henry
