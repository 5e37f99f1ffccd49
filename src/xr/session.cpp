#include "xr/session.h"

#include <algorithm>
#include <cmath>

#include "xr/failure.h"

namespace scumble::xr {

namespace {

// Both eyes and their insets: of OpenXR 1.1 XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO_WITH_FOVEATED_INSET.
constexpr XrViewConfigurationType kWithInsets = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO;

XrPosef nowhereElse() {
  return xrOf(Pose());
}

}  // namespace

Session::Session(const Instance& instance, const VulkanDevice& device, const SessionOptions& options)
    : instance_(instance), call_(instance.call()) {
  try {
    XrGraphicsBindingVulkan2KHR binding{XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR};
    binding.instance = device.instance;
    binding.physicalDevice = device.physical;
    binding.device = device.device;
    binding.queueFamilyIndex = device.queueFamily;
    binding.queueIndex = 0;
    const XrSessionCreateInfo info{XR_TYPE_SESSION_CREATE_INFO, &binding, 0, instance.system()};
    must(call_.CreateSession(instance.handle(), &info, &session_), "xrCreateSession");
    createSpace(options.isStanding);
    chooseViews();
    const auto modes = listed<XrEnvironmentBlendMode>(
        "xrEnumerateEnvironmentBlendModes",
        [&](uint32_t capacity, uint32_t* count, XrEnvironmentBlendMode* all) {
          return call_.EnumerateEnvironmentBlendModes(instance_.handle(), instance_.system(), views_,
                                                      capacity, count, all);
        });
    // In the order of the runtime's preference.
    const bool canCover = std::find(modes.begin(), modes.end(), blend_) != modes.end();
    if (!canCover && !modes.empty()) blend_ = modes.front();
    createImages(options.hasSynthesis);
    chooseRefreshRate(options.refreshRate);
    hands_ = std::make_unique<Hands>(instance, session_);
    pointer_ = std::make_unique<Pointer>(instance, session_, device, format_);
    if (options.hasVignette) vignette_ = std::make_unique<Vignette>(instance, session_, device, format_);
  } catch (...) {
    destroy();
    throw;
  }
}

Session::~Session() {
  destroy();
}

void Session::destroy() {
  // Runtimes do not like what was begun and never ended. Images come first.
  pairs_.clear(), synthesis_.reset();
  if (isBegun_) {
    XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
    info.displayTime = display_;
    info.environmentBlendMode = blend_;
    call_.EndFrame(session_, &info);
  }
  hands_.reset();
  vignette_.reset(), pointer_.reset();
  if (space_) call_.DestroySpace(space_);
  if (session_) call_.DestroySession(session_);
}

void Session::createSpace(bool isStanding) {
  const auto spaces = listed<XrReferenceSpaceType>(
      "xrEnumerateReferenceSpaces", [&](uint32_t capacity, uint32_t* count, XrReferenceSpaceType* all) {
        return call_.EnumerateReferenceSpaces(session_, capacity, count, all);
      });
  spaceType_ = isStanding ? XR_REFERENCE_SPACE_TYPE_STAGE : XR_REFERENCE_SPACE_TYPE_LOCAL;
  if (std::find(spaces.begin(), spaces.end(), spaceType_) == spaces.end())
    throw XrFailure("xrEnumerateReferenceSpaces", XR_ERROR_REFERENCE_SPACE_UNSUPPORTED);
  const XrReferenceSpaceCreateInfo info{XR_TYPE_REFERENCE_SPACE_CREATE_INFO, nullptr, spaceType_,
                                        nowhereElse()};
  must(call_.CreateReferenceSpace(session_, &info, &space_), "xrCreateReferenceSpace");
}

void Session::chooseViews() {
  // The one that the runtime likes best.
  for (const XrViewConfigurationType type :
       listed<XrViewConfigurationType>("xrEnumerateViewConfigurations",
                                       [&](uint32_t capacity, uint32_t*count, XrViewConfigurationType*all) {
                                         return call_.EnumerateViewConfigurations(
                                             instance_.handle(), instance_.system(), capacity, count, all);
                                       })) {
    const bool isOfFour = type == kWithInsets && instance_.has(XR_VARJO_QUAD_VIEWS_EXTENSION_NAME);
    if (!isOfFour && type != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO) continue;
    views_ = type;
    return;
  }
}

void Session::createImages(bool hasSynthesis) {
  const auto eyes = listed<XrViewConfigurationView>(
      "xrEnumerateViewConfigurationViews",
      [&](uint32_t capacity, uint32_t* count, XrViewConfigurationView* all) {
        return call_.EnumerateViewConfigurationViews(instance_.handle(), instance_.system(), views_, capacity,
                                                     count, all);
      },
      {XR_TYPE_VIEW_CONFIGURATION_VIEW});
  if (eyes.size() != (views_ == kWithInsets ? 2 : 1) * kEyes)
    throw XrFailure("xrEnumerateViewConfigurationViews", XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
  // Both of a pair are drawn at once: so they have one size.
  std::vector<glm::uvec2> sizes(eyes.size() / kEyes, glm::uvec2(0));
  for (size_t v = 0; v < eyes.size(); ++v)
    sizes[v / kEyes] = glm::max(
        sizes[v / kEyes], glm::uvec2(eyes[v].recommendedImageRectWidth, eyes[v].recommendedImageRectHeight));
  for (size_t v = 0; v < eyes.size(); ++v)
    sizes[v / kEyes] =
        glm::min(sizes[v / kEyes], glm::uvec2(eyes[v].maxImageRectWidth, eyes[v].maxImageRectHeight));

  const auto formats =
      listed<int64_t>("xrEnumerateSwapchainFormats", [&](uint32_t capacity, uint32_t* count, int64_t* all) {
        return call_.EnumerateSwapchainFormats(session_, capacity, count, all);
      });
  // The first one that the runtime likes of those that tell light: runtimes take others for linear.
  const auto isSrgb = [](int64_t format) {
    return format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB;
  };
  auto chosen = std::find_if(formats.begin(), formats.end(), isSrgb);
  if (chosen == formats.end())
    chosen = std::find(formats.begin(), formats.end(), int64_t(VK_FORMAT_R16G16B16A16_SFLOAT));
  if (chosen == formats.end())
    throw XrFailure("xrEnumerateSwapchainFormats", XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED);
  format_ = VkFormat(*chosen);

  for (const glm::uvec2& size : sizes)
    pairs_.push_back({std::make_unique<EyeImages>(call_, session_, format_, size), nullptr});
  constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;
  const bool hasDepth = instance_.has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME) &&
                        std::find(formats.begin(), formats.end(), int64_t(kDepth)) != formats.end();
  for (Pair& pair : pairs_) {
    if (!hasDepth) break;
    try {
      pair.depths = std::make_unique<EyeImages>(call_, session_, kDepth, pair.pictures->size());
    } catch (const XrFailure& failure) {
      // Frames are shown without it as well.
      if (failure.isLoss()) throw;
    }
  }
  // Insets and frames between are two ways to the same end, and there are views for one of them.
  if (hasSynthesis && pairs_.size() == 1)
    synthesis_ = Synthesis::create(instance_, session_, recommendedMotionSize(), formats);
}

std::vector<glm::uvec2> Session::sizes() const {
  std::vector<glm::uvec2> sizes;
  for (const Pair& pair : pairs_) sizes.push_back(pair.pictures->size());
  return sizes;
}

glm::uvec2 Session::recommendedMotionSize() const {
  if (!instance_.has(kFrameSynthesisExtension)) return instance_.motionSize();
  std::array<XrViewConfigurationView, kEyes> eyes;
  std::array<XrFrameSynthesisConfigView, kEyes> motions;
  motions.fill({kTypeFrameSynthesisConfigView, nullptr, 0, 0});
  for (size_t eye = 0; eye < kEyes; ++eye) {
    eyes[eye] = {XR_TYPE_VIEW_CONFIGURATION_VIEW};
    eyes[eye].next = &motions[eye];
  }
  uint32_t count = 0;
  // What it does not say there is none of.
  if (XR_FAILED(call_.EnumerateViewConfigurationViews(instance_.handle(), instance_.system(), views_, kEyes,
                                                      &count, eyes.data())))
    return glm::uvec2(0);
  glm::uvec2 size(0);
  for (const XrFrameSynthesisConfigView& motion : motions)
    size = glm::max(size, glm::uvec2(motion.recommendedMotionVectorImageRectWidth,
                                     motion.recommendedMotionVectorImageRectHeight));
  return size;
}

void Session::chooseRefreshRate(float wished) {
  const bool isThere = instance_.has(XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME) &&
                       call_.EnumerateDisplayRefreshRatesFB && call_.RequestDisplayRefreshRateFB &&
                       call_.GetDisplayRefreshRateFB;
  if (!isThere) return;
  try {
    must(call_.GetDisplayRefreshRateFB(session_, &refreshRate_), "xrGetDisplayRefreshRateFB");
    const auto rates = listed<float>(
        "xrEnumerateDisplayRefreshRatesFB", [&](uint32_t capacity, uint32_t* count, float* all) {
          return call_.EnumerateDisplayRefreshRatesFB(session_, capacity, count, all);
        });
    if (rates.empty() || !(wished > 0)) return;
    const float nearest = *std::min_element(rates.begin(), rates.end(), [&](float a, float b) {
      return std::abs(a - wished) < std::abs(b - wished);
    });
    must(call_.RequestDisplayRefreshRateFB(session_, nearest), "xrRequestDisplayRefreshRateFB");
    refreshRate_ = nearest;
  } catch (const XrFailure& failure) {
    // Runtimes may refuse it, and show frames all the same.
    if (failure.isLoss()) throw;
  }
}

News Session::follow() {
  News news;
  while (true) {
    XrEventDataBuffer event{XR_TYPE_EVENT_DATA_BUFFER};
    if (must(call_.PollEvent(instance_.handle(), &event), "xrPollEvent") == XR_EVENT_UNAVAILABLE) return news;
    if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING)
      throw XrFailure("xrPollEvent", XR_ERROR_INSTANCE_LOST);
    if (event.type == XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING) {
      const auto& change = reinterpret_cast<const XrEventDataReferenceSpaceChangePending&>(event);
      if (change.referenceSpaceType == spaceType_) news.recentredAt = change.changeTime;
    } else if (event.type == XR_TYPE_EVENT_DATA_DISPLAY_REFRESH_RATE_CHANGED_FB) {
      refreshRate_ =
          reinterpret_cast<const XrEventDataDisplayRefreshRateChangedFB&>(event).toDisplayRefreshRate;
    } else if (event.type == kTypeUserPresenceChanged) {
      isWorn_ = reinterpret_cast<const XrEventDataUserPresenceChanged&>(event).isUserPresent == XR_TRUE;
    } else if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
      state_ = reinterpret_cast<const XrEventDataSessionStateChanged&>(event).state;
      if (state_ == XR_SESSION_STATE_READY) {
        const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, views_};
        must(call_.BeginSession(session_, &info), "xrBeginSession");
        isRunning_ = true;
      } else if (state_ == XR_SESSION_STATE_STOPPING) {
        isRunning_ = false;
        must(call_.EndSession(session_), "xrEndSession");
      }
      isOver_ = isOver_ || state_ == XR_SESSION_STATE_EXITING;
      isLost_ = isLost_ || state_ == XR_SESSION_STATE_LOSS_PENDING;
      if (isOver_ || isLost_) isRunning_ = false;
    }
  }
}

