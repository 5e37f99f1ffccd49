#include "viewer.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <set>

#include "bindings.h"
#include "camera.h"
#include "dialogs.h"
#include "glfw.h"
#include "interface.h"
#include "interface_input.h"
#include "interface_pass.h"
#include "look_sheet.h"
#include "panel.h"
#include "passes_strip.h"
#include "pictures.h"
#include "recent_files.h"
#include "screen.h"
#include "style.h"
#include "unsaved.h"
#include "visible.h"
#include "window.h"

namespace scumble::viewer {

namespace {

constexpr double kFrameSeconds = 1 / 60.0;  // of the window, while something moves by itself
constexpr float kFlySpeed = 0.8f;           // distances to what is looked at, a second
constexpr float kDragZoom = 12;             // steps over the window's height
constexpr float kClick = 0.25f;             // heights of letters that a hand may move while it clicks
constexpr int kSettling = 3;                // frames after an event until the interface rests
constexpr int kMostLosses = 3;              // of the device, one after the other

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// What goes on while its key is held.
bool repeats(Command command) {
  constexpr Command kRepeated[] = {Command::rollLeft, Command::rollRight, Command::narrow, Command::widen,
                                   Command::stepBack, Command::stepOn,    Command::undo,   Command::redo};
  return std::find(std::begin(kRepeated), std::end(kRepeated), command) != std::end(kRepeated);
}

// ImGui's context, as long as the window.
struct Context {
  Context() { ImGui::CreateContext(); }
  ~Context() { ImGui::DestroyContext(); }
};

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

class Viewer {
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
    if (options.isStereo) eyes_ = Eyes::sideBySide;
    setStyle(window.contentScale());
    ImGui::GetIO().DisplaySize = {float(options.width), float(options.height)};
  }

  // Until it is closed. Throws VulkanFailure where the device cannot go on; what the window shows stays, and
  // it can be run again with another one.
  Status run(std::unique_ptr<Renderer> renderer) {
    drawing_ = std::make_unique<Drawing>(options_, window_, std::move(renderer));
    settling_ = kSettling;
    while (!window_.shouldClose()) {
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
    return pictures().renderer().validationMessages() == 0
               ? Status(Done{})
               : Error{ErrorKind::internal, "", 0, "", "the Vulkan validation layers have complained",
                       "see above"};
  }
  // After run() has thrown.
  void loseDevice() {
    keepEdits(true);
    shown_.clear();
    drawing_.reset();
  }

 private:
  Pictures& pictures() { return drawing_->pictures; }
  const Pictures& pictures() const { return drawing_->pictures; }

  bool isFlying() const {
    return std::any_of(held_.begin(), held_.end(),
                       [](Command command) { return command != Command::compare; });
  }
  // Whether something goes on without anybody doing anything.
  bool moves() const { return playback_.moves() || isFlying(); }

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
    if (sceneVersion_ != document_.sceneVersion()) {
      sceneVersion_ = document_.sceneVersion();
      summary_ = document_.scene().summary();
      clips_.clear();
      for (const SceneSummary::Clip& clip : summary_.clips)
        clips_.push_back(clip.name.empty() ? std::to_string(clips_.size()) : clip.name);
      camera_.setBounds(summary_);
    }
    playback_.duration = playedSeconds(document_.scene(), document_.look());
    if (opened_ != document_.opened().scenes) takeScenes();
    return Done{};
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
    const Stereo stereo = isSeenByBoth() ? Stereo::stereo : Stereo::mono;
    pictures().begin(document_, {camera_.viewpoint(), camera_.moves(), playback_.pictureTime(), stereo},
                     presentViewSize(full), now());
    pictures().askForShown(held_.count(Command::compare) > 0);
    if (showsSplit()) pictures().askForOther(otherLook_, lookOf(otherLook_));
    if (showsPasses_) pictures().askForThumbnails(), pictures().askForPass(passes_.chosen());
    if (showsLooks_) pictures().askForLooks(allLooks());
    pictures().end();
  }

  // A pass is seen by one eye.
  bool isSeenByBoth() const { return eyes_ != Eyes::one && passes_.chosen().empty(); }
  glm::uvec2 presentViewSize(const glm::uvec2& window) const {
    return viewSize(window, isSeenByBoth() ? eyes_ : Eyes::one);
  }
  bool showsSplit() const { return showsSplit_ && !isSeenByBoth(); }

  // By name; empty: the scene's own, as it is saved.
  const Look& lookOf(const std::string& name) {
    if (name.empty()) return document_.savedLook();
    const auto [known, isNew] = looks_.try_emplace(name);
    if (isNew)
      if (Result<Look> look = Look::load(name)) known->second = std::move(look).value();
    return known->second;
  }

