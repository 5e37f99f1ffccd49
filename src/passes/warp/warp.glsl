// What the warp pass reads of a material instead of its knobs.
struct WarpMaterial {
  float amount;     // pixels
  float least;      // pixels: what the distance leaves of it
  float inflation;  // pixels
  float distance;   // 1 / metre
  float setup;      // number of the material's setup, from 1
};
layout(set = 2, binding = 0, scalar) uniform WarpBlock { WarpMaterial warp; };
