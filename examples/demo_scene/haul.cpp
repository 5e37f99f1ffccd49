#include "haul.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig_form.h"

namespace demo {
namespace {

// A value over the cycle, through keys that an animator would set. Between two keys it neither overshoots
// nor moves off from a turning point, so poses hold as they were keyed.
class Curve {
 public:
  explicit Curve(std::vector<glm::vec2> keys) : keys_(std::move(keys)) {}

  float at(float frame) const {
    frame = std::fmod(std::fmod(frame, kHaulFrames) + kHaulFrames, kHaulFrames);
    const int count = int(keys_.size());
    int i = -1;
    while (i + 1 < count && key(i + 1).x <= frame) ++i;
    const glm::vec2 a = key(i), b = key(i + 1);
    const float span = b.x - a.x, t = (frame - a.x) / span;
    const float before = slope(i) * span, after = slope(i + 1) * span;
    const float t2 = t * t, t3 = t2 * t;
    return a.y * (2 * t3 - 3 * t2 + 1) + before * (t3 - 2 * t2 + t) + b.y * (3 * t2 - 2 * t3) +
           after * (t3 - t2);
  }

 private:
  // The cycle goes on to both sides.
  glm::vec2 key(int i) const {
    const int count = int(keys_.size());
    const int turn = i < 0 ? -1 : i / count;
    return keys_[size_t(i - turn * count)] + glm::vec2(float(turn) * kHaulFrames, 0.0f);
  }
  // The harmonic mean of the slopes to both sides (Fritsch and Butland); level where they differ in sign.
  float slope(int i) const {
    const glm::vec2 a = key(i - 1), b = key(i), c = key(i + 1);
    const float before = (b.y - a.y) / (b.x - a.x), after = (c.y - b.y) / (c.x - b.x);
    return before * after <= 0.0f ? 0.0f : 2.0f * before * after / (before + after);
  }

  std::vector<glm::vec2> keys_;
};

// Frames: 0 hangs on straight arms, 14 has drawn to the chest, 22 to 34 left hand over right, 36 to 48 right
// over left while he comes forward, 60 reaches furthest, 72 has thrown himself back.

// Degrees forward.
const Curve kLean{
    {{0, -36}, {14, -44}, {22, -40}, {34, -16}, {48, 12}, {60, 20}, {66, 6}, {72, -24}, {84, -31}}};
// Degrees, the left shoulder back.
const Curve kTwist{{{0, 4}, {14, -8}, {22, -6}, {32, -20}, {36, -18}, {46, 18}, {52, 12}, {60, 0}, {72, 8}}};
// Metres of the hips, ahead and up.
const Curve kForward{
    {{0, -0.06f}, {14, -0.07f}, {30, -0.03f}, {48, 0.03f}, {58, 0.05f}, {64, -0.03f}, {70, -0.08f}}};
const Curve kUp{{{0, -0.01f}, {14, -0.015f}, {34, 0}, {50, 0.05f}, {58, 0.06f}, {66, -0.02f}, {72, -0.015f}}};
// Degrees, chin down.
const Curve kNod{{{0, 6}, {14, 14}, {30, 2}, {50, -12}, {60, 2}, {72, 14}, {84, 8}}};

// How far from the block each hand holds the sheet, metres of his space. Where it says 0 the arm is straight.
const Curve kHoldLeft{
    {{0, 0}, {14, 1.15f}, {22, 1.14f}, {32, 0.74f}, {48, 0.75f}, {54, 0.35f}, {62, 0.35f}, {66, 0}}};
const Curve kHoldRight{{{0, 0}, {14, 1.00f}, {36, 1.00f}, {46, 0.20f}, {62, 0.20f}, {66, 0}}};
// Metres that a hand is off the sheet, on its way.
const Curve kOffLeft{{{22, 0}, {27, 0.12f}, {32, 0}}};
const Curve kOffRight{{{36, 0}, {41, 0.12f}, {46, 0}}};
// Which hand is the lower one: 1 the left.
const Curve kLowerLeft{{{0, 1}, {21, 1}, {25, 0}, {35, 0}, {39, 1}}};

// The bones while they are being posed, in his space.
struct Figure {
  Haul haul;
  std::array<glm::vec3, kBoneCount> at;
  std::array<glm::quat, kBoneCount> turn;

