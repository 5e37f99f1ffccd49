// What the warp pass reads of a material instead of its knobs.
struct WarpMaterial {
  float amount;     // pixels
  float least;      // pixels: what the distance leaves of it
  float inflation;  // pixels
  float distance;   // 1 / metre
  // Numbers of the material's setups, from 1; the second one of what a skeleton moves.
  float setup, characterSetup;
};
layout(set = 2, binding = 0, scalar) uniform WarpBlock { WarpMaterial warp; };
