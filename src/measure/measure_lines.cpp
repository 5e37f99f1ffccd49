// Measuring how steady lines are: the orbit that is drawn, and what is found in drawings.
#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "base/srgb.h"
#include "base/usage.h"
#include "measure/line_steadiness.h"
#include "measure/measurer.h"

namespace scumble {

using namespace measuring;

namespace {

// One picture after another goes in.
class Steadiness {
 public:
  explicit Steadiness(const std::string& method) { result_.method = method; }
  void add(Field drawn) {
    for (const float value : drawn.values) result_.drawn += value;
    Field most = greatestAround(drawn);
    if (before_) {
      const LineChange change = changeOf(*before_, mostBefore_, drawn, most);
      result_.changes += change.changes, result_.flickers += change.flickers;
    }
    before_ = std::move(drawn), mostBefore_ = std::move(most);
    ++count_;
  }
  Result<LineSteadiness> result(double degreesAStep) const {
    if (result_.drawn <= 0)
      return usage("there are no lines in what " + result_.method + " drew",
                   "let the look draw lines, and the camera see them");
    LineSteadiness all = result_;
    all.drawn /= count_;
    const double degrees = degreesAStep * (count_ - 1);
    all.changes /= all.drawn * degrees, all.flickers /= all.drawn * degrees;
    return all;
  }

 private:
  LineSteadiness result_;
  std::optional<Field> before_;
  Field mostBefore_;
  int count_ = 0;
};

Field drawnOn(const Image& drawing) {
  const bool isCoded = drawing.format == PixelFormat::srgb8;
  const size_t channels = drawing.channels.size(), colors = std::min<size_t>(channels, 3);
  Field drawn(int(drawing.width), int(drawing.height), 1);
  for (size_t pixel = 0; pixel < drawn.pixelCount(); ++pixel)
    for (size_t c = 0; c < colors; ++c) {
      const size_t at = pixel * channels + c;
      drawn.values[pixel] +=
          (isCoded ? linearFromSrgb8()[drawing.codes[at]] : drawing.pixels[at]) / float(colors);
    }
  std::vector<float> sorted = drawn.values;
  std::nth_element(sorted.begin(), sorted.begin() + long(sorted.size() / 2), sorted.end());
  const float paper = std::max(sorted[sorted.size() / 2], 1e-6f);
  for (float& value : drawn.values) value = std::clamp(1 - value / paper, 0.0f, 1.0f);
  return drawn;
}

}  // namespace

Result<LineSteadiness> steadinessOf(const std::string& method, const std::vector<Image>& drawings,
                                    double degreesAStep) {
  if (drawings.size() < 2)
    return usage("one drawing says nothing of how steady " + method + " is", "give two");
  if (!(degreesAStep > 0)) return usage("steps of no degrees", "give how far drawings are apart");
  Steadiness steadiness(method);
  for (const Image& drawing : drawings) {
    if (drawing.width != drawings[0].width || drawing.height != drawings[0].height)
      return usage("the drawings of " + method + " differ in size", "draw them alike");
    if (drawing.width == 0 || drawing.height == 0 || drawing.channels.empty() ||
        drawing.format == PixelFormat::half)
      return usage("a drawing of " + method + " is empty or of 16-bit floats", "give 8 or 32 bits a channel");
    steadiness.add(drawnOn(drawing));
  }
  return steadiness.result(degreesAStep);
}

Result<LineMeasurements> measureLines(Renderer& renderer, const Scene& scene, const Look& look,
                                      const std::string& aov, const MeasureOptions& options) {
  if (const Status status = checkMeasuring(scene, options); !status) return status.error();
  const float aspect = float(options.width) / float(options.height);
  const Result<std::vector<View>> framing =
      makeViews(scene, options.viewpoint, aspect, Stereo::mono, 0, look);
  if (!framing) return framing.error();
  LineMeasurements result;
  const glm::vec3 centre = centreOf(scene);
  for (int i = 0; i < kLineFrames; ++i) {
    View view = framing->front();
    view.node = -1;  // the orbit is the only motion
    view.worldToEye *= turnAbout(centre, float(i * kLineStep));
    result.views.push_back(view);
  }

  Look alone = look;
  if (const Status status = alone.set("ground.mode", "off"); !status) return status.error();
  RenderOptions frame;
  frame.width = options.width, frame.height = options.height;
  frame.samples = options.samples, frame.seed = options.seed;
  frame.aovs = {aov};
  Steadiness steadiness(aov);
  int done = 0;
  for (const View& view : result.views) {
    const Result<Frame> rendered = renderer.render(scene, alone, 0, {view}, frame);
    if (!rendered) return rendered.error();
    if (options.progress && !options.progress(++done, kLineFrames))
      return Error{ErrorKind::cancelled, "", 0, "", "measuring was cancelled", ""};
    const Image& lines = layer(*rendered, aov.c_str());
    if (lines.channels.size() < 4)
      return usage("the AOV " + aov + " has no coverage of lines", "name one that has");
    steadiness.add(fieldOf(lines, 3, 1, lines, 3));
  }
  Result<LineSteadiness> lines = steadiness.result(kLineStep);
  if (!lines) return lines.error();
  result.lines = std::move(lines).value();
  return result;
}

}  // namespace scumble
