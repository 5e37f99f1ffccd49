// Measuring a scene: which frames are rendered, and what is asked of them. It knows the renderer by its
// public face only. It is one thing, though long: every measure is a list of frames and what is asked of
// them.
#include "scumble/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "base/usage.h"
#include "measure/cooccurrence.h"
#include "measure/field.h"
#include "measure/magnify.h"
#include "measure/mark_lives.h"
#include "measure/measurer.h"
#include "measure/reprojection.h"
#include "measure/statistics.h"
#include "measure/vergence.h"

namespace scumble {

using namespace measuring;

PerField TemporalError::mean() const {
  return {(dolly.vectors + orbit.vectors + roll.vectors + object.vectors) / 4,
          (dolly.marks + orbit.marks + roll.marks + object.marks) / 4};
}

namespace {

constexpr const char* kModes[] = {"metatexture", "object", "screen", "fractal"};
constexpr int kModeCount = 4;

// Steps of a steady move at 24 frames a second.
constexpr int kMotions = 4, kStepsAPath = 4;
constexpr float kDollyStep = 0.02f;                                     // of the distance
constexpr float kOrbitStep = 1, kRollStep = 1, kObjectTurnStep = 0.5f;  // degrees
constexpr float kObjectStep = 0.01f;                                    // of the picture's width

constexpr int kZooms = 13, kFraming = 6;  // half octaves from 1/8 to 8; the one that is the framing
double zoomAt(int i) {
  return std::exp2(0.5 * (i - kFraming));
}
// A small region holds few marks: more seeds make up for it.
int seedsAt(int i) {
  return std::clamp(int(std::lround(2 / zoomAt(i))), 4, 16);
}

constexpr int kMarkZooms = 6;  // in an octave
constexpr float kAmount = 64;  // px at 1080 lines: the most that the knob takes
constexpr int kExampleSeeds = 4;
constexpr size_t kMostMaterials = 64;  // that ordinary mapping has a density of its own for
constexpr size_t kFewestPixels = 16;
constexpr double kAsGood = 1.1;  // a tenth is what two measurements may differ by

Error cannotFollow() {
  return usage("the surface cannot be followed from frame to frame: too little of it is away from edges",
               "use a larger --size, or a camera that sees more of the scene");
}

// What MetaTexture puts on the surface, of one frame.
struct Fields {
  Field vectors, marks;
};

// The same numbers for both.
template <class Of>
PerField perField(const Of& of) {
  return {of(&Fields::vectors), of(&Fields::marks)};
}

std::vector<Field> membersOf(const std::vector<Fields>& all, Field Fields::*member) {
  std::vector<Field> fields;
  for (const Fields& each : all) fields.push_back(each.*member);
  return fields;
}

// Turns vectors on the screen (y down) clockwise.
void turn(Field& vectors, float radians) {
  const float c = std::cos(radians), s = std::sin(radians);
  for (size_t pixel = 0; pixel < vectors.pixelCount(); ++pixel) {
    float* v = vectors.at(pixel);
    const float x = v[0], y = v[1];
    v[0] = c * x - s * y, v[1] = s * x + c * y;
  }
}

// A triangle that fills the square from -1 to 1: on it, mode `screen` shows the example flat.
constexpr const char* kSheet = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3,
                 "min": [-1, -1, 0], "max": [3, 3, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAABAQAAAgL8AAAAAAACAvwAAQEAAAAAA"}]})";

class Measurer {
 public:
  Measurer(const Draw& draw, const Scene& scene, const Look& look, const MeasureOptions& options)
      : draw_(draw), scene_(scene), look_(look), options_(options) {}

  Result<Measurements> run() {
    if (const Status status = frameScene(); !status) return status.error();
    if (const Status status = measureExample(); !status) return status.error();
    for (const char* mode : kModes) result_.modes.emplace_back().mode = mode;
    if (const Status status = findPlaces(); !status) return status.error();
    for (ModeMeasurements& mode : result_.modes)
      for (const auto step : {&Measurer::measureMotion, &Measurer::measureZoom, &Measurer::measureStereo,
                              &Measurer::measureMarks})
        if (const Status status = (this->*step)(mode); !status) return status.error();
    compareWithTargets();
    return result_;
  }

 private:
  // The look in one of the modes. For the fields themselves the surface is neither inflated nor torn less
  // with distance.
  Result<Look> lookOf(const std::string& mode, bool fieldsOnly) const {
    Look look = look_;
    std::vector<std::pair<std::string, std::string>> settings{{"ground.mode", "off"}};
    const auto everywhere = [&](const std::string& knob, const std::string& value) {
      settings.emplace_back(knob, value);
      settings.emplace_back("materials.*." + knob, value);
    };
    for (const std::string of : {"warp.metatexture.", "breakup.metatexture."}) {
      everywhere(of + "mode", mode);
      // Rivals as their authors have them: octaves are summed, and a texture has a density for each material.
      if (mode == "fractal") everywhere(of + "contrast", "off");
      if (mode != "object") continue;
      const auto tiles = [&](const std::string& materials, double ofVectors) {
        double copies = ofVectors;
        if (of == "breakup.metatexture.")
          copies *= sizeOf(materials + "warp.metatexture.") / sizeOf(materials + of);
        return fmt::format("{:f}", std::clamp(copies, 0.01, 10000.0));  // the knob's range
      };
      everywhere(of + "tiles", tiles("", result_.tiles));
      for (const auto& [material, ofVectors] : tilesOf_)
        settings.emplace_back("materials." + material + "." + of + "tiles",
                              tiles("materials." + material + ".", ofVectors));
    }
    if (fieldsOnly) {
      everywhere("warp.inflation", "0");
      everywhere("warp.distance", "0");
      everywhere("warp.amount", std::to_string(kAmount));
    }
    for (const auto& [path, value] : settings)
      if (const Status status = look.set(path, value); !status) return status.error();
    return look;
  }

  // The width of the example on the screen.
  double sizeOf(const std::string& block) const {
    const Result<KnobValue> size = look_.get(block + "size");
    return size ? std::get<double>(*size) : 1;
  }

  // Channels of a picture at pixels of the scene's own nodes: not of what features draw, which may move by
  // itself and be torn less with distance.
  Field fieldIn(const Frame& frame, const Image& image, uint32_t first, uint32_t count, size_t view,
                float scale = 1) const {
    const Image& id = layer(frame, "id", view);
    Field field = fieldOf(image, first, count, id, 0, scale);
    const Field numbers = fieldOf(id, 0, 1, id, 0);
    for (size_t pixel = 0; pixel < field.pixelCount(); ++pixel)
      if (numbers.values[pixel] > nodes_) field.valid[pixel] = 0;
    return field;
  }

  Fields fieldsOf(const Frame& frame, size_t view = 0) const {
    const Image& warp = layer(frame, "warp", view);
    Fields fields{fieldIn(frame, warp, 0, 2, view, 1080.0f / (kAmount * float(warp.height))),
                  fieldIn(frame, warp, 2, 1, view)};
    const Field depth = fieldOf(warp, 3, 1, warp, 3);
    for (size_t pixel = 0; pixel < depth.pixelCount(); ++pixel) {
      const float* vector = fields.vectors.at(pixel);
      fields.marks.valid[pixel] &= depth.valid[pixel];
      // Where _WARP or a material's amount is 0 there is nothing to measure.
      fields.vectors.valid[pixel] &= depth.valid[pixel] && (vector[0] != 0 || vector[1] != 0);
    }
    fields.vectors.depth = fields.marks.depth = depth.values;
    return fields;
  }

  Surface surfaceOf(const Frame& frame, const View& view, size_t index = 0) const {
    const glm::mat4& projection = view.eyeToClip;
    const Image& position = layer(frame, "position", index);
    return {fieldIn(frame, position, 0, 3, index), fieldIn(frame, layer(frame, "depth", index), 0, 1, index),
            2 / (std::abs(projection[1][1]) * float(position.height)), projection[2][3] == 0};
  }

  Result<Frame> render(const Scene& scene, const Look& look, const std::vector<View>& views,
                       std::vector<std::string> aovs, int seed = 0, const std::vector<View>& previous = {}) {
    RenderOptions frame;
    frame.width = options_.width, frame.height = options_.height;
    frame.samples = options_.samples;
    frame.aovs = std::move(aovs);
    frame.positionsFrom = scene.origin();
    frame.seed = options_.seed + uint32_t(seed);
    frame.previousViews = previous;
    Result<Frame> rendered = draw_(scene, look, views, frame);
    if (rendered && options_.progress && !options_.progress(++done_, total()))
      return Error{ErrorKind::cancelled, "", 0, "", "measuring was cancelled", ""};
    return rendered;
  }

  int total() const {
    int zoomFrames = 0;
    for (int i = 0; i < kZooms; ++i) zoomFrames += seedsAt(i);
    const int motionFrames = 1 + kMotions * kStepsAPath;
    return 1 + int(materials_.size()) + kExampleSeeds + motionFrames +
           kModeCount * (motionFrames + zoomFrames + 2 + 2 * kMarkZooms);
  }

  Status frameScene() {
    const float aspect = float(options_.width) / float(options_.height);
    const Result<std::vector<View>> views =
        makeViews(scene_, options_.viewpoint, aspect, Stereo::mono, 0, look_);
    if (!views) return views.error();
    view_ = views->front();
    // Its paths are the only motion.
    view_.node = -1;
    const SceneSummary summary = scene_.summary();
    nodes_ = float(summary.nodes);
    materials_ = {summary.materialNames.begin(), summary.materialNames.end()};
    materials_.erase("");
    if (materials_.size() < 2 || materials_.size() > kMostMaterials) materials_.clear();
    centre_ = centreOf(scene_);
    distance_ = glm::length(glm::vec3(view_.worldToEye * glm::vec4(centre_, 1)));
    result_.ipd = options_.ipd.value_or(distance_ / 40);

    // How many copies MetaTexture lays on a unit of uv, where it doubles from one level to the next.
    Result<Look> look = lookOf("metatexture", true);
    if (!look) return look.error();
    for (const char* knob : {"warp.metatexture.base", "materials.*.warp.metatexture.base"})
      if (const Status status = look->set(knob, "2"); !status) return status.error();
    const Result<Frame> frame = render(scene_, *look, {view_}, {"id", "metatexture"});
    if (!frame) return frame.error();
    const Field exponents = fieldIn(*frame, layer(*frame, "metatexture"), 0, 2, 0);
    const size_t seen = exponents.validCount();
    if (seen < kFewestPixels)
      return usage("this view shows next to nothing of the scene", "choose another camera");
    const auto copies = [&](const Field& counts) {
      double sum = 0;
      size_t pixels = 0;
      for (size_t pixel = 0; pixel < exponents.pixelCount(); ++pixel)
        if (exponents.valid[pixel] && counts.valid[pixel])
          sum += exponents.at(pixel)[0] + exponents.at(pixel)[1], ++pixels;
      return pixels < kFewestPixels ? 0 : std::exp2(sum / (2 * double(pixels)));
    };
    result_.tiles = copies(exponents);
    result_.visible = double(seen) / double(exponents.pixelCount());
    zoomCentre_ = zoomCentre(exponents, int(zoomAt(kZooms - 1)));

    // The same by material: what shows vectors where no other has any.
    for (const std::string& material : materials_) {
      // A name that is a pattern would mean others as well.
      if (material.find_first_of("*?") != std::string::npos) continue;
      Result<Look> alone = lookOf("metatexture", true);
      if (!alone) return alone.error();
      if (const Status status = alone->set("materials.*.warp.amount", "0"); !status) return status.error();
      const bool isPath = bool(alone->set("materials." + material + ".warp.amount", std::to_string(kAmount)));
      const Result<Frame> its = render(scene_, *alone, {view_}, {"warp", "id"});
      if (!its) return its.error();
      const double tiles = isPath ? copies(fieldsOf(*its).vectors) : 0;
      if (tiles > 0) tilesOf_.emplace_back(material, tiles);
    }
    return Done{};
  }

  Status measureExample() {
    const std::string json = kSheet;
    const Result<Scene> sheet = Scene::loadFromMemory(json.data(), json.size(), "sheet", "");
    if (!sheet) return sheet.error();
    const Result<Look> look = lookOf("screen", true);
    if (!look) return look.error();
    View view;
    const float aspect = float(options_.width) / float(options_.height);
    view.worldToEye = glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -1));
    view.eyeToClip = orthographicProjection(std::min(1.0f, 1 / aspect), aspect, 0.1f, 10);
    for (int seed = 0; seed < kExampleSeeds; ++seed) {
      const Result<Frame> frame = render(*sheet, *look, {view}, {"warp", "id"}, seed);
      if (!frame) return frame.error();
      example_.push_back(fieldsOf(*frame));
    }
    result_.exampleFrequency =
        perField([&](Field Fields::*member) { return dominantFrequency(membersOf(example_, member)); });
    exampleSpread_ = perField([&](Field Fields::*member) { return spread(membersOf(example_, member)); });
    markLevel_ = float(meanOf(membersOf(example_, &Fields::marks))[0] + 0.25 * exampleSpread_.marks);
    return Done{};
  }

