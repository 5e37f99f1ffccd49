#include "viewer.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "bindings.h"
#include "file_watch.h"
#include "glfw.h"
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

constexpr double kFilmRate = 24;            // pictures a second of what plays
constexpr double kFrameSeconds = 1 / 60.0;  // of the window, while something moves by itself
constexpr float kFlySpeed = 0.8f;           // distances to what is looked at, a second
constexpr int kSettling = 3;                // frames after an event until the interface rests

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// ImGui's context, as long as the window.
struct Context {
  Context() { ImGui::CreateContext(); }
  ~Context() { ImGui::DestroyContext(); }
};

struct Loaded {
  std::optional<Scene> scene;  // where it was read anew
  Look look;
};

class Viewer {
 public:
  Viewer(const ViewerOptions& options, Window& window, std::unique_ptr<Renderer> renderer)
      : options_(options),
        window_(window),
        maker_(std::move(renderer), Window::wake),
        device_(vulkanDeviceOf(maker_.renderer())),
        watch_(Window::wake),
        input_(window),
        screen_(device_, window.makeSurface(device_.instance)),
        playhead_(options.time) {
    setStyle(window.contentScale());
    pass_ = std::make_unique<InterfacePass>(device_, screen_.format());
    load(true);
  }
  ~Viewer() {
    if (loader_.joinable()) loader_.join();
    screen_.settle();
  }