void Session::requestEnd() {
  if (!isRunning_) {
    isOver_ = true;
    return;
  }
  must(call_.RequestExitSession(session_), "xrRequestExitSession");
}

Moment Session::begin() {
  const XrFrameWaitInfo wait{XR_TYPE_FRAME_WAIT_INFO};
  XrFrameState state{XR_TYPE_FRAME_STATE};
  must(call_.WaitFrame(session_, &wait, &state), "xrWaitFrame");
  const XrFrameBeginInfo begin{XR_TYPE_FRAME_BEGIN_INFO};
  must(call_.BeginFrame(session_, &begin), "xrBeginFrame");
  isBegun_ = true, display_ = state.predictedDisplayTime;
  Moment moment;
  moment.display = state.predictedDisplayTime;
  moment.period = 1e-6 * double(std::max<XrDuration>(state.predictedDisplayPeriod, 0));
  moment.shouldRender = state.shouldRender == XR_TRUE;
  if (moment.shouldRender) moment.isPlaced = locate(moment);
  return moment;
}

bool Session::locate(Moment& moment) const {
  const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, views_, moment.display, space_};
  XrViewState state{XR_TYPE_VIEW_STATE};
  std::vector<XrView> views(kEyes * pairs_.size(), {XR_TYPE_VIEW});
  uint32_t count = 0;
  must(call_.LocateViews(session_, &info, &state, uint32_t(views.size()), &count, views.data()),
       "xrLocateViews");
  constexpr XrViewStateFlags kKnown = XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT;
  if ((state.viewStateFlags & kKnown) != kKnown || count != views.size()) return false;
  std::vector<Eye> eyes;
  for (const XrView& view : views) {
    eyes.push_back({poseOf(view.pose), view.fov});
    if (!canBeSeenFrom(eyes.back().pose, eyes.back().angles)) return false;
  }
  moment.eyes = std::move(eyes);
  return true;
}

