// MetaTexture: an example texture that keeps its size and proportions on the screen while it sticks to a surface in
// space (Curtis et al., paper 000, section 3). Copies of the example at scales that do not change are blended; which
// ones is chosen at each point from the way the surface lies on the screen. Works for colours and for vector fields.
//
// This file includes nothing and may be taken alone. To use it in a surface shader:
//
//   MetaTexture m = ...;                                      // uniform; what it holds is said below
//   MetaTextureChoice c = metaTextureChoose(m, dSdu, dSdv, 1.0);
//   vec4 value = metaTextureSample(m, c, example, uv, vec2(0.0), gl_FragCoord.xy);
//
// dSdu, dSdv: the tangent vectors dP/du and dP/dv of the surface, projected to the screen, in pixels per unit of u and
// v (x right, y down); metaTextureProject does that. Where there are no tangents, metaTextureFromDerivatives makes
// them from dFdx(uv) and dFdy(uv). Where a shader fixes them, as `m.features = kFeatures` with a specialisation constant,
// nothing else is left in it: 4 samples at most without skew, 8 with; no loops where nothing is skipped.
#ifndef SCUMBLE_METATEXTURE_GLSL
#define SCUMBLE_METATEXTURE_GLSL

struct MetaTexture {
  vec4 mean;            // of the example; contrast is restored around it
  vec2 size;            // of the example on the screen, pixels
  vec2 shift;           // added to the coordinates of every copy, in copies
  float base;           // ratio between neighbouring scales, above 1
  float levelRotation;  // radians by which each scale is turned against the one below
  float blend;          // part of the way between two scales over which they blend, above 0 to 1
  float skip;           // a share of a blend below this is not sampled, 0 to below 0.5
  float lod;            // mip level of the example at its size on the screen, 0 or more
  float skewLevels;     // n of eq. 16, 1 or more
  float tiles;          // copies a unit of uv in mode 1
  int features;         // what shaders decide by:
  // bits 0, 1: mode: 0 MetaTexture; 1 object: ordinary mapping; 2 screen; 3 fractal: summed octaves
  // bits 2, 3: skew: 0 off, 1 approximate (eq. 14), 2 exact
  // bits 4, 5: contrast: 0 off, 1 by variance, 2 the example has a Gaussian histogram (metaTextureHistogram)
  // bit 6: the texture's horizontal runs across the foreshortening (section 3.5)
  // bit 7: some mapping closes on itself (`wraps` of metaTextureSample)
  // bit 8: skip is not 0
  // bit 9: levelRotation is not 0
  // bit 10: base is not 2
  // bit 11: copies at all scales begin at one place
};

int metaTextureMode(MetaTexture m) { return m.features & 3; }
int metaTextureSkew(MetaTexture m) { return m.features >> 2 & 3; }
int metaTextureContrast(MetaTexture m) { return m.features >> 4 & 3; }
bool metaTextureOrients(MetaTexture m) { return (m.features & 64) != 0; }
bool metaTextureWraps(MetaTexture m) { return (m.features & 128) != 0; }
bool metaTextureSkips(MetaTexture m) { return (m.features & 256) != 0; }
bool metaTextureTurns(MetaTexture m) { return (m.features & 512) != 0; }
bool metaTextureNests(MetaTexture m) { return (m.features & 2048) != 0; }
float metaTextureBase(MetaTexture m) { return (m.features & 1024) != 0 ? m.base : 2.0; }

// The transforms chosen at one point. Arrays: the two neighbouring levels of skew.
struct MetaTextureChoice {
  vec2 exponent[2];    // eq. 2, of the coordinates after the skew is taken out
  vec2 psi[2];         // cos, sin of the angle of eq. 20
  float skewLevel;     // number of the first level
  float skewBlend;     // share of the second level, 0 to 1
  float q;             // what the levels quantise: sin(2 psi) for exact skew, 2 tan(psi) for approximate
  float orientBlend;   // share of the texture with its axes exchanged
  vec2 gradU, gradV;   // of u and v on the screen, per pixel
};

