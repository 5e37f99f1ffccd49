#include "viewer.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <set>

#include "bindings.h"
#include "glfw.h"
#include "interface.h"
#include "interface_input.h"
#include "interface_pass.h"
#include "navigation.h"
#include "picture_maker.h"
#include "screen.h"
#include "sharpness.h"
#include "style.h"
#include "window.h"

namespace scumble::viewer {

namespace {

constexpr double kFrameSeconds = 1 / 60.0;  // of the window, while something moves by itself
constexpr float kFlySpeed = 0.8f;           // distances to what is looked at, a second
constexpr float kDragZoom = 12;             // steps over the window's height
constexpr int kSettling = 3;                // frames after an event until the interface rests

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

class Viewer {
 public:
  Viewer(const ViewerOptions& options, Window& window, std::unique_ptr<Renderer> renderer)
      : options_(options),
        window_(window),
        maker_(std::move(renderer), Window::wake),
        device_(vulkanDeviceOf(maker_.renderer())),
        document_(options.sources, Window::wake),
        input_(window),
        screen_(device_, window.makeSurface(device_.instance)) {
    playback_.playhead = options.time;
    setStyle(window.contentScale());
    ImGui::GetIO().DisplaySize = {float(options.width), float(options.height)};
    pass_ = std::make_unique<InterfacePass>(device_, screen_.format());
  }
  ~Viewer() { screen_.settle(); }

  Status run() {
    while (!window_.shouldClose()) {
      window_.wait(untilNextFrame());
      input_.add(window_.takeEvents());
      if (input_.hasMore() || window_.wasTouched()) settling_ = kSettling;
      if (const Status status = takeDocument(); !status) return status.error();
      takePictures();
      if (settling_ == 0 && !moves() && !isDue()) continue;
      if (settling_ > 0) --settling_;
      drawFrame();
    }
    return maker_.renderer().validationMessages() == 0
               ? Status(Done{})
               : Error{ErrorKind::internal, "", 0, "", "the Vulkan validation layers have complained",
                       "see above"};
  }

 private:
  // Whether something goes on without anybody doing anything.
  bool moves() const { return playback_.moves() || !flying_.empty(); }
  // What has moved rests, and is to be drawn in full.
  bool isDue() const { return isCoarse_ && !sharpness_.isMoving(now()); }

  double untilNextFrame() const {
    if (input_.hasMore()) return 0;
    if (settling_ > 0 || moves()) return std::max(lastFrame_ + kFrameSeconds - now(), 0.0);
    return isCoarse_ ? std::max(sharpness_.untilRest(now()), 0.0) : -1;
  }

  Status takeDocument() {
    const Result<bool> news = document_.poll();
    if (!news) return news.error();
    if (!*news) return Done{};
    settling_ = kSettling;
    const SceneSummary summary = document_.scene().summary();
    glm::vec3 low, high;
    for (int i = 0; i < 3; ++i) low[i] = float(summary.min[i]), high[i] = float(summary.max[i]);
    centre_ = 0.5f * (low + high), radius_ = std::max(0.5f * glm::distance(low, high), 1e-6f);
    playback_.duration = playedSeconds(document_.scene(), document_.look());
    return Done{};
  }

  // ---- Pictures

  void takePictures() {
    if (const auto failure = maker_.takeFailure()) {
      document_.tell(failure->message());
      settling_ = kSettling;
    }
    std::shared_ptr<const Picture> latest = maker_.latest();
    if (!latest || (picture_ && latest->number == picture_->number)) return;
    const VkExtent2D extent = latest->image.extent();
    sharpness_.drew({extent.width, extent.height}, latest->milliseconds);
    picture_ = std::move(latest);
    settling_ = kSettling;
  }

  void wish(const glm::uvec2& full) {
    if (document_.scene().empty()) return;
    if (moves()) sharpness_.moved(now());
    const glm::uvec2 size = sharpness_.isMoving(now()) ? sharpness_.sizeWhileMoving(full) : full;
    isCoarse_ = size != full;
    const Wished wished{document_.version(), moves_, size, playback_.pictureTime()};
    if (wished_ == wished) return;
    wished_ = wished;
    maker_.wish({document_.scene(), document_.look(), viewpoint(), wished.time, size, options_.samples,
                 options_.seed});
  }

