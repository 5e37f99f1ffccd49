// What the warp pass makes of a material's knobs, for the metatexture AOV.
struct FactsMaterial {
  MetaTexture meta;
};
layout(set = 2, binding = 0, scalar) uniform FactsBlock { FactsMaterial facts; };
