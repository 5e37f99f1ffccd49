#include "viewer.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "camera.h"
#include "dialogs.h"
#include "handles.h"
#include "hands.h"
#include "interface.h"
#include "interface_input.h"
#include "interface_pass.h"
#include "look_sheet.h"
#include "look_shelf.h"
#include "panel.h"
#include "passes_strip.h"
#include "picture_area.h"
#include "recent_files.h"
#include "screen.h"
#include "shader_build.h"
#include "style.h"
#include "timeline.h"
#include "track_edit.h"
#include "unsaved.h"

namespace scumble::viewer {

namespace {

constexpr double kFrameSeconds = 1 / 60.0;  // of the window, while something moves by itself
constexpr float kFlySpeed = 0.8f;           // distances to what is looked at, a second
constexpr glm::vec2 kAddedAt{0.4f, 0.8f};   // where new things go, across the window
constexpr float kAddedSize = 0.12f;         // of its height
constexpr float kDragZoom = 12;             // steps over the window's height
constexpr double kRoomForKeys = 10;         // seconds of a scene in which nothing plays yet but tracks
constexpr int kSettling = 3;                // frames after an event until the interface rests
constexpr int kMostLosses = 3;              // of the device, one after the other

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What is there as long as the device is.
struct Drawing {
  Drawing(const ViewerOptions& options, const Window& window, std::unique_ptr<Renderer> renderer)
      : pictures(std::move(renderer), {options.samples, options.seed, options.ipd}, Window::wake),
        device(vulkanDeviceOf(pictures.renderer())),
        screen(device, window.makeSurface(device.instance)),
        pass(device, screen.format()) {}
  ~Drawing() { screen.settle(); }

  Pictures pictures;
  const VulkanDevice device;
  Screen screen;
  InterfacePass pass;
  std::array<std::vector<std::shared_ptr<const Picture>>, Screen::kFrames> held;  // by frames under way
};

class Viewer : Hands::Doer {
 public:
  Viewer(const ViewerOptions& options, Window& window)
      : options_(options),
        window_(window),
        document_(options.sources, Window::wake),
        input_(window),
        unsaved_(options.stateFolder),
        recent_(options.stateFolder),
        camera_(options.viewpoint) {
    playback_.playhead = options.time;
    if (!options.stereo.empty()) area_.setEyes(eyesOf(options.stereo));
    setStyle(window.contentScale());
    ImGui::GetIO().DisplaySize = {float(options.width), float(options.height)};
  }

  enum class End { closed, otherShaders };
  // Until it is closed, or wants a renderer with other shaders. Throws VulkanFailure where the device cannot
  // go on; what the window shows stays, and it can be run again with another one.
  Result<End> run(std::unique_ptr<Renderer> renderer) {
    drawing_ = std::make_unique<Drawing>(options_, window_, std::move(renderer));
    settling_ = kSettling;
    while (!window_.shouldClose()) {
      if (hasOtherShaders()) return ended(End::otherShaders);
      window_.wait(untilNextFrame());
      input_.add(window_.takeEvents());
      if (input_.hasMore() || window_.wasTouched()) settling_ = kSettling;
      if (const Status status = takeDocument(); !status) return status.error();
      takePictures();
      keepEdits(false);
      if (settling_ == 0 && !moves() && !pictures().isDue(now())) continue;
      if (settling_ > 0) --settling_;
      drawFrame();
    }
    keepEdits(true);
    return ended(End::closed);
  }
  // Shaders are compiled as they are saved from now on.
  void setShaders(std::unique_ptr<ShaderBuild> shaders) { shaders_ = std::move(shaders); }
  // After run() has thrown, or wants other shaders.
  void loseDevice() {
    keepEdits(true);
    adding_.reset();
    area_.takeShown();
    drawing_.reset();
  }

 private:
  Pictures& pictures() { return drawing_->pictures; }
  const Pictures& pictures() const { return drawing_->pictures; }