const float kMetaTextureMaxSkew = 0.95;  // beyond it the transform nearly loses a dimension

// Projects a tangent vector to pixels. `tangent`: x, y, w of (world to clip) * (tangent, 0); ndc and w of the point.
vec2 metaTextureProject(vec3 tangent, vec2 ndc, float w, vec2 imageSize) {
  return (tangent.xy - ndc * tangent.z) / w * 0.5 * imageSize;
}

// Gradients of u and v from the projected tangents, and back: each is the inverse of the 2 x 2 Jacobian. Paper eq. 9
// and 10 assume that u and v are perpendicular; this assumes nothing, and is exact on a plane (FORMULAS 3). Where the
// surface is seen from the edge, the angle between the two is kept above about 1 / 1000 radians; where a mapping is
// degenerate everything is finite.
void metaTextureInvert(vec2 a, vec2 b, out vec2 inverseA, out vec2 inverseB) {
  float det = a.x * b.y - a.y * b.x;
  float least = 1e-3 * length(a) * length(b) + 1e-18;
  float safe = abs(det) < least ? (det < 0.0 ? -least : least) : det;
  inverseA = vec2(b.y, -b.x) / safe;
  inverseB = vec2(-a.y, a.x) / safe;
}

// dSdu and dSdv from differences of uv between pixels (dFdx(uv), dFdy(uv)): constant in each triangle.
void metaTextureFromDerivatives(vec2 uvByX, vec2 uvByY, out vec2 dSdu, out vec2 dSdv) {
  metaTextureInvert(vec2(uvByX.x, uvByY.x), vec2(uvByX.y, uvByY.y), dSdu, dSdv);
}

// Eq. 7: the cubic blend, over m.blend of the way; what is below m.skip becomes 0, without a jump.
float metaTextureBlend(MetaTexture m, float t) {
  t = clamp((t - 0.5) / m.blend + 0.5, 0.0, 1.0);
  float b = t * t * (3.0 - 2.0 * t);
  float skip = metaTextureSkips(m) ? m.skip : 0.0;
  return clamp((b - skip) / (1.0 - 2.0 * skip), 0.0, 1.0);
}

// Eq. 1, 2 and 11, from the squares of the gradients' lengths. A least length keeps the exponents finite.
vec2 metaTextureExponent(MetaTexture m, vec2 squares, float alpha) {
  vec2 size = alpha * m.size;
  return clamp(-0.5 / log2(metaTextureBase(m)) * log2(size * size * max(squares, vec2(1e-24))), vec2(-60.0), vec2(60.0));
}