  // The view after so many steps along a path; the path of an object moves the scene before the standing
  // camera.
  View moved(int motion, int step) const {
    const float n = float(step);
    const glm::mat4 one(1.0f);
    View view = view_;
    switch (motion) {
      case 0:
        view.worldToEye = glm::translate(one, glm::vec3(0, 0, n * kDollyStep * distance_)) * view.worldToEye;
        break;
      case 1:
        view.worldToEye = view.worldToEye * turnAbout(centre_, n * kOrbitStep);
        break;
      case 2:
        view.worldToEye = glm::rotate(one, glm::radians(n * kRollStep), glm::vec3(0, 0, 1)) * view.worldToEye;
        break;
      default:
        // Sideways by a part of the picture's width, which is 2 w / P00 at clip w.
        const float w = (view.eyeToClip * view.worldToEye * glm::vec4(centre_, 1)).w;
        const float sideways = n * kObjectStep * 2 * w / view.eyeToClip[0][0];
        view.worldToEye = glm::translate(one, glm::vec3(sideways, 0, 0)) * view.worldToEye *
                          turnAbout(centre_, n * kObjectTurnStep);
    }
    return view;
  }

  // What moves does so alike in every mode.
  Status findPlaces() {
    const Result<Look> look = lookOf("metatexture", true);
    if (!look) return look.error();
    const std::vector<std::string> facts{"position", "depth", "id", "motion"};
    const Result<Frame> start = render(scene_, *look, {view_}, facts);
    if (!start) return start.error();
    for (int motion = 0; motion < kMotions; ++motion) {
      Surface earlier = surfaceOf(*start, view_);
      for (int step = 1; step <= kStepsAPath; ++step) {
        const Result<Frame> frame =
            render(scene_, *look, {moved(motion, step)}, facts, 0, {moved(motion, step - 1)});
        if (!frame) return frame.error();
        Surface now = surfaceOf(*frame, view_);
        const Field pixels = fieldOf(layer(*frame, "motion"), 0, 2, layer(*frame, "id"), 0);
        places_[size_t(motion)].push_back(placesByMotion(pixels, now, earlier));
        if (places_[size_t(motion)].back().validCount() < kFewestPixels) return cannotFollow();
        earlier = std::move(now);
      }
    }
    return Done{};
  }

