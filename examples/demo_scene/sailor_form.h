// The old sailor's bones as he is built: sitting upright, thighs level, both arms held out.
// His space: he faces +Z, +Y is up, his left is +X; the hip is at the origin. Metres of a man of 1.75 m.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace demo {

// Parents before children; the right limb follows the left one bone by bone.
enum Bone : int {
  kHips,
  kSpine,
  kChest,
  kNeck,
  kHead,
  kUpperArm,
  kForearm,
  kHand,
  kUpperArmRight,
  kForearmRight,
  kHandRight,
  kThigh,
  kShin,
  kFoot,
  kThighRight,
  kShinRight,
  kFootRight,
  kBoneCount
};
constexpr int kRightSide = 3;  // from a bone on the left to its like on the right

struct BoneForm {
  const char* name;
  int parent;
  glm::vec3 at;  // where it begins
};

inline const std::array<BoneForm, kBoneCount>& sailorBones() {
  static const std::array<BoneForm, kBoneCount> bones = [] {
    std::array<BoneForm, kBoneCount> b;
    b[kHips] = {"Hips", -1, {0, 0, 0}};
    b[kSpine] = {"Spine", kHips, {0, 0.14f, -0.01f}};
    b[kChest] = {"Chest", kSpine, {0, 0.32f, -0.005f}};
    b[kNeck] = {"Neck", kChest, {0, 0.59f, 0.04f}};
    b[kHead] = {"Head", kNeck, {0, 0.645f, 0.055f}};
    // The bends of elbows and knees lie in the middle of what they will do.
    b[kUpperArm] = {"UpperArmLeft", kChest, {0.205f, 0.485f, 0.02f}};
    b[kForearm] = {"ForearmLeft", kUpperArm, {0.293f, 0.331f, 0.312f}};
    b[kHand] = {"HandLeft", kForearm, {0.21f, 0.436f, 0.62f}};
    b[kThigh] = {"ThighLeft", kHips, {0.10f, 0.0f, 0.03f}};
    b[kShin] = {"ShinLeft", kThigh, {0.13f, 0.02f, 0.48f}};
    b[kFoot] = {"FootLeft", kShin, {0.13f, -0.43f, 0.455f}};
    for (int left : {kUpperArm, kForearm, kHand, kThigh, kShin, kFoot}) {
      static const char* names[] = {"UpperArmRight", "ForearmRight", "HandRight", "", "", "",
                                    "ThighRight",    "ShinRight",    "FootRight"};
      const int parent = b[left].parent;
      b[left + kRightSide] = {names[left - kUpperArm],
                              parent == kChest || parent == kHips ? parent : parent + kRightSide,
                              b[left].at * glm::vec3(-1, 1, 1)};
    }
    return b;
  }();
  return bones;
}

// Where he sits: on the after deck, his feet in the cockpit, square to the sheet that he hauls on.
constexpr float kSailorScale = 1.14f, kSailorTurn = 0.05f;
inline glm::mat4 sailorInBoat() {
  return glm::translate(glm::mat4(1.0f), {-2.08f, 0.85f, 0.36f}) *
         glm::rotate(glm::mat4(1.0f), 1.5707963f + kSailorTurn, {0, 1, 0}) *
         glm::scale(glm::mat4(1.0f), glm::vec3(kSailorScale));
}

}  // namespace demo
