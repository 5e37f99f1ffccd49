// An OpenXR runtime without a headset, for tests: a head that goes where a script says, and what was shown to
// it kept as pictures. It is as strict as OpenXR allows, and writes down every mistake.
//
// SCUMBLE_TEST_XR names the script, a JSON object. What goes by frame keeps its last value.
//   record        folder for report.json, and frame-NNNN-{left,right}.ppm of each frame that was shown
//   size, angles  of an eye, pixels; of each eye, [left, right, up, down] in radians
//   poses, ipd    of the head, by frame, [x, y, z, qx, qy, qz, qw]; metres between its eyes
//   latch         metres by which the head has moved whenever the same frame is located again
//   latchTurn     radians about y by which it has turned then
//   floor         how far the head is from the origin of STAGE beyond that of LOCAL, [x, y, z]
//   flags         what is known of where the eyes are, by frame (XrViewStateFlags)
//   formats       Vulkan's numbers, in the runtime's order
//   depth         whether it takes depth buffers as well (false)
//   layers        whether swapchains may have more than one (true)
//   stage         whether there is a floor (true)
//   vulkan        whether it takes Vulkan (true)
//   headset       whether one is there (true)
//   refreshRates  frames a second that it offers; without them it has no such extension
//   period        seconds from frame to frame; default: by the refresh rate
//   comesBack     after how many xrGetSystem a headset that was lost is there again
//   hands         {"walk": [[x, y], ...], "turn": ..., "pause": [0, 1, ...], "look": ...} by frame; of each
//                 hand "point left", "grab right", "aim left": [[x, y, z, qx, qy, qz, qw], ...]
//   insets        {"size": ..., "angles": ...}: it has views of four, and likes them best
//   synthesis     "ext", "fb" or "both": it makes frames by those extensions
//   fbVersion     of the latter's (2)
//   motionSize    that it recommends for them, pixels
//   events        [{"frame": N, "event": ...}], as frame N is waited for: hide, show, blur, focus,
//                 stop, exit, loseSession, loseInstance, recentre, redrawFloor, takeOff, putOn
//   mute          true: it is asked to end, and does not answer
//   fail          {"xrCreateSession": -2, "xrLocateViews": [-2, 3]}: calls that give this result, always or
//                 from the third on
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "xr/openxr.h"

namespace scumble::test {

using Json = nlohmann::json;

constexpr XrTime kFirstDisplay = 1'000'000'000;
constexpr XrSystemId kSystem = 7;
const auto kInstance = reinterpret_cast<XrInstance>(0x11);
const auto kSession = reinterpret_cast<XrSession>(0x22);
const auto kActionSet = reinterpret_cast<XrActionSet>(0x33);

struct Space {
  XrReferenceSpaceType type;
  std::string aim;  // of an action, what the script calls it; else it is a room
};

struct Action {
  std::string name;
  XrActionType type;
  std::vector<XrPath> hands;
};

struct Swapchain {
  VkFormat format;
  VkExtent2D extent;
  uint32_t layers;
  std::vector<VkImage> images;
  std::vector<VkDeviceMemory> memory;
  bool isDepth() const { return format == VK_FORMAT_D32_SFLOAT; }
  uint32_t pixelBytes() const { return format == VK_FORMAT_R16G16B16A16_SFLOAT ? 8 : 4; }
  // As images are acquired and released (XR_KHR_vulkan_enable2).
  VkImageLayout layout() const {
    return isDepth() ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                     : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  }
  uint32_t next = 0;
  int acquired = -1, released = -1;
  bool isWaited = false;
};

struct Runtime {
  Json script, report;
  std::string record;
  std::map<std::string, int> failing;
  bool hasInstance = false, askedRequirements = false;
  std::set<std::string> extensions;
  std::deque<XrEventDataBuffer> events;
  int searches = 0;
  bool isLost = false;
  // Of the session.
  bool hasSession = false, isRunning = false, wantsExit = false;
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
  VkInstance vulkan = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t family = 0;
  std::set<Space*> spaces;
  std::set<Swapchain*> swapchains;
  float refreshRate = 72;
  // Of the hands.
  std::vector<std::string> paths;
  std::vector<std::unique_ptr<Action>> actions;
  bool hasActions = false, isAttached = false;
  int lastSync = -1, syncBefore = -1;
  // Of the frame.
  int frame = -1;  // that was waited for
  XrTime display = 0;
  bool isWaited = false, isBegun = false;
  int located = 0;
  std::array<XrView, 4> eyes{};