  std::vector<std::pair<std::string, Look>> allLooks() {
    std::vector<std::pair<std::string, Look>> looks;
    for (const ShippedLook& shipped : shipped_) looks.emplace_back(shipped.name, lookOf(shipped.name));
    return looks;
  }

  // ---- Hands

  // From where it is seen, whether or not that is drawn already.
  std::optional<View> presentView() const {
    const glm::uvec2 size = presentViewSize(window_.framebufferSize());
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
            eyes_ != Eyes::one};
  }

  void openSaveDialog() {
    saveDialog_.open(document_.opened().scenes[0], viewSize(window_.framebufferSize(), eyes_),
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
    else if (!passes_.chosen().empty())
      passes_.choose("");
    else
      panel_.select({});
  }

  void take(const Dropped& dropped) {
    Drop drop = sorted(dropped.files);
    if (!drop.looks.empty()) document_.openLook(drop.looks.back());
    if (!drop.others.empty())
      document_.tell(Concern::scene, drop.others[0] +
                                         ": it is no scene, look or picture by its name; drop a "
                                         ".glb, .gltf, .tilt, .json, .png, .jpg or .webp");
    dropDialog_.open(std::move(drop));
  }

  void obey(Command command) {
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
              shellText(options_.command(presentlyShown(viewSize(window_.framebufferSize(), eyes_)))));
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
        held_.insert(command);
        break;
      case Command::open:
        openDialog_.open(recent_.files());
        break;
      case Command::make:
        if (!document_.scene().empty()) openSaveDialog();
        break;
      case Command::looks:
        showsLooks_ = !showsLooks_;
        break;
      case Command::split:
        showsSplit_ = !showsSplit_;
        break;
      case Command::passes:
        showsPasses_ = !showsPasses_;
        if (!showsPasses_) passes_.choose("");
        break;
      case Command::nextCamera:
        lookThroughNextCamera();
        break;
      case Command::eyes:
        eyes_ = Eyes((int(eyes_) + 1) % 4);
        break;
      case Command::leave:
        leave();
        break;
    }
  }

  void drag(const glm::vec2& way) {
    if (button_ == GLFW_MOUSE_BUTTON_RIGHT)
      hold().lookAround(way);
    else if (modifiers_ & GLFW_MOD_SHIFT)
      hold().pan(way);
    else if (modifiers_ & GLFW_MOD_CONTROL)
      hold().zoom(-kDragZoom * way.y);
    else
      hold().orbit(way);
  }

  // Where, across the window.
  void pick(glm::vec2 place) {
    const bool isHalf = presentViewSize({2, 1}).x == 1, isAtRight = isHalf && place.x >= 0.5f;
    if (isHalf) place.x = 2 * place.x - (isAtRight ? 1.0f : 0.0f);
    pictures().pick(place, isHalf && isAtRight == (eyes_ == Eyes::sideBySide) ? 1 : 0);
  }

  void press(const MouseButton& button, const glm::uvec2& size) {
    if (!button.isDown && button.button == button_) {
      if (isClick_ && button_ == GLFW_MOUSE_BUTTON_LEFT && pictures().shown())
        pick(mouse_ / glm::max(glm::vec2(size), 1.0f));
      button_ = -1;
    }
    if (button.isDown && button_ < 0 && !ImGui::GetIO().WantCaptureMouse &&
        button.button <= GLFW_MOUSE_BUTTON_MIDDLE) {
      button_ = button.button;
      pressedAt_ = mouse_;
      isClick_ = true;
    }
  }

  void move(const glm::vec2& to, const glm::uvec2& size) {
    const glm::vec2 from = isClick_ ? pressedAt_ : mouse_;
    mouse_ = to;
    if (button_ < 0 || !pictures().shown()) return;
    // A hand that clicks is not quite still.
    if (isClick_ && glm::distance(to, pressedAt_) < kClick * ImGui::GetFontSize()) return;
    isClick_ = false;
    if (to != from) drag((to - from) / float(std::max(size.y, 1u)));
  }

  void take(const Event& event, const glm::uvec2& size) {
    const ImGuiIO& io = ImGui::GetIO();
    if (const auto* moved = std::get_if<MouseMoved>(&event)) {
      move(moved->to, size);
    } else if (const auto* button = std::get_if<MouseButton>(&event)) {
      modifiers_ = button->modifiers;
      press(*button, size);
    } else if (const auto* wheel = std::get_if<MouseWheel>(&event)) {
      if (!io.WantCaptureMouse && pictures().shown() && wheel->steps.y != 0) hold().zoom(wheel->steps.y);
    } else if (const auto* key = std::get_if<Key>(&event)) {
      modifiers_ = modifiersAfter(*key);
      const std::optional<Command> command = commandOf(key->key, key->modifiers);
      const bool isForAll = command == Command::quit || command == Command::leave;
      if (key->isDown && command && (!key->isRepeated || repeats(*command)) &&
          (!io.WantTextInput || isForAll))
        obey(*command);
      // A key that is let go of may have others beside it by now.
      if (!key->isDown)
        for (const Binding& binding : bindings())
          if (binding.key == key->key) held_.erase(binding.command);
    } else if (const auto* focus = std::get_if<Focus>(&event)) {
      if (!focus->isThere) held_.clear(), button_ = -1, modifiers_ = 0;
    } else if (const auto* dropped = std::get_if<Dropped>(&event)) {
      take(*dropped);
    }
  }

  void fly(double seconds) {
    glm::vec3 way(0);
    const auto add = [&](Command command, const glm::vec3& direction) {
      if (held_.count(command)) way += direction;
    };
    add(Command::flyRight, {1, 0, 0}), add(Command::flyLeft, {-1, 0, 0});
    add(Command::flyUp, {0, 1, 0}), add(Command::flyDown, {0, -1, 0});
    add(Command::flyForwards, {0, 0, 1}), add(Command::flyBack, {0, 0, -1});
    if (way != glm::vec3(0) && pictures().shown()) hold().fly(float(seconds) * kFlySpeed * way);
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
    for (const Event& event : events) take(event, size);
    playback_.advance(moved);
    fly(moved);
    shown_.clear();
    layOut({io.DisplaySize.x, io.DisplaySize.y});
    ImGui::Render();
    if (!isSeen) {
      pictures().hide();
      return;
    }
    wish(size);
    drawing_->screen.draw(size, [&](VkCommandBuffer commands, uint32_t frame) {
      drawing_->held[frame] = shown_;
      drawing_->pass.record(commands, frame, *ImGui::GetDrawData(), drawing_->screen.extent());
    });
  }

  // What is laid out stays as long as the frame is under way.
  const Picture* kept(std::shared_ptr<const Picture> picture) {
    return picture ? shown_.emplace_back(std::move(picture)).get() : nullptr;
  }

  static PictureShown shownOf(const DeviceImage& image) {
    const VkExtent2D extent = image.extent();
    return {ImTextureID(image.view()), {extent.width, extent.height}};
  }

  void layOut(const glm::vec2& window) {
    layOutPictures(window);
    bool isTurned = false;
    const bool showsTime = showsPanel_ && playback_.duration > 0;
    if (showsTime) {
      const TimeChange change = layOutTime(window, playback_, clips_, document_.opened().clip);
      isTurned |= change.isMoved;
      if (change.clip) document_.openClip(*change.clip);
    }
    if (showsPasses_) {
      const float right = showsPanel_ ? panelWidth(window) - ImGui::GetFontSize() : 0;
      const float bottom = showsTime ? 4.5f * ImGui::GetFontSize() : 0;
      passes_.layOut(window - glm::vec2(right, bottom), kept(pictures().thumbnails()),
                     kept(pictures().shown()), pixelFacts());
    }
    if (showsPanel_ && !document_.scene().empty())
      isTurned |= panel_.layOut(window, {title_, facts(), playback_.pictureTime()}, document_,
                                showsSplit() ? &otherLook_ : nullptr);
    layOutNotices(window);
    layOutDialogs(window);
    if (showsHelp_) layOutHelp(window);
    if (isTurned) {
      pictures().moved(now());
      settling_ = kSettling;
      playback_.duration = playedSeconds(document_.scene(), document_.look());
    }
  }

  void layOutPictures(const glm::vec2& window) {
    const Picture* const picture = kept(pictures().shown());
    if (!picture) {
      layOutWaiting(window, document_.scene().empty() ? "Reading the scene" : "Drawing the first picture");
      return;
    }
    PictureShown first = shownOf(picture->image);
    if (isSeenByBoth() && picture->right.handle() != VK_NULL_HANDLE) {
      layOutEyes(window, first, shownOf(picture->right), eyes_);
      return;
    }
    if (!passes_.chosen().empty())
      if (const Picture* const pass = kept(pictures().pass()))
        for (const Picture::Layer& layer : pass->layers)
          if (layer.aov == passes_.chosen()) first = shownOf(layer.shown);
    const Picture* const other = showsSplit() ? kept(pictures().other()) : nullptr;
    const PictureShown second = other ? shownOf(other->image) : PictureShown();
    layOutPicture(window, first, other ? &second : nullptr, split_);
    if (showsSplit() &&
        layOutSplit(window, "as it is", otherLook_.empty() ? "as it is saved" : otherLook_, split_))
      settling_ = kSettling;
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
      for (const ShippedLook& shipped : shipped_) names.push_back(shipped.name);
      const auto pictureOf = [&](size_t number) {
        kept(pictures().look(number));
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
        if (!answer->knob.empty())
          if (const Status status = document_.set(answer->knob, answer->picture); !status)
            document_.tell(Concern::knob, status.error().message());
      }
  }

  // What is under the mouse, where the strip of passes is open.
  std::string pixelFacts() const {
    const std::shared_ptr<const Picture> pass = pictures().pass();
    const glm::vec2 window{ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y};
    if (!pass || isSeenByBoth() || ImGui::GetIO().WantCaptureMouse ||
        glm::any(glm::lessThan(mouse_, glm::vec2(0))) || glm::any(glm::greaterThanEqual(mouse_, window)))
      return "";
    std::string text;
    // Numbers that have names.
    const auto named = [](const std::vector<std::string>& names, float number) {
      return number >= 1 && size_t(number) <= names.size() ? names[size_t(number) - 1] : "nothing";
    };
    for (const Picture::Layer& layer : pass->layers) {
      const glm::uvec2 size{layer.values.width, layer.values.height};
      const glm::uvec2 at = glm::min(glm::uvec2(mouse_ / window * glm::vec2(size)), size - 1u);
      text += (text.empty() ? "" : "\n") + layer.aov + ": ";
      text += layer.aov == "id" ? named(pass->objects, layer.values.at(at.x, at.y, 0)) + ", " +
                                      named(pass->materials, layer.values.at(at.x, at.y, 1))
                                : pixelText(layer.values, at.x, at.y);
    }
    return text;
  }

  std::string facts() const {
    const std::shared_ptr<const Picture>& picture = pictures().shown();
    if (!picture) return notice_;
    const VkExtent2D extent = picture->image.extent();
    return (notice_.empty() || !document_.edits().empty() ? "" : notice_ + "\n") +
           (held_.count(Command::compare) ? "as it is saved, " : "") + std::to_string(extent.width) + " x " +
           std::to_string(extent.height) + ", " + std::to_string(int(std::lround(picture->milliseconds))) +
           " ms";
  }

  const ViewerOptions& options_;
  Window& window_;
  Document document_;
  InterfaceInput input_;
  std::unique_ptr<Drawing> drawing_;

  // Scenes that are open, and what of them is kept outside of their files.
  std::vector<std::string> opened_;
  uint64_t sceneVersion_ = 0;
  SceneSummary summary_;
  std::vector<std::string> clips_;
  size_t nextCamera_ = 0;
  std::string title_;
  Unsaved unsaved_;
  RecentFiles recent_;
  std::unique_ptr<ExportJob> job_;
  ExportJob::State jobState_;  // that is shown

  std::vector<std::shared_ptr<const Picture>> shown_;  // by the frame that is laid out
  uint64_t lastShown_ = 0;                             // its number

  Camera camera_;
  glm::vec2 mouse_{0}, pressedAt_{0};
  bool isClick_ = false;
  int button_ = -1, modifiers_ = 0;
  std::set<Command> held_;

  Playback playback_;
  Panel panel_;
  PassesStrip passes_;
  OpenDialog openDialog_;
  SaveDialog saveDialog_;
  DropDialog dropDialog_;
  const std::vector<ShippedLook> shipped_ = Look::shipped();
  std::map<std::string, Look> looks_;  // those of them that were compared with
  std::string otherLook_;              // beside the line; empty: as it is saved
  float split_ = 0.5f;
  Eyes eyes_ = Eyes::one;
  std::string notice_;  // of what was saved, until something is turned again
  bool showsHelp_ = false, showsPanel_ = true, showsPasses_ = false, showsLooks_ = false, showsSplit_ = false;
  double lastFrame_ = 0;
  int settling_ = kSettling;
};

