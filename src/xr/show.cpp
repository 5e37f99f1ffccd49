#include "xr/show.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "xr/failure.h"
#include "xr/session.h"
#include "xr/walk.h"

namespace scumble::xr {

namespace {

constexpr float kNearPlane = 0.05f;   // metres of the room
constexpr float kEyeHeight = 1.6f;    // metres of the room
constexpr double kLongestStep = 0.1;  // seconds of walking at once, however late a frame is
constexpr double kDarkening = 0.1;    // seconds
constexpr auto kRest = std::chrono::milliseconds(10);
constexpr auto kPatience = std::chrono::minutes(1);
constexpr size_t kUnderWay = 2;  // frames that the device may have at once: it need not wait for the CPU

class Show {
 public:
  explicit Show(const ShowOptions& options) : options_(options) {}

  Result<ShowReport> run() {
    Result<std::unique_ptr<Instance>> instance = Instance::create();
    if (!instance) return instance.error();
    instance_ = std::move(instance).value();
    instance_->findHeadset();
    Result<std::unique_ptr<Renderer>> renderer = createRenderer(instance_->vulkan(), options_.renderer);
    if (!renderer) return renderer.error();
    renderer_ = std::move(renderer).value();
    do {
      const Status status = runSession();
      if (!status) return status.error();
    } while (isLost_ && findAgain());
    report_.validationMessages = renderer_->validationMessages();
    return report_;
  }

 private:
  struct FramesEnd {
    Show& show;
    ~FramesEnd() { (void)show.finish(0); }
  };

  bool isEnding() const {
    return (options_.frames && report_.frames >= *options_.frames) ||
           (options_.isEnding && options_.isEnding());
  }
  void tell(const std::string& line) const {
    if (options_.tell) options_.tell(line);
  }

  // Waits for a headset that was lost. Throws XrFailure where it does not come.
  bool findAgain() {
    tell("the headset was lost; waiting for it");
    for (const auto start = std::chrono::steady_clock::now();;) {
      if (isEnding()) return false;
      try {
        instance_->findHeadset();
        return true;
      } catch (const XrFailure& failure) {
        const bool comesBack = failure.result() == XR_ERROR_FORM_FACTOR_UNAVAILABLE;
        if (!comesBack || std::chrono::steady_clock::now() - start > kPatience) throw;
      }
      std::this_thread::sleep_for(kRest);
    }
  }

  Status runSession() {
    Status status = Done{};
    try {
      Session session(*instance_, vulkanDeviceOf(*renderer_),
                      {options_.isStanding, options_.refreshRate, options_.hasVignette});
      const FramesEnd end{*this};  // before its images go
      status = runFrames(session);
      isLost_ = session.isLost();
    } catch (const XrFailure& failure) {
      if (failure.result() != XR_ERROR_SESSION_LOST) throw;
      isLost_ = true;
    }
    return status;
  }

  Status runFrames(Session& session) {
    tell(instance_->headset() + " on " + instance_->runtime() + ": twice " +
         std::to_string(session.size().x) + "x" + std::to_string(session.size().y) +
         (session.refreshRate() > 0 ? " at " + std::to_string(int(session.refreshRate() + 0.5f)) + " Hz"
                                    : ""));
    for (bool isAsked = false; !session.isOver() && !session.isLost();) {
      // Whoever recentres wants to be where the camera is.
      if (session.follow().isRecentred) walk_.reset();
      if (!isAsked && isEnding()) {
        session.requestEnd();
        isAsked = true;
      }
      if (!session.isRunning()) {
        std::this_thread::sleep_for(kRest);
        continue;
      }
      Moment moment = session.begin();
      // In any case a frame that was begun is ended.
      Result<bool> drawn = false;
      if (moment.shouldRender && moment.isPlaced && !isAsked) drawn = draw(session, moment);
      session.end(moment, drawn && *drawn, darkness_);
      if (!drawn) return drawn.error();
      if (*drawn) ++report_.frames;
    }
    return Done{};
  }

  // When it is in the scene, which stands still while somebody pauses it or does not wear the headset.
  double timeAt(const Session& session, const HandsState& hands, XrTime display) {
    isPaused_ = isPaused_ != hands.pauses;
    if (!lastDisplay_) lastDisplay_ = display;
    if (isPaused_ || !session.isWorn()) stood_ += display - *lastDisplay_;
    lastDisplay_ = display;
    if (!firstDisplay_) firstDisplay_ = display;
    return options_.time + double(display - *firstDisplay_ - stood_) * 1e-9;
  }

