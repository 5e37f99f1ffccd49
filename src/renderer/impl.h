// What a renderer is made of: a device, the scenes that are on it, and the frames that are under way.
#pragma once

#include <atomic>
#include <deque>
#include <list>
#include <optional>
#include <thread>

#include "base/usage.h"
#include "renderer/setup.h"
#include "renderer/uniforms.h"
#include "renderer/view_groups.h"
#include "scumble/renderer.h"
#include "scumble/vulkan.h"

namespace scumble {

namespace renderer {

// A scene that is on the device, and what its frames are drawn with.
struct Resident {
  Resident(gpu::Device& device, gpu::Samplers& samplers, const Scene& kept)
      : scene(kept), onGpu(device, samplers) {}
  Scene scene;  // keeps the data alive that onGpu refers to
  SceneOnGpu onGpu;
  // One for each group of views that was drawn last.
  std::vector<std::unique_ptr<Setup>> setups;
};

// Images of others that a frame goes into, instead of back to the CPU.
struct Delivery {
  struct Target {
    size_t view = 0;  // index into all views; TargetKey has it in its group
    TargetKey key;
    VkImage image = VK_NULL_HANDLE;
  };
  std::vector<Target> targets;
  std::span<const VulkanReadback> readbacks;
  std::span<const VkSemaphoreSubmitInfo> waits, signals;
};

// Thrown where the caller wants to stop.
struct Cancelled {};

// What a call of begin() is about.
struct Request {
  const Scene& scene;
  const look::LookData& look;
  double time;
  const std::vector<View>& views;
  const RenderOptions& options;
  const Delivery* delivery = nullptr;
  bool isRehearsal = false;  // all but the drawing
  bool isYardstick = false;  // the plain passes
  // Parts of the progress that the caller wants to hear of: from, to.
  double progressFrom = 0, progressTo = 1;
};

// The picture behind everything; null: there is none.
const Image* backgroundOf(const Request& request);
// AOVs of single views that come back, with or without those of all.
std::vector<std::string> readBackOf(const Request& request);

// A frame between begin() and finish().
struct Begun {
  struct Part {
    ViewGroup group;
    Setup* setup = nullptr;
    std::vector<VkImage> images;  // of others, by TargetKey::image
  };
  uint32_t slot = 0;  // of those in flight
  std::vector<Part> parts;
  size_t viewCount = 0;
  std::map<std::string, PixelFormat> formats;
  // Where drawings are made: under which look, and which layers the caller has not asked for.
  std::optional<look::LookData> drawnLook;
  std::vector<std::string> drawnFrom;
  Frame frame;  // statistics so far; the pictures, where they had to be fetched early
  bool fetched = false;
};

}  // namespace renderer

struct Renderer::Impl {
  std::atomic<std::thread::id> user;  // the thread that is inside, if one is
  std::unique_ptr<gpu::Device> device;
  std::optional<gpu::Samplers> samplers;
  std::optional<world::ExampleTextures> examples;
  std::optional<world::LookTextures> lookTextures;
  ImagePassKind imagePasses = ImagePassKind::automatic;
  renderer::PassList passes, plain = renderer::plainPasses();
  // One of each of these, for what they say of themselves.
  std::vector<std::unique_ptr<frame::Pass>> asked, askedPlain;
  std::vector<const frame::Aov*> aovs;  // that they may offer
  uint64_t sceneBudget = 0;
  std::list<renderer::Resident> residents;  // the one that was drawn last first
  std::optional<world::Backdrop> backdrop;
  renderer::ColorMaps colorMaps;
  stage::KnobTable knobs, previousKnobs;  // of the last frame, and of the moment before it
  std::optional<gpu::Submission> submissions[gpu::kFramesInFlight];
  std::deque<renderer::Begun> begun;         // the oldest first
  std::vector<look::Assignment> structural;  // settings that prepare() has seen to take other pipelines

  Impl(std::unique_ptr<gpu::Device> device, const RendererOptions& options);
  ~Impl();

  // Nothing where a request can be drawn.
  Status check(const renderer::Request& request) const;
  Status begin(const renderer::Request& request);
  Status prepare(const renderer::Request& request, Rehearsal extent);
  // Waits for a frame and fetches its pictures, unless that has been done.
  void fetch(renderer::Begun& frame);
  // Makes the drawings of a frame whose layers are there, and takes away what only they needed.
  static void draw(renderer::Begun& frame);
  // Before anything goes that frames under way use.
  void fetchAll();
  Error failure(const gpu::VulkanError& error);
  Error outOfMemory();
  // After the caller wanted it to stop, before anything was sent.
  Error cancelled();

 private:
  // The scene to draw, first of the residents, as it is now. `drops`: as SceneOnGpu::update() has it. Null,
  // and nothing is done, where the scene's vertices are needed and have been dropped.
  renderer::Resident* useScene(const Scene& wanted, const world::GeometryOptions& options, bool drops,
                               FrameStats& stats);
  // Takes off the device what was drawn longest ago, but for so many scenes, while there is too much.
  void keepBudget(size_t least);
  // Texels of pictures behind everything; none: there is no such picture.
  void useBackdrop(const glm::uvec2& texels);
  // What each group of views is drawn with; what none of them needs goes.
  void useSetups(renderer::Resident& resident, const std::vector<renderer::SetupKey>& keys,
                 renderer::Begun& frame, const std::function<void(double)>& progress);
  renderer::SetupKey keyOf(const renderer::Request& request, const look::LookData& now) const;
  // For each part of a frame, which gets its images.
  std::vector<renderer::SetupKey> keysOf(const renderer::Request& request, const look::LookData& now,
                                         std::vector<renderer::Begun::Part>& parts) const;
  // Asks the caller for the newest views, and writes them where the frame will find them.
  void latch(const renderer::Request& request, const world::SceneMotion& motion,
             const renderer::Begun& frame);
  // One that no frame under way has.
  uint32_t freeSlot() const;
  void record(VkCommandBuffer commands, renderer::Resident& resident, const renderer::Begun& frame,
              const RenderOptions& options);
  // After an unexpected result of Vulkan: nothing that is under way can be trusted.
  void abandon();
};

// While one is taken, other threads are refused; the one that has it may enter again.
class Renderer::Turn {
 public:
  explicit Turn(Impl& impl) : impl_(impl) {
    std::thread::id user;
    isFirst_ = impl_.user.compare_exchange_strong(user, std::this_thread::get_id());
    isTaken_ = isFirst_ || user == std::this_thread::get_id();
  }
  ~Turn() {
    if (isFirst_) impl_.user = std::thread::id();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  explicit operator bool() const { return isTaken_; }
  Error refusal() const {
    return usage("this renderer is in use by another thread", "give each thread a renderer of its own");
  }

 private:
  Impl& impl_;
  bool isFirst_, isTaken_;
};

// What other parts of the public face know of a renderer.
struct RendererAccess {
  static gpu::Device& device(const Renderer& renderer) { return *renderer.impl_->device; }
  // Whether anybody but who asks can still want to draw it.
  static bool isHeldElsewhere(const Scene& scene) { return scene.data_.use_count() > 1; }
  static Status begin(Renderer& renderer, const renderer::Request& request);
  static Result<Frame> render(Renderer& renderer, const renderer::Request& request);
  static Result<std::unique_ptr<Renderer>> create(Result<std::unique_ptr<gpu::Device>> made,
                                                  const RendererOptions& options);
};

}  // namespace scumble
