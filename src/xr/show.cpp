#include "xr/show.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <thread>

#include "xr/clock.h"
#include "xr/failure.h"
#include "xr/resolution.h"
#include "xr/session.h"
#include "xr/walk.h"

namespace scumble::xr {

namespace {

constexpr float kNearPlane = 0.05f;   // metres of the room
constexpr float kEyeHeight = 1.6f;    // metres of the room
constexpr double kLongestStep = 0.1;  // seconds of walking at once, however late a frame is
constexpr double kDarkening = 0.1;    // seconds
constexpr auto kRest = std::chrono::milliseconds(10);
constexpr auto kPatience = std::chrono::minutes(1);     // for a headset that was lost
constexpr auto kEndPatience = std::chrono::seconds(5);  // for a runtime that is asked to end
constexpr size_t kUnderWay = 2;  // frames that the device may have at once: it need not wait for the CPU

class Show {
 public:
  Show(Instance& instance, const ShowOptions& options)
      : options_(options), instance_(instance), clock_(options.time), resolution_(options.resolution) {}

  Result<ShowReport> run() {
    Result<std::unique_ptr<Renderer>> renderer = createRenderer(instance_.vulkan(), options_.renderer);
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
  using Watch = std::chrono::steady_clock;
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

  // Waits for a headset that was lost. Throws XrFailure where it does not come, or goes again and again.
  bool findAgain() {
    if (!lostSince_) {
      lostSince_ = Watch::now();
      tell("the headset was lost; waiting for it");
    }
    while (!isEnding()) {
      std::this_thread::sleep_for(kRest);
      const bool isPatient = Watch::now() - *lostSince_ < kPatience;
      if (!isPatient) throw XrFailure("xrGetSystem", XR_ERROR_FORM_FACTOR_UNAVAILABLE);
      try {
        instance_.findHeadset();
        return true;
      } catch (const XrFailure& failure) {
        if (failure.result() != XR_ERROR_FORM_FACTOR_UNAVAILABLE) throw;
      }
    }
    return false;
  }

  Status runSession() {
    Status status = Done{};
    try {
      Session session(instance_, vulkanDeviceOf(*renderer_),
                      {options_.isStanding, options_.refreshRate, options_.hasVignette});
      const FramesEnd end{*this};  // before its images go
      if (!lostSince_) {
        tell(instance_.headset() + " on " + instance_.runtime() + ": twice " +
             std::to_string(session.size().x) + "x" + std::to_string(session.size().y) +
             (session.refreshRate() > 0 ? " at " + std::to_string(std::lround(session.refreshRate())) + " Hz"
                                        : ""));
        status = warmUp(session);
      }
      if (status) status = runFrames(session);
      isLost_ = session.isLost();
    } catch (const XrFailure& failure) {
      if (failure.result() != XR_ERROR_SESSION_LOST) throw;
      isLost_ = true;
    }
    return status;
  }

  // A frame that nobody sees, before the runtime waits for any: uploads and pipelines take a while.
  Status warmUp(Session& session) {
    Moment moment;
    moment.eyes.fill({Pose(), {-0.8f, 0.8f, 0.8f, -0.8f}});
    Status status = begin(session, standNow(), moment, {});
    if (const Status finished = finish(0); status.ok()) status = finished;
    session.release();
    return status;
  }

  Status runFrames(Session& session) {
    XrTime recentring = kNever;
    std::optional<Watch::time_point> askedAt;
    while (!session.isOver() && !session.isLost()) {
      recentring = std::min(recentring, session.follow().recentredAt);
      if (!askedAt && isEnding()) {
        session.requestEnd();
        askedAt = Watch::now();
      }
      // A runtime that does not answer is left.
      if (askedAt && Watch::now() - *askedAt > kEndPatience) return Done{};
      if (!session.isRunning()) {
        std::this_thread::sleep_for(kRest);
        continue;
      }
      Moment moment = session.begin();
      const HandsState hands = session.hands();
      isPaused_ = isPaused_ != hands.pauses;
      clock_.go(moment.display, isPaused_ || !session.isWorn() || !moment.shouldRender);
      // Whoever recentres wants to be where the camera is.
      if (moment.display >= recentring) {
        walk_.reset();
        recentring = kNever;
      }
      const bool isSeen = moment.shouldRender && moment.isPlaced && !askedAt;
      Status drawn = isSeen ? draw(session, moment, hands) : Done{};
      session.end(moment, isSeen && drawn.ok() ? std::optional(DrawnEyes{size_, kNearPlane}) : std::nullopt,
                  darkness_);
      if (!drawn) return drawn;
      if (isSeen) ++report_.frames, lostSince_.reset();
    }
    return Done{};
  }

  const Look& look() const { return options_.looks[look_].second; }

  // The camera's, which has a place in the scene and may hang on something.
  struct Camera {
    Stand stand;
    int node = -1;
  };
  Result<Camera> standNow() const {
    const Result<std::vector<View>> views =
        makeViews(options_.scene, options_.viewpoint, 1, Stereo::mono, 0, look(), clock_.time());
    if (!views) return views.error();
    return Camera{standAt(views->front(), options_.scale, options_.isStanding ? kEyeHeight : 0),
                  views->front().node};
  }

  Status draw(Session& session, Moment& moment, const HandsState& hands) {
    if (hands.nextLook) {
      look_ = (look_ + 1) % options_.looks.size();
      tell("look: " + options_.looks[look_].first);
    }
    const double sinceLast = clock_.sinceLast();
    const Result<Camera> camera = standNow();
    if (!camera) return camera.error();
    walk_.go(camera->stand, between(moment.eyes[0].pose, moment.eyes[1].pose), hands.steering,
             float(std::min(sinceLast, kLongestStep)));
    // It comes and goes within a quarter of a second or so; what is not seen is not drawn.
    darkness_ += (walk_.motion() - darkness_) * float(1 - std::exp(-sinceLast / kDarkening));
    if (darkness_ < 0.01f) darkness_ = 0;
    return begin(session, camera, moment, [&](Moment& latest) { return session.locate(latest); });
  }

  // Sends a frame. `locate`: where the eyes are by now, asked at the last moment; what is shown is told with
  // the eyes that it was drawn from.
  Status begin(Session& session, const Result<Camera>& camera, Moment& moment,
               const std::function<bool(Moment&)>& locate) {
    if (!camera) return camera.error();
    const Stand stand = walk_.on(camera->stand);
    const auto viewsOf = [&](const Moment& seen) {
      std::vector<View> views;
      for (const Eye& eye : seen.eyes) {
        View& view = views.emplace_back(viewOf(stand, eye.pose, eye.angles, kNearPlane * stand.scale));
        view.node = camera->node;
        view.isLevel = true;
      }
      return views;
    };
    RenderOptions options;
    period_ = moment.period;
    if (const glm::uvec2 size = resolution_.of(session.size()); size != size_) {
      if (size_ != glm::uvec2(0) && locate)
        tell("eyes have " + std::to_string(size.x) + "x" + std::to_string(size.y) +
             " pixels from here on: as there is time for");
      size_ = size;
    }
    options.width = size_.x, options.height = size_.y;
    options.samples = options_.samples, options.seed = options_.seed;
    // Nothing is thrown through the renderer.
    std::exception_ptr failure;
    options.latch = [&](std::vector<View>& views) {
      try {
        if (locate && locate(moment)) views = viewsOf(moment);
      } catch (const XrFailure&) {
        failure = std::current_exception();
      }
    };
    if (Status status = finish(kUnderWay - 1); !status) return status;
    VulkanTargets targets;
    targets.images = session.acquire();
    Status status =
        scumble::begin(*renderer_, options_.scene, look(), clock_.time(), viewsOf(moment), options, targets);
    if (status) ++begun_;
    if (failure) std::rethrow_exception(failure);
    return status;
  }

  // Until no more than so many frames are under way.
  Status finish(size_t most) {
    for (; begun_ > most; --begun_)
      if (const Result<Frame> frame = renderer_->finish()) {
        resolution_.took(frame->stats.gpuMilliseconds, period_);
      } else {
        begun_ = 0;
        return frame.error();
      }
    return Done{};
  }

  const ShowOptions& options_;
  Instance& instance_;
  std::unique_ptr<Renderer> renderer_;
  Clock clock_;
  bool isPaused_ = false;
  size_t look_ = 0;
  Walk walk_;
  Resolution resolution_;
  glm::uvec2 size_{0};  // of an eye, as it was drawn last
  double period_ = 0;   // milliseconds from frame to frame
  float darkness_ = 0;
  size_t begun_ = 0;
  bool isLost_ = false;
  std::optional<Watch::time_point> lostSince_;  // until a frame is shown again
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

Headset::Headset(std::unique_ptr<Instance> instance) : instance_(std::move(instance)) {
  try {
    instance_->findHeadset();
  } catch (const XrFailure& failure) {
    lack_ = errorOf(failure);
  }
}

Headset::~Headset() = default;

Result<std::unique_ptr<Headset>> Headset::find() {
  Result<std::unique_ptr<Instance>> instance = Instance::create();
  if (!instance) return instance.error();
  return std::unique_ptr<Headset>(new Headset(std::move(instance).value()));
}

const std::string& Headset::runtime() const {
  return instance_->runtime();
}

const std::string& Headset::name() const {
  return instance_->headset();
}

Result<ShowReport> Headset::show(const ShowOptions& options) {
  if (lack_) return *lack_;
  try {
    return Show(*instance_, options).run();
  } catch (const XrFailure& failure) {
    return errorOf(failure);
  }
}

}  // namespace scumble::xr
