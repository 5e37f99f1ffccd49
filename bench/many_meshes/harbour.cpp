#include "harbour.h"

#include <cmath>

namespace harbour {
namespace {

using namespace meshkit;

// One step of the amphitheatre: what stands on it, where it lies.
struct Terrace {
  float y, z;  // metres; z of the row's middle
  std::vector<Shape> shapes;
  bool water;
};

// Everything sways in one clip, houses too, so that nothing is spared when it plays.
constexpr float kSwellSeconds = 4.0f;

Channel sway(int node, const glm::quat& turn, float phase) {
  return smoothRotation(node, evenTimes(kSwellSeconds, 8), [=](float t) {
    const float angle = 0.05f * std::sin(6.2831853f * t / kSwellSeconds + phase);
    return turn * glm::angleAxis(angle, glm::vec3(0, 0, 1));
  });
}

// Each row is as wide as the camera sees there, so that all of it is in the picture.
constexpr float kEyeHeight = 18.0f, kEyeZ = 32.0f, kPitch = 0.262f;  // metres, metres, radians downward
constexpr float kVerticalFov = 0.66f;                                // radians

float rowHalfWidth(const Terrace& t) {
  const float depth = (kEyeZ - t.z) * std::cos(kPitch) + (kEyeHeight - t.y) * std::sin(kPitch);
  return 0.95f * 16.0f / 9.0f * std::tan(0.5f * kVerticalFov) * depth;
}

std::vector<Terrace> terraces() {
  const Shape rock = makeRock, hull = makeHull, barrel = makeBarrel, house = makeHouse, tree = makeTree;
  std::vector<Terrace> rows = {{0.0f, 0, {rock, rock, barrel}, true},
                               {0.0f, 0, {hull}, true},
                               {0.0f, 0, {hull, rock}, true},
                               {0.0f, 0, {hull}, true},
                               {1.2f, 0, {barrel, barrel, rock}, false},
                               {1.2f, 0, {barrel, tree}, false},
                               {3.2f, 0, {house, tree}, false},
                               {5.6f, 0, {house, house, tree}, false},
                               {8.2f, 0, {house, tree}, false},
                               {11.0f, 0, {house, house, rock}, false},
                               {14.0f, 0, {tree, rock, house}, false}};
  float z = 4.0f;
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].z = z;
    z -= 3.4f + 0.42f * float(i);
  }
  return rows;
}

Mesh makeGround(const std::vector<Terrace>& rows) {
  MeshBuilder mesh("Ground");
  for (size_t i = 0; i < rows.size(); ++i) {
    const float near = i == 0 ? 16.0f : 0.5f * (rows[i].z + rows[i - 1].z);
    const float far = i + 1 == rows.size() ? rows[i].z - 9.0f : 0.5f * (rows[i].z + rows[i + 1].z);
    const float y = rows[i].y, half = 90.0f;
    mesh.setMaterial(rows[i].water ? kWater : kQuay);
    mesh.quad({-half, y, near}, {half, y, near}, {half, y, far}, {-half, y, far});
    if (i > 0 && rows[i - 1].y < y) {
      const float below = rows[i - 1].y - 0.5f;
      mesh.setMaterial(kQuay);
      mesh.quad({-half, below, near}, {half, below, near}, {half, y, near}, {-half, y, near});
    }
  }
  return mesh.take();
}

}  // namespace

std::vector<Material> palette() {
  return {{"Granite", "#B3A594", "#63688A"},
          {"Sandstone", "#CDAE84", "#7B6C80"},
          {"Basalt", "#7E7C7A", "#454C6C"},
          {"Moss", "#A3A77A", "#566C82"},
          {"HullRed", "#A9503E", "#5E2E48", true},
          {"HullBlue", "#4F7FA0", "#2A3F6B", true},
          {"HullGreen", "#5E8F72", "#2F5468", true},
          {"HullCream", "#EBD9B4", "#868CA8", true},
          {"Planks", "#D9AE74", "#7C6272"},
          {"Spar", "#B8743F", "#5A3B48"},
          {"Oak", "#96684A", "#4A3A50"},
          {"Hoop", "#5A5C66", "#34344C"},
          {"WallWhite", "#F3E9D8", "#9DA6C0"},
          {"WallOchre", "#DDB878", "#85708A"},
          {"WallRose", "#D9A793", "#84637F"},
          {"RoofSlate", "#7F8C96", "#4A5578"},
          {"RoofTile", "#B9705F", "#6E4A66"},
          {"Window", "#4C6172", "#2F3C5C"},
          {"Leaf", "#9DAE6A", "#4B6E76"},
          {"LeafDark", "#7C9660", "#3C5C6C"},
          {"Water", "#3F8F96", "#1F4A63"},
          {"Quay", "#C2B29A", "#6E6F8E"}};
}

Document makeHarbour(size_t triangles, size_t meshes) {
  Document document;
  document.materials = palette();
  const int root = document.addNode({"Harbour"});
  const std::vector<Terrace> rows = terraces();
  document.addMesh(makeGround(rows), root);
  Random random(2024);
  Clip swell{"Swell", {}};

  // Rows share the meshes by their width, and every mesh takes its part of the triangles that are still left,
  // so that rounding does not add up.
  float allWidths = 0.0f;
  for (const Terrace& row : rows) allWidths += std::sqrt(rowHalfWidth(row));
  float owed = 0.0f;
  for (size_t i = 0, made = 1; i < rows.size(); ++i) {
    const Terrace& row = rows[i];
    owed += std::sqrt(rowHalfWidth(row)) / allWidths * float(meshes - 1);
    const size_t last = i + 1 == rows.size() ? meshes : std::min(size_t(std::lround(owed)) + 1, meshes);
    const size_t count = last - made;
    const float pitch = 2.0f * rowHalfWidth(row) / float(std::max<size_t>(count, 1));
    for (size_t k = 0; k < count; ++k, ++made) {
      const size_t done = document.triangleCount();
      const size_t share = (triangles - std::min(done, triangles)) / (meshes - made);
      // Some are finer than others, as in real scenes.
      const size_t wanted = size_t(float(share) * (made + 1 == meshes ? 1.0f : random.between(0.6f, 1.4f)));
      const Shape& shape = row.shapes[size_t(random.below(int(row.shapes.size())))];
      Mesh mesh = shape("Mesh" + std::to_string(made), wanted, random);
      const float x = -rowHalfWidth(row) + (float(k) + 0.5f) * pitch;
      const glm::vec3 at = {x + pitch * random.between(-0.08f, 0.08f), row.y,
                            row.z + random.between(-0.5f, 0.5f)};
      const glm::quat turn = glm::angleAxis(random.between(-0.5f, 0.5f), glm::vec3(0, 1, 0));
      const int node = document.addMesh(std::move(mesh), root, at, turn);
      document.nodes[size_t(node)].scale =
          glm::vec3(std::min(0.56f * pitch, 2.2f) * random.between(0.85f, 1.1f));
      swell.channels.push_back(sway(node, turn, 0.7f * float(made)));
    }
  }

  document.clips.push_back(std::move(swell));
  document.addSun({-0.75f, 0.55f, 0.55f}, {1.0f, 0.9f, 0.75f}, 3.0f);
  document.addCamera({"Bench", kVerticalFov}, {0, kEyeHeight, kEyeZ},
                     {0, kEyeHeight - std::sin(kPitch), kEyeZ - std::cos(kPitch)});
  return document;
}

}  // namespace harbour
