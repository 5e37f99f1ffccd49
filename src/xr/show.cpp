#include "xr/show.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <exception>
#include <thread>

#include "xr/clock.h"
#include "xr/failure.h"
#include "xr/follower.h"
#include "xr/resolution.h"
#include "xr/session.h"
#include "xr/touch.h"
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
// What decides where marks lie is of the eyes alone: others look on.
constexpr int kEyesRig = 0, kInsetsRig = 1, kMotionRig = 2, kSpectatorRig = 3, kPointerRig = 4;
constexpr float kCutTurn = 0.2f, kCutStep = 1;  // radians and metres from frame to frame: nobody goes so fast
constexpr float kPointerAngle = 1e-3f;          // radians, to all sides of where a hand points
constexpr size_t kUnderWay = 2;  // frames that the device may have at once: it need not wait for the CPU

std::string told(const glm::uvec2& size) {
  return std::to_string(size.x) + "x" + std::to_string(size.y);
}

// A head turns: marks are as large at the edge of what it sees as in the middle (paper 000, section 3.3),
// however narrow a headset's view is, unless the look says otherwise.
Look inHeadset(Look look) {
  for (const Knob& knob : Look::knobs()) {
    if (!knob.path.ends_with(".radial")) continue;
    const Result<KnobValue> value = look.get(knob.path);
    if (value && *value == KnobValue(std::string("auto"))) (void)look.set(knob.path, std::string("on"));
  }
  return look;
}

