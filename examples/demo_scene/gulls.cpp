// Gulls in flight: a spindle of a body and two bent wings.
#include "parts.h"

namespace demo {
namespace {

using namespace meshkit;

// Flies towards +Z. `beat` lifts (or drops) the wings, in radians.
Mesh makeGull(const std::string& name, float beat) {
  MeshBuilder mesh(name);
  mesh.setMaterial(kGull);
  auto ring = [](float z, float y, float width, float height) {
    return ellipseRing({0, y, z}, {width, 0, 0}, {0, height, 0}, 8);
  };
  mesh.loft({ring(-0.34f, 0.02f, 0.05f, 0.008f), ring(-0.22f, 0.01f, 0.045f, 0.03f),
             ring(-0.05f, 0.0f, 0.075f, 0.07f), ring(0.10f, 0.0f, 0.075f, 0.075f),
             ring(0.20f, 0.02f, 0.045f, 0.05f), ring(0.25f, 0.035f, 0.045f, 0.048f),
             ring(0.30f, 0.03f, 0.02f, 0.022f)},
            {.shading = Shading::smooth});
  mesh.setMaterial(kBeak);
  mesh.loft({ring(0.295f, 0.03f, 0.016f, 0.018f), ring(0.36f, 0.015f, 0.004f, 0.004f)});
  // The wing: up to the wrist, then down and back to the tip; leading and trailing edge per station.
  struct Station {
    float out, lift, front, back;
  };
  const float inner = 0.30f + beat, outer = -0.22f + 0.7f * beat;
  const Station wing[] = {{0.04f, 0.03f, 0.14f, -0.12f},
                          {0.22f, 0.03f + 0.18f * inner, 0.19f, -0.11f},
                          {0.42f, 0.03f + 0.40f * inner, 0.20f, -0.07f},
                          {0.62f, 0.03f + 0.40f * inner + 0.20f * outer, 0.12f, -0.09f},
                          {0.80f, 0.03f + 0.40f * inner + 0.38f * outer, 0.00f, -0.14f},
                          {0.94f, 0.03f + 0.40f * inner + 0.52f * outer, -0.13f, -0.19f}};
  for (float side : {-1.0f, 1.0f}) {
    constexpr size_t kStations = std::size(wing);
    // An upper and a lower skin, a thumb's breadth apart in the middle of the chord.
    Grid top(3, kStations), bottom(3, kStations);
    for (size_t i = 0; i < kStations; ++i) {
      const Station& s = wing[i];
      const float thick = 0.03f * (1.0f - 0.8f * float(i) / float(kStations - 1));
      const glm::vec3 front = {side * s.out, s.lift, s.front}, back = {side * s.out, s.lift - 0.015f, s.back};
      const glm::vec3 middle = glm::mix(front, back, 0.35f);
      top.at(0, i) = bottom.at(0, i) = back;
      top.at(1, i) = middle + glm::vec3(0, thick, 0);
      bottom.at(1, i) = middle - glm::vec3(0, 0.3f * thick, 0);
      top.at(2, i) = bottom.at(2, i) = front;
    }
    auto paint = [](size_t, size_t column) -> int { return column + 2 >= kStations ? kGullTip : kGull; };
    mesh.grid(top, {.flip = side > 0, .cellMaterial = paint});
    mesh.grid(bottom, {.flip = side < 0, .cellMaterial = paint});
  }
  return mesh.take();
}

}  // namespace

int addGulls(Document& document, int parent) {
  const int gulls = document.addNode({"Gulls", parent});
  struct Flight {
    glm::vec3 at;
    float heading, bank, beat;  // radians; heading 0 flies towards the viewer
  };
  const Flight flights[] = {{{-2.5f, 7.0f, 1.0f}, -2.05f, 0.38f, 0.25f},
                            {{-2.2f, 12.4f, -31.0f}, -2.3f, -0.30f, -0.05f},
                            {{8.3f, 11.6f, -14.0f}, -1.2f, 0.30f, 0.40f}};
  int number = 1;
  for (const Flight& f : flights) {
    const glm::quat turn =
        glm::angleAxis(f.heading, glm::vec3(0, 1, 0)) * glm::angleAxis(f.bank, glm::vec3(0, 0, 1));
    const int gull = document.addMesh(makeGull("Gull" + std::to_string(number++), f.beat), gulls, f.at, turn);
    document.nodes[size_t(gull)].scale = glm::vec3(1.2f);
  }
  return gulls;
}

}  // namespace demo
