#include "xr/hands.h"

#include <cstring>
#include <string>
#include <vector>

#include "xr/failure.h"

namespace scumble::xr {

namespace {

// What controllers have: of the left hand, of the right one, and the two buttons; and what each hand has, as
// its input is called. Null: it has none.
struct Controllers {
  const char *profile, *walk, *turn, *pause, *look, *point, *grab;
};
constexpr Controllers kControllers[] = {
    {"/interaction_profiles/khr/simple_controller", nullptr, nullptr, "/user/hand/left/input/select/click",
     "/user/hand/right/input/select/click", nullptr, nullptr},
    {"/interaction_profiles/oculus/touch_controller", "/user/hand/left/input/thumbstick",
     "/user/hand/right/input/thumbstick", "/user/hand/right/input/a/click", "/user/hand/right/input/b/click",
     "trigger/value", "squeeze/value"},
    {"/interaction_profiles/valve/index_controller", "/user/hand/left/input/thumbstick",
     "/user/hand/right/input/thumbstick", "/user/hand/right/input/a/click", "/user/hand/right/input/b/click",
     "trigger/value", "squeeze/value"},
    {"/interaction_profiles/microsoft/motion_controller", "/user/hand/left/input/thumbstick",
     "/user/hand/right/input/thumbstick", "/user/hand/right/input/trackpad/click",
     "/user/hand/left/input/trackpad/click", "trigger/value", "squeeze/click"},
    {"/interaction_profiles/htc/vive_controller", "/user/hand/left/input/trackpad",
     "/user/hand/right/input/trackpad", "/user/hand/right/input/menu/click",
     "/user/hand/left/input/menu/click", "trigger/value", "squeeze/click"},
};
constexpr const char* kHandPaths[kHands] = {"/user/hand/left", "/user/hand/right"};

}  // namespace

Hands::Hands(const Instance& instance, XrSession session)
    : instance_(instance), call_(instance.call()), session_(session) {
  XrActionSetCreateInfo info{XR_TYPE_ACTION_SET_CREATE_INFO};
  std::strcpy(info.actionSetName, "scumble");
  std::strcpy(info.localizedActionSetName, "In a scene");
  must(call_.CreateActionSet(instance_.handle(), &info, &set_), "xrCreateActionSet");
  try {
    begin();
  } catch (...) {
    end();
    throw;
  }
}

Hands::~Hands() {
  end();
}

void Hands::begin() {
  for (size_t hand = 0; hand < kHands; ++hand) paths_[hand] = path(kHandPaths[hand]);
  walk_ = create(XR_ACTION_TYPE_VECTOR2F_INPUT, "walk", "Walk");
  turn_ = create(XR_ACTION_TYPE_VECTOR2F_INPUT, "turn", "Turn");
  pause_ = create(XR_ACTION_TYPE_BOOLEAN_INPUT, "pause", "Pause and go on");
  look_ = create(XR_ACTION_TYPE_BOOLEAN_INPUT, "look", "Next look");
  aim_ = create(XR_ACTION_TYPE_POSE_INPUT, "aim", "Where it points", true);
  point_ = create(XR_ACTION_TYPE_BOOLEAN_INPUT, "point", "Change colours", true);
  grab_ = create(XR_ACTION_TYPE_BOOLEAN_INPUT, "grab", "Grab and place", true);
  suggest();
  const XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set_};
  must(call_.AttachSessionActionSets(session_, &attach), "xrAttachSessionActionSets");
  for (size_t hand = 0; hand < kHands; ++hand) {
    const XrActionSpaceCreateInfo space{XR_TYPE_ACTION_SPACE_CREATE_INFO, nullptr, aim_, paths_[hand],
                                        xrOf(Pose())};
    must(call_.CreateActionSpace(session_, &space, &aims_[hand]), "xrCreateActionSpace");
  }
}

void Hands::end() {
  for (const XrSpace aim : aims_)
    if (aim) call_.DestroySpace(aim);
  call_.DestroyActionSet(set_);
}

XrAction Hands::create(XrActionType type, const char* name, const char* text, bool isOfEach) const {
  XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO};
  std::strcpy(info.actionName, name);
  std::strcpy(info.localizedActionName, text);
  info.actionType = type;
  if (isOfEach) info.countSubactionPaths = uint32_t(kHands), info.subactionPaths = paths_.data();
  XrAction made = XR_NULL_HANDLE;
  must(call_.CreateAction(set_, &info, &made), "xrCreateAction");
  return made;
}