  Result<End> ended(End end) const {
    if (pictures().renderer().validationMessages() == 0) return end;
    return Error{ErrorKind::internal, "", 0, "", "the Vulkan validation layers have complained", "see above"};
  }

  bool hasOtherShaders() {
    const std::optional<Status> done = shaders_ ? shaders_->poll() : std::nullopt;
    if (!done) return false;
    settling_ = kSettling;
    if (*done)
      document_.settle(Concern::shader);
    else
      document_.tell(Concern::shader, done->error().problem);
    return done->ok();
  }

  // Whether something goes on without anybody doing anything.
  bool moves() const { return playback_.moves() || hands_.isFlying(); }

  double untilNextFrame() const {
    if (input_.hasMore()) return 0;
    if (settling_ > 0 || moves()) return std::max(lastFrame_ + kFrameSeconds - now(), 0.0);
    const std::optional<double> picture = pictures().untilDue(now()), keeping = unsaved_.untilDue(now());
    if (picture && keeping) return std::min(*picture, *keeping);
    return picture ? *picture : keeping.value_or(-1);
  }

  // ---- The document

  Status takeDocument() {
    const Result<bool> news = document_.poll();
    if (!news) return news.error();
    if (!*news) return Done{};
    settling_ = kSettling;
    // What was saved is seen soon, and then in full.
    pictures().moved(now());
    if (sceneVersion_ != document_.sceneVersion()) {
      sceneVersion_ = document_.sceneVersion();
      summary_ = document_.scene().summary();
      clips_.clear();
      for (const SceneSummary::Clip& clip : summary_.clips)
        clips_.push_back(clip.name.empty() ? std::to_string(clips_.size()) : clip.name);
      camera_.setBounds(summary_);
    }
    if (opened_ != document_.opened().scenes) takeScenes();
    return Done{};
  }

  // As long as what plays, and as tracks need, if nobody has said it.
  void setDuration() {
    const double played = playedSeconds(document_.scene(), document_.look());
    const double needed = std::max(played, document_.look().lastKeyTime());
    const bool hasTracks = !document_.look().animated().empty();
    playback_.duration =
        duration_.value_or(hasTracks && played == 0 ? std::max(needed, kRoomForKeys) : needed);
  }

  // Other scenes are there.
  void takeScenes() {
    const bool isFirst = opened_.empty();
    opened_ = document_.opened().scenes;
    recent_.add(opened_);
    title_ = std::filesystem::path(opened_[0]).filename().string();
    if (opened_.size() > 1) title_ += " and " + std::to_string(opened_.size() - 1) + " more";
    window_.setTitle(title_);
    panel_.select({});
    unsaved_.open(document_);
    looks_.forget();
    duration_.reset();
    adding_.reset();
    setDuration();
    if (isFirst) return;
    camera_.set(firstCamera());
    playback_.playhead = 0;
  }

  void openScenes(const OpenWish& wish) {
    keepEdits(true);
    if (wish.isAdded)
      document_.addScenes(wish.files);
    else
      document_.openScenes(wish.files);
  }

  void keepEdits(bool atOnce) {
    if (const Status status = unsaved_.keep(document_, now(), atOnce); !status)
      document_.tell(Concern::saving, status.error().message());
  }

  void save() {
    const Result<std::string> file = document_.save();
    if (file)
      notice_ = "saved to " + *file;
    else
      document_.tell(Concern::saving, file.error().message());
  }

  void make(const SaveWish& wish) {
    if (job_ && !job_->state().isDone) {
      document_.tell(Concern::saving, job_->file() + " is being made; wait for it, or stop it");
      return;
    }
    Shown shown = presentlyShown(wish.size);
    if (wish.kind == SaveWish::Kind::film) shown.film = {false, playback_.duration};
    if (wish.kind == SaveWish::Kind::turn) {
      shown.film = {true, double(wish.seconds)};
      if (const std::optional<Viewpoint> around = orbitOfPresent()) shown.viewpoint = around;
    }
    std::vector<std::string> words = options_.command(shown);
    words.insert(words.end(), {"-o", wish.file});
    job_ = std::make_unique<ExportJob>(words, wish.file, Window::wake);
  }