  Status measureMotion(ModeMeasurements& mode) {
    const Result<Look> look = lookOf(mode.mode, true);
    if (!look) return look.error();
    const Result<Frame> start = render(scene_, *look, {view_}, {"warp", "id"});
    if (!start) return start.error();
    PerField* const errors[kMotions] = {&mode.temporal.dolly, &mode.temporal.orbit, &mode.temporal.roll,
                                        &mode.temporal.object};
    for (int motion = 0; motion < kMotions; ++motion) {
      Fields earlier = fieldsOf(*start);
      PerField& error = *errors[motion];
      for (int step = 1; step <= kStepsAPath; ++step) {
        const Result<Frame> frame = render(scene_, *look, {moved(motion, step)}, {"warp", "id"});
        if (!frame) return frame.error();
        Fields now = fieldsOf(*frame);
        // The camera's roll turns what is attached to the surface, and with it the vectors. Eye space has y
        // up, the screen y down.
        if (motion == 2) turn(earlier.vectors, -glm::radians(kRollStep));
        const Places& places = places_[size_t(motion)][size_t(step - 1)];
        const auto errorOf = [&](Field Fields::*member) {
          return std::pow(difference(sampleAt(earlier.*member, places), now.*member).relative, 2) /
                 kStepsAPath;
        };
        error.vectors += errorOf(&Fields::vectors);
        error.marks += errorOf(&Fields::marks);
        earlier = std::move(now);
      }
      error = {std::sqrt(error.vectors), std::sqrt(error.marks)};
    }
    return Done{};
  }