// `alpha`: radial angle compensation (eq. 11 to 13), 1 for none.
MetaTextureChoice metaTextureChoose(MetaTexture m, vec2 dSdu, vec2 dSdv, float alpha) {
  MetaTextureChoice c;
  metaTextureInvert(dSdu, dSdv, c.gradU, c.gradV);
  c.q = 0.0;
  float uu = dot(c.gradU, c.gradU), vv = dot(c.gradV, c.gradV), uv = dot(c.gradU, c.gradV);
  int skew = metaTextureSkew(m);
  if (skew == 1 && uu * vv > 0.0) {
    // Eq. 14 and 15, with the sign that lessens the skew (FORMULAS 5).
    float epsilon = sqrt(min(uu, vv) / max(uu, vv));
    c.q = -atan(epsilon) * uv * inversesqrt(uu) * inversesqrt(vv);
  }
  if (skew == 2 && uu + vv > 0.0)
    c.q = clamp(-2.0 * uv / (uu + vv), -kMetaTextureMaxSkew, kMetaTextureMaxSkew);

  float level = floor(m.skewLevels * c.q);
  c.skewLevel = level;
  c.skewBlend = skew == 0 ? 0.0 : metaTextureBlend(m, m.skewLevels * c.q - level);
  for (int k = 0; k < 2; ++k) {
    float quantised = clamp((level + float(k)) / m.skewLevels, -kMetaTextureMaxSkew, kMetaTextureMaxSkew);
    if (skew == 1) {
      c.psi[k] = vec2(1.0, 0.5 * quantised) * inversesqrt(1.0 + 0.25 * quantised * quantised);
    } else {
      // cos and sin of asin(q) / 2.
      float root = sqrt(1.0 - quantised * quantised);
      c.psi[k] = vec2(sqrt(0.5 + 0.5 * root), (quantised < 0.0 ? -1.0 : 1.0) * sqrt(max(0.5 - 0.5 * root, 0.0)));
    }
    if (skew == 0) c.psi[k] = vec2(1.0, 0.0);
    vec2 psi = c.psi[k], squared = psi * psi;
    vec2 squares = squared * uu + squared.yx * vv + 2.0 * psi.x * psi.y * uv;
    if (skew != 0) {
      // What the levels leave of the skew: seen from the edge, both gradients still point across the silhouette, and a
      // scale chosen by them would stretch the texture along it. So below 45 degrees between the two it is the extent
      // along that counts.
      float dotted = (squared.x + squared.y) * uv + psi.x * psi.y * (uu + vv);
      float sine2 = 1.0 - dotted * dotted / max(squares.x * squares.y, 1e-30);
      squares *= clamp(2.0 * sine2, 1e-6, 1.0);
    }
    c.exponent[k] = metaTextureExponent(m, squares, alpha);
  }
  // From a quarter octave of foreshortening along u on, the texture turns; at three quarters it has.
  c.orientBlend = metaTextureOrients(m) ? metaTextureBlend(m, log2(max(uu, 1e-24) / max(vv, 1e-24)) - 0.5) : 0.0;
  return c;
}

// The exponents between both levels of skew: continuous everywhere.
vec2 metaTextureMeanExponent(MetaTextureChoice c) { return mix(c.exponent[0], c.exponent[1], c.skewBlend); }

// The larger singular value, squared, of the matrix with these rows, or these columns.
float metaTextureStretch(vec2 a, vec2 b) {
  float aa = dot(a, a), bb = dot(b, b), ab = dot(a, b);
  return 0.5 * (aa + bb + sqrt((aa - bb) * (aa - bb) + 4.0 * ab * ab));
}

// How many times finer than its size the texture comes out on the screen, in the direction in which that is the most: 1
// where the skew is taken out wholly; more where levels leave some of it, without an end towards a silhouette.
float metaTextureFineness(MetaTexture m, MetaTextureChoice c) {
  float squares = 0.0;
  for (int k = 0; k < 2; ++k) {
    vec2 psi = c.psi[k], scale = exp2(c.exponent[k] * log2(metaTextureBase(m))) * m.size;
    vec2 ofU = scale.x * (psi.x * c.gradU + psi.y * c.gradV), ofV = scale.y * (psi.y * c.gradU + psi.x * c.gradV);
    squares += (k == 0 ? 1.0 - c.skewBlend : c.skewBlend) * metaTextureStretch(ofU, ofV);
  }
  return sqrt(squares);
}

// Share of the second of two copies in each axis; 0 and 1 where one copy is all there is.
vec2 metaTextureShares(MetaTexture m, vec2 exponent) {
  vec2 t = exponent - floor(exponent);
  return vec2(metaTextureBlend(m, t.x), metaTextureBlend(m, t.y));
}

// Eq. 24 and 25, for all axes: the variance of the blend relative to the example's, that is the sum of the squares of
// the copies' shares.
float metaTextureVariance(MetaTexture m, MetaTextureChoice c) {
  float variance = 0.0;
  for (int k = 0; k < 2; ++k) {
    vec2 b = metaTextureShares(m, c.exponent[k]);
    vec2 squares = 2.0 * b * b - 2.0 * b + 1.0;
    float share = k == 0 ? 1.0 - c.skewBlend : c.skewBlend;
    variance += share * share * squares.x * squares.y;
  }
  float o = c.orientBlend;
  return variance * (2.0 * o * o - 2.0 * o + 1.0);
}

