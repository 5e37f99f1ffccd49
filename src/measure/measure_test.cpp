// All that is measured, of pictures for which docs/measure.md says what must come out.
#include <gtest/gtest.h>

#include "tests/support/painted_walls.h"

namespace scumble::measuring {
namespace {

using namespace test;
using scumble::test::settingOf;

constexpr uint32_t kWidth = 128, kHeight = 72;
const glm::dvec2 kPicture(kWidth, kHeight);

class MeasuredWalls : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scene = new Scene(wallScene());
    painter = new WallPainter;
    const Draw draw = [](const Scene& drawn, const Look& look, const std::vector<View>& views,
                         const RenderOptions& frame) { return painter->draw(drawn, look, views, frame); };
    MeasureOptions options;
    options.width = kWidth, options.height = kHeight;
    options.viewpoint.eye = glm::vec3(0, 0, float(kEyeDistance));
    options.viewpoint.target = glm::vec3(0);
    options.viewpoint.verticalFov = 40.0f;
    options.progress = [](int done, int total) {
      progress = {done, total};
      return true;
    };
    Look look;
    for (const auto& [knob, value] : {std::pair("warp.amount", "5"),
                                      {"warp.inflation", "3"},
                                      {"warp.distance", "0.5"},
                                      {"warp.metatexture.base", "3"}})
      if (!look.set(knob, value)) throw std::runtime_error(knob);
    measured = new Result<Measurements>(measureWith(draw, *scene, look, options));
  }
  static void TearDownTestSuite() { delete measured, delete painter, delete scene; }
  void SetUp() override { ASSERT_TRUE(*measured) << measured->error().message(); }

  static const ModeMeasurements& mode(const std::string& name) {
    for (const ModeMeasurements& mode : (*measured)->modes)
      if (mode.mode == name) return mode;
    throw std::runtime_error("no mode " + name);
  }
  // The steps of the paths: those that ask for the motion from a step before.
  static std::vector<Drawn> steps() {
    std::vector<Drawn> found;
    for (const Drawn& call : painter->calls)
      if (call.has("motion") && !call.previous.empty()) found.push_back(call);
    return found;
  }

  // The squared warp error of a field that lies on the screen, between two views, at the pixels of which both
  // see the same point, three pixels from what it cannot see. `turn`: of the earlier vectors, with the roll.
  static PerField screenError(const View& earlier, const View& now, double turn) {
    const glm::dmat4 toWorld = glm::inverse(worldToClip(now)),
                     toWorldEarlier = glm::inverse(worldToClip(earlier));
    glm::dvec3 sums[2]{}, squares[2]{}, differences(0.0);
    double count = 0;
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) {
        const glm::dvec2 place(x + 0.5, y + 0.5);
        const Seen seen = seenAt(now, toWorld, place, kPicture);
        if (!seen.number) continue;
        const glm::dvec2 before = placeIn(earlier, seen.point, kPicture);
        bool sees = true;
        for (const double dx : {-3.0, 3.0})
          for (const double dy : {-3.0, 3.0}) {
            const glm::dvec2 corner = before + glm::dvec2(dx, dy);
            sees = sees && corner.x > 0 && corner.y > 0 && corner.x < kPicture.x && corner.y < kPicture.y &&
                   seenAt(earlier, toWorldEarlier, corner, kPicture).number == seen.number;
          }
        if (!sees) continue;
        glm::dvec3 fields[2]{paintAt("screen", earlier, seen, before, kPicture, 0),
                             paintAt("screen", now, seen, place, kPicture, 0)};
        fields[0] = {turned(glm::dvec2(fields[0]), turn), fields[0].z};
        for (int i = 0; i < 2; ++i) sums[i] += fields[i], squares[i] += fields[i] * fields[i];
        differences += (fields[1] - fields[0]) * (fields[1] - fields[0]);
        ++count;
      }
    EXPECT_GT(count, 1500);
    const glm::dvec3 mean = (sums[0] + sums[1]) / (2 * count),
                     variance = (squares[0] + squares[1]) / (2 * count) - mean * mean;
    return {(differences.x + differences.y) / count / (2 * (variance.x + variance.y)),
            differences.z / count / (2 * variance.z)};
  }

  static Scene* scene;
  static WallPainter* painter;
  static Result<Measurements>* measured;
  static std::pair<int, int> progress;
};
Scene* MeasuredWalls::scene = nullptr;
WallPainter* MeasuredWalls::painter = nullptr;
Result<Measurements>* MeasuredWalls::measured = nullptr;
std::pair<int, int> MeasuredWalls::progress;

