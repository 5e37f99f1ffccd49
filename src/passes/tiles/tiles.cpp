#include "passes/tiles/tiles.h"

#include <algorithm>
#include <cmath>

#include "frame/image_step.h"
#include "passes/blur/blur_knobs.h"
#include "passes/color/color_knobs.h"
#include "passes/colorize/colorize_knobs.h"
#include "passes/final_color/final_color_knobs.h"
#include "passes/limit/limit_knobs.h"
#include "passes/tiles/tile_steps.shared.h"
#include "passes/warp/warp_knobs.h"
#include "shaders/tile_blocks_image_comp.h"
#include "shaders/tile_blocks_image_frag.h"
#include "shaders/tile_facts_image_comp.h"
#include "shaders/tile_facts_image_frag.h"
#include "shaders/tile_flags_image_comp.h"
#include "shaders/tile_flags_image_frag.h"
#include "shaders/tile_marked_image_comp.h"
#include "shaders/tile_marked_image_frag.h"
#include "shaders/tile_pixels_image_comp.h"
#include "shaders/tile_pixels_image_frag.h"
#include "shading/displacement.shared.h"

namespace scumble::passes {

using namespace frame;

namespace {

// How far the warp moves colours, pixels.
float farthestTear(const FrameInput& input) {
  float farthest = 0;
  for (size_t m = 0; m < input.scene.materialCount(); ++m)
    farthest = std::max(farthest, input.knobs.of<WarpParams>(m).amount * input.scene.warpScaleOf(m));
  return shared::kFarthestTear * input.uniforms.pixelScale * farthest;
}

// Whether colours are others, at places that surfaces do not tell, before they are torn.
bool isChangedLater(const FrameInput& input) {
  const std::vector<std::string> colorizers = input.look.declared(look::kColorizers);
  const auto grades = [&](const std::string& name) { return mayGrade(input.look, name, input.scene.data()); };
  return std::any_of(colorizers.begin(), colorizers.end(), grades) ||
         !paletteColors(input.knobs.scene<LimitParams>()).empty() || input.backdrop;
}

class Tiles : public Pass {
 public:
  const char* name() const override { return "tiles"; }

  void declare(FrameBuilder& frame, uint32_t) override {
    hasSamples_ = frame.configuration().samples > 1;
    hasBlended_ = frame.has(kTransparentOrder);
    constexpr gpu::ImageShape kRow{.format = kBytes, .overX = shared::kTileSize},
        kTile{.format = kBytes, .overX = shared::kTileSize, .overY = shared::kTileSize};
    const std::vector<gpu::Handle> rows = pixels_.declare(
        frame, {.name = name(),
                .shader = {{shaders::tile_pixels_image_frag}, {shaders::tile_pixels_image_comp}},
                .inputs = {{shared::kTileShadow, frame.get(kShadow)},
                           {shared::kTileLitColor, frame.get(kLit)},
                           {shared::kTileShadowedColor, frame.get(kShadowed)},
                           {shared::kTileDepth, frame.get(kDepth)}},
                .outputs = {frame.image("tile rows, least", kRow), frame.image("tile rows, most", kRow)},
                .fetches = 3 * shared::kTileSize,
                .uniformBytes = sizeof(shared::TilePixels)});
    const std::vector<gpu::Handle> facts = facts_.declare(
        frame, {.name = name(),
                .shader = {{shaders::tile_facts_image_frag}, {shaders::tile_facts_image_comp}},
                .inputs = {{shared::kTileLeast, rows[0]}, {shared::kTileMost, rows[1]}},
                .outputs = {frame.image("tiles, least", kTile), frame.image("tiles, most", kTile)},
                .fetches = 2 * shared::kTileSize});
    const gpu::Handle flags =
        flags_.declare(frame, {.name = name(),
                               .shader = {{shaders::tile_flags_image_frag}, {shaders::tile_flags_image_comp}},
                               .inputs = {{shared::kTileLeast, facts[0]}, {shared::kTileMost, facts[1]}},
                               .outputs = {frame.image("tile flags", kTile)},
                               .fetches = 9 * 9 + 3 * 3 + 2})[0];
    const gpu::Handle marked = marked_.declare(
        frame, {.name = name(),
                .shader = {{shaders::tile_marked_image_frag}, {shaders::tile_marked_image_comp}},
                .inputs = {{shared::kTileOwnFlags, flags}},
                .outputs = {frame.image("marked tile flags", kTile)},
                .fetches = 1 + 3 * 3})[0];
    frame.give(kTiles, blocks_.declare(frame, {.name = name(),
                                               .shader = {{shaders::tile_blocks_image_frag},
                                                          {shaders::tile_blocks_image_comp}},
                                               .inputs = {{shared::kTileOwnFlags, marked}},
                                               .outputs = {frame.image(kTiles.name, kTile)},
                                               .fetches = 1 + shared::kTileBlock * shared::kTileBlock})[0]);
  }
  void create(FrameBuilder& frame) override {
    for (ImageStep* const step : steps_) step->create(frame);
  }
  void bind(const gpu::GraphResources& resources) override {
    for (ImageStep* const step : steps_) step->bind(resources);
  }

  void update(const FrameInput& input) override {
    const auto tilesOf = [](float pixels) { return int(std::ceil(pixels / float(shared::kTileSize))); };
    const float pixelScale = input.uniforms.pixelScale;
    const BackgroundParams background = input.knobs.scene<BackgroundParams>();
    pixels_.setJobs({{{background.air > 0, hasBlended_}, {}}});
    pixels_.update(shared::TilePixels{airDistances(background, input.uniforms).x});

    const float tear = farthestTear(input);
    const int shaded = tilesOf(blurReach(input.knobs.scene<BlurParams>().radius * pixelScale)),
              torn = tilesOf(
                  std::max({tear, input.inflation,
                            tear > 0 ? lostReach(input.knobs.scene<FinalColorParams>(), pixelScale) : 0}) +
                  1.5f),
              blurred = 2 * shaded;
    const bool isNear = torn <= shared::kFarthestTile;
    const int wanted = (tear > 0 ? shared::kWantsTears : 0) |
                       (marksUse(input.knobs) != MarksUse::none ? shared::kWantsMarks : 0) |
                       (isChangedLater(input) ? shared::kTearsAll : 0) |
                       (isNear ? 0 : shared::kTearsEverywhere) | (hasSamples_ ? shared::kWantsMixed : 0);
    const uint32_t reach = isNear ? uint32_t(torn) : 0;
    flags_.setJobs({{{uint32_t(256 * shaded + blurred), reach, uint32_t(wanted)}, {}}});
    marked_.setJobs({{{reach, uint32_t(wanted)}, {}}});
  }

 private:
  ImageStep pixels_, facts_, flags_, marked_, blocks_;
  bool hasSamples_ = false, hasBlended_ = false;
  ImageStep* const steps_[5] = {&pixels_, &facts_, &flags_, &marked_, &blocks_};
};

}  // namespace

std::unique_ptr<Pass> makeTiles() {
  return std::make_unique<Tiles>();
}

}  // namespace scumble::passes
