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
// Where she heads, and everything that travels with her: a unit vector along the water.
glm::vec3 boatHeading();
void addHull(Document& document, int boat);
void addRig(Document& document, int boat);
void addSails(Document& document, int boat);

int addSailor(Document& document, int boat);
// What he hauls on.
void addSheet(Document& document, int boat);

int addPier(Document& document, int parent, glm::vec3 root, glm::vec3 head);
int addShore(Document& document, int parent);
int addLighthouse(Document& document, int parent, glm::vec3 position);
// Flat water, where the renderer puts its ocean.
int addOcean(Document& document, int parent);
int addGulls(Document& document, int parent);
int addClouds(Document& document, int parent);

}  // namespace demo
