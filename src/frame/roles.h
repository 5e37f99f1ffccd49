// What passes hand on to each other. A pass asks the frame for a role and gives roles of its own; it never
// names another pass, so that one can be put between two others without a change to either.
#pragma once

#include <cstdint>

namespace scumble::frame {

// Told apart by where it stands; a pass outside of the library may declare its own.
struct Role {
  const char* name;
};

// Which surfaces of each pixel: the first ones, or the next ones behind them (one sample a pixel), which
// layered ripple shows; roles of both have the same meaning. Overlays are laid over the picture after its
// edges were torn: strokes and fins, and lines.
enum class Layer : uint8_t { first, behind, paint, lines };
inline constexpr Layer kLayers[] = {Layer::first, Layer::behind}, kOverlays[] = {Layer::paint, Layer::lines};

// Buffers: the final vertices that `deform` writes, and the positions that they had a frame before.
inline constexpr Role kVertices{"vertices"}, kPreviousVertices{"previous vertices"};

// Which draws the views see: commands by bucket (world/draw_list.h).
inline constexpr Role kDrawList{"draw list"};
inline constexpr Role kDrawnObjects{"drawn objects"};  // shared::DrawnObject for each

// Indices of the triangles of blended surfaces, in the order in which they are composited; only where there
// are any.
inline constexpr Role kTransparentOrder{"transparent order"};

inline constexpr Role kShadowMap{"shadow map"};  // depth from the light in sigmoid-warped light space
// What blended surfaces of less than half opacity hold back of the key light; only where a scene has blended
// ones. R: 1 - the depth of the nearest one, as in the shadow map; G: the greatest opacity.
inline constexpr Role kVeils{"veils"};
// In tiles that are marked. R, G: warp vector in pixels (x right, y down); B: breakup marks, where the tile
// is shaded; A: eye depth of the inflated surface, or 0.
inline constexpr Role kWarp{"warp"};
inline constexpr Role kInflatedDepth{"inflated depth"};  // the depth buffer of those
// R: Lambert x cast shadow; G: lens; B: breakup, where it may act; A: coverage.
inline constexpr Role kShadow{"shadow"};
// Square root of the linear colour in full light, and in shadow; A: coverage. Square roots need no more than
// 8 bits, and cost drivers less than sRGB.
inline constexpr Role kLit{"lit"}, kShadowed{"shadowed"};
// Blended surfaces by themselves, and how far away they are: as kOverlay and kOverlayDistance. Only where
// there are any, and something changes colours by their distance.
inline constexpr Role kBlended{"blended"}, kBlendedDistance{"blended distance"};
// Samples of those and of the depth buffer, where a pixel has several; nothing is premultiplied there.
inline constexpr Role kShadowSamples{"shadow samples"}, kLitSamples{"lit samples"},
    kShadowedSamples{"shadowed samples"}, kDepthSamples{"depth samples"};
inline constexpr Role kTiles{"tiles"};  // flags of tiles (shading/tiles.shared.h)
inline constexpr Role kDepth{"depth"};  // depth buffer of the surfaces
// The depth buffer of what AOVs say of surfaces (passes/facts): one sample a pixel.
inline constexpr Role kDepthOfFacts{"depth of facts"};
// Square root of the colours of prepainted materials (world/feature.h); once a pixel, wherever they are first
// or not. A: 0 where there are none.
inline constexpr Role kPrepaintedLit{"prepainted lit"}, kPrepaintedShadowed{"prepainted shadowed"};
// R, G, A: the shadow's, blurred, at a quarter of the size; B: eye depth. In tiles that are blurred.
inline constexpr Role kBlur{"blur"};
// R: the lens channel under coverage, spread as far as it glows; at a quarter of the size.
inline constexpr Role kBloom{"bloom"};
// R: light after threshold and inner glow; G: lens; B: the glow's part of it; A: coverage. Behind the first
// surfaces: the shadow as it is. Not in plain tiles, unless there is a picture behind everything.
inline constexpr Role kLight{"light"};
// R, G, B, A: that light of each of a pixel's four samples; where there are several.
inline constexpr Role kSampleLight{"sample light"};
// Colours of the first surfaces and the sky: the picture before anything else is done to it.
inline constexpr Role kSurfaceColors{"surface colors"};
// The same after what changes colours smoothly, so that samples of a pixel change as the pixel does.
inline constexpr Role kGradedColors{"graded colors"};
// The picture, where the colours of its pixels are means of single samples, those of kDepthSamples and
// others.
inline constexpr Role kSampledPicture{"sampled picture"};
// An overlay so far: each pass that changes its colours takes the present one and gives the next. R, G, B:
// square roots of colours, times coverage; A: coverage.
inline constexpr Role kOverlay{"overlay"};
// How far away an overlay's colours are, wherever something changes colours by that. R: along the view axis,
// in radii of the scene, which halves hold at every scale, times G; G: coverage.
inline constexpr Role kOverlayDistance{"overlay distance"};
// R: how far the picture's paint reaches, 1 within it; only where it ends before the frame does.
inline constexpr Role kPaintedExtent{"painted extent"};
// The picture so far: each pass that works on it takes the present one and gives the next.
inline constexpr Role kPicture{"picture"};

}  // namespace scumble::frame