// FORMULAS 2: contrast is restored by the root of the variance.
float metaTextureGain(MetaTexture m, float variance) { return metaTextureContrast(m) == 0 ? 1.0 : inversesqrt(variance); }

// Coordinates that meet where a mapping wraps. Copies at whole multiples meet by themselves; others run to the middle
// of the wrap and back again, mirrored. `wraps`: 1 for an axis that closes on itself after one unit.
vec2 metaTextureFold(vec2 uv, vec2 wraps) {
  return mix(uv, abs(uv - floor(uv + 0.5)), wraps);
}

// The copies of one level of skew: the coordinates of the coarser scale in x, of the finer one in y, for u and for v.
void metaTextureCopies(MetaTexture m, vec2 uv, vec2 psi, vec2 level, vec2 wraps, out vec2 u, out vec2 v) {
  vec2 coarse = exp2(level * log2(metaTextureBase(m))), fine = metaTextureBase(m) * coarse;
  vec2 turned = vec2(psi.x * uv.x + psi.y * uv.y, psi.x * uv.y + psi.y * uv.x);
  u = vec2(coarse.x, fine.x) * turned.x;
  v = vec2(coarse.y, fine.y) * turned.y;
  if (metaTextureWraps(m)) {
    vec2 folded = metaTextureFold(uv, wraps);
    folded = vec2(psi.x * folded.x + psi.y * folded.y, psi.x * folded.y + psi.y * folded.x);
    bool straight = psi.y == 0.0 && !metaTextureTurns(m);
    vec4 scales = vec4(coarse.x, fine.x, coarse.y, fine.y), whole = round(scales);
    bvec4 meets = lessThan(abs(scales - whole), 1e-4 * scales);
    u = mix(vec2(coarse.x, fine.x) * folded.x, whole.xy * turned.x, straight ? meets.xy : bvec2(false));
    v = mix(vec2(coarse.y, fine.y) * folded.y, whole.zw * turned.y, straight ? meets.zw : bvec2(false));
  }
}

// Each copy starts elsewhere in the texture, at a place that depends on its level only. Otherwise all copies would show
// the same near the origin of uv, and a blend of equals has more contrast than eq. 24 counts with. Nested copies begin at
// one place, wherever it is: what one shows there, those at other scales do.
vec4 metaTextureFetch(MetaTexture m, MetaTextureChoice c, sampler2D example, vec2 at, vec2 level, float skewLevel) {
  if (metaTextureTurns(m)) {
    float angle = 0.5 * (level.x + level.y) * m.levelRotation;
    at = vec2(cos(angle) * at.x - sin(angle) * at.y, sin(angle) * at.x + cos(angle) * at.y);
  }
  vec2 ofSkew = m.shift + skewLevel * vec2(0.3711, 0.7133);
  at += metaTextureNests(m) ? exp2(level * log2(metaTextureBase(m))) * ofSkew : ofSkew + 0.618034 * level;
  vec4 value = textureLod(example, at, m.lod);
  if (metaTextureOrients(m)) value = mix(value, textureLod(example, at.yx, m.lod), c.orientBlend);
  return value;
}

