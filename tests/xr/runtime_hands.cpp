// Actions, and hands that do what the script says.
#include "runtime.h"

namespace scumble::test {

namespace {

XrResult XRAPI_CALL stringToPath(XrInstance, const char* text, XrPath* path) {
  BEGIN("xrStringToPath");
  const auto found = std::find(r.paths.begin(), r.paths.end(), text);
  *path = XrPath(found - r.paths.begin()) + 1;
  if (found == r.paths.end()) r.paths.emplace_back(text);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createActionSet(XrInstance, const XrActionSetCreateInfo* info, XrActionSet* set) {
  BEGIN("xrCreateActionSet");
  NEED(info->actionSetName[0] && info->localizedActionSetName[0], "a set of actions has no name",
       XR_ERROR_NAME_INVALID);
  *set = kActionSet;
  r.hasActions = true, r.isAttached = false;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroyActionSet(XrActionSet) {
  BEGIN("xrDestroyActionSet");
  NEED(r.hasActions, "a set of actions is destroyed twice", XR_ERROR_HANDLE_INVALID);
  r.actions.clear();
  r.hasActions = false;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createAction(XrActionSet, const XrActionCreateInfo* info, XrAction* action) {
  BEGIN("xrCreateAction");
  NEED(!r.isAttached, "an action for a set that is attached", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  const std::string name = info->actionName;
  NEED(!name.empty() &&
           name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_./") == std::string::npos,
       "an action's name is none of OpenXR's", XR_ERROR_PATH_FORMAT_INVALID);
  for (const auto& other : r.actions)
    NEED(other->name != name, "two actions of one name", XR_ERROR_NAME_DUPLICATED);
  const std::vector<XrPath> hands(info->subactionPaths, info->subactionPaths + info->countSubactionPaths);
  for (const XrPath hand : hands)
    NEED(r.paths.at(hand - 1).starts_with("/user/hand/"), "an action of no hand", XR_ERROR_PATH_UNSUPPORTED);
  r.actions.push_back(std::make_unique<Action>(Action{name, info->actionType, hands}));
  *action = reinterpret_cast<XrAction>(r.actions.back().get());
  return XR_SUCCESS;
}

// What controllers have, by the specification (its section 6.4), as far as anybody asks for it: of one hand,
// or both.
bool isOf(const std::string& profile, const std::string& input) {
  static const std::map<std::string, std::array<std::vector<std::string>, 3>> kInputs{
      {"khr/simple_controller", {{{"select/click", "menu/click"}, {}, {}}}},
      {"oculus/touch_controller",
       {{{"squeeze/value", "trigger/value", "thumbstick", "thumbstick/click"},
         {"x/click", "y/click", "menu/click"},
         {"a/click", "b/click"}}}},
      {"valve/index_controller",
       {{{"a/click", "b/click", "squeeze/value", "trigger/click", "trigger/value", "thumbstick",
          "thumbstick/click", "trackpad"},
         {},
         {}}}},
      {"microsoft/motion_controller",
       {{{"menu/click", "squeeze/click", "trigger/value", "thumbstick", "thumbstick/click", "trackpad",
          "trackpad/click"},
         {},
         {}}}},
      {"htc/vive_controller",
       {{{"squeeze/click", "menu/click", "trigger/click", "trigger/value", "trackpad", "trackpad/click"},
         {},
         {}}}}};
  const std::string kProfiles = "/interaction_profiles/";
  const auto found =
      profile.starts_with(kProfiles) ? kInputs.find(profile.substr(kProfiles.size())) : kInputs.end();
  if (found == kInputs.end()) return false;
  const auto& [both, left, right] = found->second;
  if (input == "/user/hand/left/input/aim/pose" || input == "/user/hand/right/input/aim/pose") return true;
  for (const auto& [hand, own] : {std::pair("left", &left), std::pair("right", &right)})
    for (const auto* const inputs : {&both, own})
      for (const std::string& one : *inputs)
        if (input == "/user/hand/" + std::string(hand) + "/input/" + one) return true;
  return false;
}

XrResult XRAPI_CALL suggest(XrInstance, const XrInteractionProfileSuggestedBinding* suggested) {
  BEGIN("xrSuggestInteractionProfileBindings");
  NEED(!r.isAttached, "bindings for actions that are attached", XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  const std::string profile = r.paths.at(suggested->interactionProfile - 1);
  NEED(suggested->countSuggestedBindings > 0, "no bindings for " + profile, XR_ERROR_VALIDATION_FAILURE);
  for (uint32_t i = 0; i < suggested->countSuggestedBindings; ++i) {
    const XrActionSuggestedBinding& one = suggested->suggestedBindings[i];
    const std::string input = r.paths.at(one.binding - 1);
    const auto* const action = reinterpret_cast<const Action*>(one.action);
    const bool isStick = input.ends_with("thumbstick") || input.ends_with("trackpad");
    const bool isPose = input.ends_with("/pose");
    NEED(isOf(profile, input) && isStick == (action->type == XR_ACTION_TYPE_VECTOR2F_INPUT) &&
             isPose == (action->type == XR_ACTION_TYPE_POSE_INPUT),
         profile + ": " + input + " is nothing for " + action->name, XR_ERROR_PATH_UNSUPPORTED);
  }
  // One that knows fewer makers.
  if (profile.find("valve") != std::string::npos) return XR_ERROR_PATH_UNSUPPORTED;
  r.report["profiles"].push_back(profile);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL attach(XrSession, const XrSessionActionSetsAttachInfo* info) {
  BEGIN("xrAttachSessionActionSets");
  NEED(!r.isAttached && info->countActionSets == 1, "actions are attached twice",
       XR_ERROR_ACTIONSETS_ALREADY_ATTACHED);
  r.isAttached = true;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL sync(XrSession, const XrActionsSyncInfo*) {
  BEGIN("xrSyncActions");
  NEED(r.isAttached, "actions are asked for that are not attached", XR_ERROR_ACTIONSET_NOT_ATTACHED);
  NEED(r.lastSync < r.frame, "hands are asked twice in a frame", XR_SUCCESS);
  if (r.state != XR_SESSION_STATE_FOCUSED) return XR_SESSION_NOT_FOCUSED;
  r.syncBefore = r.lastSync;
  r.lastSync = r.frame;
  return XR_SUCCESS;
}

// What the script calls an action, of one hand where it is of each.
std::string nameOf(const Action& action, XrPath hand) {
  std::string name = action.name;
  if (hand == 0) return name;
  const std::string& path = runtime().paths.at(hand - 1);
  return name.append(" ").append(path, path.rfind('/') + 1);
}

XrResult XRAPI_CALL getBoolean(XrSession, const XrActionStateGetInfo* info, XrActionStateBoolean* state) {
  BEGIN("xrGetActionStateBoolean");
  const auto& action = *reinterpret_cast<const Action*>(info->action);
  NEED(std::find(action.hands.begin(), action.hands.end(), info->subactionPath) != action.hands.end() ||
           (action.hands.empty() && !info->subactionPath),
       "an action of a hand that it is not of", XR_ERROR_PATH_UNSUPPORTED);
  const std::string name = nameOf(action, info->subactionPath);
  const Json now = handAt(name, r.lastSync), before = handAt(name, r.syncBefore);
  state->isActive = !now.is_null();
  state->currentState = state->isActive && now != 0;
  state->changedSinceLastSync = state->currentState != XrBool32(!before.is_null() && before != 0);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getVector2f(XrSession, const XrActionStateGetInfo* info, XrActionStateVector2f* state) {
  BEGIN("xrGetActionStateVector2f");
  const Json now =
      handAt(nameOf(*reinterpret_cast<const Action*>(info->action), info->subactionPath), r.lastSync);
  state->isActive = !now.is_null();
  if (state->isActive) state->currentState = {now[0], now[1]};
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createActionSpace(XrSession, const XrActionSpaceCreateInfo* info, XrSpace* space) {
  BEGIN("xrCreateActionSpace");
  const auto& action = *reinterpret_cast<const Action*>(info->action);
  NEED(action.type == XR_ACTION_TYPE_POSE_INPUT &&
           std::find(action.hands.begin(), action.hands.end(), info->subactionPath) != action.hands.end(),
       "a space of no pose", XR_ERROR_ACTION_TYPE_MISMATCH);
  auto* const made = new Space{XR_REFERENCE_SPACE_TYPE_VIEW, nameOf(action, info->subactionPath)};
  r.spaces.insert(made);
  *space = reinterpret_cast<XrSpace>(made);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL locateSpace(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* location) {
  BEGIN("xrLocateSpace");
  auto* const from = reinterpret_cast<Space*>(space);
  auto* const room = reinterpret_cast<Space*>(base);
  NEED(r.spaces.count(from) == 1 && r.spaces.count(room) == 1 && !from->aim.empty() && room->aim.empty(),
       "a hand in no room", XR_ERROR_HANDLE_INVALID);
  NEED(time == r.display, "a hand at another time than the frame's", XR_ERROR_TIME_INVALID);
  NEED(location->type == XR_TYPE_SPACE_LOCATION, "a location's structure has no type",
       XR_ERROR_VALIDATION_FAILURE);
  const Json at = handAt(from->aim, r.frame);
  location->locationFlags = at.is_null() ? 0 : 15;
  if (at.is_null()) return XR_SUCCESS;
  auto pose = at.get<std::array<float, 7>>();
  const auto floor = r.script.value("floor", std::array<float, 3>{0, 0, 0});
  if (room->type == XR_REFERENCE_SPACE_TYPE_STAGE)
    for (size_t i = 0; i < 3; ++i) pose[i] += floor[i];
  location->pose = {{pose[3], pose[4], pose[5], pose[6]}, {pose[0], pose[1], pose[2]}};
  return XR_SUCCESS;
}

}  // namespace

// What the script has of that at a frame; null where it has nothing.
Json handAt(const std::string& name, int frame) {
  const Runtime& r = runtime();
  const Json hands = r.script.value("hands", Json::object());
  if (!hands.contains(name) || frame < 0) return nullptr;
  return hands[name][std::min(size_t(frame), hands[name].size() - 1)];
}

std::map<std::string, PFN_xrVoidFunction> handCalls() {
  return {
      ENTRY(LocateSpace, locateSpace),
      ENTRY(StringToPath, stringToPath),
      ENTRY(CreateActionSet, createActionSet),
      ENTRY(DestroyActionSet, destroyActionSet),
      ENTRY(CreateAction, createAction),
      ENTRY(CreateActionSpace, createActionSpace),
      ENTRY(SuggestInteractionProfileBindings, suggest),
      ENTRY(AttachSessionActionSets, attach),
      ENTRY(SyncActions, sync),
      ENTRY(GetActionStateBoolean, getBoolean),
      ENTRY(GetActionStateVector2f, getVector2f),
  };
}

}  // namespace scumble::test
