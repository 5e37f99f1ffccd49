// Frames: the pace, the eyes, and a close look at what is shown.
#include <cmath>
#include <cstdio>
#include <fstream>

#include "runtime.h"

namespace scumble::test {

namespace {

void happen(const std::string& event) {
  Runtime& r = runtime();
  if (event == "hide") goTo(XR_SESSION_STATE_VISIBLE), goTo(XR_SESSION_STATE_SYNCHRONIZED);
  if (event == "show") goTo(XR_SESSION_STATE_VISIBLE), goTo(XR_SESSION_STATE_FOCUSED);
  if (event == "blur") goTo(XR_SESSION_STATE_VISIBLE);
  if (event == "focus") goTo(XR_SESSION_STATE_FOCUSED);
  if (event == "exit") r.wantsExit = true;
  if (event == "stop" || event == "exit")
    goTo(XR_SESSION_STATE_VISIBLE), goTo(XR_SESSION_STATE_SYNCHRONIZED), goTo(XR_SESSION_STATE_STOPPING);
  if (event == "loseSession") r.isLost = true, goTo(XR_SESSION_STATE_LOSS_PENDING);
  if (event == "loseInstance") {
    const XrEventDataInstanceLossPending lost{XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING, nullptr, 0};
    post(&lost, sizeof lost);
  }
  if (event == "recentre" || event == "redrawFloor") {
    XrEventDataReferenceSpaceChangePending changed{XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING};
    changed.session = kSession;
    changed.referenceSpaceType =
        event == "recentre" ? XR_REFERENCE_SPACE_TYPE_LOCAL : XR_REFERENCE_SPACE_TYPE_STAGE;
    // It holds from the frame after the next one on.
    changed.changeTime = r.display + 2 * XrDuration(1e9 / double(r.refreshRate));
    post(&changed, sizeof changed);
  }
  if (event == "takeOff" || event == "putOn") {
    const XrEventDataUserPresenceChanged changed{kTypeUserPresenceChanged, nullptr, kSession,
                                                 XrBool32(event == "putOn")};
    post(&changed, sizeof changed);
  }
}

XrResult XRAPI_CALL waitFrame(XrSession, const XrFrameWaitInfo*, XrFrameState* state) {
  BEGIN("xrWaitFrame");
  NEED(r.isRunning, "a frame of a session that does not run", XR_ERROR_SESSION_NOT_RUNNING);
  NEED(!r.isWaited, "a frame is waited for twice", XR_ERROR_CALL_ORDER_INVALID);
  ++r.frame;
  const auto period = XrDuration(1e9 * r.script.value("period", 1 / double(r.refreshRate)));
  r.display = kFirstDisplay + r.frame * period;
  if (r.script.contains("events"))
    for (const Json& event : r.script["events"])
      if (event["frame"] == r.frame) happen(event["event"]);
  r.isWaited = true;
  r.located = 0;
  state->predictedDisplayTime = r.display;
  state->predictedDisplayPeriod = period;
  state->shouldRender =
      r.state == XR_SESSION_STATE_VISIBLE || r.state == XR_SESSION_STATE_FOCUSED ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL beginFrame(XrSession, const XrFrameBeginInfo*) {
  BEGIN("xrBeginFrame");
  NEED(r.isWaited, "a frame is begun that was not waited for", XR_ERROR_CALL_ORDER_INVALID);
  NEED(!r.isBegun, "a frame is begun within another", XR_ERROR_CALL_ORDER_INVALID);
  r.isWaited = false, r.isBegun = true;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL locateViews(XrSession, const XrViewLocateInfo* info, XrViewState* state,
                                uint32_t capacity, uint32_t* count, XrView* out) {
  BEGIN("xrLocateViews");
  NEED(r.spaces.count(reinterpret_cast<Space*>(info->space)) == 1, "eyes in no space",
       XR_ERROR_HANDLE_INVALID);
  NEED(info->displayTime == r.display, "eyes at another time than the frame's", XR_ERROR_TIME_INVALID);
  NEED(info->viewConfigurationType == r.views() && (capacity == 0 || capacity == r.viewCount()),
       "eyes of other views", XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED);
  *count = r.viewCount();
  if (capacity == 0) return XR_SUCCESS;
  const auto flags = r.script.value("flags", std::vector<XrViewStateFlags>{15});
  state->viewStateFlags = flags[std::min(size_t(r.frame), flags.size() - 1)];
  std::array<float, 7> head{0, 0, 0, 0, 0, 0, 1};
  if (const Json poses = r.script.value("poses", Json::array()); !poses.empty())
    head = poses[std::min(size_t(r.frame), poses.size() - 1)].get<std::array<float, 7>>();
  const auto latch = r.script.value("latch", std::array<float, 3>{0, 0, 0});
  const bool isOnFloor = reinterpret_cast<Space*>(info->space)->type == XR_REFERENCE_SPACE_TYPE_STAGE;
  const auto floor = r.script.value("floor", std::array<float, 3>{0, 0, 0});
  for (size_t i = 0; i < 3; ++i) head[i] += float(r.located) * latch[i] + (isOnFloor ? floor[i] : 0);
  if (const float turn = 0.5f * float(r.located) * r.script.value("latchTurn", 0.0f); turn != 0) {
    // About y, after what it is.
    const float c = std::cos(turn), t = std::sin(turn);
    head = {head[0],
            head[1],
            head[2],
            c * head[3] + t * head[5],
            c * head[4] + t * head[6],
            c * head[5] - t * head[3],
            c * head[6] - t * head[4]};
  }
  ++r.located;
  // The head's own x axis, for its eyes.
  const float x = head[3], y = head[4], z = head[5], w = head[6];
  const std::array<float, 3> side{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
  const float half = 0.5f * r.script.value("ipd", 0.064f);
  for (size_t eye = 0; eye < r.viewCount(); ++eye) {
    NEED(out[eye].type == XR_TYPE_VIEW, "a view's structure has no type", XR_ERROR_VALIDATION_FAILURE);
    const float along = eye % 2 == 0 ? -half : half;
    const Json& from = eye < 2 ? r.script : r.script["insets"];
    XrView& view = r.eyes[eye];
    view = {XR_TYPE_VIEW};
    view.pose = {{x, y, z, w},
                 {head[0] + along * side[0], head[1] + along * side[1], head[2] + along * side[2]}};
    const auto angles = from.contains("angles") ? from["angles"][eye % 2].get<std::array<float, 4>>()
                                                : std::array<float, 4>{-0.5f, 0.5f, 0.5f, -0.5f};
    view.fov = {angles[0], angles[1], angles[2], angles[3]};
    out[eye].pose = view.pose, out[eye].fov = view.fov;
  }
  return XR_SUCCESS;
}
// A picture in the room.
XrResult lookAtRay(const XrCompositionLayerQuad& quad, Json& frame) {
  Runtime& r = runtime();
  const XrVector3f& at = quad.pose.position;
  const XrQuaternionf& q = quad.pose.orientation;
  NEED(std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 1e-3f, "a quad's turn is none",
       XR_ERROR_POSE_INVALID);
  NEED(quad.layerFlags == (XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT |
                           XR_COMPOSITION_LAYER_UNPREMULTIPLIED_ALPHA_BIT),
       "a ray that covers all", XR_ERROR_LAYER_INVALID);
  // Along it, and what it faces.
  const std::array<float, 3> along{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z),
                                   2 * (q.x * q.z - q.w * q.y)},
      facing{2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)};
  frame["rays"].push_back({{"at", {at.x, at.y, at.z}},
                           {"size", {quad.size.width, quad.size.height}},
                           {"along", along},
                           {"facing", facing}});
  return XR_SUCCESS;
}

// A picture that goes with the head.
XrResult lookAtQuad(const XrCompositionLayerQuad& quad, Json& frame) {
  Runtime& r = runtime();
  auto* const from = reinterpret_cast<Swapchain*>(quad.subImage.swapchain);
  auto* const space = reinterpret_cast<Space*>(quad.space);
  NEED(r.swapchains.count(from) == 1 && from->released >= 0 && from->acquired < 0,
       "a quad of an image that was not released", XR_ERROR_LAYER_INVALID);
  NEED(r.spaces.count(space) == 1 && space->aim.empty(), "a quad in no space", XR_ERROR_HANDLE_INVALID);
  if (space->type != XR_REFERENCE_SPACE_TYPE_VIEW) return lookAtRay(quad, frame);
  NEED(quad.layerFlags == XR_COMPOSITION_LAYER_BLEND_TEXTURE_SOURCE_ALPHA_BIT, "a quad that covers all",
       XR_ERROR_LAYER_INVALID);
  Json one{{"size", quad.size.width}, {"distance", -quad.pose.position.z}};
  if (from->format == VK_FORMAT_R8G8B8A8_SRGB) {
    const std::vector<uint8_t> bytes = bytesOf(*from, 0, quad.subImage.imageRect);
    const auto width = size_t(quad.subImage.imageRect.extent.width);
    // From the middle to the right.
    for (size_t x = width / 2; x < width; ++x) one["alpha"].push_back(bytes[4 * (width / 2 * width + x) + 3]);
    one["light"] = *std::max_element(bytes.begin(), bytes.begin() + 3);
  }
  frame["quads"].push_back(one);
  return XR_SUCCESS;
}

// How far away what a view shows is.
XrResult lookAtDepth(const XrCompositionLayerProjectionView& view,
                     const XrCompositionLayerDepthInfoKHR& depth, const std::string& file, Json& eye) {
  Runtime& r = runtime();
  NEED(r.extensions.count(XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME) == 1, "depth without its extension",
       XR_ERROR_VALIDATION_FAILURE);
  auto* const from = reinterpret_cast<Swapchain*>(depth.subImage.swapchain);
  NEED(r.swapchains.count(from) == 1 && from->isDepth() && from->released >= 0 && from->acquired < 0,
       "depth of an image that was not released", XR_ERROR_LAYER_INVALID);
  const XrRect2Di &rect = depth.subImage.imageRect, &seen = view.subImage.imageRect;
  NEED(rect.offset.x == seen.offset.x && rect.offset.y == seen.offset.y &&
           rect.extent.width == seen.extent.width && rect.extent.height == seen.extent.height &&
           uint32_t(rect.extent.width) <= from->extent.width &&
           uint32_t(rect.extent.height) <= from->extent.height &&
           depth.subImage.imageArrayIndex < from->layers,
       "depth of another rectangle than the view's", XR_ERROR_SWAPCHAIN_RECT_INVALID);
  NEED(depth.minDepth >= 0 && depth.maxDepth <= 1 && depth.minDepth < depth.maxDepth && depth.nearZ > 0 &&
           depth.farZ > 0 && depth.nearZ != depth.farZ,
       "depths that make no sense", XR_ERROR_VALIDATION_FAILURE);
  // Metres: what lies at minDepth is nearZ away. JSON knows no infinity.
  eye["depth"] = {{"nearZ", std::isinf(depth.nearZ) ? -1 : depth.nearZ}, {"farZ", depth.farZ}};
  if (r.record.empty()) return XR_SUCCESS;
  const std::vector<uint8_t> bytes = bytesOf(*from, depth.subImage.imageArrayIndex, rect);
  std::ofstream out(r.record + "/" + file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  return XR_SUCCESS;
}

// What frame synthesis takes, of either extension.
template <class Info>
XrResult lookAtMotion(const Info& info, const std::string& file, Json& eye) {
  Runtime& r = runtime();
  const auto& parts = {&info.motionVectorSubImage, &info.depthSubImage};
  for (const XrSwapchainSubImage* const part : parts) {
    auto* const from = reinterpret_cast<Swapchain*>(part->swapchain);
    NEED(r.swapchains.count(from) == 1 && from->released >= 0 && from->acquired < 0,
         "motion of an image that was not released", XR_ERROR_LAYER_INVALID);
    NEED(from->isDepth() == (part == &info.depthSubImage) &&
             (from->isDepth() || from->format == VK_FORMAT_R16G16B16A16_SFLOAT),
         "motion in another format", XR_ERROR_LAYER_INVALID);
    const auto size = r.motionSize();
    NEED(part->imageRect.offset.x == 0 && part->imageRect.offset.y == 0 &&
             uint32_t(part->imageRect.extent.width) == size[0] &&
             uint32_t(part->imageRect.extent.height) == size[1] && part->imageArrayIndex < from->layers,
         "motion of another size than was recommended", XR_ERROR_SWAPCHAIN_RECT_INVALID);
    if (r.record.empty()) continue;
    const std::vector<uint8_t> bytes = bytesOf(*from, part->imageArrayIndex, part->imageRect);
    std::ofstream out(r.record + "/" + file + (from->isDepth() ? ".motion-depth" : ".motion"),
                      std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  }
  NEED(info.nearZ != info.farZ && info.minDepth == 0 && info.maxDepth == 1, "depths that make no sense",
       XR_ERROR_VALIDATION_FAILURE);
  const XrPosef& room = info.appSpaceDeltaPose;
  eye["motion"] = {{"flags", info.layerFlags},
                   {"farZ", info.farZ},
                   {"room",
                    {room.position.x, room.position.y, room.position.z, room.orientation.x,
                     room.orientation.y, room.orientation.z, room.orientation.w}}};
  return XR_SUCCESS;
}

// What is chained behind a view.
XrResult lookAtChain(const XrCompositionLayerProjectionView& view, const std::string& name, Json& eye) {
  Runtime& r = runtime();
  for (auto* next = static_cast<const XrBaseInStructure*>(view.next); next; next = next->next) {
    XrResult result = XR_SUCCESS;
    if (next->type == XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR) {
      result = lookAtDepth(view, *reinterpret_cast<const XrCompositionLayerDepthInfoKHR*>(next),
                           name + ".depth", eye);
    } else if (next->type == kTypeFrameSynthesisInfo && r.extensions.count(kFrameSynthesisExtension)) {
      const auto& info = *reinterpret_cast<const XrFrameSynthesisInfo*>(next);
      NEED(info.motionVectorScale.x == 1 && std::abs(info.motionVectorScale.y) == 1 &&
               info.motionVectorScale.z == 1 && info.motionVectorOffset.x == 0 &&
               info.motionVectorOffset.y == 0,
           "motion that is scaled", XR_ERROR_VALIDATION_FAILURE);
      result = lookAtMotion(info, name, eye);
      if (result == XR_SUCCESS) eye["motion"]["up"] = info.motionVectorScale.y;
    } else if (next->type == XR_TYPE_COMPOSITION_LAYER_SPACE_WARP_INFO_FB &&
               r.extensions.count(XR_FB_SPACE_WARP_EXTENSION_NAME)) {
      result = lookAtMotion(*reinterpret_cast<const XrCompositionLayerSpaceWarpInfoFB*>(next), name, eye);
    } else {
      return r.mistake("a view with something unknown", XR_ERROR_VALIDATION_FAILURE);
    }
    if (result != XR_SUCCESS) return result;
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL endFrame(XrSession, const XrFrameEndInfo* info) {
  BEGIN("xrEndFrame");
  NEED(r.isBegun, "a frame is ended that was not begun", XR_ERROR_CALL_ORDER_INVALID);
  NEED(info->displayTime == r.display, "a frame ends at another time", XR_ERROR_TIME_INVALID);
  NEED(info->environmentBlendMode == XR_ENVIRONMENT_BLEND_MODE_OPAQUE, "a blend mode that is not offered",
       XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED);
  r.isBegun = false;
  Json frame{
      {"frame", r.frame}, {"display", r.display}, {"layers", info->layerCount}, {"eyes", Json::array()}};
  for (uint32_t l = 0; l < info->layerCount; ++l) {
    if (info->layers[l]->type == XR_TYPE_COMPOSITION_LAYER_QUAD) {
      const XrResult result =
          lookAtQuad(*reinterpret_cast<const XrCompositionLayerQuad*>(info->layers[l]), frame);
      if (result != XR_SUCCESS) return result;
      continue;
    }
    const auto* const layer = reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[l]);
    NEED(layer->type == XR_TYPE_COMPOSITION_LAYER_PROJECTION && layer->viewCount == r.viewCount(),
         "a layer of another kind", XR_ERROR_LAYER_INVALID);
    NEED(r.spaces.count(reinterpret_cast<Space*>(layer->space)) == 1, "a layer in no space",
         XR_ERROR_HANDLE_INVALID);
    NEED(r.located > 0, "a layer of eyes that were not located", XR_ERROR_POSE_INVALID);
    for (uint32_t eye = 0; eye < r.viewCount(); ++eye) {
      const XrCompositionLayerProjectionView& view = layer->views[eye];
      auto* const from = reinterpret_cast<Swapchain*>(view.subImage.swapchain);
      NEED(view.type == XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW && r.swapchains.count(from) == 1,
           "a view of no swapchain", XR_ERROR_HANDLE_INVALID);
      NEED(from->released >= 0 && from->acquired < 0, "a view of an image that was not released",
           XR_ERROR_LAYER_INVALID);
      const XrRect2Di& rect = view.subImage.imageRect;
      NEED(rect.offset.x >= 0 && rect.offset.y >= 0 && rect.extent.width > 0 && rect.extent.height > 0 &&
               uint32_t(rect.offset.x + rect.extent.width) <= from->extent.width &&
               uint32_t(rect.offset.y + rect.extent.height) <= from->extent.height &&
               view.subImage.imageArrayIndex < from->layers,
           "a view reaches out of its image", XR_ERROR_SWAPCHAIN_RECT_INVALID);
      // What is shown was drawn from where the runtime has last said that the eyes are.
      const XrVector3f &a = view.pose.position, &b = r.eyes[eye].pose.position;
      NEED(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) < 1e-5f, "a view is from elsewhere than its eye",
           XR_SUCCESS);
      const XrQuaternionf &p = view.pose.orientation, &q = r.eyes[eye].pose.orientation;
      NEED(std::abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w) > 1 - 1e-6f,
           "a view is turned otherwise than its eye", XR_SUCCESS);
      const XrFovf &seen = view.fov, &told = r.eyes[eye].fov;
      NEED(seen.angleLeft == told.angleLeft && seen.angleRight == told.angleRight &&
               seen.angleUp == told.angleUp && seen.angleDown == told.angleDown,
           "a view of other angles than its eye's", XR_SUCCESS);
      char name[64];
      std::snprintf(name, sizeof name, "frame-%04d-%s%s.ppm", r.frame, eye < 2 ? "" : "inset-",
                    eye % 2 == 0 ? "left" : "right");
      if (!r.record.empty()) savePicture(*from, view.subImage.imageArrayIndex, rect, r.record + "/" + name);
      frame["eyes"].push_back(
          {{"place", {a.x, a.y, a.z}}, {"size", {rect.extent.width, rect.extent.height}}, {"picture", name}});
      const XrResult result = lookAtChain(view, name, frame["eyes"].back());
      if (result != XR_SUCCESS) return result;
    }
  }
  r.report["frames"].push_back(frame);
  return XR_SUCCESS;
}

}  // namespace

std::map<std::string, PFN_xrVoidFunction> frameCalls() {
  return {
      ENTRY(WaitFrame, waitFrame),
      ENTRY(BeginFrame, beginFrame),
      ENTRY(LocateViews, locateViews),
      ENTRY(EndFrame, endFrame),
  };
}

}  // namespace scumble::test