  // Turns a bone by `local` in its parent's space.
  void pose(int bone, glm::quat local) {
    const BoneForm& form = sailorBones()[size_t(bone)];
    haul.turns[size_t(bone)] = local;
    if (form.parent < 0) {
      at[size_t(bone)] = haul.hips;
      turn[size_t(bone)] = local;
      return;
    }
    const size_t parent = size_t(form.parent);
    at[size_t(bone)] = place(form.parent, form.at);
    turn[size_t(bone)] = turn[parent] * local;
  }
  // Turns a bone so that it stands by `world` in his space.
  void poseInWorld(int bone, glm::quat world) {
    const size_t parent = size_t(sailorBones()[size_t(bone)].parent);
    pose(bone, glm::inverse(turn[parent]) * world);
  }
  // Where a point of the figure as it was built comes to be with a bone.
  glm::vec3 place(int bone, glm::vec3 point) const {
    return at[size_t(bone)] + turn[size_t(bone)] * (point - sailorBones()[size_t(bone)].at);
  }
};

glm::mat3 frame(glm::vec3 along, glm::vec3 side) {
  const glm::vec3 z = glm::normalize(along), x = glm::normalize(glm::cross(side, z));
  return {x, glm::cross(z, x), z};
}

// Bends a limb of two bones so that the third one begins at `target`; `bend` is where the joint between
// points to, `bendBuilt` where it pointed when he was built.
void reach(Figure& figure, int upper, glm::vec3 target, glm::vec3 bend) {
  const auto& bones = sailorBones();
  const glm::vec3 root = bones[size_t(upper)].at, middle = bones[size_t(upper + 1)].at,
                  end = bones[size_t(upper + 2)].at;
  const float first = glm::distance(root, middle), second = glm::distance(middle, end);
  figure.pose(upper, glm::quat(1, 0, 0, 0));
  const glm::vec3 from = figure.at[size_t(upper)], line = target - from;
  const float length = glm::min(glm::length(line), 0.9995f * (first + second));
  const glm::vec3 along = glm::normalize(line);
  const float a = (first * first - second * second + length * length) / (2.0f * length);
  const float h = std::sqrt(std::max(first * first - a * a, 0.0f));
  const glm::vec3 side = glm::normalize(bend - along * glm::dot(bend, along));
  const glm::vec3 joint = from + along * a + side * h;
  const glm::vec3 bendBuilt = middle - glm::mix(root, end, 0.5f);
  figure.poseInWorld(
      upper, glm::quat_cast(frame(joint - from, side) * glm::transpose(frame(middle - root, bendBuilt))));
  figure.poseInWorld(upper + 1, glm::quat_cast(frame(from + along * length - joint, side) *
                                               glm::transpose(frame(end - middle, bendBuilt))));
}

glm::quat pitch(float degrees) {
  return glm::angleAxis(glm::radians(degrees), glm::vec3(1, 0, 0));
}
glm::quat yaw(float degrees) {
  return glm::angleAxis(glm::radians(degrees), glm::vec3(0, 1, 0));
}

// The nearest place to the block on the sheet that an arm reaches.
float nearestHold(glm::vec3 block, glm::vec3 along, glm::vec3 shoulder, float arm) {
  const glm::vec3 line = block - shoulder;
  const float b = glm::dot(line, along), c = glm::dot(line, line) - arm * arm;
  const float inside = b * b - c;
  if (inside < 0.0f) return -b;
  return std::max(-b - std::sqrt(inside), 0.0f);
}

void poseArms(Figure& figure, float f) {
  static const glm::mat4 fromBoat = glm::inverse(sailorInBoat());
  static const glm::vec3 block = glm::vec3(fromBoat * glm::vec4(sheetBlock(), 1.0f));
  // The sheet runs from the block to before his breastbone.
  const glm::vec3 along = glm::normalize(figure.place(kChest, {0.09f, 0.34f, 0.29f}) - block);
  constexpr float kArm = 0.665f,
                  kBetween = 0.15f;  // metres; his arm, all but straight, and from hand to hand
  auto hold = [&](int arm, float keyed) {
    return std::max(keyed,
                    nearestHold(block, along, figure.place(kChest, sailorBones()[size_t(arm)].at), kArm));
  };
  const float right = hold(kUpperArmRight, kHoldRight.at(f));
  float left = hold(kUpperArm, kHoldLeft.at(f));
  const bool rightAbove = f < 22.0f || f >= 48.0f;
  if (rightAbove) left = std::max(left, right + kBetween);
  auto put = [&](int arm, float held, float off, float side) {
    const glm::vec3 away = glm::normalize(glm::vec3(0.7f * side, 0.7f, 0.0f));
    reach(figure, arm, block + along * held + away * off,
          figure.turn[kChest] * glm::vec3(0.65f * side, -0.45f, -0.6f));
    figure.pose(arm + 2, glm::quat(1, 0, 0, 0));
  };
  put(kUpperArm, left, kOffLeft.at(f), 1.0f);
  put(kUpperArmRight, right, kOffRight.at(f), -1.0f);
  figure.haul.grip = block + along * glm::mix(right, left, kLowerLeft.at(f));
}

void poseLegs(Figure& figure) {
  static const glm::mat4 fromBoat = glm::inverse(sailorInBoat());
  // The left foot stands on the sole, the right one is braced against the far bench.
  const glm::vec3 stands[] = {{-1.40f, kSole + 0.115f, 0.22f}, {-1.24f, kBench + 0.115f, 0.43f}};
  for (int side = 0; side < 2; ++side) {
    const int thigh = kThigh + side * kRightSide;
    reach(figure, thigh, glm::vec3(fromBoat * glm::vec4(stands[side], 1.0f)),
          {side == 0 ? 0.12f : -0.10f, 1.0f, 0.4f});
    figure.poseInWorld(thigh + 2, side == 0 ? yaw(10.0f) : yaw(-8.0f) * pitch(-14.0f));
  }
}

}  // namespace

Haul haulAt(float f) {
  Figure figure;
  figure.haul.hips = {0.0f, kUp.at(f), kForward.at(f)};
  // The hips lead, the chest follows, the head comes last. He looks out past the sail to windward, so that
  // the viewer sees his face at three quarters, while his chest twists below it.
  const float hips = kLean.at(f + 2.0f), chest = kLean.at(f - 1.0f), late = kLean.at(f - 4.0f);
  figure.pose(kHips, pitch(0.35f * hips) * yaw(0.2f * kTwist.at(f + 2.0f)));
  figure.pose(kSpine, pitch(0.35f * kLean.at(f)) * yaw(0.4f * kTwist.at(f)));
  figure.pose(kChest, pitch(0.30f * chest) * yaw(0.4f * kTwist.at(f - 1.0f)));
  figure.pose(kNeck,
              pitch(-0.30f * late + 0.4f * kNod.at(f - 2.0f)) * yaw(10.0f - 0.8f * kTwist.at(f - 3.0f)));
  figure.pose(kHead, pitch(-0.25f * late + 0.6f * kNod.at(f - 3.0f)) * yaw(18.0f));
  poseArms(figure, f);
  poseLegs(figure);
  return figure.haul;
}

}  // namespace demo
