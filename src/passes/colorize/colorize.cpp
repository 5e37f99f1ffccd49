#include "passes/colorize/colorize.h"

#include <cassert>
#include <deque>

#include "frame/image_step.h"
#include "passes/colorize/tiles.h"
#include "shaders/colorize_image_comp.h"
#include "shaders/colorize_image_frag.h"

namespace scumble::passes {

using namespace frame;

namespace {

class Colorize : public Pass {
 public:
  const char* name() const override { return "colorize"; }

  void declare(FrameBuilder& frame) override {
    const Configuration& configuration = frame.configuration();
    width_ = configuration.width, height_ = configuration.height, viewCount_ = configuration.viewCount;
    const auto add = [&](const char* step, Slot color, Slot depth, Slot output) {
      steps_.emplace_back().declare(frame, step,
                                    {{shaders::colorize_image_frag}, {shaders::colorize_image_comp}},
                                    {{frame.slot(color)}, {frame.slot(depth)}}, frame.slot(output),
                                    sizeof(shared::ColorizeUniforms), {}, 0, kMaxColorizeJobs);
    };
    add("colorize", Slot::color, Slot::depth, Slot::colorize);
    if (configuration.layered) add("behind-colorize", Slot::behind, Slot::behindDepth, Slot::behindColorize);
  }
  void create(FrameBuilder& frame, const FrameResources& resources) override {
    for (ImageStep& step : steps_) step.create(frame, resources);
  }

  void update(const FrameInput& input) override {
    const std::vector<PlacedColorizer> colorizers =
        placeColorizers(input.look, input.scene.data(), input.scene.motion().worldAsDrawn(), input.uniforms);
    assert(colorizers.size() <= size_t(shared::kMaxColorizers));
    int features = 0;
    for (const PlacedColorizer& one : colorizers) features |= one.features;
    const TileGrid grid(width_, height_);
    std::vector<std::vector<uint64_t>> masks;
    for (uint32_t view = 0; view < viewCount_; ++view) {
      const shared::ViewUniforms& uniforms = input.uniforms.views[view];
      masks.push_back(tileMasks(grid, colorizers, glm::dmat4(uniforms.worldToClip)));
      if (uniforms.orthographic != 0) features |= shared::kHasParallel;
    }
    if (!steps_.front().hasAreasByView())
      while (masks.size() > 1) {
        for (size_t i = 0; i < grid.count(); ++i) masks[0][i] |= masks.back()[i];
        masks.pop_back();
      }
    const std::vector<ColorizeJob> plan = planJobs(grid, masks);

    std::vector<ImageStep::Job> jobs;
    for (size_t j = 0; j < plan.size(); ++j) {
      shared::ColorizeUniforms uniforms{};
      const uint32_t count = listFor(plan[j].mask, colorizers, uniforms);
      jobs.push_back({{count, count > 0 ? uint32_t(features) : 0}, {}, plan[j].areas});
      for (ImageStep& step : steps_) step.update(uniforms, j);
    }
    for (ImageStep& step : steps_) step.setJobs(jobs);
  }

 private:
  std::deque<ImageStep> steps_;  // they are referred to, and stay where they are
  uint32_t width_ = 0, height_ = 0, viewCount_ = 1;
};

}  // namespace

std::unique_ptr<Pass> makeColorize() {
  return std::make_unique<Colorize>();
}

}  // namespace scumble::passes
