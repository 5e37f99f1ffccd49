// What splats leave on coats and on fins (paper 003, section 3.2).
#pragma once

#include <cstdint>
#include <vector>

#include "bake/fins.h"

namespace scumble::bake {

// Texels of one coat or fin, with a border of kGutter all around it that shows how it goes on.
struct Tile {
  uint32_t width = 0, height = 0;  // with the border; 0: nothing is there
  std::vector<uint8_t> rgba;       // sRGB, straight alpha, row 0 at the top
};
constexpr int kGutter = 4;  // texels

// A picture of values that is looked up between texels and levels, repeating.
class ValuePicture {
 public:
  explicit ValuePicture(int example);
  // `texel`: how far apart places are at which it is looked up, in units of its extent.
  float at(const glm::vec2& uv, float texel) const;

 private:
  struct Level {
    uint32_t size;
    std::vector<uint8_t> values;
  };
  std::vector<Level> levels_;
};

// Texels of a tile, with the border. `texel`: metres.
glm::uvec2 tileSize(const Chart& chart, float texel);
glm::uvec2 tileSize(const Fin& fin, float texel);

class Capture {
 public:
  // All of them must stay.
  Capture(const Proxy& proxy, const Shell& shell, const std::vector<Splat>& splats,
          const BakeOptions& options, float texel);

  // What lies over a chart at heights from `low` to `high`, in parts of the shell's height.
  Tile coat(uint32_t chart, float low, float high) const;
  // `top`: gets the part of its height above which it is empty; texels are of what lies below.
  Tile fin(const Fin& fin, float& top) const;

 private:
  // A splat as one chart has it.
  struct Landing {
    uint32_t splat;
    glm::vec2 at, along;  // in the chart's plane
    float share;          // of its height in the shell's
  };
  void land(const BakeOptions& options);
  // Lays a splat over a texel. `offset`: from its middle, along it and across, metres.
  struct Brush;
  Brush brushOf(const Splat& splat, float sine) const;
  struct Standing;
  // `most`: how high the fin is, metres.
  std::vector<Standing> standingOn(const Fin& fin, float& most) const;
  void lay(const Brush& brush, const glm::vec2& offset, glm::vec4& texel) const;

  const Proxy& proxy_;
  const Shell& shell_;
  const std::vector<Splat>& splats_;
  const BakeOptions& options_;
  float texel_;
  ValuePicture bristles_{1};
  std::vector<std::vector<Landing>> landings_;     // by chart, in the order of splats
  std::vector<std::vector<uint32_t>> splatsOver_;  // by triangle
};

}  // namespace scumble::bake
