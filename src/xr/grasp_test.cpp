// What hands take hold of, and where it goes.
#include "xr/grasp.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace scumble::xr {
namespace {

const glm::vec3 kTriangle[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

// A world of a boat with a hull and a sail, beside a rock, on a shelf that is turned and scaled.
struct Scenery {
  SceneEditor editor;
  MeshId mesh;
  NodeId root, boat, hull, sail, rock;

  Scenery() {
    mesh = *editor.addMesh({{.positions = kTriangle}});
    glm::mat4 shelf = glm::rotate(glm::mat4(1.0f), 0.7f, glm::vec3(0, 1, 0));
    shelf[3] = glm::vec4(1, 2, 3, 1);
    root = *editor.addNode({.name = "root", .transform = glm::scale(shelf, glm::vec3(2))});
    boat = *editor.addNode(
        {.name = "boat", .parent = root, .transform = glm::translate(glm::mat4(1.0f), {5, 0, 0})});
    hull = *editor.addNode({.name = "hull", .parent = boat, .mesh = mesh});
    sail = *editor.addNode({.name = "sail", .parent = boat, .mesh = mesh});
    rock = *editor.addNode({.name = "rock", .parent = root, .mesh = mesh});
  }
  std::vector<glm::dmat4> world() { return nodesToWorld(*editor.scene(), Look(), 0); }
  glm::dmat4 worldOf(NodeId node) { return world()[size_t(node)]; }
};

glm::dmat4 handAt(const glm::dvec3& place, double turn) {
  glm::dmat4 matrix = glm::mat4_cast(glm::angleAxis(turn, glm::normalize(glm::dvec3(1, 2, 3))));
  matrix[3] = glm::dvec4(place, 1);
  return matrix;
}

void expectNear(const glm::dmat4& a, const glm::dmat4& b) {
  for (int column = 0; column < 4; ++column) EXPECT_LT(glm::length(a[column] - b[column]), 1e-5) << column;
}

TEST(GraspsOfHands, takeWhatAPartBelongsTo) {
  Scenery s;
  const glm::dmat4 hand = handAt({1, 1, 1}, 0);
  Result<Grasp> grasp = Grasp::take(s.editor, s.sail, -1, {hand, s.world()});
  ASSERT_TRUE(grasp.ok());
  EXPECT_EQ(grasp->node(), s.boat) << "the root is everything, and the sail is a part of the boat";
  EXPECT_EQ(Grasp::take(s.editor, s.rock, -1, {hand, s.world()})->node(), s.rock);
  // More, or less of it, as far as that goes.
  EXPECT_FALSE(grasp->widen(s.editor, true, {hand, s.world()}));
  EXPECT_TRUE(grasp->widen(s.editor, false, {hand, s.world()}));
  EXPECT_EQ(grasp->node(), s.sail);
  EXPECT_FALSE(grasp->widen(s.editor, false, {hand, s.world()}));
  EXPECT_TRUE(grasp->widen(s.editor, true, {hand, s.world()}));
  EXPECT_EQ(grasp->node(), s.boat);
  // Whoever stands on the hull does not lift the boat, nor the hull.
  EXPECT_EQ(Grasp::take(s.editor, s.sail, int(s.hull), {hand, s.world()})->node(), s.sail);
  const Result<Grasp> own = Grasp::take(s.editor, s.hull, int(s.hull), {hand, s.world()});
  ASSERT_FALSE(own.ok());
  EXPECT_EQ(own.error().problem, "it carries you");
  // Two hands on one thing, or on a thing and a part of it.
  const Grasp boat = *Grasp::take(s.editor, s.sail, -1, {hand, s.world()}),
              rock = *Grasp::take(s.editor, s.rock, -1, {hand, s.world()});
  Grasp sail = boat;
  ASSERT_TRUE(sail.widen(s.editor, false, {hand, s.world()}));
  EXPECT_TRUE(boat.concerns(s.editor, sail));
  EXPECT_TRUE(sail.concerns(s.editor, boat));
  EXPECT_FALSE(boat.concerns(s.editor, rock));
  // What hangs in a flat space cannot be placed; the flat thing itself can.
  ASSERT_TRUE(
      s.editor.setTransform(s.boat, glm::scale(s.editor.transformOf(s.boat), glm::dvec3(1, 1, 0))).ok());
  Result<Grasp> flat = Grasp::take(s.editor, s.sail, -1, {hand, s.world()});
  ASSERT_TRUE(flat.ok());
  EXPECT_FALSE(flat->widen(s.editor, false, {hand, s.world()}));
  ASSERT_TRUE(flat->follow(s.editor, {handAt({2, 1, 1}, 0), s.world()}).ok());
  EXPECT_EQ(flat->told(s.editor, s.world()).find("nan"), std::string::npos);
  // The ground, the sea: no node of the scene.
  EXPECT_FALSE(Grasp::take(s.editor, NodeId(5), -1, {hand, s.world()}).ok());
  EXPECT_FALSE(Grasp::take(s.editor, NodeId::none, -1, {hand, s.world()}).ok());
}

TEST(GraspsOfHands, goAsTheHandGoes) {
  Scenery s;
  const glm::dmat4 before = s.worldOf(s.sail), rock = s.worldOf(s.rock);
  const glm::dmat4 first = handAt({1, 1, 1}, 0.2f), then = handAt({-2, 4, 1.5f}, 1.9f);
  Result<Grasp> grasp = Grasp::take(s.editor, s.sail, -1, {first, s.world()});
  ASSERT_TRUE(grasp.ok());
  ASSERT_TRUE(grasp->follow(s.editor, {first, s.world()}).ok());
  expectNear(s.worldOf(s.sail), before);
  ASSERT_TRUE(grasp->follow(s.editor, {then, s.world()}).ok());
  // All six degrees of freedom, in the world, whatever it hangs on.
  expectNear(s.worldOf(s.sail), then * glm::inverse(first) * before);
  expectNear(s.worldOf(s.rock), rock);
  // What is let go for a part of it is where it was.
  ASSERT_TRUE(grasp->widen(s.editor, false, {then, s.world()}));
  expectNear(s.worldOf(s.sail), before);
  ASSERT_TRUE(grasp->follow(s.editor, {first, s.world()}).ok());
  expectNear(s.worldOf(s.hull), before);
  expectNear(s.worldOf(s.sail), first * glm::inverse(then) * before);
  // Where that is, in words.
  ASSERT_TRUE(
      s.editor
          .setTransform(s.sail, glm::inverse(s.worldOf(s.boat)) * glm::translate(glm::dmat4(1.0), {1, -2, 3}))
          .ok());
  EXPECT_EQ(grasp->told(s.editor, s.world()), "'sail' at 1.00, -2.00, 3.00, turned by 0, 0, 0 degrees");
}

// What it hangs on goes on meanwhile: the hand has it, and not that.
TEST(GraspsOfHands, stayInTheHandWhereTheWorldMoves) {
  Scenery s;
  const glm::dmat4 hand = handAt({1, 1, 1}, 0.2f);
  const glm::dmat4 before = s.worldOf(s.boat);
  Result<Grasp> grasp = Grasp::take(s.editor, s.hull, -1, {hand, s.world()});
  ASSERT_TRUE(grasp.ok());
  glm::dmat4 shelf = s.editor.transformOf(s.root);
  shelf[3].x += 7;
  ASSERT_TRUE(s.editor.setTransform(s.root, glm::rotate(shelf, 0.4, glm::dvec3(0, 1, 0))).ok());
  ASSERT_TRUE(grasp->follow(s.editor, {hand, s.world()}).ok());
  expectNear(s.worldOf(s.boat), before);
}

}  // namespace
}  // namespace scumble::xr