std::vector<VulkanTarget> Session::acquire(bool synthesis) {
  std::vector<VulkanTarget> targets;
  const auto add = [&](const std::vector<VulkanTarget>& more) {
    targets.insert(targets.end(), more.begin(), more.end());
  };
  for (size_t pair = 0; pair < pairs_.size(); ++pair) {
    add(pairs_[pair].pictures->acquire(pair * kEyes));
    if (pairs_[pair].depths) add(pairs_[pair].depths->acquire(pair * kEyes, "depth"));
  }
  if (synthesis && synthesis_) add(synthesis_->acquire(pairs_.size() * kEyes));
  return targets;
}

void Session::release() {
  for (const Pair& pair : pairs_) {
    pair.pictures->release();
    if (pair.depths) pair.depths->release();
  }
  if (synthesis_) synthesis_->release();
}

void Session::end(const Moment& moment, const std::optional<DrawnEyes>& drawn) {
  release();
  std::vector<XrCompositionLayerProjectionView> views(drawn ? moment.eyes.size() : 0);
  std::vector<XrCompositionLayerDepthInfoKHR> depths(views.size());
  XrCompositionLayerProjection projection{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  projection.space = space_;
  projection.viewCount = uint32_t(views.size());
  projection.views = views.data();
  std::vector<const XrCompositionLayerBaseHeader*> layers;
  std::vector<XrCompositionLayerQuad> quads;
  if (drawn) {
    for (size_t v = 0; v < views.size(); ++v) {
      const Pair& pair = pairs_[v / kEyes];
      const size_t eye = v % kEyes;
      const glm::uvec2 size = drawn->sizes[v / kEyes];
      views[v] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
      views[v].pose = xrOf(moment.eyes[v].pose);
      views[v].fov = moment.eyes[v].angles;
      views[v].subImage = pair.pictures->part(eye, size);
      if (pair.depths) {
        depths[v] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR};
        depths[v].subImage = pair.depths->part(eye, size);
        tellDepths(depths[v], drawn->nearPlane);
        views[v].next = &depths[v];
      }
      if (drawn->synthesis && synthesis_)
        views[v].next = synthesis_->chained(eye, *drawn->synthesis, views[v].next);
    }
    layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection));
    const glm::vec3 head = between(moment.eyes[0].pose, moment.eyes[1].pose).place;
    for (const Ray& ray : drawn->rays) pointer_->addLayers(ray, head, space_, quads);
    if (vignette_)
      if (const auto vignette = vignette_->layer(drawn->darkness)) quads.push_back(*vignette);
    for (const XrCompositionLayerQuad& quad : quads)
      layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&quad));
  }
  XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
  info.displayTime = moment.display;
  info.environmentBlendMode = blend_;
  info.layerCount = uint32_t(layers.size());
  info.layers = layers.data();
  isBegun_ = false;
  must(call_.EndFrame(session_, &info), "xrEndFrame");
}

}  // namespace scumble::xr
