// still_life OUT.glb: writes a table by a window: a jug with poppies, a bowl of fruit, a bottle, a cut lemon
// on a cloth. Round forms, few colours and much white, for washes and for lines.
#include <cmath>

#include "mesh_kit/glb_writer.h"
#include "mesh_kit/mesh_builder.h"

namespace {

using namespace meshkit;

enum Material {
  kCloth,
  kBorder,
  kEnamel,
  kRim,
  kBowl,
  kApple,
  kPear,
  kLemon,
  kFlesh,
  kBottle,
  kLabel,
  kCork,
  kStem,
  kPoppy,
  kHeart,
  kLeaf
};

std::vector<meshkit::Material> palette() {
  return {{"Cloth", "#F4EFE3", "#B7BBD2", true}, {"Border", "#6E86B8", "#4A5791", true},
          {"Enamel", "#EDF0EC", "#A3B2C6"},      {"Rim", "#3E5C94", "#2C3A66"},
          {"Bowl", "#5E93A3", "#37567A"},        {"Apple", "#CC4A36", "#7E2E44"},
          {"Pear", "#C9B94F", "#7F8450"},        {"Lemon", "#F0CB3E", "#B58A46"},
          {"Flesh", "#F7E7A0", "#C9B478"},       {"Bottle", "#3F7A5C", "#284A52"},
          {"Label", "#EFE3C6", "#B3A6A8"},       {"Cork", "#B98E5E", "#7A5B58"},
          {"Stem", "#6F8F4C", "#45605A"},        {"Poppy", "#DD5A33", "#9C3442", true},
          {"Heart", "#2E2A33", "#221E2A"},       {"Leaf", "#7FA05A", "#4B6E62", true}};
}

// A cloth over a table: flat on top, in folds where it hangs down; its border is of another colour.
Mesh makeCloth() {
  MeshBuilder mesh("Cloth");
  constexpr int kAlong = 72, kAcross = 56;
  constexpr float kHalfWidth = 0.78f, kHalfDepth = 0.5f, kHang = 0.26f;
  Grid grid(kAcross + 1, kAlong + 1);
  for (int r = 0; r <= kAcross; ++r)
    for (int c = 0; c <= kAlong; ++c) {
      const float s = (2.0f * float(c) / kAlong - 1) * (kHalfWidth + kHang),
                  t = (2.0f * float(r) / kAcross - 1) * (kHalfDepth + kHang);
      const float overX = std::max(std::abs(s) - kHalfWidth, 0.0f),
                  overZ = std::max(std::abs(t) - kHalfDepth, 0.0f);
      const float down = std::max(overX, overZ);
      float x = glm::clamp(s, -kHalfWidth, kHalfWidth), z = glm::clamp(t, -kHalfDepth, kHalfDepth);
      // Folds grow downwards, and lean out.
      const float fold = 0.16f * down * (std::sin(19 * s + 0.6f) + 0.6f * std::sin(31 * t + 9 * s));
      if (overZ > 0) z += std::copysign(0.02f + 0.1f * overZ + fold, t);
      if (overX > 0) x += std::copysign(0.02f + 0.1f * overX + fold, s);
      const float ripple = 0.004f * std::sin(7 * s + 3 * t) * std::sin(5 * t - 2 * s);
      grid.at(size_t(r), size_t(c)) = {x, -down + ripple, z};
    }
  mesh.grid(grid, {.shading = Shading::smooth, .flip = true, .cellMaterial = [&](size_t r, size_t c) {
                     const size_t side = std::min(std::min(r, kAcross - 1 - r), std::min(c, kAlong - 1 - c));
                     return side == 12 || side == 14 ? kBorder : kCloth;
                   }});
  return mesh.take();
}

void handle(MeshBuilder& mesh, const std::vector<glm::vec3>& points, float radius) {
  const std::vector<glm::vec3> path = smoothCurve(points, 6);
  mesh.tube(path, std::vector<float>(path.size(), radius), 10);
}

Mesh makeJug() {
  MeshBuilder mesh("Jug");
  mesh.setMaterial(kEnamel);
  mesh.lathe({{0.0f, 0.0f},
              {0.085f, 0.0f},
              {0.098f, 0.012f},
              {0.112f, 0.06f},
              {0.115f, 0.1f},
              {0.104f, 0.16f},
              {0.08f, 0.21f},
              {0.068f, 0.245f},
              {0.07f, 0.275f},
              {0.082f, 0.3f}},
             40, Shading::smooth);
  mesh.lathe({{0.074f, 0.3f}, {0.062f, 0.27f}, {0.06f, 0.24f}, {0.0f, 0.22f}}, 40, Shading::smooth);
  handle(mesh,
         {{0.075f, 0.27f, 0}, {0.13f, 0.28f, 0}, {0.165f, 0.22f, 0}, {0.15f, 0.14f, 0}, {0.105f, 0.1f, 0}},
         0.011f);
  mesh.setMaterial(kRim);
  mesh.lathe({{0.078f, 0.296f}, {0.085f, 0.298f}, {0.087f, 0.305f}, {0.08f, 0.309f}, {0.073f, 0.303f}}, 40,
             Shading::smooth);
  return mesh.take();
}

// A flower at the origin that looks up: four bowls of petals, crumpled.
void petals(MeshBuilder& mesh, float radius, float turn) {
  mesh.setMaterial(kPoppy);
  for (int p = 0; p < 4; ++p) {
    Grid petal(6, 9);
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 9; ++c) {
        const float out = float(r) / 5, a = turn + kPi / 2 * float(p) + (float(c) / 8 - 0.5f) * 2.1f;
        const float crumple = 0.12f * out * std::sin(5 * a + 2 * float(p));
        const float reach = radius * (0.12f + 0.88f * out) * (1 - 0.16f * std::pow(float(c) / 4 - 1, 2.0f));
        petal.at(size_t(r), size_t(c)) = {reach * std::cos(a),
                                          radius * (0.75f * out * out + crumple - 0.05f * float(p % 2)),
                                          reach * std::sin(a)};
      }
    mesh.grid(petal, {.shading = Shading::smooth, .flip = true});
  }
  mesh.setMaterial(kHeart);
  mesh.lathe({{0.0f, 0.0f},
              {0.16f * radius, 0.1f * radius},
              {0.18f * radius, 0.3f * radius},
              {0.0f, 0.42f * radius}},
             12, Shading::smooth);
}