// Lanczos resampling of these sines is exact to some thousandths of their height.
constexpr double kResampling = 0.005;

const std::string kAttached[] = {"metatexture", "object", "fractal"};

TEST_F(MeasuredWalls, modesStandInTheirOrderAndAreDrawnAsSuch) {
  std::vector<std::string> names;
  for (const ModeMeasurements& each : (*measured)->modes) names.push_back(each.mode);
  EXPECT_EQ(names, (std::vector<std::string>{"metatexture", "object", "screen", "fractal"}));
  for (const Drawn& call : painter->calls)
    EXPECT_EQ(settingOf(call.look, "breakup.metatexture.mode"), call.mode);
}

TEST_F(MeasuredWalls, pathsAreThoseOfThePage) {
  // Bounds from (-2.6, -1.6, 0) to (2.6, 1.6, 2).
  const glm::dvec4 centre(0, 0, 1, 1);
  const double distance = kEyeDistance - 1;
  const std::vector<Drawn> all = steps();
  ASSERT_EQ(all.size(), 16u);
  for (size_t i = 0; i < all.size(); ++i) {
    const View &now = all[i].views[0], &before = all[i].previous[0];
    const glm::dmat4 step = glm::dmat4(now.worldToEye) * glm::inverse(glm::dmat4(before.worldToEye));
    const double turn =
        std::acos(std::clamp((step[0][0] + step[1][1] + step[2][2] - 1) / 2, -1.0, 1.0)) * 180 / kPi;
    const glm::dvec3 moved(step[3]);
    const glm::dvec4 centreNow = glm::dmat4(now.worldToEye) * centre,
                     centreBefore = glm::dmat4(before.worldToEye) * centre;
    SCOPED_TRACE(i);
    switch (i / 4) {
      case 0:  // dolly, towards the scene
        EXPECT_NEAR(turn, 0, 1e-3);
        EXPECT_NEAR(moved.x, 0, 1e-5);
        EXPECT_NEAR(moved.y, 0, 1e-5);
        EXPECT_NEAR(moved.z, 0.02 * distance, 1e-5);
        break;
      case 1:  // orbit around the scene's centre, about the vertical
        EXPECT_NEAR(turn, 1, 1e-3);
        EXPECT_NEAR(step[1][1], 1, 1e-6);
        EXPECT_NEAR(glm::length(glm::dvec3(centreNow - centreBefore)), 0, 1e-5);
        break;
      case 2:  // roll about the view axis
        EXPECT_NEAR(turn, 1, 1e-3);
        EXPECT_NEAR(step[2][2], 1, 1e-6);
        EXPECT_NEAR(glm::length(moved), 0, 1e-5);
        break;
      default:  // the object, carried and turned
        EXPECT_NEAR(turn, 0.5, 1e-3);
        EXPECT_NEAR(step[1][1], 1, 1e-6);
        const glm::dvec2 carried =
            placeIn(now, glm::dvec3(centre), kPicture) - placeIn(before, glm::dvec3(centre), kPicture);
        EXPECT_NEAR(carried.x, 0.01 * kWidth, 1e-3);
        EXPECT_NEAR(carried.y, 0, 1e-3);
    }
  }
}