  Status measureZoom(ModeMeasurements& mode) {
    const Result<Look> look = lookOf(mode.mode, true);
    if (!look) return look.error();
    // Both fields, and the number of each.
    constexpr std::pair<Field Fields::*, double PerField::*> kFields[] = {
        {&Fields::vectors, &PerField::vectors}, {&Fields::marks, &PerField::marks}};
    // Frequency in the part of the picture before that this one shows, where it is deeper than the framing.
    PerField frequencyBefore;
    for (int i = 0; i < kZooms; ++i) {
      const View view = magnified(view_, float(zoomAt(i)), zoomCentre_);
      std::vector<Fields> samples;
      for (int seed = 0; seed < seedsAt(i); ++seed) {
        const Result<Frame> frame = render(scene_, *look, {view}, {"warp", "id"}, seed);
        if (!frame) return frame.error();
        samples.push_back(fieldsOf(*frame));
      }
      ZoomPoint point;
      point.zoom = zoomAt(i);
      for (const auto& [member, number] : kFields) {
        std::vector<Field> fields = membersOf(samples, member);
        point.frequency.*number = dominantFrequency(fields);
        point.contrast.*number = exampleSpread_.*number > 0 ? spread(fields) / exampleSpread_.*number : 0;
        if (i == kFraming) mode.flatness.*number = cooccurrenceError(membersOf(example_, member), fields);
        if (i > kFraming && frequencyBefore.*number > 0)
          point.frequency.*number *= mode.zoom.back().frequency.*number / (frequencyBefore.*number);
        if (i < kFraming) continue;
        for (Field& field : fields) keepMagnified(field, zoomAt(i + 1) / zoomAt(i), zoomCentre_);
        frequencyBefore.*number = dominantFrequency(fields);
      }
      mode.zoom.push_back(point);
    }
    for (double PerField::*number : {&PerField::vectors, &PerField::marks}) {
      double lowest = 0, highest = 0, mean = 0, farthest = 0;
      for (const ZoomPoint& point : mode.zoom) {
        const double frequency = point.frequency.*number;
        if (frequency > 0 && (lowest == 0 || frequency < lowest)) lowest = frequency;
        highest = std::max(highest, frequency);
        mean += point.contrast.*number / kZooms;
      }
      for (const ZoomPoint& point : mode.zoom) {
        farthest = std::max(farthest, std::abs(point.contrast.*number - mean));
        mode.contrastError.*number =
            std::max(mode.contrastError.*number, std::abs(point.contrast.*number - 1));
      }
      mode.frequencyDrift.*number = lowest > 0 ? std::log2(highest / lowest) : 0;
      mode.contrastDeviation.*number = mean > 0 ? farthest / mean : 0;
    }
    return Done{};
  }

