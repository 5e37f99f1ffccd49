// Main and jib: cloth with a belly, reef band and patches. The patches are cells of the same cloth, so
// nothing lies upon anything and nothing flickers.
#include "parts.h"
#include "rig_form.h"
#include "timing.h"

namespace demo {
namespace {

using namespace meshkit;

// A patch sewn on along the weave: columns and rows of cells, half open.
struct Patch {
  size_t row0, row1, column0, column1;
  Paint paint;
};

GridOptions cloth(const std::vector<Patch>& patches, bool flip) {
  return {.shading = Shading::smooth,
          .flip = flip,
          .projectAlong = {0, 0, 1},
          .cellMaterial = [patches](size_t row, size_t column) -> int {
            for (const Patch& p : patches)
              if (row >= p.row0 && row < p.row1 && column >= p.column0 && column < p.column1) return p.paint;
            return kSail;
          }};
}

// u from luff to leech, v from foot to head; `depth` is its belly's, metres.
Mesh makeMainsail(float depth) {
  MeshBuilder mesh("Mainsail");
  constexpr size_t kColumns = 29, kRows = 35;
  const glm::vec3 tack = boomPoint(0.0f) + glm::vec3(0, 0.10f, 0),
                  clew = boomPoint(0.965f) + glm::vec3(0, 0.08f, 0);
  const glm::vec3 throat = gaffPoint(0.0f) + glm::vec3(0, -0.08f, 0),
                  peak = gaffPoint(0.97f) + glm::vec3(0, -0.05f, 0);
  Grid sail(kRows, kColumns);
  for (size_t r = 0; r < kRows; ++r) {
    const float v = float(r) / float(kRows - 1);
    for (size_t c = 0; c < kColumns; ++c) {
      const float u = float(c) / float(kColumns - 1);
      const glm::vec3 foot = glm::mix(tack, clew, u), head = glm::mix(throat, peak, u);
      glm::vec3 p = glm::mix(foot, head, v);
      // Deepest at 40 percent of the chord and below the middle; the head is laced straight to the gaff.
      const float draft = std::max(std::sin(kPi * std::pow(u, 0.76f)), 0.0f);
      // The sine of pi is a hair below zero in floats, and a power of that is not a number.
      const float swell = std::max(std::sin(kPi * std::pow(glm::mix(0.16f, 1.0f, v), 0.85f)), 0.0f);
      const float belly = depth * draft * std::pow(swell, 0.8f);
      p += glm::vec3(-0.22f, 0.0f, 0.97f) * belly;
      // The foot hangs in a curve, the leech is cut slightly hollow.
      p.y -= 0.10f * std::sin(kPi * u) * (1.0f - v) * (1.0f - v);
      p.x += 0.07f * std::sin(kPi * v) * u * u;
      sail.at(r, c) = p;
    }
  }
  mesh.grid(sail, cloth({{4, 8, 16, 22, kSailPatch1},
                         {13, 18, 6, 10, kSailPatch2},
                         {20, 24, 19, 25, kSailPatch3},
                         {26, 29, 9, 13, kSailPatch1},
                         {9, 10, 0, 28, kSailBand},
                         {0, 3, 25, 28, kSailBand},
                         {31, 34, 25, 28, kSailBand}},
                        false));
  // Reef points: short ends of rope along the band.
  mesh.setMaterial(kRope);
  for (size_t c = 3; c < kColumns - 2; c += 4) {
    const glm::vec3 p = sail.at(9, c) + glm::vec3(0, 0, -0.012f);
    mesh.tube({p, p + glm::vec3(0.0f, -0.07f, -0.02f), p + glm::vec3(0.01f, -0.14f, -0.012f)}, {0.012f}, 5);
  }
  // Hoops hold the luff to the mast.
  for (size_t r = 6; r < kRows; r += 11) {
    const glm::vec3 luff = sail.at(r, 0);
    std::vector<glm::vec3> hoop;
    for (int i = 0; i <= 12; ++i) {
      const float a = 2.0f * kPi * float(i) / 12.0f;
      hoop.push_back(mastPoint(luff.y) +
                     glm::vec3(0.10f * std::cos(a), 0.02f * std::cos(a), 0.10f * std::sin(a)));
    }
    mesh.tube(hoop, {0.013f}, 5);
  }
  return mesh.take();
}

Mesh makeJib(float depth) {
  MeshBuilder mesh("Jib");
  constexpr size_t kColumns = 19, kRows = 25;
  const glm::vec3 stayFoot = bowspritPoint(0.95f), stayHead = mastPoint(4.54f);
  const glm::vec3 tack = glm::mix(stayFoot, stayHead, 0.05f), head = glm::mix(stayFoot, stayHead, 0.90f);
  const glm::vec3 clew = {1.06f, 1.42f, 0.46f};
  Grid sail(kRows, kColumns);
  for (size_t r = 0; r < kRows; ++r) {
    const float v = float(r) / float(kRows - 1);
    const glm::vec3 luff = glm::mix(tack, head, v), leech = glm::mix(clew, head, std::min(v, 0.985f));
    for (size_t c = 0; c < kColumns; ++c) {
      const float u = float(c) / float(kColumns - 1);
      glm::vec3 p = glm::mix(luff, leech, u);
      const float belly =
          depth * std::sin(kPi * std::pow(u, 0.8f)) * std::sin(kPi * glm::mix(0.22f, 1.0f, v));
      p += glm::vec3(-0.15f, 0.0f, 0.98f) * std::max(belly, 0.0f);
      p.y -= 0.10f * std::sin(kPi * u) * (1.0f - v) * (1.0f - v);
      sail.at(r, c) = p;
    }
  }
  mesh.grid(sail, cloth({{6, 10, 7, 12, kSailPatch2},
                         {0, 2, 15, 18, kSailBand},
                         {0, 2, 0, 3, kSailBand},
                         {14, 17, 3, 8, kSailPatch1}},
                        false));
  // The sheet runs aft inside the shrouds to the coaming.
  mesh.setMaterial(kRope);
  mesh.tube(hangingRope(clew, {-0.3f, deckHeight(-0.3f, 0.72f) + 0.03f, 0.74f}, 0.05f, 8), {0.0135f}, 5);
  return mesh.take();
}

}  // namespace

void addSails(Document& document, int boat) {
  const int sails = document.addNode({"Sails", boat});
  // They breathe with the swell, the jib ahead of the main.
  constexpr float kMainDepth = 0.30f, kJibDepth = 0.24f, kBreath = 0.06f;  // metres
  Mesh mainsail = makeMainsail(kMainDepth), jib = makeJib(kJibDepth);
  mainsail.addTarget(makeMainsail(kMainDepth + kBreath));
  jib.addTarget(makeJib(kJibDepth + kBreath));
  const int main = document.addMesh(std::move(mainsail), sails),
            fore = document.addMesh(std::move(jib), sails);
  auto breath = [](float time) {
    return 0.7f * std::sin(phase(time, 4.0f)) + 0.3f * std::sin(phase(time, 2.0f) + 0.5f);
  };
  std::vector<Channel>& channels = sailing(document).channels;
  channels.push_back(
      weightKeys(main, onTwos(), [&](float time) { return std::vector<float>{breath(time)}; }));
  channels.push_back(
      weightKeys(fore, onTwos(), [&](float time) { return std::vector<float>{breath(time + 0.4f)}; }));
}

}  // namespace demo
