// Panoramas as they are drawn: places lie where they are, and nothing shows what they are put together of.
#include "scumble/panorama.h"

#include <cmath>

#include "base/srgb.h"
#include "base/test_folder.h"
#include "panorama/tiling.h"
#include "tests/support/aov.h"
#include "tests/support/plain_wash.h"
#include "tests/support/ray_cast.h"
#include "tests/support/render_test.h"
#include "tests/support/sanitized.h"

namespace scumble::panorama {
namespace {

using namespace test;

constexpr uint32_t kRows = 128;
constexpr glm::vec3 kEye(0.3f, 1.2f, 0.4f);

// A room with something in it, all around the eye.
Scene room() {
  TestScene s;
  s.light({0.3f, 1, 0.5f});
  const int wall = s.material(TestScene::colored("Wall", {0.7f, 0.6f, 0.5f, 1}));
  s.add(gridMesh({-4, 0, -4}, {8, 0, 0}, {0, 4, 0}, 4, {8, 4}), wall);
  s.add(gridMesh({4, 0, 4}, {-8, 0, 0}, {0, 4, 0}, 4, {8, 4}), wall);
  s.add(gridMesh({4, 0, -4}, {0, 0, 8}, {0, 4, 0}, 4, {8, 4}), wall);
  s.add(gridMesh({-4, 0, 4}, {0, 0, -8}, {0, 4, 0}, 4, {8, 4}), wall);
  s.add(gridMesh({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 4, {8, 8}),
        s.material(TestScene::colored("Floor", {0.5f, 0.3f, 0.2f, 1})));
  const int red = s.material(TestScene::colored("Red", {0.7f, 0.1f, 0.1f, 1}));
  s.add(sphereMesh({1.5f, 0.8f, -1.5f}, 0.7f), red);
  s.add(boxMesh({-2.5f, 0, 1}, {-1.5f, 1.6f, 2}), red);
  s.add(sphereMesh({0.6f, 3.2f, 0.8f}, 0.4f), red);
  return s.load();
}

View cameraAt(const Scene& scene, float heading, float pitch = 0) {
  const glm::vec3 ahead(std::sin(heading) * std::cos(pitch), std::sin(pitch),
                        -std::cos(heading) * std::cos(pitch));
  return viewsFrom(scene, {kEye, kEye + ahead}, 64, 64).front();
}

RenderOptions optionsFor(PanoramaKind kind, std::vector<std::string> aovs = {}, uint32_t height = kRows) {
  return sized(height * aspectOf(kind), height, std::move(aovs));
}

class Panoramas : public RenderTest {
 protected:
  static Frame paint(const Scene& scene, const Look& look, const View& from, const Panorama& panorama,
                     const RenderOptions& options) {
    Result<Frame> frame = renderPanorama(renderer(), scene, look, 0, from, panorama, options);
    if (!frame) throw std::runtime_error(frame.error().message());
    return std::move(frame).value();
  }
};

// Where a pixel's middle looks, and from where, by what panorama.h says. Longitude, latitude.
glm::dvec2 anglesOf(const Image& image, PanoramaKind kind, uint32_t x, uint32_t y) {
  const double longitudes = glm::radians(double(longitudesOf(kind)));
  return {((x + 0.5) / image.width - 0.5) * longitudes, (0.5 - (y + 0.5) / image.height) * 0.5 * kTurn};
}
glm::dvec3 wayOf(const glm::dvec2& angles) {
  return {std::sin(angles.x) * std::cos(angles.y), std::sin(angles.y),
          -std::cos(angles.x) * std::cos(angles.y)};
}

// What is at a pixel lies that way from its eye, and as far as `depth` says.
TEST_F(Panoramas, placesLieWhereTheyAreSeen) {
  NOT_WITH_SANITIZERS();
  const Scene scene = room();
  constexpr double kHeading = 0.7;
  for (const PanoramaKind kind : {PanoramaKind::vr180, PanoramaKind::mono360}) {
    const Frame frame = paint(scene, quietLook(), cameraAt(scene, float(kHeading), 0.4f), {kind},
                              optionsFor(kind, {"position", "depth", "id"}));
    for (int eye = 0; eye < eyesOf(kind); ++eye) {
      const Image &position = aov(frame, "position", size_t(eye)), &depth = aov(frame, "depth", size_t(eye));
      const double pixel = 0.5 * kTurn / kRows;
      Difference away(1.5), distances(0.004);  // pixels; metres
      for (uint32_t y = 0; y < position.height; ++y)
        for (uint32_t x = 0; x < position.width; ++x) {
          if (aov(frame, "id", size_t(eye)).at(x, y, 0) == 0) continue;
          const glm::dvec2 angles = anglesOf(position, kind, x, y);
          const double apart = kind == PanoramaKind::mono360 ? 0 : 0.063 * easing(float(angles.y));
          const glm::dvec2 world(angles.x + kHeading, angles.y);
          const glm::dvec3 right(std::cos(world.x), 0, std::sin(world.x));
          const glm::dvec3 place = glm::dvec3(kEye) + (eye == 0 ? -0.5 : 0.5) * apart * right;
          const glm::dvec3 way = glm::dvec3(texel(position, int(x), int(y))) - place;
          away.add(glm::length(glm::cross(wayOf(world), glm::normalize(way))) / pixel, 0);
          distances.add(depth.at(x, y, 0), glm::length(way));
        }
      // The nearest pixel's middle is up to 0.7 pixels off; and eyes keep their places for a strip.
      EXPECT_LE(away.beyondPart(), 0.001) << away.text();
      EXPECT_LE(distances.beyondPart(), 0.001) << distances.text();
      EXPECT_GT(away.count, position.width * position.height / 2);
    }
  }
}

// A picture moved to the right by so many columns, all around.
Image moved(const Image& image, uint32_t columns) {
  Image result = image;
  const size_t channels = image.channels.size();
  for (uint32_t y = 0; y < image.height; ++y)
    for (uint32_t x = 0; x < image.width; ++x)
      for (size_t c = 0; c < channels; ++c)
        result.pixels[(size_t(y) * image.width + (x + columns) % image.width) * channels + c] =
            image.at(x, y, uint32_t(c));
  return result;
}

// The part of the pixels whose numbers in `a` are not among those around them in `b`, by more than a
// tolerance: edges are sampled elsewhere in a pixel.
double beyond(const Image& a, const Image& b, float tolerance) {
  const int width = int(a.width), height = int(a.height);
  size_t count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      bool isOff = false;
      for (uint32_t c = 0; c < a.channels.size(); ++c) {
        float least = INFINITY, most = -INFINITY;
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
          for (int i = x - 1; i <= x + 1; ++i) {
            const float value = b.at(uint32_t((i + width) % width), uint32_t(j), c);
            least = std::min(least, value), most = std::max(most, value);
          }
        const float own = a.at(uint32_t(x), uint32_t(y), c);
        isOff |= own < least - tolerance || own > most + tolerance;
      }
      count += isOff;
    }
  return double(count) / double(a.width * a.height);
}

// Where a camera that is turned has its parts lies elsewhere, and nothing else: no pass shows where they end,
// nor where the picture does.
TEST_F(Panoramas, turningTheCameraTurnsThePicture) {
  NOT_WITH_SANITIZERS();
  const Scene scene = room();
  const std::vector<Look> looks{
      *Look::load("age-of-sail"), *Look::load("henry"), *Look::load("ink"), [] {
        // Paper lies around the camera, unless it goes along with its turn; its grain is as large as a pixel.
        Look look = *Look::load("watercolour");
        for (const auto& [knob, value] :
             thoseThere({{"watercolor.paperMotion", "turn"}, {"watercolor.paperSize", "1000"}}))
          if (!look.set(knob, value)) throw std::runtime_error(knob);
        return look;
      }()};
  constexpr uint32_t kColumns = 19;
  // Marks and grain of more than a pixel.
  Panorama panorama;
  panorama.knobHeight = 180;
  for (const PanoramaKind kind : {PanoramaKind::mono360, PanoramaKind::ods})
    for (const Look& look : looks) {
      // Of two eyes the first look, which is the whole of what there is to know of one.
      if ((kind == PanoramaKind::ods) != (&look == &looks.front())) continue;
      panorama.kind = kind;
      const RenderOptions options =
          optionsFor(kind, {"final-shadow", "color", "final-color", "warp"}, 2 * kRows);
      const float turn = kTurn * float(kColumns) / float(options.width);
      const Frame a = paint(scene, look, cameraAt(scene, 0.2f), panorama, options);
      const Frame b = paint(scene, look, cameraAt(scene, 0.2f + turn), panorama, options);
      for (const Frame::Layer& layer : a.layers)
        for (size_t eye = 0; eye < layer.views.size(); ++eye) {
          // Pigment lies on a quarter of the pixels, which is coarse in a picture as small as this.
          // Pixels, or parts of white. Towards the poles the same vector is ever more columns long.
          const float tolerance = layer.name == "warp" ? 4.0f : 0.05f;
          EXPECT_LT(beyond(layer.views[eye], moved(aov(b, layer.name, eye), kColumns), tolerance),
                    &look == &looks.back() ? 0.05 : 0.005)
              << layer.name << " of look " << &look - looks.data();
        }
    }
}

// Two eyes in one place see what one eye sees there.
TEST_F(Panoramas, eyesInOnePlaceSeeTheSame) {
  const Scene scene = room();
  const View from = cameraAt(scene, 0);
  const uint32_t height = kSanitized ? 32 : 64;
  const Frame one = paint(scene, Look(), from, {PanoramaKind::mono360},
                          optionsFor(PanoramaKind::mono360, {"depth"}, height));
  const Frame two =
      paint(scene, Look(), from, {PanoramaKind::ods, 0}, optionsFor(PanoramaKind::ods, {"depth"}, height));
  for (const char* layer : {"", "depth"})
    for (size_t eye = 0; eye < 2; ++eye)
      EXPECT_TRUE(sameBytes(aov(two, layer, eye), aov(one, layer))) << layer << eye;
  // The same call, the same bytes.
  expectSame(paint(scene, Look(), from, {PanoramaKind::mono360},
                   optionsFor(PanoramaKind::mono360, {"depth"}, height)),
             one);
}

TEST_F(Panoramas, itIsLevelHoweverTheCameraIsPitched) {
  NOT_WITH_SANITIZERS();
  const Scene scene = room();
  const RenderOptions options = optionsFor(PanoramaKind::mono360, {}, 64);
  const Image level = aov(paint(scene, Look(), cameraAt(scene, 1), {PanoramaKind::mono360}, options), "");
  const Image up = aov(paint(scene, Look(), cameraAt(scene, 1, 0.6f), {PanoramaKind::mono360}, options), "");
  EXPECT_LT(beyond(level, up, 0.02f), 0.01);
}

// A camera on a boat goes with it and keeps level: all that is seen lies where a level eye sees it from one
// place, by some heading.
TEST_F(Panoramas, itRidesTheSeaAndKeepsLevel) {
  NOT_WITH_SANITIZERS();
  if (!hasKnob("ocean.mode")) GTEST_SKIP() << "there is no sea in this build";
  TestScene s;
  s.add(boxMesh({-0.8f, -0.3f, -0.5f}, {0.8f, 0.4f, 0.5f}),
        s.material(TestScene::colored("Wood", {0.5f, 0.4f, 0.3f, 1})));
  const Scene scene = s.load();
  const Look look = quietLook({{"ocean.mode", "on"},
                               {"ocean.wind", "16"},
                               {"ocean.tiles", "1"},
                               {"ocean.grid", "40"},
                               {"nodes.*.float.rides", "on"},
                               {"nodes.*.float.length", "1"},
                               {"nodes.*.float.beam", "1"}});
  View from = viewsFrom(scene, {{0, 2, 0}, {0, 2, -1}}, 64, 64).front();
  from.node = 0;
  const Result<Frame> frame =
      renderPanorama(renderer(), scene, look, 4, from, {PanoramaKind::mono360},
                     optionsFor(PanoramaKind::mono360, {"position", "depth", "id"}, 64));
  ASSERT_TRUE(frame) << frame.error().message();
  const Image &position = aov(*frame, "position"), &depth = aov(*frame, "depth");
  // How far the places of the eye by all pixels lie apart, were it turned by so much.
  size_t count = 0;
  const auto spread = [&](double heading, glm::dvec3& middle) {
    glm::dvec3 sum(0), squares(0);
    count = 0;
    for (uint32_t y = 0; y < position.height; ++y)
      for (uint32_t x = 0; x < position.width; ++x) {
        if (aov(*frame, "id").at(x, y, 0) == 0 || depth.at(x, y, 0) > 8) continue;
        const glm::dvec2 angles = anglesOf(position, PanoramaKind::mono360, x, y);
        const glm::dvec3 eye = glm::dvec3(texel(position, int(x), int(y))) -
                               double(depth.at(x, y, 0)) * wayOf({angles.x + heading, angles.y});
        sum += eye, squares += eye * eye, ++count;
      }
    middle = sum / double(count);
    const glm::dvec3 variance = squares / double(count) - middle * middle;
    return std::sqrt(variance.x + variance.y + variance.z);
  };
  double best = INFINITY;
  glm::dvec3 eye(0), middle(0);
  for (int i = -200; i <= 200; ++i)
    if (const double now = spread(0.002 * i, middle); now < best) best = now, eye = middle;
  EXPECT_GT(count, 500u);
  // A pixel is 0.05 radians; did it tilt with the boat, this were 0.17.
  EXPECT_LT(best, 0.1);
  EXPECT_GT(glm::distance(eye, glm::dvec3(0, 2, 0)), 0.1) << "the sea carries it";
}

// Of a camera that has moved: what is at a pixel was so many of the panorama's pixels elsewhere.
TEST_F(Panoramas, motionIsByThePanoramasPixels) {
  NOT_WITH_SANITIZERS();
  const Scene scene = room();
  RenderOptions options = optionsFor(PanoramaKind::mono360, {"position", "motion", "id"});
  const View now = cameraAt(scene, 0);
  View before = now;
  const glm::vec3 step(0.05f, 0.02f, -0.03f);
  before.worldToEye[3] += glm::vec4(step, 0);  // the eye was at minus it, by axes that are the world's
  options.previousViews = {before};
  const Frame frame = paint(scene, quietLook(), now, {PanoramaKind::mono360}, options);
  const Image &position = aov(frame, "position"), &motion = aov(frame, "motion");
  Difference along(0.02), down(0.02);
  const double pixels = position.width / double(kTurn);
  const auto placeOf = [&](const glm::dvec3& point, const glm::dvec3& eye) {
    const glm::dvec3 d = glm::normalize(point - eye);
    return pixels * glm::dvec2(std::atan2(d.x, -d.z), -std::asin(d.y));
  };
  for (uint32_t y = kRows / 8; y < kRows * 7 / 8; ++y)
    for (uint32_t x = 0; x < position.width; ++x) {
      if (aov(frame, "id").at(x, y, 0) == 0) continue;
      const glm::dvec3 point(texel(position, int(x), int(y)));
      glm::dvec2 way = placeOf(point, kEye) - placeOf(point, glm::dvec3(kEye) - glm::dvec3(step));
      way.x -= position.width * std::round(way.x / position.width);
      along.add(motion.at(x, y, 0), way.x), down.add(motion.at(x, y, 1), way.y);
    }
  EXPECT_LE(along.beyondPart(), 0.01) << along.text();
  EXPECT_LE(down.beyondPart(), 0.01) << down.text();
  EXPECT_GT(along.most + down.most + 1, 1);
}

// The way across the seam is the short one.
TEST_F(Panoramas, motionGoesAcrossTheSeam) {
  NOT_WITH_SANITIZERS();
  const Scene scene = room();
  for (const float side : {0.5f, -0.5f}) {
    RenderOptions options = optionsFor(PanoramaKind::mono360, {"position", "motion"});
    const View now = cameraAt(scene, 0);
    View before = now;
    before.worldToEye[3] += glm::vec4(side, 0, 0, 0);
    options.previousViews = {before};
    const Frame frame = paint(scene, quietLook(), now, {PanoramaKind::mono360}, options);
    const Image &position = aov(frame, "position"), &motion = aov(frame, "motion");
    size_t across = 0;
    Difference along(0.05);
    for (uint32_t y = kRows * 3 / 8; y < kRows * 5 / 8; ++y)
      for (const uint32_t x : {0u, 1u, 2u, position.width - 3, position.width - 2, position.width - 1}) {
        const glm::dvec3 point(texel(position, int(x), int(y)));
        const auto columnOf = [&](const glm::dvec3& eye) {
          const glm::dvec3 d = point - eye;
          return position.width / double(kTurn) * std::atan2(d.x, -d.z);
        };
        const double way = columnOf(kEye) - columnOf(glm::dvec3(kEye) - glm::dvec3(side, 0, 0));
        const double turns = std::round(way / position.width);
        across += turns != 0;
        along.add(motion.at(x, y, 0), way - position.width * turns);
      }
    EXPECT_GT(across, kRows / 4) << "places that were on the other side of it";
    EXPECT_LE(along.most, 0.3) << along.text();
  }
}

// A watercolour's stamps stand upright on the sphere, whichever part of it a frame shows: one that looks at
// the zenith has them lead there from all around.
TEST_F(Panoramas, stampsStandUpright) {
  NOT_WITH_SANITIZERS();
  if (!hasKnob("watercolor.turns")) GTEST_SKIP() << "built without watercolours";
  TestScene s;
  // Seen from within.
  TestMesh dome = sphereMesh(kEye, 4, 64);
  std::reverse(dome.indices.begin(), dome.indices.end());
  for (glm::vec3& normal : dome.normals) normal = -normal;
  s.add(dome, s.material(TestScene::unlit("Dome", {0.3f, 0.5f, 0.7f, 1})));
  const Scene scene = s.load();
  const TestFolder folder;
  constexpr int kSide = 64;
  Image bar{kSide, kSide, {"R", "G", "B", "A"}, {}};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (int c = 0; c < 4; ++c) bar.pixels.push_back(c == 3 || (x >= 24 && x < 40) ? 1.0f : 0.0f);
  ASSERT_TRUE(writePng(folder.file("bar.png"), bar).ok());
  const Look look = quietLook(plainWash({{"watercolor.generator", "shapes"},
                                         {"watercolor.brush", folder.file("bar.png")},
                                         {"watercolor.turns", "0"},
                                         {"watercolor.spacing", "120"},
                                         {"watercolor.stampSize", "0.4"},
                                         {"watercolor.backruns", "0"}}));
  constexpr int kSize = 512;
  for (const bool isUp : {true, false})
    for (const bool isOnSphere : {true, false}) {
      std::vector<View> views =
          viewsFrom(scene, {kEye, kEye + glm::vec3(0, isUp ? 1 : -1, 1e-3f), 80}, kSize, kSize);
      RenderOptions options = sized(kSize, kSize, {"pigment"});
      if (isOnSphere)
        options.sphere = SpherePart{glm::transpose(glm::mat3(views[0].worldToEye)), glm::radians(80.0f)};
      const Frame frame = draw(scene, look, views, options);
      const Image& pigment = aov(frame, "pigment");
      const glm::dvec2 pole = pixelOf(views[0], kEye + glm::vec3(0, isUp ? 2 : -2, 0), kSize, kSize);
      // How much it changes towards the zenith and beside that, in eight parts around it.
      double along[8]{}, beside[8]{};
      for (int y = 8; y < kSize - 8; ++y)
        for (int x = 8; x < kSize - 8; ++x) {
          const glm::dvec2 from = glm::dvec2(x + 0.5, y + 0.5) - pole;
          if (glm::length(from) < 60 || glm::length(from) > 230) continue;
          const glm::dvec2 change(texel(pigment, x + 1, y).w - texel(pigment, x - 1, y).w,
                                  texel(pigment, x, y + 1).w - texel(pigment, x, y - 1).w);
          const int part = int((std::atan2(from.y, from.x) / double(kTurn) + 1.0625) * 8) % 8;
          const double towards = glm::dot(change, glm::normalize(from));
          along[part] += towards * towards, beside[part] += glm::dot(change, change) - towards * towards;
        }
      for (int part = 0; part < 8; ++part) {
        const bool isAtTheSide = part % 4 == 0;
        if (isOnSphere) {
          EXPECT_GT(along[part], 1);
          EXPECT_GT(beside[part], 1.5 * along[part]) << (isUp ? "zenith" : "nadir") << ", part " << part;
        } else if (isAtTheSide) {
          EXPECT_LT(beside[part], along[part]) << "upright in the frame, which is no part of a sphere";
        }
      }
    }
}

// A picture behind everything goes all around.
TEST_F(Panoramas, aBackgroundGoesAllAround) {
  NOT_WITH_SANITIZERS();
  TestScene small;
  small.add(boxMesh({-0.01f, 0, -0.01f}, {0.01f, 0.02f, 0.01f}),
            small.material(TestScene::colored("Red", {1, 0, 0, 1})));
  const Scene scene = small.load();
  auto picture = std::make_shared<Image>(Image{512, 256, {"R", "G", "B"}, {}});
  for (uint32_t y = 0; y < picture->height; ++y)
    for (uint32_t x = 0; x < picture->width; ++x) {
      const double angle = (x + 0.5) / picture->width * kTurn;
      for (const double value :
           {0.5 + 0.4 * std::sin(angle), 0.5 + 0.4 * std::cos(angle), (y + 0.5) / picture->height})
        picture->pixels.push_back(float(value));
    }
  RenderOptions options = optionsFor(PanoramaKind::mono360);
  options.background = picture;
  const Look look = quietLook({{"background.simplify", "0"}, {"background.style", "0"}});
  const Image all = aov(paint(scene, look, cameraAt(scene, 0.9f), {PanoramaKind::mono360}, options), "");
  size_t far = 0;
  // Straight up and down all longitudes meet in a pixel.
  for (uint32_t y = 1; y + 1 < all.height; ++y)
    for (uint32_t x = 0; x < all.width; ++x) {
      const double angle = (x + 0.5) / all.width * kTurn;
      far += std::abs(all.at(x, y, 0) - (0.5 + 0.4 * std::sin(angle))) > 0.02 ||
             std::abs(all.at(x, y, 1) - (0.5 + 0.4 * std::cos(angle))) > 0.02 ||
             std::abs(all.at(x, y, 2) - (y + 0.5) / all.height) > 0.02;
    }
  EXPECT_LT(double(far), 0.002 * all.width * all.height);  // the box
  // And so does the half of it.
  options = optionsFor(PanoramaKind::vr180);
  options.background = picture;
  const Image half = aov(paint(scene, look, cameraAt(scene, 0.9f), {PanoramaKind::vr180}, options), "", 1);
  for (uint32_t x = 4; x < half.width; x += 16)
    EXPECT_NEAR(half.at(x, 40, 0), all.at(x + half.width / 2, 40, 0), 0.02) << x;
}

TEST_F(Panoramas, picturesComeBackAsTheyAreWanted) {
  const Scene scene = room();
  RenderOptions options = optionsFor(PanoramaKind::mono360, {"color", "shadow-map"}, 32);
  options.transparent = true;
  const View from = cameraAt(scene, 0);
  const Frame floats = paint(scene, Look(), from, {PanoramaKind::mono360}, options);
  options.formats = {{"", PixelFormat::srgb8}, {"color", PixelFormat::half}};
  const Frame others = paint(scene, Look(), from, {PanoramaKind::mono360}, options);
  const Image &codes = aov(others, ""), &linear = aov(floats, "");
  ASSERT_EQ(codes.codes.size(), linear.pixels.size());
  for (size_t i = 0; i < linear.pixels.size(); ++i)
    EXPECT_EQ(codes.codes[i],
              i % 4 == 3 ? alphaCode(linear.pixels[i]) : SrgbEncoder::instance()(linear.pixels[i]));
  ASSERT_EQ(aov(others, "color").halves.size(), aov(floats, "color").pixels.size());
  EXPECT_TRUE(aov(others, "color").pixels.empty());
  // One for all, of its own size.
  EXPECT_NE(aov(floats, "shadow-map").width, options.width);
  EXPECT_GT(floats.stats.drawCalls, 0u);
}

TEST_F(Panoramas, whoeverStopsItCanGoOn) {
  const Scene scene = room();
  RenderOptions options = optionsFor(PanoramaKind::mono360, {}, 32);
  double last = -1;
  options.progress = [&](double part) {
    EXPECT_GE(part, last);
    last = part;
    return part < 0.3;
  };
  const Result<Frame> stopped =
      renderPanorama(renderer(), scene, Look(), 0, cameraAt(scene, 0), {PanoramaKind::mono360}, options);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled);
  EXPECT_LT(last, 0.35);
  // Nothing is under way any more.
  EXPECT_FALSE(renderer().finish());
  EXPECT_NO_THROW(draw(scene, Look(), {cameraAt(scene, 0)}, sized(16, 16)));
}

TEST_F(Panoramas, whatMakesNoSenseIsRefused) {
  const Scene scene = room();
  const View from = cameraAt(scene, 0);
  const auto problem = [&](const View& view, const Panorama& panorama, const RenderOptions& options) {
    const Result<Frame> frame = renderPanorama(renderer(), scene, Look(), 0, view, panorama, options);
    return frame ? "" : frame.error().kind == ErrorKind::usage ? frame.error().problem : "no usage";
  };
  const RenderOptions good = optionsFor(PanoramaKind::vr180, {}, 32);
  EXPECT_NE(problem(from, {}, sized(64, 32)).find("aspect"), std::string::npos);
  EXPECT_NE(problem(from, {PanoramaKind::ods}, good).find("aspect"), std::string::npos);
  EXPECT_NE(problem(from, {}, sized(8, 8)).find("out of range"), std::string::npos);
  EXPECT_NE(problem(from, {PanoramaKind::vr180, -1}, good).find("eyes"), std::string::npos);
  EXPECT_NE(problem(from, {PanoramaKind::vr180, NAN}, good).find("eyes"), std::string::npos);
  EXPECT_NE(problem(from, {PanoramaKind::vr180, 0.06f, 0}, good).find("knobHeight"), std::string::npos);
  EXPECT_NE(problem(from, {PanoramaKind::vr180, 0.06f, 90, 0}, good).find("strip"), std::string::npos);
  EXPECT_NE(problem(parallelView(1, 1), {}, good).find("perspective"), std::string::npos);
  RenderOptions bad = good;
  bad.previousViews = {from, from};
  EXPECT_NE(problem(from, {}, bad).find("one camera"), std::string::npos);
  bad = good;
  bad.latch = [](std::vector<View>&) {};
  EXPECT_NE(problem(from, {}, bad).find("latch"), std::string::npos);
  bad = good;
  bad.height = bad.width = 16385;
  EXPECT_NE(problem(from, {}, bad).find("out of range"), std::string::npos);
  // Frames that somebody else has begun are theirs.
  ASSERT_TRUE(renderer().begin(scene, Look(), 0, {from}, sized(16, 16)));
  EXPECT_EQ(renderer().framesBegun(), 1u);
  EXPECT_NE(problem(from, {}, good).find("under way"), std::string::npos);
  EXPECT_TRUE(renderer().finish());
  EXPECT_EQ(renderer().framesBegun(), 0u);
  bad = good;
  bad.formats = {{"depth", PixelFormat::half}};
  EXPECT_NE(problem(from, {}, bad).find("not asked for"), std::string::npos);
  bad.aovs = {"depth"}, bad.formats = {{"depth", PixelFormat::srgb8}};
  EXPECT_NE(problem(from, {}, bad).find("no colour"), std::string::npos);
  bad = good;
  bad.aovs = {"colour"};
  EXPECT_NE(problem(from, {}, bad).find("colour"), std::string::npos);
  // What a sphere's parts are is checked as well.
  RenderOptions part = sized(16, 16);
  part.sphere = SpherePart{glm::mat3(2.0f)};
  EXPECT_FALSE(renderer().render(scene, Look(), 0, {from}, part));
  part.sphere = SpherePart{glm::mat3(1.0f), 0};
  EXPECT_FALSE(renderer().render(scene, Look(), 0, {from}, part));
  part.sphere = SpherePart{};
  EXPECT_FALSE(renderer().render(scene, Look(), 0, {parallelView(1, 1)}, part));
  EXPECT_TRUE(renderer().render(scene, Look(), 0, {from}, part));
}

}  // namespace
}  // namespace scumble::panorama
