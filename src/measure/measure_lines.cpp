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
  void add(Field ink) {
    for (const float value : ink.values) result_.ink += value;
    Field most = greatestAround(ink);
    if (before_) {
      const InkChange change = changeOf(*before_, mostBefore_, ink, most);
      result_.changes += change.changes, result_.flickers += change.flickers;
    }
    before_ = std::move(ink), mostBefore_ = std::move(most);
    ++count_;
  }
  Result<LineSteadiness> result(double degreesAStep) const {
    if (result_.ink <= 0)
      return usage("there is no ink in what " + result_.method + " drew",
                   "let the look draw lines, and the camera see them");
    LineSteadiness all = result_;
    all.ink /= count_;
    const double degrees = degreesAStep * (count_ - 1);
    all.changes /= all.ink * degrees, all.flickers /= all.ink * degrees;
    return all;
  }

 private:
  LineSteadiness result_;
  std::optional<Field> before_;
  Field mostBefore_;
  int count_ = 0;
};

Field inkOf(const Image& drawing) {
  const bool isCoded = drawing.format == PixelFormat::srgb8;
  const size_t channels = drawing.channels.size(), colors = std::min<size_t>(channels, 3);
  Field ink(int(drawing.width), int(drawing.height), 1);
  for (size_t pixel = 0; pixel < ink.pixelCount(); ++pixel)
    for (size_t c = 0; c < colors; ++c) {
      const size_t at = pixel * channels + c;
      ink.values[pixel] +=
          (isCoded ? linearFromSrgb8()[drawing.codes[at]] : drawing.pixels[at]) / float(colors);
    }
  std::vector<float> sorted = ink.values;
  std::nth_element(sorted.begin(), sorted.begin() + long(sorted.size() / 2), sorted.end());
  const float paper = std::max(sorted[sorted.size() / 2], 1e-6f);
  for (float& value : ink.values) value = std::clamp(1 - value / paper, 0.0f, 1.0f);
  return ink;
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
    steadiness.add(inkOf(drawing));
  }
  return steadiness.result(degreesAStep);
}

Result<LineMeasurements> measureLines(Renderer& renderer, const Scene& scene, const Look& look,
                                      const MeasureOptions& options) {
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

  RenderOptions frame;
  frame.width = options.width, frame.height = options.height;
  frame.samples = options.samples, frame.seed = options.seed;
  frame.aovs = {"ink"};
  int done = 0;
  for (const std::string method : {"lines", "plain"}) {
    Look drawn = look;
    std::vector<std::pair<std::string, std::string>> settings{{"ground.mode", "off"}};
    if (method == "plain") settings.insert(settings.end(), {{"ink.fade", "0"}, {"ink.fadeAngle", "0"}});
    for (const auto& [path, value] : settings)
      if (const Status status = drawn.set(path, value); !status) return status.error();
    Steadiness steadiness(method);
    for (const View& view : result.views) {
      const Result<Frame> rendered = renderer.render(scene, drawn, 0, {view}, frame);
      if (!rendered) return rendered.error();
      if (options.progress && !options.progress(++done, 2 * kLineFrames))
        return Error{ErrorKind::cancelled, "", 0, "", "measuring was cancelled", ""};
      const Image& ink = layer(*rendered, "ink", 0);
      steadiness.add(fieldOf(ink, 3, 1, ink, 3));
    }
    Result<LineSteadiness> of = steadiness.result(kLineStep);
    if (!of) return of.error();
    result.methods.push_back(std::move(of).value());
  }
  return result;
}

}  // namespace scumble
