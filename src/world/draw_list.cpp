#include "world/draw_list.h"

#include <algorithm>
#include <map>

namespace scumble::world {

bool DrawList::update(gpu::Device& device, std::vector<Draw> draws,
                      const std::vector<shared::DrawLevel>& levels, size_t objects,
                      const std::function<void()>& settle) {
  draws_ = std::move(draws);
  mirrored_.resize(draws_.size(), 0);  // mostly as before; place() knows
  const bool grows = !commands_.handle() || draws_.size() > room_ || levels.size() > roomForLevels_ ||
                     objects > roomForObjects_;
  if (grows) {
    settle();
    room_ = std::max({1u, room_, count()});
    roomForLevels_ = std::max({1u, roomForLevels_, uint32_t(levels.size())});
    roomForObjects_ = std::max({1u, roomForObjects_, uint32_t(objects)});
    constexpr VkBufferUsageFlags kUsage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    commands_ = gpu::PerFrameBuffer(device, room_ * sizeof(shared::DrawCommand), kUsage);
    for (gpu::Buffer* const written : {&seen_, &torn_, &casters_})
      *written = gpu::Buffer(device, room_ * sizeof(shared::DrawCommand),
                             kUsage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::device);
    drawn_ = gpu::Buffer(device, roomForObjects_ * sizeof(shared::DrawnObject),
                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryKind::device);
    levels_ = gpu::PerFrameBuffer(device, roomForLevels_ * sizeof(shared::DrawLevel),
                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    places_ =
        gpu::PerFrameBuffer(device, room_ * sizeof(shared::DrawPlace), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  }
  std::copy(levels.begin(), levels.end(), levels_.as<shared::DrawLevel>());
  sortIntoBuckets();
  return grows;
}

void DrawList::sortIntoBuckets() {
  const auto stateOf = [&](size_t draw) {
    DrawState state = draws_[draw].state;
    state.mirrored = mirrored_[draw];
    return state;
  };
  // How many there are of each.
  std::map<DrawState, uint32_t> counts, bucketOf;
  for (size_t d = 0; d < draws_.size(); ++d) ++counts[stateOf(d)];
  std::vector<DrawBucket> buckets;
  std::vector<uint32_t> next;  // free command, by bucket
  for (const auto& [state, count] : counts) {
    bucketOf[state] = uint32_t(buckets.size());
    next.push_back(buckets.empty() ? 0 : buckets.back().first + buckets.back().count);
    buckets.push_back({state, next.back(), count});
  }
  const auto haveSameState = [](const DrawBucket& a, const DrawBucket& b) { return a.state == b.state; };
  if (!std::equal(buckets.begin(), buckets.end(), buckets_.begin(), buckets_.end(), haveSameState))
    ++statesVersion_;
  buckets_ = std::move(buckets);

  // Each to its place, in their order.
  commandOf_.resize(draws_.size());
  auto* const commands = commands_.as<shared::DrawCommand>();
  auto* const places = places_.as<shared::DrawPlace>();
  for (size_t d = 0; d < draws_.size(); ++d) {
    const Draw& draw = draws_[d];
    const uint32_t bucket = bucketOf[stateOf(d)];
    commandOf_[d] = next[bucket]++;
    commands[commandOf_[d]] = {draw.indexCount, 1, draw.firstIndex, draw.vertexOffset, draw.object};
    shared::DrawPlace& place = places[commandOf_[d]];
    place.bucket = bucket, place.firstLevel = draw.firstLevel, place.levels = draw.levels;
    place.textures = draw.textures, place.isClosed = draw.state.isClosed;
  }
}

void DrawList::place(const std::vector<scene::Bounds>& bounds, const std::vector<uint8_t>& mirrored,
                     const std::vector<float>& scales) {
  bool turns = false;
  for (size_t d = 0; d < draws_.size(); ++d) {
    const uint8_t now = mirrored[draws_[d].object];
    turns |= now != mirrored_[d];
    mirrored_[d] = now;
  }
  if (turns) sortIntoBuckets();
  auto* const places = places_.as<shared::DrawPlace>();
  for (size_t d = 0; d < draws_.size(); ++d) {
    const scene::Bounds& box = bounds[draws_[d].object];
    shared::DrawPlace& place = places[commandOf_[d]];
    place.low = box.empty ? glm::vec3(1.0f) : box.min;
    place.high = box.empty ? glm::vec3(-1.0f) : box.max;
    place.scale = scales[draws_[d].object];
  }
}

void DrawList::addUploads(std::vector<gpu::PerFrameBuffer*>& uploads) {
  uploads.push_back(&commands_);
  uploads.push_back(&places_);
  uploads.push_back(&levels_);
}

}  // namespace scumble::world