  // ---- Pictures

  void takePictures() {
    if (pictures().poll()) settling_ = kSettling;
    if (job_ && !(job_->state() == jobState_)) {
      jobState_ = job_->state();
      settling_ = kSettling;
    }
    if (const auto failure = pictures().takeFailure())
      document_.tell(Concern::picture, failure->message());
    else if (pictures().shown() && pictures().shown()->number != lastShown_)
      document_.settle(Concern::picture);
    if (pictures().shown()) lastShown_ = pictures().shown()->number;
    if (auto picked = pictures().takePicked()) {
      if (adding_) {
        const bool isNothing = picked->object.empty() && picked->material.empty();
        return add(*std::exchange(adding_, std::nullopt),
                   isNothing ? std::nullopt : std::optional(picked->place));
      }
      // Looks know nodes that have a name; the ground and the sea are materials alone.
      const std::vector<std::string>& nodes = summary_.nodeNames;
      if (std::find(nodes.begin(), nodes.end(), picked->object) == nodes.end()) picked->object.clear();
      panel_.select(*picked);
      if (!picked->object.empty() || !picked->material.empty()) showsPanel_ = true;
    }
  }

  void wish(const glm::uvec2& full) {
    if (document_.scene().empty()) return;
    if (moves()) pictures().moved(now());
    const Stereo stereo = area_.isSeenByBoth() ? Stereo::stereo : Stereo::mono;
    pictures().begin(document_, {camera_.viewpoint(), camera_.moves(), playback_.pictureTime(), stereo},
                     area_.viewSize(full), now());
    pictures().askForShown(hands_.isHeld(Command::compare));
    if (area_.isSplit()) {
      const std::string& other = area_.otherLook();
      pictures().askForOther(other, other.empty() ? document_.savedLook() : looks_.look(other));
    }
    if (showsPasses_) pictures().askForThumbnails(), pictures().askForPass(area_.pass());
    if (showsLooks_) pictures().askForLooks(allLooks());
    pictures().end();
  }

  std::vector<std::pair<std::string, Look>> allLooks() {
    return looks_.all(options_.sources.ownLook(opened_).name);
  }

  // ---- Hands

  // From where it is seen, whether or not that is drawn already.
  std::optional<View> presentView() const {
    const glm::uvec2 size = area_.viewSize(window_.framebufferSize());
    if (document_.scene().empty() || size.x == 0 || size.y == 0) return std::nullopt;
    const Result<std::vector<View>> views =
        makeViews(document_.scene(), camera_.viewpoint(), float(size.x) / float(size.y), Stereo::mono, 0.063f,
                  document_.look(), playback_.pictureTime());
    return views ? std::optional(views->front()) : std::nullopt;
  }

  // The camera is the hand's from now on.
  Navigation& hold() {
    pictures().moved(now());
    return camera_.hold(camera_.isHeld() ? std::nullopt : presentView());
  }

  // Of the command line, which knows the scenes that it has opened; others have cameras of their own.
  std::optional<Viewpoint> firstCamera() const {
    const bool isFirst = document_.opened().scenes == options_.sources.opened.scenes;
    return isFirst ? std::nullopt : std::optional(Viewpoint());
  }

  // Around what is framed, from where it is seen now.
  std::optional<Viewpoint> orbitOfPresent() const {
    const std::optional<View> view = presentView();
    if (!view) return std::nullopt;
    const glm::vec3 away = glm::normalize(glm::vec3(glm::inverse(view->worldToEye)[2]));
    Viewpoint around;
    around.orbit = true;
    around.azimuth = glm::degrees(std::atan2(away.x, away.z));
    around.elevation = glm::degrees(std::asin(std::clamp(away.y, -1.0f, 1.0f)));
    return around;
  }

  // All of it, or what was picked, from where it is seen now.
  void frame() {
    std::optional<Viewpoint> around = orbitOfPresent();
    if (!around) return;
    around->frame = panel_.picked().object;
    camera_.set(around);
  }