  Status run() {
    while (!window_.shouldClose()) {
      window_.wait(untilNextFrame());
      input_.add(window_.takeEvents());
      if (input_.hasMore() || window_.wasTouched()) settling_ = kSettling;
      if (const Status status = takeLoaded(); !status) return status;
      takeSaved();
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
  bool moves() const { return (isPlaying_ && duration_ > 0) || isFlying(); }
  // What has moved rests, and is to be drawn in full.
  bool isDue() const { return isCoarse_ && !sharpness_.isMoving(now()); }
  bool isFlying() const { return !flying_.empty(); }

  double untilNextFrame() const {
    if (input_.hasMore()) return 0;
    if (settling_ > 0 || moves()) return std::max(lastFrame_ + kFrameSeconds - now(), 0.0);
    return isCoarse_ ? std::max(sharpness_.untilRest(now()), 0.0) : -1;
  }

  // ---- Files

  void load(bool withScene) {
    if (loader_.joinable()) {
      loadsAgain_ = true, loadsSceneAgain_ |= withScene;
      return;
    }
    loader_ = std::thread([this, withScene, scene = scene_] {
      Result<Loaded> loaded = read(withScene, scene);
      {
        const std::lock_guard lock(loadedMutex_);
        loaded_ = std::move(loaded);
      }
      Window::wake();
    });
  }
  Result<Loaded> read(bool withScene, const Scene& scene) const {
    Loaded loaded;
    if (withScene) {
      Result<Scene> anew = options_.loadScene();
      if (!anew) return anew.error();
      loaded.scene = std::move(anew).value();
    }
    Result<Look> look = options_.loadLook(withScene ? *loaded.scene : scene);
    if (!look) return look.error();
    loaded.look = std::move(look).value();
    return loaded;
  }
  std::optional<Result<Loaded>> loadedLast() {
    const std::lock_guard lock(loadedMutex_);
    return std::exchange(loaded_, std::nullopt);
  }

  // The first time all must be right; later what was there stays.
  Status takeLoaded() {
    std::optional<Result<Loaded>> last = loadedLast();
    if (!last) return Done{};
    loader_.join();
    Result<Loaded>& loaded = *last;
    settling_ = kSettling;
    if (loaded) {
      problem_.clear();
      if (loaded->scene) takeScene(std::move(*loaded->scene));
      look_ = std::move(loaded->look);
      duration_ = playedSeconds(scene_, look_);
      ++version_;
    } else if (scene_.empty()) {
      return loaded.error();
    } else {
      problem_ = loaded.error().message();
    }
    std::vector<std::string> files = options_.sceneFiles;
    files.insert(files.end(), scene_.files().begin(), scene_.files().end());
    if (!options_.lookFile.empty()) files.push_back(options_.lookFile);
    for (const std::string& file : look_.files()) files.push_back(file);
    watch_.watch(files);
    if (std::exchange(loadsAgain_, false)) load(std::exchange(loadsSceneAgain_, false));
    return Done{};
  }

  void takeScene(Scene scene) {
    scene_ = std::move(scene);
    const SceneSummary summary = scene_.summary();
    glm::vec3 low, high;
    for (int i = 0; i < 3; ++i) low[i] = float(summary.min[i]), high[i] = float(summary.max[i]);
    centre_ = 0.5f * (low + high), radius_ = std::max(0.5f * glm::distance(low, high), 1e-6f);
  }

  void takeSaved() {
    const std::set<std::string> saved = watch_.takeSaved();
    if (saved.empty()) return;
    const std::vector<std::string>& own = options_.sceneFiles;
    const std::vector<std::string>& named = scene_.files();
    load(std::any_of(saved.begin(), saved.end(), [&](const std::string& file) {
      return std::find(own.begin(), own.end(), file) != own.end() ||
             std::find(named.begin(), named.end(), file) != named.end();
    }));
  }

  // ---- Pictures

  void takePictures() {
    if (const auto failure = maker_.takeFailure()) {
      problem_ = failure->second.message();
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
    if (scene_.empty() || full.x == 0 || full.y == 0) return;
    if (moves()) sharpness_.moved(now());
    isCoarse_ = sharpness_.isMoving(now());
    const glm::uvec2 size = isCoarse_ ? sharpness_.sizeWhileMoving(full) : full;
    isCoarse_ = size != full;
    const double time = pictureTime();
    if (wished_ == Wished{version_, size, time}) return;
    wished_ = {version_, size, time};
    maker_.wish({scene_, look_, viewpoint(), time, size, options_.samples, options_.seed});
  }

  // Frames of a film, or every second one.
  double pictureTime() const {
    const double rate = onTwos_ ? kFilmRate / 2 : kFilmRate;
    return std::floor(playhead_ * rate + 1e-6) / rate;
  }

  Viewpoint viewpoint() const {
    return isHandHeld_ ? navigation_.viewpoint() : base_.value_or(options_.viewpoint);
  }

  // ---- Hands

  // The camera is the hand's from now on, from where the picture sees.
  Navigation& hold() {
    if (!isHandHeld_ && picture_) {
      navigation_.takeUp(picture_->view, centre_, radius_);
      isHandHeld_ = true;
    }
    sharpness_.moved(now());
    ++version_;
    return navigation_;
  }

  void frameFrom(const std::optional<glm::vec2>& azimuthAndElevation) {
    if (azimuthAndElevation) {
      hold().lookFrom(azimuthAndElevation->x, azimuthAndElevation->y);
      return;
    }
    // All of it, from where it is seen now.
    const glm::vec3 away =
        picture_ ? glm::vec3(glm::inverse(picture_->view.worldToEye)[2]) : glm::vec3(0, 0, 1);
    Viewpoint all;
    all.orbit = true;
    all.azimuth = glm::degrees(std::atan2(away.x, away.z));
    all.elevation = glm::degrees(std::asin(std::clamp(away.y, -1.0f, 1.0f)));
    base_ = all, isHandHeld_ = false;
    ++version_;
  }

  void obey(Command command, bool isRepeated) {
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
      case Command::frameAll:
        frameFrom(std::nullopt);
        break;
      case Command::lookCamera:
        base_.reset(), isHandHeld_ = false, ++version_;
        break;
      case Command::viewFront:
        frameFrom(glm::vec2(0, 0));
        break;
      case Command::viewBack:
        frameFrom(glm::vec2(180, 0));
        break;
      case Command::viewRight:
        frameFrom(glm::vec2(90, 0));
        break;
      case Command::viewLeft:
        frameFrom(glm::vec2(-90, 0));
        break;
      case Command::viewTop:
        frameFrom(glm::vec2(0, 90));
        break;
      case Command::viewBottom:
        frameFrom(glm::vec2(0, -90));
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
        if (!isRepeated) isPlaying_ = !isPlaying_;
        break;
      case Command::stepBack:
        step(-1);
        break;
      case Command::stepOn:
        step(1);
        break;
      case Command::toStart:
        playhead_ = 0;
        break;
      case Command::onTwos:
        onTwos_ = !onTwos_;
        break;
      case Command::slower:
        speed_ = std::max(speed_ / 2, 1 / 16.0);
        break;
      case Command::faster:
        speed_ = std::min(speed_ * 2, 16.0);
        break;
      default:
        flying_.insert(command);
        break;
    }
  }

  void copyCommand() {
    const glm::uvec2 size = window_.framebufferSize();
    const bool isOwn = isHandHeld_ || base_;
    window_.copy(
        options_.command(isOwn ? std::optional(viewpoint()) : std::nullopt, pictureTime(), size.x, size.y));
  }

  void step(int frames) {
    const double rate = onTwos_ ? kFilmRate / 2 : kFilmRate;
    isPlaying_ = false;
    playhead_ = std::max(std::floor(playhead_ * rate + 1e-6) + frames, 0.0) / rate;
  }

  void take(const Event& event, const glm::uvec2& size) {
    const ImGuiIO& io = ImGui::GetIO();
    if (const auto* moved = std::get_if<MouseMoved>(&event)) {
      const glm::vec2 drag = (moved->to - mouse_) / float(std::max(size.y, 1u));
      mouse_ = moved->to;
      if (button_ < 0 || !picture_ || drag == glm::vec2(0)) return;
      if (button_ == GLFW_MOUSE_BUTTON_RIGHT)
        hold().lookAround(drag);
      else if (io.KeyShift)
        hold().pan(drag);
      else if (io.KeyCtrl)
        hold().zoom(-12 * drag.y);
      else
        hold().orbit(drag);
    } else if (const auto* button = std::get_if<MouseButton>(&event)) {
      if (!button->isDown && button->button == button_) button_ = -1;
      if (button->isDown && button_ < 0 && !io.WantCaptureMouse && button->button <= GLFW_MOUSE_BUTTON_MIDDLE)
        button_ = button->button;
    } else if (const auto* wheel = std::get_if<MouseWheel>(&event)) {
      if (!io.WantCaptureMouse && picture_ && wheel->steps.y != 0) hold().zoom(wheel->steps.y);
    } else if (const auto* key = std::get_if<Key>(&event)) {
      const std::optional<Command> command = commandOf(key->key, key->modifiers);
      if (key->isDown && command && !io.WantTextInput) obey(*command, key->isRepeated);
      // A key that is let go of may have others beside it by now.
      if (!key->isDown)
        for (const Binding& binding : bindings())
          if (binding.key == key->key) flying_.erase(binding.command);
    } else if (const auto* focus = std::get_if<Focus>(&event)) {
      if (!focus->isThere) flying_.clear(), button_ = -1;
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
    if (size.x == 0 || size.y == 0) {
      for (const Event& event : events) take(event, size);
      return;
    }
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {float(size.x), float(size.y)};
    io.DeltaTime = float(seconds);
    ImGui::NewFrame();
    for (const Event& event : events) take(event, size);
    if (isPlaying_ && duration_ > 0) playhead_ = std::fmod(playhead_ + seconds * speed_, duration_);
    fly(seconds);
    layOut(size);
    ImGui::Render();
    wish(size);
    screen_.draw(size, [&](VkCommandBuffer commands, uint32_t frame) {
      held_[frame] = picture_;
      pass_->record(commands, frame, *ImGui::GetDrawData());
    });
  }

  void layOut(const glm::uvec2& size) {
    const ImVec2 whole(float(size.x), float(size.y));
    if (picture_) {
      const VkExtent2D extent = picture_->image.extent();
      const float fit = std::min(whole.x / float(extent.width), whole.y / float(extent.height));
      const ImVec2 shown(float(extent.width) * fit, float(extent.height) * fit);
      const ImVec2 low(std::round((whole.x - shown.x) / 2), std::round((whole.y - shown.y) / 2));
      ImGui::GetBackgroundDrawList()->AddImage(ImTextureID(picture_->image.view()), low,
                                               {low.x + shown.x, low.y + shown.y});
    }
    const float unit = ImGui::GetFontSize();
    constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                        ImGuiWindowFlags_AlwaysAutoResize |
                                        ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
    if (!picture_) {
      ImGui::SetNextWindowPos({whole.x / 2, whole.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
      ImGui::Begin("waiting", nullptr, kFixed);
      ImGui::TextUnformatted(scene_.empty() ? "Reading the scene" : "Drawing the first picture");
      ImGui::End();
    }
    if (duration_ > 0) layOutTime(whole, unit, kFixed);
    if (!problem_.empty()) {
      ImGui::SetNextWindowPos({whole.x / 2, unit}, ImGuiCond_Always, {0.5f, 0});
      ImGui::SetNextWindowSize({std::min(whole.x - 2 * unit, 52 * unit), 0});
      ImGui::Begin("problem", nullptr, kFixed);
      ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.95f, 0.6f, 0.5f, 1));
      ImGui::TextWrapped("%s", problem_.c_str());
      ImGui::PopStyleColor();
      ImGui::TextDisabled("What was there before stays.");
      ImGui::End();
    }
    if (showsHelp_) layOutHelp(whole, unit, kFixed);
    if (showsPanel_) layOutPanel(whole, unit, kFixed);
  }

  void layOutTime(const ImVec2& whole, float unit, ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos({whole.x / 2, whole.y - unit}, ImGuiCond_Always, {0.5f, 1});
    ImGui::Begin("time", nullptr, flags);
    if (ImGui::Button(isPlaying_ ? "Pause" : "Play", {4.5f * unit, 0})) isPlaying_ = !isPlaying_;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(std::clamp(whole.x - 34 * unit, 8 * unit, 40 * unit));
    float at = float(pictureTime());
    if (ImGui::SliderFloat("##time", &at, 0, float(duration_), "%.2f s")) {
      playhead_ = std::clamp(double(at), 0.0, duration_), isPlaying_ = false;
      sharpness_.moved(now());
    }
    ImGui::SameLine();
    ImGui::Text("of %.2f s", duration_);
    ImGui::SameLine();
    ImGui::Checkbox("On twos", &onTwos_);
    if (speed_ != 1) {
      ImGui::SameLine();
      ImGui::Text("%g x", speed_);
    }
    ImGui::End();
  }

  void layOutHelp(const ImVec2& whole, float unit, ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos({unit, unit});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {whole.x - 2 * unit, whole.y - 2 * unit});
    ImGui::Begin("help", nullptr, flags);
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
      for (const HelpRow& row : helpRows()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(row.names.c_str());
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", row.meaning);
      }
      ImGui::EndTable();
    }
    ImGui::End();
  }

  void layOutPanel(const ImVec2& whole, float unit, ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos({whole.x - unit, unit}, ImGuiCond_Always, {1, 0});
    ImGui::Begin("panel", nullptr, flags);
    ImGui::TextUnformatted(options_.title.c_str());
    ImGui::PushTextWrapPos(24 * unit);
    if (!look_.description().empty()) ImGui::TextDisabled("%s", look_.description().c_str());
    ImGui::PopTextWrapPos();
    if (picture_) {
      const VkExtent2D extent = picture_->image.extent();
      ImGui::Separator();
      ImGui::Text("%u x %u, %.0f ms", extent.width, extent.height, picture_->milliseconds);
      const Viewpoint seen = viewpoint();
      if (seen.eye) ImGui::TextDisabled("eye %.2f, %.2f, %.2f", seen.eye->x, seen.eye->y, seen.eye->z);
      if (seen.verticalFov) ImGui::TextDisabled("field %.1f degrees", *seen.verticalFov);
    }
    ImGui::End();
  }

  const ViewerOptions& options_;
  Window& window_;
  PictureMaker maker_;
  const VulkanDevice device_;
  FileWatch watch_;
  InterfaceInput input_;
  Screen screen_;
  std::unique_ptr<InterfacePass> pass_;
  std::array<std::shared_ptr<const Picture>, Screen::kFrames> held_;  // which frames under way show

  std::thread loader_;
  std::mutex loadedMutex_;
  std::optional<Result<Loaded>> loaded_;
  bool loadsAgain_ = false, loadsSceneAgain_ = false;
  Scene scene_;
  Look look_;
  glm::vec3 centre_{0};
  float radius_ = 1;
  std::string problem_;

  // What the picture shows, and what was last asked for.
  struct Wished {
    uint64_t version = 0;
    glm::uvec2 size{0};
    double time = 0;
    bool operator==(const Wished&) const = default;
  } wished_;
  uint64_t version_ = 1;
  std::shared_ptr<const Picture> picture_;
  Sharpness sharpness_;
  bool isCoarse_ = false;

  Navigation navigation_;
  bool isHandHeld_ = false;
  std::optional<Viewpoint> base_;
  glm::vec2 mouse_{0};
  int button_ = -1;
  std::set<Command> flying_;

  double playhead_ = 0, duration_ = 0, speed_ = 1;
  bool isPlaying_ = false, onTwos_ = false, showsHelp_ = false, showsPanel_ = true;
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
