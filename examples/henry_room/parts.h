// The parts of Henry's room. Each adds its nodes under `parent`.
#pragma once

#include "mesh_kit/document.h"
#include "mesh_kit/mesh_builder.h"
#include "palette.h"
#include "room_form.h"

namespace henry {

using meshkit::Document;
using meshkit::MeshBuilder;

// Where things stand in the room.
constexpr glm::vec3 kTable = {-1.10f, 0.0f, -0.69f};
constexpr float kTableTop = 0.74f, kTableRadius = 0.72f;
constexpr glm::vec3 kCake = {-1.16f, kTableTop, -0.62f};
constexpr glm::vec3 kHedgehog = {-0.56f, 0.0f, -1.50f};
constexpr float kSeat = 0.46f;
constexpr glm::vec3 kChairBack = {1.51f, 0.985f, -2.48f};  // of the chair by the arch, its back's top
constexpr glm::vec3 kPresent = {2.08f, 0.0f, -1.05f};
constexpr int kCandles = 5, kBalloons = 4;
glm::vec3 flameAt(int candle);     // the middle of a flame, in the world
glm::vec3 balloonAt(int balloon);  // the middle of a balloon at rest, in the world

// Paints of a shell's parts.
struct ShellPaint {
  int wall, wainscot, ceiling, reveal;
};
meshkit::Mesh makeShell(const std::string& name, const Shell& shell, const ShellPaint& paint);

void addRoom(Document& document, int parent);
void addFloor(Document& document, int parent);
// A window of bars and a ring, in its wall; its node is at the middle of the hole.
void addWindow(Document& document, int parent, const std::string& name, const Shell& shell,
               const Opening& opening, const Oval& oval);
// Bare nodes: the unit box of each is the light that falls through one half of a window. Looks hang
// colorizers on them.
void addShafts(Document& document, int parent);
void addKitchenDoor(Document& document, int parent);
void addLeaves(Document& document, int parent);
void addShelf(Document& document, int parent);
void addTable(Document& document, int parent);
void addChairs(Document& document, int parent);
void addPresent(Document& document, int parent);
void addCake(Document& document, int parent);
void addBalloons(Document& document, int parent);
void addDust(Document& document, int parent);
void addHedgehog(Document& document, int parent);
void addParlour(Document& document, int parent);

// A ball, an egg, a bead.
void addBall(MeshBuilder& mesh, glm::vec3 center, glm::vec3 halfSize, int levels);

}  // namespace henry
