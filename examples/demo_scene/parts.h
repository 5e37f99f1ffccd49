// The parts of the demo scene. Each adds its nodes under `parent` and returns its own top node.
#pragma once

#include "mesh_kit/document.h"
#include "mesh_kit/mesh_builder.h"
#include "palette.h"

namespace demo {

using meshkit::Document;
using meshkit::MeshBuilder;

// Boat space: +X ahead, +Y up, +Z starboard, the waterline at y = 0, amidships at x = 0.
int addBoat(Document& document, int parent);
void addHull(Document& document, int boat);
void addRig(Document& document, int boat);
void addSails(Document& document, int boat);
// The foam where the hull meets the water, in the space of `parent`.
void addFoam(Document& document, int parent, const glm::mat4& boat);

int addSailor(Document& document, int boat);
// What he hauls on.
void addSheet(Document& document, int boat);

int addPier(Document& document, int parent, glm::vec3 root, glm::vec3 head);
int addShore(Document& document, int parent);
int addLighthouse(Document& document, int parent, glm::vec3 position);
// The broken water that a boat leaves behind, in the plane of X and Z, metres.
struct Wake {
  glm::vec2 stern, astern;
  float length;
};
int addSea(Document& document, int parent, glm::vec2 nearCenter, const Wake& wake);
int addGulls(Document& document, int parent);
int addClouds(Document& document, int parent);

// The water's height at a place, metres: what floats or stands in it asks this.
float seaHeight(glm::vec2 place);

}  // namespace demo