void leaf(MeshBuilder& mesh, const glm::vec3& from, const glm::vec3& tip, float width) {
  mesh.setMaterial(kLeaf);
  Grid blade(9, 3);
  const glm::vec3 along = tip - from, side = glm::normalize(glm::cross(along, glm::vec3(0, 1, 0.2f)));
  for (int r = 0; r < 9; ++r) {
    const float t = float(r) / 8, wide = width * std::sin(kPi * std::pow(t, 0.8f)) + 0.0006f;
    const glm::vec3 middle = from + t * along + glm::vec3(0, 0.25f * glm::length(along) * t * (1 - t), 0);
    for (int c = 0; c < 3; ++c)
      blade.at(size_t(r), size_t(c)) =
          middle + side * wide * float(c - 1) + glm::vec3(0, c == 1 ? 0 : 0.35f * wide, 0);
  }
  mesh.grid(blade, {.shading = Shading::smooth});
}

// From the jug's mouth, at the origin.
Mesh makeFlowers() {
  MeshBuilder mesh("Flowers");
  struct Flower {
    glm::vec3 head, look;
    float radius;
  };
  const Flower flowers[] = {{{-0.12f, 0.2f, 0.06f}, {-0.5f, 0.5f, 0.8f}, 0.075f},
                            {{0.05f, 0.27f, 0.02f}, {0.2f, 0.8f, 0.7f}, 0.07f},
                            {{0.15f, 0.15f, 0.05f}, {0.7f, 0.4f, 0.7f}, 0.062f},
                            {{-0.03f, 0.35f, -0.05f}, {-0.2f, 0.9f, 0.3f}, 0.052f},
                            {{-0.19f, 0.09f, -0.02f}, {-0.9f, 0.2f, 0.4f}, 0.05f}};
  for (size_t i = 0; i < std::size(flowers); ++i) {
    const Flower& flower = flowers[i];
    const std::vector<glm::vec3> stem = smoothCurve({{0.02f * flower.head.x, -0.1f, 0},
                                                     {0.25f * flower.head.x, 0.03f, 0.3f * flower.head.z},
                                                     0.75f * flower.head,
                                                     flower.head},
                                                    5);
    mesh.setMaterial(kStem);
    mesh.setTransform(glm::mat4(1.0f));
    mesh.tube(stem, std::vector<float>(stem.size(), 0.0038f), 7);
    const glm::vec3 up = glm::normalize(flower.look),
                    right = glm::normalize(glm::cross(up, glm::vec3(0.3f, 0.1f, 1)));
    mesh.setTransform(glm::mat4(glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(glm::cross(right, up), 0),
                                glm::vec4(flower.head, 1)));
    petals(mesh, flower.radius, float(i));
  }
  mesh.setTransform(glm::mat4(1.0f));
  leaf(mesh, {0.02f, 0.0f, 0.03f}, {0.2f, 0.03f, 0.1f}, 0.024f);
  leaf(mesh, {-0.02f, 0.0f, 0.03f}, {-0.17f, -0.01f, 0.12f}, 0.022f);
  leaf(mesh, {0.0f, 0.02f, 0.0f}, {0.12f, 0.2f, -0.06f}, 0.02f);
  leaf(mesh, {-0.02f, 0.02f, 0.0f}, {-0.13f, 0.26f, -0.02f}, 0.018f);
  return mesh.take();
}