  const Look& chosenLook(const HandsState& hands) {
    if (hands.nextLook) {
      look_ = (look_ + 1) % options_.looks.size();
      tell("look: " + options_.looks[look_].first);
    }
    return options_.looks[look_].second;
  }

  Result<bool> draw(Session& session, Moment& moment) {
    const double sinceLast = lastDisplay_ ? double(moment.display - *lastDisplay_) * 1e-9 : 0;
    const HandsState hands = session.hands();
    const double time = timeAt(session, hands, moment.display);
    const Look& look = chosenLook(hands);
    const Result<std::vector<View>> camera =
        makeViews(options_.scene, options_.viewpoint, 1, Stereo::mono, 0, look, time);
    if (!camera) return camera.error();
    const Stand origin = standAt(camera->front(), options_.scale, options_.isStanding ? kEyeHeight : 0);
    walk_.go(origin, between(moment.eyes[0].pose, moment.eyes[1].pose), hands.steering,
             float(std::min(sinceLast, kLongestStep)));
    const Stand stand = walk_.on(origin);
    // It comes and goes within a quarter of a second or so; what is not seen is not drawn.
    darkness_ += (walk_.motion() - darkness_) * float(1 - std::exp(-sinceLast / kDarkening));
    if (darkness_ < 0.01f) darkness_ = 0;
    const auto viewsOf = [&](const Moment& seen) {
      std::vector<View> views;
      for (const Eye& eye : seen.eyes) {
        View& view = views.emplace_back(viewOf(stand, eye.pose, eye.angles, kNearPlane * stand.scale));
        view.node = camera->front().node;
        view.isLevel = true;
      }
      return views;
    };
    RenderOptions options;
    options.width = session.size().x, options.height = session.size().y;
    options.samples = options_.samples, options.seed = options_.seed;
    // What is shown is told with the eyes that it was drawn from.
    options.latch = [&](std::vector<View>& views) {
      Moment latest = moment;
      if (!session.locate(latest)) return;
      moment = latest;
      views = viewsOf(moment);
    };
    if (const Status status = finish(kUnderWay - 1); !status) return status.error();
    VulkanTargets targets;
    targets.images = session.acquire();
    if (const Status status =
            scumble::begin(*renderer_, options_.scene, look, time, viewsOf(moment), options, targets);
        !status)
      return status.error();
    ++begun_;
    return true;
  }

  // Until no more than so many frames are under way.
  Status finish(size_t most) {
    for (; begun_ > most; --begun_)
      if (const Result<Frame> frame = renderer_->finish(); !frame) {
        begun_ = 0;
        return frame.error();
      }
    return Done{};
  }

  const ShowOptions& options_;
  // The runtime has made the renderer's device: so it ends later.
  std::unique_ptr<Instance> instance_;
  std::unique_ptr<Renderer> renderer_;
  std::optional<XrTime> firstDisplay_, lastDisplay_;
  XrDuration stood_ = 0;
  bool isPaused_ = false;
  size_t look_ = 0;
  Walk walk_;
  float darkness_ = 0;
  size_t begun_ = 0;
  bool isLost_ = false;
  ShowReport report_;
};

}  // namespace

Result<std::vector<View>> usualEyes(const Scene& scene, const Look& look, const Viewpoint& viewpoint,
                                    double time) {
  const Result<std::vector<View>> camera = makeViews(scene, viewpoint, 1, Stereo::mono, 0, look, time);
  if (!camera) return camera.error();
  const Stand stand = standAt(camera->front(), 1, 0);
  const float out = glm::radians(54.0f), in = glm::radians(40.0f), up = glm::radians(44.0f),
              down = glm::radians(55.0f), half = 0.5f * 0.063f;
  std::vector<View> eyes{viewOf(stand, {{1, 0, 0, 0}, {-half, 0, 0}}, {-out, in, up, -down}, kNearPlane),
                         viewOf(stand, {{1, 0, 0, 0}, {half, 0, 0}}, {-in, out, up, -down}, kNearPlane)};
  for (View& eye : eyes) eye.size = {2064, 2208}, eye.node = camera->front().node, eye.isLevel = true;
  return eyes;
}

Result<Headset> findHeadset() {
  const Result<std::unique_ptr<Instance>> instance = Instance::create();
  if (!instance) return instance.error();
  Headset found;
  found.runtime = (*instance)->runtime();
  try {
    (*instance)->findHeadset();
    found.name = (*instance)->headset();
  } catch (const XrFailure& failure) {
    found.lack = errorOf(failure);
  }
  return found;
}

Result<ShowReport> show(const ShowOptions& options) {
  try {
    return Show(options).run();
  } catch (const XrFailure& failure) {
    return errorOf(failure);
  }
}

}  // namespace scumble::xr