  void lookThroughNextCamera() {
    if (summary_.cameras.empty()) {
      notice_ = "the scene has no cameras";
      return;
    }
    Viewpoint through;
    through.camera = std::to_string(nextCamera_++ % summary_.cameras.size());
    camera_.set(through);
  }

  Shown presentlyShown(const glm::uvec2& size) const {
    return {document_.opened(),
            camera_.isOther() ? std::optional(camera_.viewpoint()) : std::nullopt,
            document_.edits(),
            playback_.pictureTime(),
            size.x,
            size.y,
            std::nullopt,
            layoutOf(area_.eyes())};
  }

  void openSaveDialog() {
    saveDialog_.open(document_.opened().scenes[0], viewSize(window_.framebufferSize(), area_.eyes()),
                     playback_.duration > 0);
  }

  // What lies over everything goes first.
  void leave() {
    if (openDialog_.isOpen() || saveDialog_.isOpen() || dropDialog_.isOpen())
      openDialog_.close(), saveDialog_.close(), dropDialog_.close();
    else if (showsLooks_ || showsHelp_)
      showsLooks_ = showsHelp_ = false;
    else if (!document_.problems().empty())
      document_.settleAll();
    else if (!area_.pass().empty())
      area_.choosePass("");
    else
      panel_.select({});
  }

  void drop(const std::vector<std::string>& files) override {
    Drop drop = sorted(files);
    if (!drop.looks.empty()) document_.openLook(drop.looks.back());
    if (!drop.others.empty())
      document_.tell(Concern::scene, drop.others[0] +
                                         ": it is no scene, look or picture by its name; drop a "
                                         ".glb, .gltf, .tilt, .json, .png, .jpg or .webp");
    dropDialog_.open(std::move(drop), panel_.picked().material);
  }

  void obey(Command command) override {
    switch (command) {
      case Command::help:
        showsHelp_ = !showsHelp_;
        break;
      case Command::panel:
        showsPanel_ = !showsPanel_;
        break;
      case Command::fullscreen:
        window_.setFullscreen(!window_.isFullscreen());
        break;
      case Command::quit:
        window_.close();
        break;
      case Command::copyCommand:
        if (!document_.scene().empty())
          window_.copy(
              shellText(options_.command(presentlyShown(viewSize(window_.framebufferSize(), area_.eyes())))));
        break;
      case Command::save:
        if (!document_.scene().empty()) save();
        break;
      case Command::undo:
        document_.undo();
        break;
      case Command::redo:
        document_.redo();
        break;
      case Command::frameAll:
        frame();
        break;
      case Command::lookCamera:
        camera_.set(firstCamera());
        break;
      case Command::viewFront:
        hold().lookFrom(0, 0);
        break;
      case Command::viewBack:
        hold().lookFrom(180, 0);
        break;
      case Command::viewRight:
        hold().lookFrom(90, 0);
        break;
      case Command::viewLeft:
        hold().lookFrom(-90, 0);
        break;
      case Command::viewTop:
        hold().lookFrom(0, 90);
        break;
      case Command::viewBottom:
        hold().lookFrom(0, -90);
        break;
      case Command::rollLeft:
        hold().roll(-2);
        break;
      case Command::rollRight:
        hold().roll(2);
        break;
      case Command::narrow:
        hold().widen(1 / 1.05f);
        break;
      case Command::widen:
        hold().widen(1.05f);
        break;
      case Command::play:
        playback_.toggle();
        break;
      case Command::stepBack:
        playback_.step(-1);
        break;
      case Command::stepOn:
        playback_.step(1);
        break;
      case Command::toStart:
        playback_.playhead = 0;
        break;
      case Command::onTwos:
        playback_.onTwos = !playback_.onTwos;
        break;
      case Command::slower:
        playback_.goFaster(0.5);
        break;
      case Command::faster:
        playback_.goFaster(2);
        break;
      case Command::flyForwards:
      case Command::flyBack:
      case Command::flyLeft:
      case Command::flyRight:
      case Command::flyDown:
      case Command::flyUp:
      case Command::compare:
        break;  // as long as their keys are held
      case Command::handles:
        showsHandles_ = !showsHandles_;
        break;
      case Command::key:
        key();
        break;
      case Command::open:
        openDialog_.open(recent_.files());
        break;
      case Command::make:
        if (!document_.scene().empty()) openSaveDialog();
        break;
      case Command::looks:
        showsLooks_ = !showsLooks_;
        looks_.forget();
        break;
      case Command::split:
        area_.toggleSplit();
        break;
      case Command::passes:
        showsPasses_ = !showsPasses_;
        if (!showsPasses_) area_.choosePass("");
        break;
      case Command::nextCamera:
        lookThroughNextCamera();
        break;
      case Command::eyes:
        area_.nextEyes();
        break;
      case Command::leave:
        leave();
        break;
    }
  }

