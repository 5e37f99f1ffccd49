#include "xr/session.h"

#include <algorithm>
#include <cmath>

#include "xr/failure.h"

namespace scumble::xr {

namespace {

constexpr XrViewConfigurationType kViews = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

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
    const auto modes = listed<XrEnvironmentBlendMode>(
        "xrEnumerateEnvironmentBlendModes",
        [&](uint32_t capacity, uint32_t* count, XrEnvironmentBlendMode* all) {
          return call_.EnumerateEnvironmentBlendModes(instance_.handle(), instance_.system(), kViews,
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
  pictures_.reset(), depths_.reset(), synthesis_.reset();
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

void Session::createImages(bool hasSynthesis) {
  const auto eyes = listed<XrViewConfigurationView>(
      "xrEnumerateViewConfigurationViews",
      [&](uint32_t capacity, uint32_t* count, XrViewConfigurationView* all) {
        return call_.EnumerateViewConfigurationViews(instance_.handle(), instance_.system(), kViews, capacity,
                                                     count, all);
      },
      {XR_TYPE_VIEW_CONFIGURATION_VIEW});
  if (eyes.size() != kEyes)
    throw XrFailure("xrEnumerateViewConfigurationViews", XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
  // Both are drawn at once: so they have one size.
  for (const XrViewConfigurationView& eye : eyes)
    size_ = glm::max(size_, glm::uvec2(eye.recommendedImageRectWidth, eye.recommendedImageRectHeight));
  for (const XrViewConfigurationView& eye : eyes)
    size_ = glm::min(size_, glm::uvec2(eye.maxImageRectWidth, eye.maxImageRectHeight));

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

  pictures_ = std::make_unique<EyeImages>(call_, session_, format_, size_);
  constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;
  if (instance_.has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME) &&
      std::find(formats.begin(), formats.end(), int64_t(kDepth)) != formats.end())
    try {
      depths_ = std::make_unique<EyeImages>(call_, session_, kDepth, size_);
    } catch (const XrFailure& failure) {
      // Frames are shown without it as well.
      if (failure.isLoss()) throw;
    }
  if (hasSynthesis) synthesis_ = Synthesis::create(instance_, session_, recommendedMotionSize(), formats);
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
  must(call_.EnumerateViewConfigurationViews(instance_.handle(), instance_.system(), kViews, kEyes, &count,
                                             eyes.data()),
       "xrEnumerateViewConfigurationViews");
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
        const XrSessionBeginInfo info{XR_TYPE_SESSION_BEGIN_INFO, nullptr, kViews};
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
  const XrViewLocateInfo info{XR_TYPE_VIEW_LOCATE_INFO, nullptr, kViews, moment.display, space_};
  XrViewState state{XR_TYPE_VIEW_STATE};
  std::array<XrView, kEyes> views;
  views.fill({XR_TYPE_VIEW});
  uint32_t count = 0;
  must(call_.LocateViews(session_, &info, &state, kEyes, &count, views.data()), "xrLocateViews");
  constexpr XrViewStateFlags kKnown = XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT;
  if ((state.viewStateFlags & kKnown) != kKnown || count != kEyes) return false;
  std::array<Eye, kEyes> eyes;
  for (size_t eye = 0; eye < kEyes; ++eye) {
    eyes[eye] = {poseOf(views[eye].pose), views[eye].fov};
    if (!canBeSeenFrom(eyes[eye].pose, eyes[eye].angles)) return false;
  }
  moment.eyes = eyes;
  return true;
}

std::vector<VulkanTarget> Session::acquire(bool synthesis) {
  std::vector<VulkanTarget> targets = pictures_->acquire(0);
  const auto add = [&](const std::vector<VulkanTarget>& more) {
    targets.insert(targets.end(), more.begin(), more.end());
  };
  if (depths_) add(depths_->acquire(0, "depth"));
  if (synthesis && synthesis_) add(synthesis_->acquire(kMotionViews));
  return targets;
}

void Session::release() {
  pictures_->release();
  if (depths_) depths_->release();
  if (synthesis_) synthesis_->release();
}

void Session::end(const Moment& moment, const std::optional<DrawnEyes>& drawn) {
  release();
  std::array<XrCompositionLayerProjectionView, kEyes> views;
  std::array<XrCompositionLayerDepthInfoKHR, kEyes> depths;
  XrCompositionLayerProjection projection{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  projection.space = space_;
  projection.viewCount = kEyes;
  projection.views = views.data();
  std::vector<const XrCompositionLayerBaseHeader*> layers;
  std::vector<XrCompositionLayerQuad> quads;
  if (drawn) {
    for (size_t eye = 0; eye < kEyes; ++eye) {
      views[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
      views[eye].pose = xrOf(moment.eyes[eye].pose);
      views[eye].fov = moment.eyes[eye].angles;
      views[eye].subImage = pictures_->part(eye, drawn->size);
      if (depths_) {
        depths[eye] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR};
        depths[eye].subImage = depths_->part(eye, drawn->size);
        // Reversed: 0 is endlessly far away, and so nearZ, which is where minDepth lies, is the farther one.
        depths[eye].minDepth = 0, depths[eye].nearZ = std::numeric_limits<float>::infinity();
        depths[eye].maxDepth = 1, depths[eye].farZ = drawn->nearPlane;
        views[eye].next = &depths[eye];
      }
      if (drawn->synthesis && synthesis_)
        views[eye].next = synthesis_->chained(eye, *drawn->synthesis, views[eye].next);
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