TEST_F(MeasuredWalls, whatSticksHasNoWarpErrorAlsoWhereTheCameraRolls) {
  for (const std::string& name : kAttached) {
    const TemporalError& error = mode(name).temporal;
    for (const PerField& each : {error.dolly, error.orbit, error.roll, error.object}) {
      EXPECT_LT(each.vectors, kResampling) << name;
      EXPECT_LT(each.marks, kResampling) << name;
    }
  }
}

TEST_F(MeasuredWalls, whatLiesOnTheScreenHasTheErrorOfItsSines) {
  const TemporalError& error = mode("screen").temporal;
  const PerField found[] = {error.dolly, error.orbit, error.roll, error.object};
  const std::vector<Drawn> all = steps();
  ASSERT_EQ(all.size(), 16u);
  for (size_t motion = 0; motion < 4; ++motion) {
    PerField squares;
    for (size_t step = 0; step < 4; ++step) {
      const Drawn& call = all[4 * motion + step];
      const PerField each =
          screenError(call.previous[0], call.views[0], turnOf(call.views[0]) - turnOf(call.previous[0]));
      squares.vectors += each.vectors / 4, squares.marks += each.marks / 4;
    }
    EXPECT_GT(squares.vectors, 0.01) << motion;
    // Not quite the same pixels count beside the walls' edges, in so small a picture.
    EXPECT_NEAR(found[motion].vectors / std::sqrt(squares.vectors), 1, 0.04) << motion;
    EXPECT_NEAR(found[motion].marks / std::sqrt(squares.marks), 1, 0.04) << motion;
  }
}

TEST_F(MeasuredWalls, theMeanIsThatOfTheFourMotions) {
  TemporalError error;
  error.dolly = {1, 10}, error.orbit = {2, 20}, error.roll = {4, 40}, error.object = {9, 90};
  EXPECT_DOUBLE_EQ(error.mean().vectors, 4);
  EXPECT_DOUBLE_EQ(error.mean().marks, 40);
}

TEST_F(MeasuredWalls, frequencyOverTheZoomIsThatOfTheSines) {
  EXPECT_NEAR((*measured)->exampleFrequency.vectors / 0.09, 1, 0.02);
  EXPECT_NEAR((*measured)->exampleFrequency.marks / 0.06, 1, 0.02);
  const struct {
    const char* mode;
    double vectors, marks;  // octaves
  } drifts[] = {{"metatexture", 0.5, 1.5}, {"object", 6, 6}, {"screen", 0, 0}, {"fractal", 1, 0}};
  for (const auto& drift : drifts) {
    const ModeMeasurements& found = mode(drift.mode);
    ASSERT_EQ(found.zoom.size(), 13u);
    // The octaves' marks have their frequency in the middle only, and the framing shows more. What counts
    // deeper than that is how it changes where both pictures show the same.
    double marksAtFraming = 1;
    if (std::string(drift.mode) == "fractal") {
      marksAtFraming = found.zoom[6].frequency.marks / patternOf(drift.mode, true, 1).frequency;
      EXPECT_LT(marksAtFraming, 0.8);
    }
    for (size_t i = 0; i < 13; ++i) {
      const ZoomPoint& point = found.zoom[i];
      const double zoom = std::pow(2, 0.5 * double(i) - 3);
      EXPECT_NEAR(point.zoom, zoom, 1e-9);
      EXPECT_NEAR(std::log2(point.frequency.vectors / patternOf(drift.mode, false, zoom).frequency), 0, 0.15)
          << drift.mode << " " << zoom;
      const double marks = marksAtFraming * patternOf(drift.mode, true, zoom).frequency;
      EXPECT_NEAR(std::log2(point.frequency.marks / marks), 0, 0.15) << drift.mode << " " << zoom;
    }
    EXPECT_NEAR(found.frequencyDrift.vectors, drift.vectors, 0.15) << drift.mode;
    EXPECT_NEAR(found.frequencyDrift.marks, drift.marks, 0.15) << drift.mode;
  }
}