  void drag(Hands::Grip grip, const glm::vec2& way) override {
    switch (grip) {
      case Hands::Grip::orbit:
        return hold().orbit(way);
      case Hands::Grip::pan:
        return hold().pan(way);
      case Hands::Grip::zoom:
        return hold().zoom(-kDragZoom * way.y);
      case Hands::Grip::lookAround:
        return hold().lookAround(way);
    }
  }
  void zoom(float steps) override { hold().zoom(steps); }

  void click(const glm::vec2& place) override {
    const glm::vec2 window = glm::max(glm::vec2(window_.framebufferSize()), 1.0f);
    adding_.reset();
    const PictureArea::Place in = area_.placeIn(place / window);
    pictures().pick(in.place, in.view);
  }

  bool grab(const glm::vec2& place) override { return showsHandles() && handles_.grab(place); }
  void pull(const glm::vec2& place) override {
    const std::optional<Turn> turn = handles_.pull(place);
    if (!turn) return;
    if (std::any_of(turn->edits.begin(), turn->edits.end(),
                    [](const auto& edit) { return isTrackText(edit.second); }))
      pause();
    turned(document_.set(turn->step, turn->edits));
  }
  void letGo() override {
    if (const std::optional<Target> target = handles_.letGo()) panel_.choose(*target), showsPanel_ = true;
  }

  // Something of the look is another by hand, or could not be.
  void turned(const Status& status) {
    if (!status) document_.tell(Concern::knob, status.error().message());
    pictures().moved(now());
    settling_ = kSettling;
  }

  // Keys are set at a time: what is turned while it plays would leave one at each picture.
  void pause() {
    if (playback_.isPlaying) playback_.seek(playback_.pictureTime());
  }

  // Of the knob under the mouse, of the track that is edited, or of the camera. Not of what is held just now.
  void key() {
    if (ImGui::IsAnyItemActive() || handles_.isHeld() || document_.scene().empty()) return;
    pause();
    const double time = playback_.pictureTime();
    const bool isOverPicture = !ImGui::GetIO().WantCaptureMouse;
    const std::string path = showsPanel_ && !panel_.hovered().empty() ? panel_.hovered() : timeline_.chosen();
    document_.closeStep();
    if (!isOverPicture) {
      if (path.empty()) return;
      const auto text = keyToggledAt(document_.look(), path, time);
      turned(text ? document_.set(path, *text) : Status(noTrackOf(path)));
      timeline_.choose(path);
    } else if (presentView()) {
      const Result<Turn> turn = cameraKeyed(document_.scene(), document_.look(), hold().viewpoint(), time);
      turned(turn ? document_.set(turn->step, turn->edits) : Status(turn.error()));
      if (turn) {
        // It stands where it stood, and goes where its keys take it.
        camera_.set(Viewpoint());
        timeline_.choose("camera.eye");
        notice_ = fmt::format("the camera is kept at {:.2f} s", time);
      }
    }
    document_.closeStep();
  }