  Status measureStereo(ModeMeasurements& mode) {
    std::vector<View> eyes(2, view_);
    for (size_t i = 0; i < 2; ++i)
      eyes[i].worldToEye =
          glm::translate(glm::mat4(1.0f), glm::vec3((i == 0 ? 0.5f : -0.5f) * float(result_.ipd), 0, 0)) *
          view_.worldToEye;
    const Result<Look> fieldLook = lookOf(mode.mode, true), own = lookOf(mode.mode, false);
    if (!fieldLook) return fieldLook.error();
    if (!own) return own.error();
    const Result<Frame> fields = render(scene_, *fieldLook, eyes, {"warp", "position", "depth", "id"});
    if (!fields) return fields.error();
    const Result<Frame> pictures = render(scene_, *own, eyes, {"final-shadow", "color"});
    if (!pictures) return pictures.error();

    const Surface left = surfaceOf(*fields, eyes[0], 0), right = surfaceOf(*fields, eyes[1], 1);
    const Places places = placesByProjection(right, left, eyes[0].eyeToClip * eyes[0].worldToEye);
    if (places.validCount() < kFewestPixels) return cannotFollow();
    const Fields inLeft = fieldsOf(*fields, 0), inRight = fieldsOf(*fields, 1);
    mode.stereo.warp = perField([&](Field Fields::*member) {
      return difference(sampleAt(inLeft.*member, places), inRight.*member).relative;
    });
    const auto differenceOf = [&](const char* name, uint32_t channels) {
      const auto shown = [&](size_t view) {
        return fieldIn(*fields, layer(*pictures, name, view), 0, channels, view);
      };
      // rms of a channel, so that one and three can be compared.
      return difference(sampleAt(shown(0), places), shown(1)).rms / std::sqrt(double(channels));
    };
    mode.stereo.finalShadow = differenceOf("final-shadow", 1);
    mode.stereo.color = differenceOf("color", 3);
    mode.stereo.finalColor = differenceOf("", 3);
    mode.stereo.marksInConflict = vergenceOf(inLeft.marks, inRight.marks, places).share();
    const auto luminance = [&](size_t view) {
      Field colors = fieldIn(*fields, layer(*pictures, "", view), 0, 3, view);
      Field field(colors.width, colors.height, 1);
      field.valid = colors.valid;
      for (size_t pixel = 0; pixel < field.pixelCount(); ++pixel) {
        const float* const c = colors.at(pixel);
        *field.at(pixel) = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
      }
      return field;
    };
    mode.stereo.pictureInConflict = vergenceOf(luminance(0), luminance(1), places).share();
    return Done{};
  }

