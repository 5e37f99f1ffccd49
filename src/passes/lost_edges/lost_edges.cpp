#include "passes/lost_edges/lost_edges.h"

#include "frame/image_step.h"
#include "passes/final_color/final_color_knobs.h"
#include "passes/limit/limit_knobs.h"
#include "passes/lost_edges/lost_edges.shared.h"
#include "passes/warp/warp_knobs.h"
#include "shaders/lost_edges_image_comp.h"
#include "shaders/lost_edges_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

class LostEdges : public Pass {
 public:
  const char* name() const override { return "lost-edges"; }
  uint32_t variant(const scene::SceneData&, const look::LookData& look) const override {
    return look.get<FinalColorParams>().lostEdges > 0 && mayTear(look);
  }

  void declare(FrameBuilder& frame, uint32_t isThere) override {
    if (!isThere) return;
    frame.give(
        kPicture,
        step_.declare(frame, {.name = name(),
                              .shader = {{shaders::lost_edges_image_frag}, {shaders::lost_edges_image_comp}},
                              .inputs = {{shared::kLostPicture, frame.get(kPicture), true},
                                         {shared::kLostWarp, frame.get(kWarp)}},
                              .tiles = frame.get(kTiles),
                              .outputs = {frame.image(name(), {.format = kHalves})},
                              .fetches = 2 + 2 * shared::kLostSteps,
                              .uniformBytes = sizeof(shared::LostEdgesUniforms),
                              .maxJobs = 2})[0]);
  }
  void create(FrameBuilder& frame) override { step_.create(frame); }
  void bind(const gpu::GraphResources& resources) override { step_.bind(resources); }

  void update(const FrameInput& input) override {
    const FinalColorParams params = input.knobs.scene<FinalColorParams>();
    constexpr float kWholeTear = 2;  // pixels at 1080 lines
    const float scale = input.uniforms.pixelScale;
    const shared::LostEdgesUniforms uniforms{params.lostEdges, params.lostValues, lostReach(params, scale),
                                             kWholeTear * scale};
    const uint32_t mode = paletteColors(input.knobs.scene<LimitParams>()).empty() ? 1 : 2;
    step_.setJobs({{{0}, {}, {shared::kTileTorn, 0}}, {{mode}, {}, {shared::kTileTorn, shared::kTileTorn}}});
    for (size_t job = 0; job < 2; ++job) step_.update(uniforms, job);
  }

 private:
  ImageStep step_;
};

}  // namespace

std::unique_ptr<Pass> makeLostEdges() {
  return std::make_unique<LostEdges>();
}

}  // namespace scumble::passes
