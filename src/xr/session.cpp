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
    createSwapchains();
    chooseRefreshRate(options.refreshRate);
    hands_ = std::make_unique<Hands>(instance, session_);
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
  pictures_.clear(), depths_.clear();
  if (isBegun_) {
    XrFrameEndInfo info{XR_TYPE_FRAME_END_INFO};
    info.displayTime = display_;
    info.environmentBlendMode = blend_;
    call_.EndFrame(session_, &info);
  }
  hands_.reset();
  vignette_.reset();
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

void Session::createSwapchains() {
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

  pictures_ = createEyeImages(format_, XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT);
  constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;
  if (!instance_.has(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME) ||
      std::find(formats.begin(), formats.end(), int64_t(kDepth)) == formats.end())
    return;
  try {
    depths_ = createEyeImages(kDepth, XR_SWAPCHAIN_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  } catch (const XrFailure& failure) {
    // Frames are shown without it as well.
    if (failure.isLoss()) throw;
  }
}

Session::EyeImages Session::createEyeImages(VkFormat format, XrSwapchainUsageFlags usage) const {
  const Swapchain::Kind one{format, usage | XR_SWAPCHAIN_USAGE_SAMPLED_BIT, size_.x, size_.y};
  Swapchain::Kind both = one;
  both.layers = kEyes;
  EyeImages images;
  // Runtimes that have no images of layers have two of one.
  try {
    images.push_back(std::make_unique<Swapchain>(call_, session_, both));
  } catch (const XrFailure& failure) {
    if (failure.isLoss()) throw;
    for (size_t eye = 0; eye < kEyes; ++eye)
      images.push_back(std::make_unique<Swapchain>(call_, session_, one));
  }
  return images;
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

std::vector<VulkanTarget> Session::acquire() {
  std::vector<VulkanTarget> targets;
  acquire(pictures_, targets);
  acquire(depths_, targets);
  return targets;
}

void Session::acquire(const EyeImages& images, std::vector<VulkanTarget>& targets) const {
  std::vector<VkImage> acquired;
  for (const auto& swapchain : images) acquired.push_back(swapchain->acquire());
  for (size_t eye = 0; eye < kEyes && !images.empty(); ++eye) {
    const Swapchain::Kind& kind = imagesOf(images, eye).kind();
    const bool isDepth = &images == &depths_;
    VulkanTarget& target = targets.emplace_back();
    target.image = acquired[images.size() == 1 ? 0 : eye];
    target.format = kind.format;
    target.extent = {kind.width, kind.height};
    target.layer = layerOf(images, eye);
    // As runtimes want them back (XR_KHR_vulkan_enable2).
    target.after =
        isDepth ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    target.view = eye;
    if (isDepth) target.aov = "depth";
  }
}

void Session::release() {
  for (const EyeImages* images : {&pictures_, &depths_})
    for (const auto& swapchain : *images) swapchain->release();
}

void Session::end(const Moment& moment, const std::optional<DrawnEyes>& drawn, float darkness) {
  release();
  std::array<XrCompositionLayerProjectionView, kEyes> views;
  std::array<XrCompositionLayerDepthInfoKHR, kEyes> depths;
  const glm::uvec2 size = drawn ? drawn->size : size_;
  for (size_t eye = 0; eye < kEyes; ++eye) {
    views[eye] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW};
    views[eye].pose = xrOf(moment.eyes[eye].pose);
    views[eye].fov = moment.eyes[eye].angles;
    views[eye].subImage = imagesOf(pictures_, eye).part(size.x, size.y, layerOf(pictures_, eye));
    if (!drawn || depths_.empty()) continue;
    depths[eye] = {XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR};
    depths[eye].subImage = imagesOf(depths_, eye).part(size.x, size.y, layerOf(depths_, eye));
    // Reversed: 0 is endlessly far away, and so nearZ, which is where minDepth lies, is the farther one.
    depths[eye].minDepth = 0, depths[eye].nearZ = std::numeric_limits<float>::infinity();
    depths[eye].maxDepth = 1, depths[eye].farZ = drawn->nearPlane;
    views[eye].next = &depths[eye];
  }
  XrCompositionLayerProjection projection{XR_TYPE_COMPOSITION_LAYER_PROJECTION};
  projection.space = space_;
  projection.viewCount = kEyes;
  projection.views = views.data();
  const auto vignette = vignette_ ? vignette_->layer(darkness) : std::nullopt;
  std::vector<const XrCompositionLayerBaseHeader*> layers;
  if (drawn) {
    layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection));
    if (vignette) layers.push_back(reinterpret_cast<const XrCompositionLayerBaseHeader*>(&*vignette));
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