  Viewpoint viewpoint() const {
    return isHandHeld_ ? navigation_.viewpoint() : base_.value_or(options_.viewpoint);
  }

  // ---- Hands

  // From where it is seen, whether or not that is drawn already.
  std::optional<View> presentView() const {
    const glm::uvec2 size = window_.framebufferSize();
    if (document_.scene().empty() || size.x == 0 || size.y == 0) return std::nullopt;
    const Result<std::vector<View>> views =
        makeViews(document_.scene(), viewpoint(), float(size.x) / float(size.y), Stereo::mono, 0.063f,
                  document_.look(), playback_.pictureTime());
    return views ? std::optional(views->front()) : std::nullopt;
  }

  // The camera is the hand's from now on.
  Navigation& hold() {
    if (!isHandHeld_)
      if (const std::optional<View> view = presentView()) {
        navigation_.takeUp(*view, centre_, radius_);
        isHandHeld_ = true;
      }
    sharpness_.moved(now());
    ++moves_;
    return navigation_;
  }

  void letGo(const std::optional<Viewpoint>& base) {
    base_ = base, isHandHeld_ = false;
    ++moves_;
  }

  // All of it, from where it is seen now.
  void frameAll() {
    const std::optional<View> view = presentView();
    if (!view) return;
    const glm::vec3 away = glm::normalize(glm::vec3(glm::inverse(view->worldToEye)[2]));
    Viewpoint all;
    all.orbit = true;
    all.azimuth = glm::degrees(std::atan2(away.x, away.z));
    all.elevation = glm::degrees(std::asin(std::clamp(away.y, -1.0f, 1.0f)));
    letGo(all);
  }

  void copyCommand() const {
    const glm::uvec2 size = window_.framebufferSize();
    const bool isOwn = isHandHeld_ || base_;
    window_.copy(options_.command({isOwn ? std::optional(viewpoint()) : std::nullopt, document_.lookName(),
                                   document_.edits(), playback_.pictureTime(), size.x, size.y}));
  }