XrPath Hands::path(const char* text) const {
  XrPath path = XR_NULL_PATH;
  must(call_.StringToPath(instance_.handle(), text, &path), "xrStringToPath");
  return path;
}

void Hands::suggest() const {
  for (const Controllers& of : kControllers) {
    std::vector<XrActionSuggestedBinding> bindings;
    const std::pair<XrAction, const char*> uses[] = {
        {walk_, of.walk}, {turn_, of.turn}, {pause_, of.pause}, {look_, of.look}};
    for (const auto& [action, input] : uses)
      if (input) bindings.push_back({action, path(input)});
    for (const char* const hand : kHandPaths) {
      bindings.push_back({aim_, path((hand + std::string("/input/aim/pose")).c_str())});
      for (const auto& [action, input] : {std::pair(point_, of.point), std::pair(grab_, of.grab)})
        if (input) bindings.push_back({action, path((hand + std::string("/input/") + input).c_str())});
    }
    XrInteractionProfileSuggestedBinding suggested{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING};
    suggested.interactionProfile = path(of.profile);
    suggested.countSuggestedBindings = uint32_t(bindings.size());
    suggested.suggestedBindings = bindings.data();
    // Runtimes need not know every maker's.
    const XrResult result = call_.SuggestInteractionProfileBindings(instance_.handle(), &suggested);
    if (result != XR_ERROR_PATH_UNSUPPORTED) must(result, "xrSuggestInteractionProfileBindings");
  }
}

HandsState Hands::follow(bool isFocused, XrSpace room, XrTime time) {
  HandsState state;
  if (!isFocused) return state;
  const XrActiveActionSet active{set_, XR_NULL_PATH};
  const XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
  // The focus may be gone before its event comes.
  if (must(call_.SyncActions(session_, &info), "xrSyncActions") == XR_SESSION_NOT_FOCUSED) return state;
  state.pauses = isPressedNow(pause_), state.nextLook = isPressedNow(look_);
  for (size_t hand = 0; hand < kHands; ++hand) {
    const auto isHeld = [&](XrAction action) {
      const XrActionStateBoolean now = button(action, paths_[hand]);
      return now.isActive && now.currentState;
    };
    state.hands[hand] = {std::nullopt, isHeld(point_), isHeld(grab_), stick(hand == 0 ? walk_ : turn_)};
    // Where it is costs the runtime something, and matters only then.
    if (state.hands[hand].points || state.hands[hand].grabs) state.hands[hand].aim = aimOf(hand, room, time);
  }
  state.steering.walk = state.hands[0].stick, state.steering.turn = state.hands[1].stick.x;
  return state;
}

std::optional<Pose> Hands::aimOf(size_t hand, XrSpace room, XrTime time) const {
  XrSpaceLocation location{XR_TYPE_SPACE_LOCATION};
  must(call_.LocateSpace(aims_[hand], room, time, &location), "xrLocateSpace");
  constexpr XrSpaceLocationFlags kKnown =
      XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  if ((location.locationFlags & kKnown) != kKnown) return std::nullopt;
  const Pose pose = poseOf(location.pose);
  return isPlace(pose) ? std::optional(pose) : std::nullopt;
}

glm::vec2 Hands::stick(XrAction action) const {
  const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action, XR_NULL_PATH};
  XrActionStateVector2f state{XR_TYPE_ACTION_STATE_VECTOR2F};
  must(call_.GetActionStateVector2f(session_, &info, &state), "xrGetActionStateVector2f");
  return state.isActive ? glm::vec2(state.currentState.x, state.currentState.y) : glm::vec2(0);
}

XrActionStateBoolean Hands::button(XrAction action, XrPath hand) const {
  const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action, hand};
  XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
  must(call_.GetActionStateBoolean(session_, &info, &state), "xrGetActionStateBoolean");
  return state;
}

bool Hands::isPressedNow(XrAction action) const {
  const XrActionStateBoolean state = button(action);
  return state.isActive && state.currentState && state.changedSinceLastSync;
}

}  // namespace scumble::xr