// Standing at the origin; a dent for the stem at its top.
Mesh makeFruit(const char* name, int material, const std::vector<glm::vec2>& profile, float stemFrom,
               float stemTo) {
  MeshBuilder mesh(name);
  mesh.setMaterial(material);
  mesh.lathe(profile, 28, Shading::smooth);
  mesh.setMaterial(kStem);
  mesh.tube(
      smoothCurve({{0, stemFrom, 0}, {0.003f, 0.5f * (stemFrom + stemTo), 0}, {0.012f, stemTo, 0.004f}}, 4),
      std::vector<float>(9, 0.0032f), 6);
  return mesh.take();
}

Mesh makeApple() {
  return makeFruit("Apple", kApple,
                   {{0.0f, 0.006f},
                    {0.018f, 0.0f},
                    {0.034f, 0.012f},
                    {0.043f, 0.034f},
                    {0.045f, 0.052f},
                    {0.038f, 0.072f},
                    {0.022f, 0.082f},
                    {0.009f, 0.078f},
                    {0.0f, 0.07f}},
                   0.07f, 0.102f);
}
Mesh makePear() {
  return makeFruit("Pear", kPear,
                   {{0.0f, 0.004f},
                    {0.02f, 0.0f},
                    {0.038f, 0.014f},
                    {0.045f, 0.038f},
                    {0.04f, 0.062f},
                    {0.027f, 0.085f},
                    {0.02f, 0.104f},
                    {0.014f, 0.117f},
                    {0.0f, 0.121f}},
                   0.118f, 0.148f);
}

Mesh makeLemon() {
  MeshBuilder mesh("Lemon");
  mesh.setMaterial(kLemon);
  mesh.lathe({{0.0f, -0.062f},
              {0.007f, -0.058f},
              {0.012f, -0.05f},
              {0.028f, -0.036f},
              {0.036f, -0.014f},
              {0.037f, 0.006f},
              {0.03f, 0.03f},
              {0.014f, 0.046f},
              {0.008f, 0.053f},
              {0.0f, 0.056f}},
             26, Shading::smooth);
  return mesh.take();
}
// Half of one, cut at y = 0, which looks up.
Mesh makeCutLemon() {
  MeshBuilder mesh("Cut lemon");
  mesh.setMaterial(kLemon);
  mesh.lathe({{0.0f, -0.058f},
              {0.007f, -0.054f},
              {0.012f, -0.046f},
              {0.028f, -0.034f},
              {0.037f, -0.01f},
              {0.037f, 0.0f},
              {0.033f, 0.0f}},
             26, Shading::smooth);
  mesh.setMaterial(kCloth);
  mesh.lathe({{0.033f, 0.0f}, {0.03f, 0.0005f}, {0.0f, 0.0005f}}, 26);
  mesh.setMaterial(kFlesh);
  for (int i = 0; i < 8; ++i) {
    const float a = 2 * kPi * float(i) / 8, b = a + 2 * kPi / 8;
    const auto at = [](float angle, float r) {
      return glm::vec3(r * std::cos(angle), 0.0016f, r * std::sin(angle));
    };
    const glm::vec3 segment[] = {at(0.5f * (a + b), 0.004f), at(b - 0.12f, 0.024f), at(b - 0.16f, 0.028f),
                                 at(a + 0.16f, 0.028f), at(a + 0.12f, 0.024f)};
    mesh.polygon(segment);
  }
  return mesh.take();
}

