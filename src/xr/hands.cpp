#include "xr/hands.h"

#include <cstring>
#include <vector>

#include "xr/failure.h"

namespace scumble::xr {

namespace {

// What controllers have: of the left hand, of the right one, and the two buttons. Null: it has none.
struct Controllers {
  const char *profile, *walk, *turn, *pause, *look;
};
constexpr Controllers kControllers[] = {
    {"/interaction_profiles/khr/simple_controller", nullptr, nullptr, "/user/hand/left/input/select/click",
     "/user/hand/right/input/select/click"},
    {"/interaction_profiles/oculus/touch_controller", "/user/hand/left/input/thumbstick",
     "/user/hand/right/input/thumbstick", "/user/hand/right/input/a/click", "/user/hand/right/input/b/click"},
    {"/interaction_profiles/valve/index_controller", "/user/hand/left/input/thumbstick",
     "/user/hand/right/input/thumbstick", "/user/hand/right/input/a/click", "/user/hand/right/input/b/click"},
    {"/interaction_profiles/microsoft/motion_controller", "/user/hand/left/input/thumbstick",
     "/user/hand/right/input/thumbstick", "/user/hand/right/input/trackpad/click",
     "/user/hand/left/input/trackpad/click"},
    {"/interaction_profiles/htc/vive_controller", "/user/hand/left/input/trackpad",
     "/user/hand/right/input/trackpad", "/user/hand/right/input/menu/click",
     "/user/hand/left/input/menu/click"},
};

}  // namespace

Hands::Hands(const Instance& instance, XrSession session)
    : instance_(instance), call_(instance.call()), session_(session) {
  XrActionSetCreateInfo info{XR_TYPE_ACTION_SET_CREATE_INFO};
  std::strcpy(info.actionSetName, "scumble");
  std::strcpy(info.localizedActionSetName, "In a scene");
  must(call_.CreateActionSet(instance_.handle(), &info, &set_), "xrCreateActionSet");
  try {
    walk_ = create(XR_ACTION_TYPE_VECTOR2F_INPUT, "walk", "Walk");
    turn_ = create(XR_ACTION_TYPE_VECTOR2F_INPUT, "turn", "Turn");
    pause_ = create(XR_ACTION_TYPE_BOOLEAN_INPUT, "pause", "Pause and go on");
    look_ = create(XR_ACTION_TYPE_BOOLEAN_INPUT, "look", "Next look");
    suggest();
    const XrSessionActionSetsAttachInfo attach{XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO, nullptr, 1, &set_};
    must(call_.AttachSessionActionSets(session_, &attach), "xrAttachSessionActionSets");
  } catch (...) {
    call_.DestroyActionSet(set_);
    throw;
  }
}

Hands::~Hands() {
  call_.DestroyActionSet(set_);
}

XrAction Hands::create(XrActionType type, const char* name, const char* text) const {
  XrActionCreateInfo info{XR_TYPE_ACTION_CREATE_INFO};
  std::strcpy(info.actionName, name);
  std::strcpy(info.localizedActionName, text);
  info.actionType = type;
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
    XrInteractionProfileSuggestedBinding suggested{XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING};
    suggested.interactionProfile = path(of.profile);
    suggested.countSuggestedBindings = uint32_t(bindings.size());
    suggested.suggestedBindings = bindings.data();
    // Runtimes need not know every maker's.
    const XrResult result = call_.SuggestInteractionProfileBindings(instance_.handle(), &suggested);
    if (result != XR_ERROR_PATH_UNSUPPORTED) must(result, "xrSuggestInteractionProfileBindings");
  }
}

HandsState Hands::follow(bool isFocused) {
  HandsState state;
  if (!isFocused) return state;
  const XrActiveActionSet active{set_, XR_NULL_PATH};
  const XrActionsSyncInfo info{XR_TYPE_ACTIONS_SYNC_INFO, nullptr, 1, &active};
  // The focus may be gone before its event comes.
  if (must(call_.SyncActions(session_, &info), "xrSyncActions") == XR_SESSION_NOT_FOCUSED) return state;
  state.steering = {stick(walk_), stick(turn_).x};
  state.pauses = isPressedNow(pause_), state.nextLook = isPressedNow(look_);
  return state;
}

glm::vec2 Hands::stick(XrAction action) const {
  const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action, XR_NULL_PATH};
  XrActionStateVector2f state{XR_TYPE_ACTION_STATE_VECTOR2F};
  must(call_.GetActionStateVector2f(session_, &info, &state), "xrGetActionStateVector2f");
  return state.isActive ? glm::vec2(state.currentState.x, state.currentState.y) : glm::vec2(0);
}

bool Hands::isPressedNow(XrAction action) const {
  const XrActionStateGetInfo info{XR_TYPE_ACTION_STATE_GET_INFO, nullptr, action, XR_NULL_PATH};
  XrActionStateBoolean state{XR_TYPE_ACTION_STATE_BOOLEAN};
  must(call_.GetActionStateBoolean(session_, &info, &state), "xrGetActionStateBoolean");
  return state.isActive && state.currentState && state.changedSinceLastSync;
}

}  // namespace scumble::xr
