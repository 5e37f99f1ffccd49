#include "scumble/panorama.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/gtc/matrix_transform.hpp>
#include <new>

#include "base/usage.h"
#include "panorama/canvas.h"
#include "panorama/tiling.h"

namespace scumble {

using namespace panorama;

namespace {

bool isParallel(const View& view) {
  return view.eyeToClip[2][3] == 0;
}

Status checkPanorama(const Panorama& panorama, const RenderOptions& options) {
  if (!(panorama.ipd >= 0 && panorama.ipd <= 1e6f))
    return usage("the distance between the eyes is out of range", "give metres, like 0.063");
  if (!(panorama.knobHeight >= 1 && panorama.knobHeight <= 180))
    return usage("a panorama's knobHeight is out of range", "use 1 to 180 degrees");
  if (!(panorama.strip >= 0.5f && panorama.strip <= 15))
    return usage("a panorama's strip is out of range", "use 0.5 to 15 degrees");
  const uint32_t aspect = aspectOf(panorama.kind), least = 16, most = 16384 / aspect;
  const std::string what =
      "a panorama of " + std::to_string(options.width) + "x" + std::to_string(options.height);
  if (options.width != aspect * options.height)
    return usage(what + " has not the aspect of its kind",
                 aspect == 1 ? "use one like 2048x2048" : "use one like 4096x2048");
  if (options.height < least || options.height > most)
    return usage(what + " is out of range",
                 "use a height of " + std::to_string(least) + " to " + std::to_string(most));
  // Those of parts are others.
  for (const auto& [name, format] : options.formats)
    if (!name.empty() && std::find(options.aovs.begin(), options.aovs.end(), name) == options.aovs.end())
      return usage("there is a format for '" + name + "', which is not asked for", "name it in aovs as well");
  if (options.sphere || options.latch || options.drawing)
    return usage("a panorama is drawn without latch, drawing and sphere", "leave them empty");
  return Done{};
}

// What turns the world's places into a level camera's: x right, y up, -z ahead.
glm::mat4 worldToSphere(const View& from) {
  const glm::mat4 back = glm::rotate(glm::mat4(1.0f), headingOf(from), glm::vec3(0, 1, 0));
  const glm::vec3 place(glm::inverse(from.worldToEye)[3]);
  return glm::transpose(back) * glm::translate(glm::mat4(1.0f), -place);
}

// The eyes' views of a part.
std::vector<View> viewsOf(const View& from, const Panorama& panorama, const Tiling& tiling, Place place) {
  const Band& band = tiling.bands[place.band];
  const float longitude = band.longitudeOf(place.part);
  const glm::mat4 toEye(glm::transpose(turnOf(longitude, band.latitude)));
  const glm::vec2 tangents = 0.5f * glm::vec2(band.size) / tiling.pixelsOfRadian;
  std::vector<View> views;
  for (int eye = 0; eye < eyesOf(panorama.kind); ++eye) {
    View view = from;
    view.size = glm::uvec2(0);
    view.rig = 0;
    view.isLevel = true;
    view.worldToEye =
        toEye * glm::translate(glm::mat4(1.0f), -placeOf(longitude, eye == 0 ? -band.eyes : band.eyes)) *
        worldToSphere(from);
    // The depths are the camera's.
    view.eyeToClip[0] = {1 / tangents.x, 0, 0, 0};
    view.eyeToClip[1] = {0, -1 / tangents.y, 0, 0};
    view.eyeToClip[2][0] = view.eyeToClip[2][1] = 0;
    views.push_back(view);
  }
  return views;
}

std::vector<Place> placesOf(const Tiling& tiling, float longitudes) {
  std::vector<Place> places;
  for (size_t b = 0; b < tiling.bands.size(); ++b) {
    const Band& band = tiling.bands[b];
    for (int part = 0; part < band.parts; ++part)
      if (band.parts == 1 ||
          std::abs(band.longitudeOf(part)) - kShareEnds * band.spacing() < 0.5f * longitudes + 0.01f)
        places.push_back({b, part});
  }
  return places;
}

void add(FrameStats& sum, const FrameStats& one) {
  if (sum.passes.empty())
    sum.passes = one.passes;
  else if (sum.passes.size() == one.passes.size())
    for (size_t i = 0; i < one.passes.size(); ++i) {
      sum.passes[i].milliseconds += one.passes[i].milliseconds;
      sum.passes[i].bytesRead += one.passes[i].bytesRead;
      sum.passes[i].bytesWritten += one.passes[i].bytesWritten;
      sum.passes[i].fetches += one.passes[i].fetches;
    }
  sum.gpuMilliseconds += one.gpuMilliseconds;
  sum.cpuMilliseconds += one.cpuMilliseconds;
  sum.readbackMilliseconds += one.readbackMilliseconds;
  sum.uploadMilliseconds += one.uploadMilliseconds;
  sum.setupMilliseconds += one.setupMilliseconds;
  sum.pipelines += one.pipelines;
  sum.writtenPrimitives += one.writtenPrimitives;
  sum.writtenTextures += one.writtenTextures;
  sum.writtenMaterials += one.writtenMaterials;
  sum.triangles = std::max(sum.triangles, one.triangles);
  sum.drawCalls += one.drawCalls;
  sum.deviceBytes = std::max(sum.deviceBytes, one.deviceBytes);
  sum.uploadedBytes += one.uploadedBytes;
  sum.imageBytes = std::max(sum.imageBytes, one.imageBytes);
  sum.imageBytesUnshared = std::max(sum.imageBytesUnshared, one.imageBytesUnshared);
}

// A panorama while it is drawn.
class Work {
 public:
  Work(const Panorama& panorama, const RenderOptions& options)
      : panorama_(panorama),
        options_(options),
        tiling_(tilingOf(panorama, options.height)),
        places_(placesOf(tiling_, glm::radians(longitudesOf(panorama.kind)))) {}