// Eq. 8 and 23 with the pairing of FORMULAS 1. `pixel`: where on the screen (mode 2 only).
vec4 metaTextureSample(MetaTexture m, MetaTextureChoice c, sampler2D example, vec2 uv, vec2 wraps, vec2 pixel) {
  vec4 sum = vec4(0.0);
  float squares = 0.0;
  int mode = metaTextureMode(m), skew = metaTextureSkew(m);
  if (mode == 0) {
    // Where shares may be skipped, loops run from the first to the last copy that has one; else over all, and unroll.
    // METATEXTURE_UNROLLS: always the latter, with the same result; for shaders in which Mesa 22.3's llvmpipe cannot
    // compile such loops (it ends the process).
#ifdef METATEXTURE_UNROLLS
    const bool skips = false;
#else
    bool skips = metaTextureSkips(m);
#endif
    int firstLevel = skips && c.skewBlend >= 1.0 ? 1 : 0;
    int lastLevel = skew == 0 || (skips && c.skewBlend <= 0.0) ? 0 : 1;
    for (int k = firstLevel; k <= lastLevel; ++k) {
      float skewShare = k == 0 ? 1.0 - c.skewBlend : c.skewBlend;
      vec2 exponent = k == 0 ? c.exponent[0] : c.exponent[1], psi = k == 0 ? c.psi[0] : c.psi[1];
      vec2 level = floor(exponent), b = metaTextureShares(m, exponent), u, v;
      metaTextureCopies(m, uv, psi, level, wraps, u, v);
      ivec2 first = skips ? ivec2(greaterThanEqual(b, vec2(1.0))) : ivec2(0);
      ivec2 last = skips ? ivec2(greaterThan(b, vec2(0.0))) : ivec2(1);
      for (int j = first.y; j <= last.y; ++j)
        for (int i = first.x; i <= last.x; ++i) {
          float share = skewShare * (i == 0 ? 1.0 - b.x : b.x) * (j == 0 ? 1.0 - b.y : b.y);
          vec2 at = vec2(i == 0 ? u.x : u.y, j == 0 ? v.x : v.y);
          sum += share * metaTextureFetch(m, c, example, at, level + vec2(i, j),
                                          skew == 0 ? 0.0 : c.skewLevel + float(k));
          squares += share * share;
        }
    }
    squares *= 2.0 * c.orientBlend * c.orientBlend - 2.0 * c.orientBlend + 1.0;
  } else if (mode == 1) {
    // Ordinary texture mapping.
    sum = textureGrad(example, uv * m.tiles + m.shift, vec2(c.gradU.x, c.gradV.x) * m.tiles,
                      vec2(c.gradU.y, c.gradV.y) * m.tiles);
    squares = 1.0;
  } else if (mode == 2) {
    sum = textureLod(example, pixel / m.size + m.shift, m.lod);
    squares = 1.0;
  } else {
    // Summed octaves around one scale for both axes (Benard et al. 2009, "Dynamic solid textures"): as the exponent
    // goes from one whole number to the next, each octave takes the place of the one before.
    float exponent = max(c.exponent[0].x, c.exponent[0].y), t = exponent - floor(exponent);
    vec4 shares = vec4(0.5 * (1.0 - t), vec3(2.0, 1.0, 0.0) / 6.0 + t / 6.0);
    for (int i = 0; i < 4; ++i) {
      vec2 at = exp2((floor(exponent) + float(i) - 1.0) * log2(metaTextureBase(m))) * uv + m.shift;
      sum += shares[i] * textureLod(example, at, max(m.lod + (float(i) - 1.0 - t) * log2(metaTextureBase(m)), 0.0));
      squares += shares[i] * shares[i];
    }
  }
  return m.mean + (sum - m.mean) * metaTextureGain(m, squares);
}

// Contrast 2 (Heitz and Neyret 2018): the example was replaced by one whose channels are Gaussian with mean 0.5 and
// deviation 1 / 6; this takes the blend back to the example's own histogram. `inverse`: its channels' inverses, from
// 0 to 1, in one row of 256 texels.
vec4 metaTextureHistogram(sampler2D inverse, vec4 gaussian) {
  vec4 at = clamp(gaussian, 0.0, 1.0) * (255.0 / 256.0) + 0.5 / 256.0;
  return vec4(textureLod(inverse, vec2(at.r, 0.5), 0.0).r, textureLod(inverse, vec2(at.g, 0.5), 0.0).g,
              textureLod(inverse, vec2(at.b, 0.5), 0.0).b, textureLod(inverse, vec2(at.a, 0.5), 0.0).a);
}
#endif
