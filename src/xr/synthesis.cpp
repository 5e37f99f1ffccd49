#include "xr/synthesis.h"

#include <algorithm>

#include "xr/failure.h"

namespace scumble::xr {

namespace {

// Of XR_FB_space_warp, from its second version on; Debian 12's headers leave it out.
constexpr XrCompositionLayerSpaceWarpInfoFlagsFB kSkip = 1;
// Of XR_EXT_frame_synthesis: time for one frame of two.
constexpr XrFlags64 kRelaxed = 2;
constexpr VkFormat kMotionFormat = VK_FORMAT_R16G16B16A16_SFLOAT, kMotionDepth = VK_FORMAT_D32_SFLOAT;

// What both extensions have.
template <class Info>
void fill(Info& info, const EyeImages& motion, const EyeImages& depth, size_t eye,
          const SynthesisMoment& moment, const void* next) {
  info.next = next;
  info.motionVectorSubImage = motion.part(eye, motion.size());
  info.depthSubImage = depth.part(eye, depth.size());
  info.appSpaceDeltaPose = xrOf(moment.room);
  tellDepths(info, moment.nearPlane);
}

}  // namespace

Synthesis::Synthesis(const Instance& instance, XrSession session, glm::uvec2 size)
    : kind_(instance.has(kFrameSynthesisExtension) ? Kind::ext : Kind::fb),
      isUpwards_(instance.has(XR_FB_SPACE_WARP_EXTENSION_NAME)),
      canSkip_(instance.version(XR_FB_SPACE_WARP_EXTENSION_NAME) >= 2),
      motion_(instance.call(), session, kMotionFormat, size),
      depth_(instance.call(), session, kMotionDepth, size) {}

std::unique_ptr<Synthesis> Synthesis::create(const Instance& instance, XrSession session, glm::uvec2 size,
                                             const std::vector<int64_t>& formats) {
  const auto has = [&](VkFormat format) {
    return std::find(formats.begin(), formats.end(), int64_t(format)) != formats.end();
  };
  const bool isThere =
      instance.has(kFrameSynthesisExtension) || instance.has(XR_FB_SPACE_WARP_EXTENSION_NAME);
  if (!isThere || size.x == 0 || size.y == 0 || !has(kMotionFormat) || !has(kMotionDepth)) return nullptr;
  try {
    return std::unique_ptr<Synthesis>(new Synthesis(instance, session, size));
  } catch (const XrFailure& failure) {
    if (failure.isLoss()) throw;
    return nullptr;
  }
}

std::vector<VulkanTarget> Synthesis::acquire(size_t firstView) {
  std::vector<VulkanTarget> targets = motion_.acquire(firstView, "motion");
  for (VulkanTarget& target : targets)
    target.motion = kind_ == Kind::fb ? MotionUnit::ndcUpwards : MotionUnit::ndc;
  const std::vector<VulkanTarget> depths = depth_.acquire(firstView, "depth");
  targets.insert(targets.end(), depths.begin(), depths.end());
  return targets;
}

void Synthesis::release() {
  motion_.release(), depth_.release();
}

const void* Synthesis::chained(size_t eye, const SynthesisMoment& moment, const void* next) {
  // Where there is no word for that, frames that are like none before come without.
  if (moment.isCut && (kind_ == Kind::ext || !canSkip_)) return next;
  if (kind_ == Kind::fb) {
    XrCompositionLayerSpaceWarpInfoFB& info = fb_[eye] = {XR_TYPE_COMPOSITION_LAYER_SPACE_WARP_INFO_FB};
    fill(info, motion_, depth_, eye, moment, next);
    if (moment.isCut) info.layerFlags = kSkip;
    return &info;
  }
  XrFrameSynthesisInfo& info = ext_[eye] = {kTypeFrameSynthesisInfo};
  fill(info, motion_, depth_, eye, moment, next);
  info.layerFlags = kRelaxed;
  info.motionVectorScale = {1, isUpwards_ ? -1.0f : 1.0f, 1, 1};
  return &info;
}

}  // namespace scumble::xr