  // Where something was picked, else where something is to be seen below the middle.
  void add(const Addable& what) {
    const Picked& picked = panel_.picked();
    if (!picked.object.empty() || !picked.material.empty()) return add(what, picked.place);
    adding_ = what;
    pictures().pick(kAddedAt, 0);
  }
  // Nothing: there is nothing to be seen; so it lies there as far away as the scene's middle.
  void add(const Addable& what, const std::optional<glm::vec3>& seen) {
    const std::optional<View> view = presentView();
    if (!view) return;
    const glm::vec2 window(window_.framebufferSize());
    const Lens lens(*view, window);
    const Lens::Ray ray = lens.rayAt(kAddedAt * window);
    const glm::vec3 eye(glm::inverse(view->worldToEye)[3]);
    const float far = float(glm::distance(view->origin + glm::dvec3(eye), camera_.centre()));
    const glm::vec3 place = seen ? glm::vec3(glm::dvec3(*seen) - view->origin) : ray.from + far * ray.way;
    const float size = kAddedSize * window.y * lens.pixelSize(place);
    const Added made = added(what, document_.look(), glm::vec3(view->origin + glm::dvec3(place)), size);
    document_.closeStep();
    turned(document_.set(made.target.name, made.edits));
    document_.closeStep();
    panel_.choose(made.target);
    showsHandles_ = true;
  }

  void fly(double seconds) {
    if (const glm::vec3 way = hands_.flight(); way != glm::vec3(0) && pictures().shown())
      hold().fly(float(seconds) * kFlySpeed * way);
  }

  // ---- A frame of the window

  void drawFrame() {
    const double time = now(), seconds = std::clamp(time - lastFrame_, 1e-4, 0.25);
    lastFrame_ = time;
    const glm::uvec2 size = window_.framebufferSize();
    const std::vector<Event> events = input_.feed();
    const bool isSeen = size.x > 0 && size.y > 0;
    ImGuiIO& io = ImGui::GetIO();
    if (isSeen) io.DisplaySize = {float(size.x), float(size.y)};
    io.DeltaTime = float(seconds);
    ImGui::NewFrame();
    // What begins now has not moved since the last frame, which may be long ago.
    const double moved = moves() ? seconds : 0;
    if (lookVersion_ != document_.version()) lookVersion_ = document_.version(), setDuration();
    const bool isThere = pictures().shown() != nullptr;
    for (const Event& event : events) hands_.take(event, size, isThere, *this);
    playback_.advance(moved);
    fly(moved);
    area_.takeShown();
    layOut({io.DisplaySize.x, io.DisplaySize.y});
    ImGui::Render();
    if (!isSeen) {
      pictures().hide();
      return;
    }
    wish(size);
    drawing_->screen.draw(size, [&](VkCommandBuffer commands, uint32_t frame) {
      drawing_->held[frame] = area_.takeShown();
      drawing_->pass.record(commands, frame, *ImGui::GetDrawData(), drawing_->screen.extent());
    });
  }

  void layOut(const glm::vec2& window) {
    if (!pictures().shown())
      layOutWaiting(window, document_.scene().empty() ? "Reading the scene" : "Drawing the first picture");
    if (area_.layOut(window, pictures())) settling_ = kSettling;
    layOutHandles(window);
    bool isTurned = layOutTimeline(window);
    if (showsPasses_) {
      const float right = showsPanel_ ? panelWidth(window) - ImGui::GetFontSize() : 0;
      layOutPasses(window - glm::vec2(right, showsTime() ? timeline_.height() : 0), area_.pass(),
                   area_.keep(pictures().thumbnails()), area_.keep(pictures().shown()),
                   area_.pixelFacts(hands_.mouse(), pictures()));
    }
    if (showsPanel_ && !document_.scene().empty()) {
      const Panel::Change change = panel_.layOut(
          window, {title_, facts(), playback_.pictureTime(), showsTime() ? timeline_.height() : 0}, document_,
          area_.isSplit() ? &area_.otherLook() : nullptr);
      isTurned |= change.isTurned;
      if (!change.keyed.empty()) pause(), timeline_.choose(change.keyed);
      if (change.added) add(*change.added);
    }
    layOutNotices(window);
    layOutDialogs(window);
    if (showsHelp_) layOutHelp(window);
    if (isTurned) turned(Done{});
    // What is turned without a pause is undone at once.
    if (!ImGui::IsAnyItemActive() && !handles_.isHeld()) document_.closeStep();
  }

