#include "tests/support/render_test.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <iterator>
#include <stdexcept>

#include "look/look_data.h"
#include "tests/support/aov.h"
#include "tests/support/test_device.h"

namespace scumble::test {

namespace {

std::unique_ptr<Renderer> shared, other;

// Renderers end before the process does: drivers unload in an order of their own.
class Renderers : public ::testing::Environment {
 public:
  void TearDown() override { shared.reset(), other.reset(); }
};
[[maybe_unused]] const auto* const kEnvironment = ::testing::AddGlobalTestEnvironment(new Renderers);

Renderer& existing(std::unique_ptr<Renderer>& renderer, ImagePassKind kind) {
  if (!renderer) {
    RendererOptions options;
    options.validation = true;
    options.imagePasses = kind;
    options.device = testDevice();
    Result<std::unique_ptr<Renderer>> made = Renderer::create(options);
    if (!made) throw std::runtime_error(made.error().message());
    renderer = std::move(made).value();
  }
  return *renderer;
}

int messages() {
  return (shared ? shared->validationMessages() : 0) + (other ? other->validationMessages() : 0);
}

}  // namespace

Renderer& RenderTest::renderer() {
  return existing(shared, ImagePassKind::fragment);
}
Renderer& RenderTest::otherRenderer() {
  return existing(other, ImagePassKind::compute);
}

void RenderTest::SetUp() {
  messagesBefore_ = messages();
}
void RenderTest::TearDown() {
  EXPECT_EQ(messages(), messagesBefore_) << "the validation layers have something to say (above, on stderr)";
}

Frame RenderTest::draw(const Scene& scene, const Look& look, const std::vector<View>& views,
                       const RenderOptions& options) {
  Result<Frame> frame = renderer().render(scene, look, 0, views, options);
  if (!frame) throw std::runtime_error(frame.error().message());
  return std::move(frame).value();
}

std::string stereoName(const ::testing::TestParamInfo<Stereo>& info) {
  return info.param == Stereo::stereo ? "stereo" : "mono";
}

std::string settingOf(const Look& look, const std::string& path) {
  const Result<look::KnobRef> knob = look::findKnob(path);
  if (!knob) throw std::runtime_error(knob.error().message());
  const look::Assignment* setting = look.data().settingOf(*knob->block, knob->row->name);
  return look::formatValue(*knob->row, setting ? setting->value.number : knob->row->defaultValue);
}

bool hasKnob(const std::string& path) {
  return look::isKnob(path);
}

Knobs thoseThere(const Knobs& knobs) {
  Knobs there;
  std::copy_if(knobs.begin(), knobs.end(), std::back_inserter(there),
               [](const auto& knob) { return hasKnob(knob.first); });
  return there;
}

Look quietLook(const Knobs& knobs) {
  Look look;
  Knobs all{{"ground.mode", "off"},      {"ground.strokes", "0"},   {"levels.error", "0"},
            {"background.mode", "look"}, {"background.air", "0"},   {"final.bloom", "0"},
            {"final.lostEdges", "0"},    {"background.steps", "0"}, {"palette.planes", "0"},
            {"background.skyTones", "0"}};
  all.insert(all.end(), knobs.begin(), knobs.end());
  for (const auto& [path, value] : all)
    if (const Status set = look.set(path, value); !set) throw std::runtime_error(set.error().message());
  return look;
}

std::vector<View> viewsFrom(const Scene& scene, const Stand& stand, uint32_t width, uint32_t height,
                            Stereo stereo) {
  Viewpoint viewpoint;
  viewpoint.eye = stand.eye, viewpoint.target = stand.target;
  viewpoint.roll = stand.roll, viewpoint.verticalFov = stand.fov;
  Result<std::vector<View>> views =
      makeViews(scene, viewpoint, float(width) / float(height), stereo, stand.ipd);
  if (!views) throw std::runtime_error(views.error().message());
  return std::move(views).value();
}

View parallelView(float halfHeight, float aspect) {
  View view;
  view.worldToEye = glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -5));
  view.eyeToClip = orthographicProjection(halfHeight, aspect, 0.1f, 20);
  return view;
}

void expectSame(const Frame& a, const Frame& b, const std::string& what) {
  ASSERT_EQ(a.layers.size(), b.layers.size()) << what;
  for (size_t i = 0; i < a.layers.size(); ++i) {
    EXPECT_EQ(a.layers[i].name, b.layers[i].name) << what;
    ASSERT_EQ(a.layers[i].views.size(), b.layers[i].views.size()) << what;
    for (size_t v = 0; v < a.layers[i].views.size(); ++v)
      EXPECT_TRUE(sameBytes(a.layers[i].views[v], b.layers[i].views[v]))
          << what << ": layer '" << a.layers[i].name << "', view " << v;
  }
}

RenderOptions sized(uint32_t width, uint32_t height, std::vector<std::string> aovs, uint32_t samples) {
  RenderOptions options;
  options.width = width, options.height = height, options.samples = samples;
  options.aovs = std::move(aovs);
  return options;
}

}  // namespace scumble::test