  Runtime() {
    if (const char* const file = std::getenv("SCUMBLE_TEST_XR")) {
      std::ifstream in(file);
      script = Json::parse(in, nullptr, false);
    }
    if (!script.is_object()) script = Json::object();
    record = script.value("record", "");
    report = {
        {"frames", Json::array()}, {"mistakes", Json::array()}, {"calls", Json::array()}, {"ended", false}};
  }
  ~Runtime() { write(); }

  void write() const {
    if (!record.empty()) std::ofstream(record + "/report.json") << report.dump(1);
  }
  XrResult mistake(const std::string& text, XrResult result) {
    report["mistakes"].push_back(text);
    write();
    return result;
  }
  // What fails by the script cannot be done rightly after it.
  bool mayFail(const char* call) const {
    const Json fail = script.value("fail", Json::object());
    return fail.contains(call);
  }
  bool offersRates() const { return script.contains("refreshRates"); }
  // The views that it likes best, and how many there are.
  bool hasInsets() const { return script.contains("insets"); }
  bool isOfFour() const { return hasInsets() && extensions.count(XR_VARJO_QUAD_VIEWS_EXTENSION_NAME); }
  XrViewConfigurationType views() const {
    return isOfFour() ? XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO
                      : XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  }
  uint32_t viewCount() const { return isOfFour() ? 4 : 2; }
  std::string synthesis() const { return script.value("synthesis", ""); }
  std::array<uint32_t, 2> motionSize() const {
    return script.value("motionSize", std::array<uint32_t, 2>{24, 16});
  }
};
Runtime& runtime();

// What the script makes of a call; each is written down.
XrResult begun(const char* call);
#define BEGIN(call)                        \
  [[maybe_unused]] Runtime& r = runtime(); \
  if (const XrResult scripted = begun(call); scripted != XR_SUCCESS) return scripted
#define NEED(condition, text, result) \
  if (!(condition)) return r.mistake(text, result)

template <class T>
XrResult give(const std::vector<T>& all, uint32_t capacity, uint32_t* count, T* out) {
  *count = uint32_t(all.size());
  if (capacity == 0) return XR_SUCCESS;
  if (capacity < all.size()) return XR_ERROR_SIZE_INSUFFICIENT;
  std::copy(all.begin(), all.end(), out);
  return XR_SUCCESS;
}
void post(const void* event, size_t size);
void goTo(XrSessionState state);

// What the script has of an action at a frame, by its name there ("aim left"); null where it has nothing.
Json handAt(const std::string& name, int frame);

// A rectangle of a layer that was released last, as it is stored.
std::vector<uint8_t> bytesOf(const Swapchain& from, uint32_t layer, const XrRect2Di& rect);
// The same as a PPM, where the format is one of pictures.
void savePicture(const Swapchain& from, uint32_t layer, const XrRect2Di& rect, const std::string& file);

// The calls of each chapter, by their names.
std::map<std::string, PFN_xrVoidFunction> imageCalls();
std::map<std::string, PFN_xrVoidFunction> handCalls();
std::map<std::string, PFN_xrVoidFunction> frameCalls();
#define ENTRY(name, function) \
  { "xr" #name, reinterpret_cast<PFN_xrVoidFunction>(&function) }

}  // namespace scumble::test