Mesh makeBowl() {
  MeshBuilder mesh("Bowl");
  mesh.setMaterial(kBowl);
  mesh.lathe({{0.0f, 0.0f}, {0.06f, 0.0f}, {0.062f, 0.012f}, {0.1f, 0.03f}, {0.135f, 0.06f}, {0.15f, 0.092f}},
             44, Shading::smooth);
  mesh.setMaterial(kEnamel);
  mesh.lathe({{0.15f, 0.092f}, {0.144f, 0.094f}, {0.128f, 0.064f}, {0.095f, 0.038f}, {0.0f, 0.026f}}, 44,
             Shading::smooth);
  return mesh.take();
}

Mesh makeBottle() {
  MeshBuilder mesh("Bottle");
  mesh.setMaterial(kBottle);
  mesh.lathe({{0.0f, 0.0f},
              {0.046f, 0.0f},
              {0.052f, 0.008f},
              {0.052f, 0.21f},
              {0.049f, 0.235f},
              {0.034f, 0.262f},
              {0.021f, 0.285f},
              {0.018f, 0.31f},
              {0.018f, 0.36f},
              {0.022f, 0.362f},
              {0.022f, 0.378f},
              {0.016f, 0.38f}},
             36, Shading::smooth);
  mesh.setMaterial(kLabel);
  mesh.lathe({{0.0528f, 0.07f}, {0.0528f, 0.17f}}, 36, Shading::smooth);
  mesh.setMaterial(kCork);
  mesh.lathe({{0.0f, 0.37f}, {0.0145f, 0.372f}, {0.0155f, 0.402f}, {0.0f, 0.404f}}, 20, Shading::smooth);
  return mesh.take();
}

Document makeScene() {
  Document document;
  document.materials = palette();
  const int table = document.addNode({"Table", -1, {0, 0.74f, 0}});
  document.addMesh(makeCloth(), table);
  const glm::vec3 jug(-0.2f, 0.003f, -0.12f);
  document.addMesh(makeJug(), table, jug, glm::angleAxis(-0.5f, glm::vec3(0, 1, 0)));
  document.addMesh(makeFlowers(), table, jug + glm::vec3(0, 0.3f, 0));
  document.addMesh(makeBottle(), table, {0.1f, 0.003f, -0.22f}, glm::angleAxis(0.3f, glm::vec3(0, 1, 0)));
  const glm::vec3 bowl(0.27f, 0.003f, 0.02f);
  document.addMesh(makeBowl(), table, bowl);
  const auto turned = [](float angle, const glm::vec3& axis) {
    return glm::angleAxis(angle, glm::normalize(axis));
  };
  document.addMesh(makeApple(), table, bowl + glm::vec3(-0.055f, 0.043f, 0.03f), turned(0.25f, {1, 0, 0.4f}));
  document.addMesh(makeApple(), table, bowl + glm::vec3(0.06f, 0.045f, 0.02f), turned(-0.5f, {0.3f, 0, 1}));
  document.addMesh(makePear(), table, bowl + glm::vec3(0.005f, 0.052f, -0.055f), turned(-0.4f, {0.4f, 0, 1}));
  document.addMesh(makeLemon(), table, bowl + glm::vec3(0.0f, 0.115f, 0.035f),
                   turned(1.35f, {0.2f, 0.3f, 1}));
  document.addMesh(makeApple(), table, {-0.02f, 0.003f, 0.16f}, turned(0.1f, {1, 0, 1}));
  document.addMesh(makePear(), table, {0.5f, 0.04f, 0.2f}, turned(1.45f, {0.6f, 0.1f, -0.5f}));
  document.addMesh(makeLemon(), table, {-0.44f, 0.038f, 0.12f}, turned(1.5f, {0.5f, 0.2f, 1}));
  document.addMesh(makeCutLemon(), table, {-0.27f, 0.036f, 0.24f}, turned(0.9f, {1, 0, -0.25f}));

  document.addSun({-0.72f, 0.62f, 0.42f}, {1.0f, 0.95f, 0.86f}, 3.0f);
  document.addCamera({"Table camera", 0.5f, 16.0f / 9.0f, 0.05f, 100.0f}, {0.3f, 1.42f, 2.05f},
                     {0.0f, 0.97f, -0.04f});
  return document;
}

}  // namespace

int main(int argc, char** argv) {
  return meshkit::generate(argc, argv, "still_life", makeScene);
}