  void save() {
    const Result<std::string> file = document_.save();
    if (file)
      notice_ = "saved to " + *file;
    else
      document_.tell(file.error().message());
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
        copyCommand();
        break;
      case Command::save:
        save();
        break;
      case Command::undo:
        document_.undo();
        break;
      case Command::redo:
        document_.redo();
        break;
      case Command::frameAll:
        frameAll();
        break;
      case Command::lookCamera:
        letGo(std::nullopt);
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
        flying_.insert(command);
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

  void take(const Event& event, const glm::uvec2& size) {
    const ImGuiIO& io = ImGui::GetIO();
    if (const auto* moved = std::get_if<MouseMoved>(&event)) {
      const glm::vec2 way = (moved->to - mouse_) / float(std::max(size.y, 1u));
      mouse_ = moved->to;
      if (button_ >= 0 && picture_ && way != glm::vec2(0)) drag(way);
    } else if (const auto* button = std::get_if<MouseButton>(&event)) {
      modifiers_ = button->modifiers;
      if (!button->isDown && button->button == button_) button_ = -1;
      if (button->isDown && button_ < 0 && !io.WantCaptureMouse && button->button <= GLFW_MOUSE_BUTTON_MIDDLE)
        button_ = button->button;
    } else if (const auto* wheel = std::get_if<MouseWheel>(&event)) {
      if (!io.WantCaptureMouse && picture_ && wheel->steps.y != 0) hold().zoom(wheel->steps.y);
    } else if (const auto* key = std::get_if<Key>(&event)) {
      modifiers_ = modifiersAfter(*key);
      const std::optional<Command> command = commandOf(key->key, key->modifiers);
      if (key->isDown && command && (!key->isRepeated || repeats(*command)) &&
          (!io.WantTextInput || *command == Command::quit))
        obey(*command);
      // A key that is let go of may have others beside it by now.
      if (!key->isDown)
        for (const Binding& binding : bindings())
          if (binding.key == key->key) flying_.erase(binding.command);
    } else if (const auto* focus = std::get_if<Focus>(&event)) {
      if (!focus->isThere) flying_.clear(), button_ = -1, modifiers_ = 0;
    }
  }

  void fly(double seconds) {
    glm::vec3 way(0);
    const auto add = [&](Command command, const glm::vec3& direction) {
      if (flying_.count(command)) way += direction;
    };
    add(Command::flyRight, {1, 0, 0}), add(Command::flyLeft, {-1, 0, 0});
    add(Command::flyUp, {0, 1, 0}), add(Command::flyDown, {0, -1, 0});
    add(Command::flyForwards, {0, 0, 1}), add(Command::flyBack, {0, 0, -1});
    if (way != glm::vec3(0) && picture_) hold().fly(float(seconds) * kFlySpeed * way);
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
    layOut({io.DisplaySize.x, io.DisplaySize.y});
    ImGui::Render();
    if (!isSeen) {
      isCoarse_ = false;
      return;
    }
    wish(size);
    screen_.draw(size, [&](VkCommandBuffer commands, uint32_t frame) {
      held_[frame] = picture_;
      pass_->record(commands, frame, *ImGui::GetDrawData(), screen_.extent());
    });
  }

  void layOut(const glm::vec2& window) {
    if (picture_) {
      const VkExtent2D extent = picture_->image.extent();
      layOutPicture(window, {extent.width, extent.height}, ImTextureID(picture_->image.view()));
    } else {
      layOutWaiting(window, document_.scene().empty() ? "Reading the scene" : "Drawing the first picture");
    }
    bool isTurned = false;
    if (playback_.duration > 0) isTurned |= layOutTime(window, playback_);
    if (showsPanel_ && !document_.scene().empty())
      isTurned |=
          layOutPanel(window, options_.title, facts(), document_, inspector_, playback_.pictureTime());
    if (isTurned) {
      sharpness_.moved(now());
      settling_ = kSettling;
      playback_.duration = playedSeconds(document_.scene(), document_.look());
    }
    if (!document_.problem().empty()) layOutProblem(window, document_.problem());
    if (showsHelp_) layOutHelp(window);
  }

  std::string facts() const {
    if (!picture_) return notice_;
    const VkExtent2D extent = picture_->image.extent();
    return (notice_.empty() || !document_.edits().empty() ? "" : notice_ + "\n") +
           std::to_string(extent.width) + " x " + std::to_string(extent.height) + ", " +
           std::to_string(int(std::lround(picture_->milliseconds))) + " ms";
  }

  const ViewerOptions& options_;
  Window& window_;
  PictureMaker maker_;
  const VulkanDevice device_;
  Document document_;
  InterfaceInput input_;
  Screen screen_;
  std::unique_ptr<InterfacePass> pass_;
  std::array<std::shared_ptr<const Picture>, Screen::kFrames> held_;  // which frames under way show

  glm::vec3 centre_{0};
  float radius_ = 1;

  // What was last asked for.
  struct Wished {
    uint64_t version = 0, moves = 0;
    glm::uvec2 size{0};
    double time = 0;
    bool operator==(const Wished&) const = default;
  } wished_;
  std::shared_ptr<const Picture> picture_;
  Sharpness sharpness_;
  bool isCoarse_ = false;

  Navigation navigation_;
  uint64_t moves_ = 0;  // of the camera
  bool isHandHeld_ = false;
  std::optional<Viewpoint> base_;
  glm::vec2 mouse_{0};
  int button_ = -1, modifiers_ = 0;
  std::set<Command> flying_;

  Playback playback_;
  Inspector inspector_;
  std::string notice_;  // of what was saved, until something is turned again
  bool showsHelp_ = false, showsPanel_ = true;
  double lastFrame_ = 0;
  int settling_ = kSettling;
};

}  // namespace

Status runViewer(const ViewerOptions& options) {
  Result<std::unique_ptr<Window>> window = Window::open(options.title, options.width, options.height);
  if (!window) return window.error();
  VulkanWishes wishes;
  wishes.instanceExtensions = Window::instanceExtensions();
  wishes.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  Result<std::unique_ptr<Renderer>> renderer = createRenderer(wishes, options.renderer);
  if (!renderer) return renderer.error();
  try {
    const Context context;
    Viewer viewer(options, **window, std::move(renderer).value());
    return viewer.run();
  } catch (const VulkanFailure& failure) {
    return Error{ErrorKind::noUsableGpu, "", 0, "", failure.what(), "`scumble render` needs no window"};
  }
}

}  // namespace scumble::viewer
