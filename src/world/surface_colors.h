// The colours that a scene's surfaces have, by area: what a look's automatic choices of colours are made
// from.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/shared.h"
#include "scene/scene_data.h"
#include "stage/palette.h"
#include "world/geometry.h"

namespace scumble::world {

class SurfaceColors {
 public:
  using MaterialOf = std::function<const scene::Material&(size_t)>;

  // Looks at some points of all that is shown, at rest. Reads vertices only of items that have another
  // primitive, stretch or picture than last time.
  void look(const std::vector<GeometryItem>& items, const MaterialOf& materialOf,
            const std::vector<Shared<scene::TextureImage>>& images);
  // Of what was looked at last, with the materials' present colours.
  SceneColors colors(const std::vector<GeometryItem>& items, const MaterialOf& materialOf);

 private:
  // An item's points: their colours without the material's factor.
  struct Part {
    const scene::Primitive* primitive = nullptr;
    std::shared_ptr<const scene::TextureImage> image;
    glm::mat3 linear{0.0f}, transform{0.0f};
    std::vector<ColorSample> samples;
    // Of these, with a factor; it has changed where that has.
    std::optional<glm::dvec3> factor;
    SceneColorSum sum;
  };
  static Part partOf(const GeometryItem& item, const scene::Material& material,
                     const std::vector<Shared<scene::TextureImage>>& images);
  static void sample(Part& part, const scene::Material& material);

  std::vector<Part> parts_;  // by item
};

}  // namespace scumble::world