TEST_F(MeasuredWalls, contrastIsRelativeToTheExample) {
  // Heights of 1 at seven zooms and 0.5 at six have the mean 10 / 13; of 1 at seven and 1.1 at six, 13.6
  // / 13.
  const double octaves = 10.0 / 13, marks = 13.6 / 13;
  const struct {
    const char* mode;
    PerField deviation, error;
  } expected[] = {{"metatexture", {0, 1.1 / marks - 1}, {0, 0.1}},
                  {"screen", {0, 0}, {0, 0}},
                  {"fractal", {1 - 0.5 / octaves, 0}, {0.5, 0}}};
  for (const auto& one : expected) {
    const ModeMeasurements& found = mode(one.mode);
    EXPECT_NEAR(found.contrastDeviation.vectors, one.deviation.vectors, 0.03) << one.mode;
    EXPECT_NEAR(found.contrastDeviation.marks, one.deviation.marks, 0.03) << one.mode;
    EXPECT_NEAR(found.contrastError.vectors, one.error.vectors, 0.03) << one.mode;
    EXPECT_NEAR(found.contrastError.marks, one.error.marks, 0.03) << one.mode;
  }
  EXPECT_NEAR(mode("object").zoom[6].contrast.marks, 0.9, 0.03);
}

TEST_F(MeasuredWalls, stereoIsWhatDiffersBetweenTheEyes) {
  EXPECT_NEAR((*measured)->ipd, (kEyeDistance - 1) / 40, 1e-6);
  std::vector<Drawn> both;
  for (const Drawn& call : painter->calls)
    if (call.views.size() == 2 && call.has("warp")) both.push_back(call);
  ASSERT_EQ(both.size(), 4u);
  const std::vector<View>& eyes = both[2].views;
  const auto standsAt = [](const View& view) { return glm::inverse(glm::dmat4(view.worldToEye))[3]; };
  EXPECT_NEAR(standsAt(eyes[1]).x - standsAt(eyes[0]).x, (*measured)->ipd, 1e-5) << "the left one is first";
  for (const std::string& name : kAttached) {
    EXPECT_LT(mode(name).stereo.warp.vectors, kResampling) << name;
    EXPECT_LT(mode(name).stereo.warp.marks, kResampling) << name;
  }
  // What is attached lies where the wall does; what lies on the screen does not.
  for (const std::string& name : kAttached) EXPECT_LT(mode(name).stereo.marksInConflict, 0.05) << name;
  EXPECT_GT(mode("screen").stereo.marksInConflict, 0.5);
  const PerField expected = screenError(eyes[0], eyes[1], 0);
  EXPECT_GT(expected.vectors, 0.1);
  EXPECT_NEAR(mode("screen").stereo.warp.vectors / std::sqrt(expected.vectors), 1, 0.04);
  EXPECT_NEAR(mode("screen").stereo.warp.marks / std::sqrt(expected.marks), 1, 0.04);
  const auto rms = [](const std::array<double, 3>& step) {
    return std::sqrt((step[0] * step[0] + step[1] * step[1] + step[2] * step[2]) / 3);
  };
  for (const ModeMeasurements& each : (*measured)->modes) {
    EXPECT_NEAR(each.stereo.finalShadow, kShadowStep, 1e-3);
    EXPECT_NEAR(each.stereo.color, rms(kColorStep), 1e-3);
    EXPECT_NEAR(each.stereo.finalColor, rms(kFinalStep), 1e-3);
  }
}