  Status measureMarks(ModeMeasurements& mode) {
    const Result<Look> look = lookOf(mode.mode, true);
    if (!look) return look.error();
    // From several zooms on, since scales change at some.
    MarkCount all;
    for (int i = 0; i < kMarkZooms; ++i) {
      Field shown[2];
      for (int k = 0; k < 2; ++k) {
        const View view = magnified(view_, std::exp2(float(i) / kMarkZooms + float(k)), zoomCentre_);
        const Result<Frame> frame = render(scene_, *look, {view}, {"warp", "id"});
        if (!frame) return frame.error();
        shown[k] = fieldsOf(*frame).marks;
      }
      const MarkCount count = countMarks(shown[0], shown[1], 2, zoomCentre_, markLevel_);
      all.marksBefore += count.marksBefore, all.died += count.died;
      all.marksAfter += count.marksAfter, all.born += count.born;
    }
    const auto share = [](size_t some, size_t of) { return of > 0 ? double(some) / double(of) : 0.0; };
    mode.marks = {share(all.born, all.marksAfter), share(all.died, all.marksBefore)};
    return Done{};
  }

  // A rival that is worse in flatness or drift pays with those for what else it is better in.
  bool isAsGood(const ModeMeasurements& rival) const {
    const ModeMeasurements& ours = result_.modes[0];
    return rival.flatness.vectors <= kAsGood * ours.flatness.vectors &&
           rival.frequencyDrift.vectors <= kAsGood * ours.frequencyDrift.vectors;
  }

