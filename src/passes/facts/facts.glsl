struct FactsMaterial {
  MetaTexture meta;  // what the warp pass makes of its knobs, for the metatexture AOV
  float number;      // from 1, for the id AOV
};
layout(set = 2, binding = 0, scalar) uniform FactsBlock { FactsMaterial facts; };