  bool showsTime() const { return showsPanel_ && playback_.duration > 0; }
  bool layOutTimeline(const glm::vec2& window) {
    if (!showsTime()) return false;
    const Timeline::Change change = timeline_.layOut(window, playback_, clips_, document_);
    if (change.clip) document_.openClip(*change.clip);
    if (change.duration) duration_ = change.duration, setDuration();
    return change.isMoved || change.isTurned;
  }

  // Whether nobody else says where the camera is.
  bool isThroughTheLook() const {
    const Viewpoint from = camera_.viewpoint();
    return from.camera.empty() && from.frame.empty() && !from.orbit && !from.turntable && !from.eye &&
           !from.target;
  }
  // Where both eyes are seen, nothing lies at one place.
  bool showsHandles() const { return showsHandles_ && !area_.isSeenByBoth(); }
  void layOutHandles(const glm::vec2& window) {
    const std::optional<View> view = showsHandles() && pictures().shown() ? presentView() : std::nullopt;
    if (view)
      handles_.layOut(window,
                      {*view, document_.scene(), summary_, document_.look(), playback_.pictureTime(),
                       panel_.target(), isThroughTheLook()},
                      hands_.mouse());
    else
      handles_.hide();
  }

  void layOutNotices(const glm::vec2& window) {
    Notices notices(window);
    notices.problems(document_.problems());
    if (unsaved_.offered()) {
      const Notices::Answer answer = notices.kept(*unsaved_.offered());
      if (answer != Notices::Answer::none) {
        if (const Status status = unsaved_.answer(document_, answer == Notices::Answer::take); !status)
          document_.tell(Concern::saving, status.error().message());
        settling_ = kSettling;
      }
    }
    if (job_ && notices.job(*job_)) {
      if (job_->state().isDone)
        job_.reset();
      else
        job_->cancel();
      settling_ = kSettling;
    }
  }

  void layOutDialogs(const glm::vec2& window) {
    if (openDialog_.isOpen() || saveDialog_.isOpen() || dropDialog_.isOpen()) showsLooks_ = false;
    if (showsLooks_) {
      std::vector<std::string> names;
      for (const auto& [name, look] : allLooks()) names.push_back(name);
      const auto pictureOf = [&](size_t number) {
        area_.keep(pictures().look(number));
        return pictures().look(number);
      };
      if (const auto taken = layOutLookSheet(window, names, pictureOf, window.x / window.y)) {
        document_.openLook(names[*taken]);
        showsLooks_ = false;
      }
    }
    if (openDialog_.isOpen())
      if (const auto wish = openDialog_.layOut(window)) openScenes(*wish);
    if (saveDialog_.isOpen())
      if (const auto wish = saveDialog_.layOut(window)) make(*wish);
    if (dropDialog_.isOpen())
      if (const auto answer = dropDialog_.layOut(window)) {
        if (answer->scenes) openScenes(*answer->scenes);
        if (!answer->background.empty()) document_.openBackground(answer->background);
        if (!answer->knob.empty()) {
          pause();
          const auto text =
              turnedAt(document_.look(), answer->knob, answer->picture, playback_.pictureTime());
          turned(text ? document_.set(answer->knob, *text) : Status(noTrackOf(answer->knob)));
        }
      }
  }

  std::string facts() const {
    const std::shared_ptr<const Picture>& picture = pictures().shown();
    if (!picture) return notice_;
    const VkExtent2D extent = picture->image.extent();
    return (notice_.empty() || !document_.edits().empty() ? "" : notice_ + "\n") +
           (hands_.isHeld(Command::compare) ? "as it is saved, " : "") + std::to_string(extent.width) +
           " x " + std::to_string(extent.height) + ", " +
           std::to_string(int(std::lround(picture->milliseconds))) + " ms";
  }