class Show {
 public:
  Show(Instance& instance, const ShowOptions& options)
      : options_(options),
        instance_(instance),
        clock_(options.time),
        looks_(options.looks),
        touch_(
            options.scene, [this](const std::string& line) { tell(line); },
            [this](const std::string& line) {
              if (options_.changed) options_.changed(line);
            }),
        follower_(options.spectator ? options.spectator->inertia : 0),
        resolution_(options.resolution) {
    for (auto& [name, look] : looks_) look = inHeadset(look);
  }

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
  struct SessionEnd {
    Show& show;
    ~SessionEnd() { show.letGo(), show.discard(); }
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
                      {options_.isStanding, options_.refreshRate, options_.hasVignette,
                       options_.synthesis != FrameSynthesis::off});
      const SessionEnd end{*this};  // before its images go
      if (!lostSince_) {
        tell(instance_.headset() + " on " + instance_.runtime() + ": twice " + told(session.sizes().front()) +
             (session.sizes().size() > 1 ? ", and " + told(session.sizes().back()) + " in their middles"
                                         : "") +
             (session.refreshRate() > 0 ? " at " + std::to_string(std::lround(session.refreshRate())) + " Hz"
                                        : ""));
        if (options_.synthesis == FrameSynthesis::on && session.motionSize() == glm::uvec2(0))
          tell("the runtime makes no frames by itself");
        status = warmUp(session);
      }
      isSynthesizing_ = options_.synthesis == FrameSynthesis::on;
      before_.reset();
      if (status) status = runFrames(session);
      if (const Status finished = finish(0); status.ok()) status = finished;
      isLost_ = session.isLost();
    } catch (const XrFailure& failure) {
      if (failure.result() != XR_ERROR_SESSION_LOST) throw;
      isLost_ = true;
    }
    return status;
  }

  // Frames that nobody sees, before the runtime waits for any: uploads and pipelines take a while. One with
  // all that there may be in a frame; the other looks, as long as there is patience; and one as they will be.
  Status warmUp(Session& session) {
    Moment moment;
    moment.eyes.assign(kEyes * session.sizes().size(), {Pose(), {-0.8f, 0.8f, 0.8f, -0.8f}});
    const auto draw = [&](bool isWhole) {
      isSynthesizing_ = isWhole;
      Status status =
          begin(session, standNow(), moment, {}, isWhole ? std::optional(Touch::Question()) : std::nullopt);
      if (const Status finished = finish(0); status.ok()) status = finished;
      session.release();
      return status;
    };
    if (Status status = draw(true); !status) return status;
    const Watch::time_point start = Watch::now();
    const std::chrono::duration<double> patience(options_.readying);
    size_t ready = 1;
    for (; ready < looks_.size() && Watch::now() - start < patience && !isEnding(); ++ready) {
      const Result<Camera> camera = standNow();
      if (!camera) return camera.error();
      if (Status status =
              renderer_->prepare(touch_.scene(), looks_[ready].second,
                                 viewsOf(*camera, walk_.on(camera->stand), moment), renderOptions(moment));
          !status)
        return status;
    }
    if (ready < looks_.size() && options_.readying > 0 && !isEnding())
      tell(std::to_string(ready) + " of " + std::to_string(looks_.size()) +
           " looks are ready; the others take a moment when they are taken");
    return draw(false);
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
      const HandsState hands = session.hands(moment);
      isPaused_ = isPaused_ != hands.pauses;
      clock_.go(moment.display, isPaused_ || !session.isWorn() || !moment.shouldRender);
      // Whoever recentres wants to be where the camera is.
      if (moment.display >= recentring) {
        walk_.reset(), before_.reset(), touch_.letGoOfAll();
        recentring = kNever;
      }
      const bool isSeen = moment.shouldRender && moment.isPlaced && !askedAt;
      Status drawn = isSeen ? draw(session, moment, hands) : Done{};
      std::optional<DrawnEyes> eyes;
      if (isSeen && drawn.ok()) eyes = DrawnEyes{sizes_, kNearPlane, synthesis_, darkness_, touch_.rays()};
      session.end(moment, eyes);
      if (!drawn) return drawn;
      if (isSeen) ++report_.frames, lostSince_.reset();
      // What was not seen is nothing to go on from.
      if (!isSeen) before_.reset();
    }
    return Done{};
  }

  Look& look() { return looks_[look_].second; }

  // The camera's, which has a place in the scene and may hang on something.
  struct Camera {
    Stand stand;
    int node = -1;
  };
  Result<Camera> standNow() const {
    const Result<std::vector<View>> views = makeViews(options_.scene, options_.viewpoint, 1, Stereo::mono, 0,
                                                      looks_[look_].second, clock_.time());
    if (!views) return views.error();
    return Camera{standAt(views->front(), options_.scale, options_.isStanding ? kEyeHeight : 0),
                  views->front().node};
  }

  Status draw(Session& session, Moment& moment, const HandsState& hands) {
    if (hands.nextLook) {
      look_ = (look_ + 1) % looks_.size();
      touch_.letGoOfColours(), before_.reset();
      tell("look: " + looks_[look_].first);
    }
    const double sinceLast = clock_.sinceLast();
    const Result<Camera> camera = standNow();
    if (!camera) return camera.error();
    // The stick of a hand that has hold of a thing is about that.
    Steering steering = hands.steering;
    if (touch_.hasThing(0)) steering.walk = glm::vec2(0);
    steering.mayTurn = !touch_.hasThing(1);
    walk_.go(camera->stand, between(moment.eyes[0].pose, moment.eyes[1].pose), steering,
             float(std::min(sinceLast, kLongestStep)));
    // It comes and goes within a quarter of a second or so; what is not seen is not drawn.
    darkness_ += (walk_.motion() - darkness_) * float(1 - std::exp(-sinceLast / kDarkening));
    if (darkness_ < 0.01f) darkness_ = 0;
    touch_.go(hands, {walk_.on(camera->stand), camera->node, clock_.time(), looks_[look_].first}, look());
    return begin(
        session, camera, moment, [&](Moment& latest) { return session.locate(latest); },
        touch_.takeQuestion());
  }

  // What all frames have.
  RenderOptions renderOptions(const Moment& moment) const {
    RenderOptions options;
    options.width = sizes_.front().x, options.height = sizes_.front().y;
    // An inset is a part of what its eye sees, and finer: angles count there, and not pixels of either.
    const XrFovf& angles = moment.eyes.front().angles;
    if (moment.eyes.size() > kEyes)
      options.sphere = SpherePart{glm::mat3(1.0f), std::tan(angles.angleUp) - std::tan(angles.angleDown)};
    options.samples = options_.samples, options.seed = options_.seed;
    return options;
  }

  // One from the room that somebody stands in.
  View viewFrom(const Camera& camera, const Stand& stand, const Eye& eye, int rig, glm::uvec2 size) const {
    View view = viewOf(stand, eye.pose, eye.angles, kNearPlane * stand.scale);
    view.node = camera.node, view.isLevel = true;
    view.rig = rig, view.size = size;
    return view;
  }
  std::vector<View> viewsOf(const Camera& camera, const Stand& stand, const Moment& seen) const {
    std::vector<View> views;
    for (size_t v = 0; v < seen.eyes.size(); ++v)
      views.push_back(
          viewFrom(camera, stand, seen.eyes[v], v < kEyes ? kEyesRig : kInsetsRig, sizes_[v / kEyes]));
    return views;
  }

  // Who looks on, of a frame that is seen, or not: by a head that is steadied in the camera's own room, so
  // that they are at once where the camera goes.
  View spectatorView(const Camera& camera, const Stand& stand, const Moment& moment, bool isSeen) {
    const Spectator& spectator = *options_.spectator;
    const glm::vec2 size(spectator.size);
    const float up = 0.5f * glm::radians(spectator.verticalFov),
                across = std::atan(std::tan(up) * size.x / size.y);
    const Pose head = inRoom(camera.stand, inScene(stand, between(moment.eyes[0].pose, moment.eyes[1].pose)));
    const Pose steady = isSeen ? follower_.go(head, float(clock_.sinceLast())) : head;
    return viewFrom(camera, camera.stand, {steady, {-across, across, up, -up}}, kSpectatorRig,
                    spectator.size);
  }

  // Motion is since the frame before, where there is one.
  SynthesisMoment goOnFromBefore(const Stand& stand, const std::vector<View>& views,
                                 RenderOptions& options) const {
    SynthesisMoment moment{Pose(), true, kNearPlane};
    options.previousViews = views;
    if (!before_) return moment;
    std::copy(before_->views.begin(), before_->views.end(), options.previousViews.begin());
    options.previousTime = before_->time;
    options.previousScene = before_->scene;
    moment.room = seenFrom(before_->stand, stand);
    const float turned = 2 * std::acos(std::min(std::abs(moment.room.turn.w), 1.0f));
    moment.isCut = turned > kCutTurn || glm::length(moment.room.place) > kCutStep;
    return moment;
  }

  // Sends a frame. `locate`: where the eyes are by now, asked at the last moment; what is shown is told with
  // the eyes that it was drawn from. `question`: what it is asked beside.
  Status begin(Session& session, const Result<Camera>& camera, Moment& moment,
               const std::function<bool(Moment&)>& locate, const std::optional<Touch::Question>& question) {
    if (!camera) return camera.error();
    const Stand stand = walk_.on(camera->stand);
    period_ = moment.period;
    std::vector<glm::uvec2> sizes;
    for (const glm::uvec2& size : session.sizes()) sizes.push_back(resolution_.of(size));
    if (sizes != sizes_) {
      if (!sizes_.empty() && locate)
        tell("eyes have " + told(sizes.front()) + " pixels from here on: as there is time for");
      sizes_ = sizes;
    }
    if (options_.synthesis == FrameSynthesis::whenLate && resolution_.isTooMuch() && !isSynthesizing_ &&
        session.motionSize() != glm::uvec2(0)) {
      isSynthesizing_ = true;
      tell("the runtime makes every other frame from here on: there is no time for all");
    }
    if (Status status = finish(kUnderWay - 1); !status) return status;

    // Eyes; the same for what moves; who looks on; and where a hand points.
    const bool synthesizes = isSynthesizing_ && session.motionSize() != glm::uvec2(0);
    const auto eyesNow = [&](std::vector<View>& views) {
      const std::vector<View> eyes = viewsOf(*camera, stand, moment);
      std::copy(eyes.begin(), eyes.end(), views.begin());
      for (size_t v = 0; v < kEyes && synthesizes; ++v)
        views[kEyes + v] = viewFrom(*camera, stand, moment.eyes[v], kMotionRig, session.motionSize());
    };
    std::vector<View> views(moment.eyes.size() + (synthesizes ? kEyes : 0));
    eyesNow(views);
    VulkanTargets targets;
    Under under;
    if (options_.spectator) {
      under.spectator = views.size();
      views.push_back(spectatorView(*camera, stand, moment, locate != nullptr));
      targets.readbacks.push_back({views.size() - 1, ""});
    }
    if (question) {
      under.question = question, under.pointer = views.size();
      const Eye along{question->aim, {-kPointerAngle, kPointerAngle, kPointerAngle, -kPointerAngle}};
      views.push_back(viewFrom(*camera, stand, along, kPointerRig, {1, 1}));
      for (const char* const aov : {"id", "depth"}) targets.readbacks.push_back({views.size() - 1, aov});
    }
    RenderOptions options = renderOptions(moment);
    options.formats[""] = PixelFormat::srgb8;
    synthesis_.reset();
    if (synthesizes) synthesis_ = goOnFromBefore(stand, views, options);
    // Nothing is thrown through the renderer.
    std::exception_ptr failure;
    options.latch = [&](std::vector<View>& latched) {
      try {
        if (locate && locate(moment)) eyesNow(latched);
      } catch (const XrFailure&) {
        failure = std::current_exception();
      }
    };
    targets.images = session.acquire(synthesizes);
    const double time = clock_.time();
    Status status = scumble::begin(*renderer_, touch_.scene(), look(), time, views, options, targets);
    if (status) {
      if (locate) {
        // While nobody saw anything nothing was to be seen.
        if (lastDisplay_)
          seen_ += std::clamp<XrDuration>(moment.display - *lastDisplay_, 0, Clock::kLongestStep);
        lastDisplay_ = moment.display;
        under.seconds = double(seen_) * 1e-9;
        under.isSeen = true;
      }
      under_.push_back(under);
      if (synthesizes) {
        views.resize(2 * kEyes);
        eyesNow(views);
        before_ = Before{views, time, touch_.scene(), stand};
      }
    }
    if (failure) std::rethrow_exception(failure);
    return status;
  }

  // Until no more than so many frames are under way.
  Status finish(size_t most) {
    while (under_.size() > most) {
      const Under under = under_.front();
      under_.pop_front();
      const Result<Frame> frame = renderer_->finish();
      if (!frame) {
        under_.clear();
        return frame.error();
      }
      resolution_.took(frame->stats.gpuMilliseconds, period_);
      if (!under.isSeen) continue;
      if (under.question) touch_.answer(*under.question, *frame, under.pointer);
      for (const Frame::Layer& layer : frame->layers)
        if (under.spectator && layer.name.empty())
          options_.spectator->see(std::make_shared<const Image>(layer.views[*under.spectator]),
                                  under.seconds);
    }
    return Done{};
  }

  // As a session ends: what was held is told.
  void letGo() noexcept {
    try {
      touch_.letGoOfAll();
    } catch (...) {
      // Its words are lost.
    }
  }

  // Of frames under way nobody wants anything any more.
  void discard() noexcept {
    for (; !under_.empty(); under_.pop_front()) (void)renderer_->finish();
  }

  const ShowOptions& options_;
  Instance& instance_;
  std::unique_ptr<Renderer> renderer_;
  Clock clock_;
  bool isPaused_ = false;
  std::vector<std::pair<std::string, Look>> looks_;
  size_t look_ = 0;
  Walk walk_;
  Touch touch_;
  Follower follower_;
  Resolution resolution_;
  std::vector<glm::uvec2> sizes_;  // of each pair of eyes, as they were drawn last
  double period_ = 0;              // milliseconds from frame to frame
  float darkness_ = 0;
  // A frame under way, and what it is asked for beside what the eyes see.
  struct Under {
    bool isSeen = false;
    double seconds = 0;               // when, since the first one
    std::optional<size_t> spectator;  // which view that is
    std::optional<Touch::Question> question;
    size_t pointer = 0;  // which view looks for the answer
  };
  std::deque<Under> under_;            // the oldest first
  std::optional<XrTime> lastDisplay_;  // of a frame that was seen
  XrDuration seen_ = 0;                // nanoseconds
  // Where everything was in the frame that was seen before, where the runtime makes frames between.
  struct Before {
    std::vector<View> views;
    double time = 0;
    Scene scene;
    Stand stand;
  };
  std::optional<Before> before_;
  std::optional<SynthesisMoment> synthesis_;  // of the present frame
  bool isSynthesizing_ = false;
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