// Shares of pairs of levels a distance apart, the four directions together, of sines whose place is anywhere.
std::vector<double> sharesOf(const Pattern& pattern, const Pattern& example, int distance) {
  constexpr int kLevels = 16, kPlaces = 90;
  std::vector<double> shares(kLevels * kLevels);
  // Standard deviation of a product of two cosines: a half of its height. Levels cover 2.5 to either side.
  const double reach = 2.5 * 0.5 * example.height;
  const auto level = [&](double value) {
    return std::clamp(int(std::floor((value + reach) / (2 * reach) * kLevels)), 0, kLevels - 1);
  };
  const int directions[4][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
  for (const auto& direction : directions)
    for (int i = 0; i < kPlaces; ++i)
      for (int j = 0; j < kPlaces; ++j) {
        const double a = 2 * kPi * (i + 0.5) / kPlaces, b = 2 * kPi * (j + 0.5) / kPlaces,
                     step = 2 * kPi * pattern.frequency * distance;
        const int first = level(pattern.height * std::cos(a) * std::cos(b)),
                  second = level(pattern.height * std::cos(a + direction[0] * step) *
                                 std::cos(b + direction[1] * step));
        for (const int at : {first * kLevels + second, second * kLevels + first})
          shares[size_t(at)] += 1.0 / (8 * kPlaces * kPlaces);
      }
  return shares;
}

TEST_F(MeasuredWalls, flatnessIsTheErrorOfPairs) {
  for (const ModeMeasurements& each : (*measured)->modes)
    for (const bool marks : {false, true}) {
      if (marks && each.mode == "fractal") continue;  // they are not the same all over
      const Pattern example = patternOf("screen", marks, 1), pattern = patternOf(each.mode, marks, 1);
      double expected = 0;
      for (const int distance : {1, 2, 4, 8}) {
        const std::vector<double> a = sharesOf(example, example, distance),
                                  b = sharesOf(pattern, example, distance);
        for (size_t i = 0; i < a.size(); ++i) expected += std::abs(a[i] - b[i]) / 8;
      }
      const double found = marks ? each.flatness.marks : each.flatness.vectors;
      EXPECT_NEAR(found, expected, 0.06) << each.mode << (marks ? " marks" : " vectors");
    }
}

// By material; marks are made for a width of their own.
TEST_F(MeasuredWalls, ordinaryMappingIsGivenAsManyCopiesAsMetaTexture) {
  const Look look;
  const double widths = std::get<double>(*look.get("warp.metatexture.size")) /
                        std::get<double>(*look.get("breakup.metatexture.size"));
  // The board covers a small part.
  EXPECT_GT((*measured)->tiles, std::exp2(1.5) * 1.01);
  EXPECT_LT((*measured)->tiles, std::exp2(1.5) * 1.3);
  int seen = 0;
  for (const Drawn& call : painter->calls) {
    if (call.mode != "object") continue;
    ++seen;
    for (const auto& each : {std::pair("Wall", 1.5), {"Board", 3.5}}) {
      const std::string material = each.first;
      const double exponent = each.second;
      const auto tiles = [&](const std::string& of) {
        return std::get<double>(*call.look.get("materials." + material + "." + of + ".metatexture.tiles"));
      };
      EXPECT_NEAR(tiles("warp"), std::exp2(exponent), 1e-4);
      EXPECT_NEAR(tiles("breakup"), widths * std::exp2(exponent), 1e-4);
    }
  }
  EXPECT_GT(seen, 50);
}

TEST_F(MeasuredWalls, octavesAreSummedAsTheirAuthorsDo) {
  for (const Drawn& call : painter->calls)
    for (const char* of : {"warp", "breakup"}) {
      const std::string knob = of + std::string(".metatexture.contrast");
      EXPECT_EQ(std::get<std::string>(*call.look.get(knob)), call.mode == "fractal" ? "off" : "auto");
      EXPECT_EQ(std::get<std::string>(*call.look.get("materials.Wall." + knob)),
                call.mode == "fractal" ? "off" : "auto");
    }
}

TEST_F(MeasuredWalls, fieldsLieOnTheSurfaceAndPicturesAreTheLooksOwn) {
  int fields = 0, pictures = 0, exponents = 0;
  for (const Drawn& call : painter->calls) {
    EXPECT_EQ(settingOf(call.look, "ground.mode"), "off");
    const bool isPicture = call.has("final-shadow");
    ++(isPicture ? pictures : fields);
    EXPECT_EQ(settingOf(call.look, "warp.amount"), isPicture ? "5" : "64");
    EXPECT_EQ(settingOf(call.look, "warp.inflation"), isPicture ? "3" : "0");
    EXPECT_EQ(settingOf(call.look, "warp.distance"), isPicture ? "0.5" : "0");
    if (!call.has("metatexture")) continue;
    ++exponents;
    EXPECT_EQ(settingOf(call.look, "warp.metatexture.base"), "2") << "exponents count doublings";
  }
  EXPECT_GT(fields, 300);
  EXPECT_EQ(pictures, 4);
  EXPECT_EQ(exponents, 1);
}

TEST_F(MeasuredWalls, whatIsSeenOfTheSceneIsCounted) {
  // 5.2 x 3.2 m of the wall at 6 m; the board stands before it.
  const double height = 2 * kEyeDistance * std::tan(kHalfFov), width = height * kWidth / kHeight;
  EXPECT_NEAR((*measured)->visible, 5.2 * 3.2 / (height * width), 0.01);
  EXPECT_EQ(progress.first, progress.second);
  EXPECT_EQ(size_t(progress.first), painter->calls.size());
}

TEST_F(MeasuredWalls, targetsAreThoseOfThePage) {
  const ModeMeasurements &ours = mode("metatexture"), &door = mode("screen");
  const std::vector<MeasureTarget>& targets = (*measured)->targets;
  const auto mean = [](const TemporalError& t) {
    return (t.dolly.vectors + t.orbit.vectors + t.roll.vectors + t.object.vectors) / 4;
  };
  const struct {
    const char* name;
    double value, limit;
  } expected[] = {{"frequency", ours.frequencyDrift.vectors, 1},
                  {"contrast", ours.contrastDeviation.vectors, 0.05},
                  {"warp error", mean(ours.temporal) / mean(door.temporal), 1.0 / 3},
                  {"stereo", ours.stereo.warp.vectors / door.stereo.warp.vectors, 0.2}};
  ASSERT_EQ(targets.size(), 6u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(targets[i].name, expected[i].name);
    EXPECT_DOUBLE_EQ(targets[i].value, expected[i].value);
    EXPECT_DOUBLE_EQ(targets[i].limit, expected[i].limit);
    EXPECT_TRUE(targets[i].isKept());
  }
  // Against the best of those that are as flat and drift as little: ordinary mapping drifts six octaves.
  const ModeMeasurements* best[2] = {};
  for (const char* name : {"screen", "fractal", "object"}) {
    const ModeMeasurements& rival = mode(name);
    if (rival.flatness.vectors > 1.1 * ours.flatness.vectors ||
        rival.frequencyDrift.vectors > 1.1 * ours.frequencyDrift.vectors)
      continue;
    if (!best[0] || mean(rival.temporal) < mean(best[0]->temporal)) best[0] = &rival;
    if (!best[1] || rival.stereo.warp.vectors < best[1]->stereo.warp.vectors) best[1] = &rival;
  }
  ASSERT_TRUE(best[0] && best[1]);
  EXPECT_NE(best[0]->mode, "object");
  EXPECT_EQ(targets[4].name, "warp error, best rival");
  EXPECT_DOUBLE_EQ(targets[4].value, mean(ours.temporal) / mean(best[0]->temporal));
  EXPECT_DOUBLE_EQ(targets[4].limit, 1.1);
  EXPECT_NE(targets[4].meaning.find(best[0]->mode), std::string::npos);
  EXPECT_EQ(targets[5].name, "stereo, best rival");
  EXPECT_DOUBLE_EQ(targets[5].value, ours.stereo.warp.vectors / best[1]->stereo.warp.vectors);
}

}  // namespace
}  // namespace scumble::measuring