  const ViewerOptions& options_;
  Window& window_;
  Document document_;
  InterfaceInput input_;
  std::unique_ptr<Drawing> drawing_;
  std::unique_ptr<ShaderBuild> shaders_;

  // Scenes that are open, and what of them is kept outside of their files.
  std::vector<std::string> opened_;
  uint64_t sceneVersion_ = 0, lookVersion_ = 0;  // that are known here
  SceneSummary summary_;
  std::vector<std::string> clips_;
  size_t nextCamera_ = 0;
  std::string title_;
  Unsaved unsaved_;
  RecentFiles recent_;
  std::unique_ptr<ExportJob> job_;
  ExportJob::State jobState_;  // that is shown

  uint64_t lastShown_ = 0;  // the picture's number

  Camera camera_;
  Hands hands_;
  Handles handles_;
  std::optional<Addable> adding_;  // as soon as it is known where

  Playback playback_;
  std::optional<double> duration_;  // that somebody has set
  PictureArea area_;
  Panel panel_;
  Timeline timeline_;
  OpenDialog openDialog_;
  SaveDialog saveDialog_;
  DropDialog dropDialog_;
  LookShelf looks_;
  std::string notice_;  // of what was saved, until something is turned again
  bool showsHelp_ = false, showsPanel_ = true, showsPasses_ = false, showsLooks_ = false,
       showsHandles_ = false;
  double lastFrame_ = 0;
  int settling_ = kSettling;
};

Result<std::unique_ptr<Renderer>> rendererFor(const ViewerOptions& options, const std::string& shaderFolder) {
  RendererOptions renderer = options.renderer;
  renderer.shaderFolder = shaderFolder;
  return createRenderer(Window::vulkanWishes(), renderer);
}

}  // namespace

Status runViewer(const ViewerOptions& options) {
  const std::string title = std::filesystem::path(options.sources.opened.scenes[0]).filename().string();
  Result<std::unique_ptr<Window>> window = Window::open(title, options.width, options.height);
  if (!window) return window.error();
  std::string shaderFolder;
  std::unique_ptr<ShaderBuild> shaders;
  if (!options.shaderBuild.empty()) {
    Result<std::unique_ptr<ShaderBuild>> build = ShaderBuild::open(options.shaderBuild, Window::wake);
    if (!build) return build.error();
    shaders = std::move(build).value();
    shaderFolder = shaders->folder();
  }
  Result<std::unique_ptr<Renderer>> renderer = rendererFor(options, shaderFolder);
  if (!renderer) return renderer.error();
  const InterfaceContext context;
  Viewer viewer(options, **window);
  viewer.setShaders(std::move(shaders));

  for (int losses = 0;;) {
    try {
      const Result<Viewer::End> end = viewer.run(std::move(renderer).value());
      if (!end) return end.error();
      if (*end == Viewer::End::closed) return Done{};
      viewer.loseDevice();
      renderer = rendererFor(options, shaderFolder);
      if (!renderer) return renderer.error();
    } catch (const VulkanFailure& failure) {
      viewer.loseDevice();
      const bool isLost = failure.result == VK_ERROR_DEVICE_LOST;
      const std::string advice = isLost ? "knobs that were turned are kept, and offered at the next start"
                                        : "`scumble render` needs no window";
      const Error error{ErrorKind::noUsableGpu, "", 0, "", failure.what(), advice};
      if (!isLost || ++losses > kMostLosses) return error;
      renderer = rendererFor(options, shaderFolder);
      if (!renderer) return error;
    } catch (const std::exception& failure) {
      viewer.loseDevice();
      return Error{ErrorKind::internal,
                   "",
                   0,
                   "",
                   failure.what(),
                   "knobs that were turned are kept, and offered at the next start; please report this"};
    }
  }
}

}  // namespace scumble::viewer