Result<std::unique_ptr<Renderer>> rendererFor(const ViewerOptions& options) {
  VulkanWishes wishes;
  wishes.instanceExtensions = Window::instanceExtensions();
  wishes.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  return createRenderer(wishes, options.renderer);
}

}  // namespace

Status runViewer(const ViewerOptions& options) {
  const std::string title = std::filesystem::path(options.sources.opened.scenes[0]).filename().string();
  Result<std::unique_ptr<Window>> window = Window::open(title, options.width, options.height);
  if (!window) return window.error();
  Result<std::unique_ptr<Renderer>> renderer = rendererFor(options);
  if (!renderer) return renderer.error();
  const Context context;
  Viewer viewer(options, **window);
  for (int losses = 0;;) {
    try {
      return viewer.run(std::move(renderer).value());
    } catch (const VulkanFailure& failure) {
      viewer.loseDevice();
      const bool isLost = failure.result == VK_ERROR_DEVICE_LOST;
      const std::string advice = isLost ? "knobs that were turned are kept, and offered at the next start"
                                        : "`scumble render` needs no window";
      const Error error{ErrorKind::noUsableGpu, "", 0, "", failure.what(), advice};
      if (!isLost || ++losses > kMostLosses) return error;
      renderer = rendererFor(options);
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