  Result<Frame> draw(Renderer& renderer, const Scene& scene, const Look& look, double time, const View& from);

 private:
  Status add(Frame frame, Place place);
  bool report(size_t done) const {
    return !options_.progress || options_.progress(double(done) / double(places_.size()));
  }

  const Panorama& panorama_;
  const RenderOptions& options_;
  Tiling tiling_;
  std::vector<Place> places_;
  struct Layer {
    std::string name;
    std::vector<Canvas> eyes;
    std::optional<Image> once;  // one for all views, of a size of its own
  };
  std::vector<Layer> layers_;
  Frame whole_;
};

Status Work::add(Frame frame, Place place) {
  scumble::add(whole_.stats, frame.stats);
  if (layers_.empty()) {
    whole_.objects = std::move(frame.objects), whole_.materials = std::move(frame.materials);
    for (Frame::Layer& layer : frame.layers) {
      Layer& own = layers_.emplace_back(Layer{layer.name, {}, {}});
      if (Renderer::hasSizeOfItsOwn(layer.name)) own.once = layer.views.front();
      for (int eye = 0; eye < eyesOf(panorama_.kind); ++eye)
        own.eyes.emplace_back(tiling_, options_.width, options_.height,
                              glm::radians(longitudesOf(panorama_.kind)));
    }
  }
  for (size_t i = 0; i < layers_.size(); ++i)
    for (size_t eye = 0; eye < layers_[i].eyes.size() && !layers_[i].once; ++eye) {
      const Image& image = frame.layers[i].views[eye];
      layers_[i].eyes[eye].add(image, place, carryOf(layers_[i].name, image.isColor));
      const auto format = options_.formats.find(layers_[i].name);
      if (format != options_.formats.end() && format->second == PixelFormat::srgb8 && !image.isColor)
        return usage("the AOV '" + layers_[i].name + "' is no colour", "8-bit codes are for colours only");
    }
  return Done{};
}

Result<Frame> Work::draw(Renderer& renderer, const Scene& scene, const Look& look, double time,
                         const View& from) {
  RenderOptions options = options_;
  options.progress = nullptr;
  // What is put together is so in floats.
  std::erase_if(options.formats, [](const auto& format) { return !Renderer::hasSizeOfItsOwn(format.first); });
  SpherePart& sphere = options.sphere.emplace();
  sphere.knobHeight = glm::radians(panorama_.knobHeight);
  // As many frames are under way as can be; what has been begun is finished, whatever goes wrong.
  std::deque<Place> underWay;
  struct Rest {
    Renderer& renderer;
    std::deque<Place>& underWay;
    ~Rest() {
      for (; !underWay.empty(); underWay.pop_front()) (void)renderer.finish();
    }
  } rest{renderer, underWay};
  std::optional<Error> error;
  size_t next = 0, done = 0;
  while (done < places_.size() && !(error && underWay.empty())) {
    if (!error && next < places_.size() && underWay.size() < size_t(Renderer::kMaxBegun)) {
      const Place place = places_[next];
      const Band& band = tiling_.bands[place.band];
      options.width = band.size.x, options.height = band.size.y;
      sphere.eyeToSphere = turnOf(band.longitudeOf(place.part), band.latitude);
      options.previousViews.clear();
      if (!options_.previousViews.empty())
        options.previousViews = viewsOf(options_.previousViews.front(), panorama_, tiling_, place);
      const Status begun =
          report(done) ? renderer.begin(scene, look, time, viewsOf(from, panorama_, tiling_, place), options)
                       : Status(Error{ErrorKind::cancelled, "", 0, "", "rendering was cancelled", ""});
      if (!begun) error = begun.error();
      if (begun) underWay.push_back(place), ++next;
      continue;
    }
    Result<Frame> frame = renderer.finish();
    const Place place = underWay.front();
    underWay.pop_front();
    ++done;
    if (!frame && !error) error = frame.error();
    if (frame && !error)
      if (const Status added = add(std::move(frame).value(), place); !added) error = added.error();
  }
  if (error) return *error;
  report(done);
  for (Layer& layer : layers_) {
    const auto format = options_.formats.find(layer.name);
    Frame::Layer& own = whole_.layers.emplace_back(Frame::Layer{layer.name, {}});
    if (layer.once)
      own.views.push_back(std::move(*layer.once));
    else
      for (Canvas& eye : layer.eyes)
        own.views.push_back(
            eye.take(format == options_.formats.end() ? PixelFormat::float32 : format->second));
  }
  return std::move(whole_);
}

}  // namespace

Result<PanoramaPlan> planPanorama(const Panorama& panorama, const RenderOptions& options) {
  if (const Status status = checkPanorama(panorama, options); !status) return status.error();
  const Tiling tiling = tilingOf(panorama, options.height);
  PanoramaPlan plan;
  for (const Place& place : placesOf(tiling, glm::radians(longitudesOf(panorama.kind)))) {
    const glm::uvec2 size = tiling.bands[place.band].size;
    ++plan.frames;
    plan.pixels += uint64_t(size.x) * size.y * uint64_t(eyesOf(panorama.kind));
  }
  return plan;
}

Result<Frame> renderPanorama(Renderer& renderer, const Scene& scene, const Look& look, double time,
                             const View& from, const Panorama& panorama, const RenderOptions& options) {
  if (const Status status = checkPanorama(panorama, options); !status) return status.error();
  if (renderer.framesBegun() > 0)
    return usage("a frame of the renderer is under way", "finish() it before a panorama");
  if (isParallel(from))
    return usage("a camera without perspective stands nowhere", "use a perspective one for a panorama");
  if (options.previousViews.size() > 1)
    return usage("a panorama has one camera", "give its view a frame earlier, or none at all");
  if (!options.previousViews.empty() && isParallel(options.previousViews.front()))
    return usage("a camera without perspective stands nowhere", "use a perspective one for a panorama");
  try {
    return Work(panorama, options).draw(renderer, scene, look, time, from);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::noUsableGpu, "", 0, "", "there is not enough memory", "use a smaller picture"};
  }
}

}  // namespace scumble