  void compareWithTargets() {
    const ModeMeasurements &ours = result_.modes[0], &showerDoor = result_.modes[2];
    const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0; };
    result_.targets = {
        {"frequency", "octaves that the screen frequency drifts over a 64x zoom", ours.frequencyDrift.vectors,
         1},
        {"contrast", "contrast over a 64x zoom, from its mean", ours.contrastDeviation.vectors, 0.05},
        {"warp error", "warp error relative to the shower door's",
         ratio(ours.temporal.mean().vectors, showerDoor.temporal.mean().vectors), 1.0 / 3},
        {"stereo", "stereo difference of the warp relative to the shower door's",
         ratio(ours.stereo.warp.vectors, showerDoor.stereo.warp.vectors), 0.2}};
    const auto against = [&](const char* name, const char* what, const auto& numberOf) {
      const ModeMeasurements* best = nullptr;
      for (size_t i = 1; i < result_.modes.size(); ++i)
        if (isAsGood(result_.modes[i]) && (!best || numberOf(result_.modes[i]) < numberOf(*best)))
          best = &result_.modes[i];
      if (best)
        result_.targets.push_back({name, what + (" relative to that of " + best->mode),
                                   ratio(numberOf(ours), numberOf(*best)), kAsGood});
    };
    against("warp error, best rival", "warp error",
            [](const ModeMeasurements& m) { return m.temporal.mean().vectors; });
    against("stereo, best rival", "stereo difference",
            [](const ModeMeasurements& m) { return m.stereo.warp.vectors; });
  }

  const Draw& draw_;
  const Scene& scene_;
  const Look& look_;
  const MeasureOptions& options_;
  Measurements result_;
  int done_ = 0;

  View view_;
  float nodes_ = 0;  // of the scene; greater numbers are those of features
  std::set<std::string> materials_;
  std::vector<std::pair<std::string, double>> tilesOf_;  // by material: copies a unit of uv, of vectors
  glm::vec3 centre_{0.0f};                               // the scene's, world
  float distance_ = 0;                                   // from the eye to it, metres
  glm::vec2 zoomCentre_{0.0f};
  std::vector<Fields> example_;
  PerField exampleSpread_;
  float markLevel_ = 0;                               // what is above it is a mark
  std::array<std::vector<Places>, kMotions> places_;  // for each step of each motion
};

}  // namespace

const Image& measuring::layer(const Frame& frame, const char* name, size_t view) {
  for (const Frame::Layer& l : frame.layers)
    if (l.name == name) return l.views[view];
  return frame.layers.front().views[view];
}

glm::vec3 measuring::centreOf(const Scene& scene) {
  const SceneSummary summary = scene.summary();
  glm::vec3 centre;
  for (int i = 0; i < 3; ++i) centre[i] = float(0.5 * (summary.min[i] + summary.max[i]) - scene.origin()[i]);
  return centre;
}

glm::mat4 measuring::turnAbout(const glm::vec3& place, float degrees) {
  const glm::mat4 one(1.0f);
  return glm::translate(one, place) * glm::rotate(one, glm::radians(degrees), glm::vec3(0, 1, 0)) *
         glm::translate(one, -place);
}

Status measuring::checkMeasuring(const Scene& scene, const MeasureOptions& options) {
  if (scene.empty()) return usage("the scene is empty", "load one with Scene::load");
  if (options.width < 16 || options.height < 16 || options.width > 4096 || options.height > 4096)
    return usage("a picture of " + std::to_string(options.width) + "x" + std::to_string(options.height) +
                     " cannot be measured",
                 "use 16x16 to 4096x4096");
  if (options.ipd && !(std::isfinite(*options.ipd) && *options.ipd > 0 && *options.ipd <= 1e6f))
    return usage("the distance between the eyes is not above zero", "give it in metres");
  return Done{};
}

Result<Measurements> measuring::measureWith(const Draw& draw, const Scene& scene, const Look& look,
                                            const MeasureOptions& options) {
  return Measurer(draw, scene, look, options).run();
}

Result<Measurements> measure(Renderer& renderer, const Scene& scene, const Look& look,
                             const MeasureOptions& options) {
  if (const Status status = checkMeasuring(scene, options); !status) return status.error();
  const Draw draw = [&](const Scene& drawn, const Look& with, const std::vector<View>& views,
                        const RenderOptions& frame) { return renderer.render(drawn, with, 0, views, frame); };
  return measureWith(draw, scene, look, options);
}

}  // namespace scumble
