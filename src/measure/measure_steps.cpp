// Measuring what poses that stand do to what is seen (paper 000, section 7.4: is there an ideal frame rate
// for animated characters?).
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/usage.h"
#include "measure/measurer.h"

namespace scumble {

using namespace measuring;

namespace {

constexpr double kGrid = 24;       // frames a second
constexpr float kMoves = 0.05f;    // pixels
constexpr double kFarPart = 0.95;  // of what moves, up to which jumps are not far

// What one hold's pictures show, one after the other.
class Steps {
 public:
  void add(const Frame& frame) {
    const Image &motion = layer(frame, "motion"), &picture = layer(frame, "");
    for (size_t i = 0; i + 1 < motion.pixels.size(); i += motion.channels.size()) {
      const float length = std::hypot(motion.pixels[i], motion.pixels[i + 1]);
      if (std::isfinite(length) && length > kMoves) jumps_.push_back(length);
    }
    pixels_ += double(motion.width) * motion.height;
    if (before_) {
      double sum = 0;
      for (size_t i = 0; i < picture.pixels.size(); ++i)
        if (i % picture.channels.size() < 3) sum += std::abs(picture.pixels[i] - before_->pixels[i]);
      changes_ += sum / (3.0 * picture.width * picture.height);
    }
    before_ = picture;
  }

  // `pixelsOfOne`: of a length as long as it is far away. `seconds`: that all took.
  StepMeasurements result(int hold, double pixelsOfOne, double seconds) {
    StepMeasurements found;
    found.hold = hold, found.stands = hold / kGrid;
    found.changes = changes_ / seconds;
    if (jumps_.empty()) return found;
    double sum = 0;
    for (const float jump : jumps_) sum += jump;
    found.jump = sum / double(jumps_.size());
    const auto far = jumps_.begin() + long(kFarPart * double(jumps_.size() - 1));
    std::nth_element(jumps_.begin(), far, jumps_.end());
    found.farJump = *far;
    const auto degrees = [&](double pixels) { return glm::degrees(std::atan(pixels / pixelsOfOne)); };
    found.jumpDegrees = degrees(found.jump), found.farJumpDegrees = degrees(found.farJump);
    found.moving = double(jumps_.size()) / pixels_;
    return found;
  }

 private:
  std::vector<float> jumps_;  // pixels
  double pixels_ = 0, changes_ = 0;
  std::optional<Image> before_;
};

int posesOf(int hold) {
  return int(kStepSeconds * kGrid) / hold;
}

}  // namespace

Result<std::vector<StepMeasurements>> measureSteps(Renderer& renderer, const Scene& scene, const Look& look,
                                                   const std::vector<int>& holds,
                                                   const MeasureOptions& options) {
  if (const Status status = checkMeasuring(scene, options); !status) return status.error();
  int total = 0;
  for (const int hold : holds) {
    if (hold < 1 || hold > int(kGrid))
      return usage("poses cannot stand for " + std::to_string(hold) + " frames", "give 1 to 24");
    total += posesOf(hold) + 1;
  }
  const float aspect = float(options.width) / float(options.height);
  const Result<std::vector<View>> framing =
      makeViews(scene, options.viewpoint, aspect, Stereo::mono, 0, look);
  if (!framing) return framing.error();
  View view = framing->front();
  view.node = -1;  // it stands
  const double pixelsOfOne = 0.5 * options.height * std::abs(double(view.eyeToClip[1][1]));

  std::vector<StepMeasurements> result;
  int done = 0;
  bool moves = false;
  for (const int hold : holds) {
    Look held = look;
    for (const auto& [knob, value] : {std::pair{"animation.hold", hold}, {"warp.boilHold", 0}})
      if (const Status status = held.set(knob, value); !status) return status.error();
    RenderOptions frame;
    frame.width = options.width, frame.height = options.height;
    frame.samples = options.samples, frame.seed = options.seed;
    frame.aovs = {"motion"};
    frame.previousViews = {view};
    Steps steps;
    for (int pose = 0; pose <= posesOf(hold); ++pose) {
      const double time = pose * hold / kGrid;
      frame.previousTime = pose ? time - hold / kGrid : time;
      const Result<Frame> rendered = renderer.render(scene, held, time, {view}, frame);
      if (!rendered) return rendered.error();
      if (options.progress && !options.progress(++done, total))
        return Error{ErrorKind::cancelled, "", 0, "", "measuring was cancelled", ""};
      steps.add(*rendered);
    }
    result.push_back(steps.result(hold, pixelsOfOne, posesOf(hold) * hold / kGrid));
    moves |= result.back().jump > 0;
  }
  if (!moves) return usage("nothing in the scene moves", "give one with a clip (--clip names another)");
  return result;
}

}  // namespace scumble
