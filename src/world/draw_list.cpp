#include "world/draw_list.h"

#include <algorithm>
#include <map>

namespace scumble::world {

bool DrawList::update(gpu::Device& device, std::vector<Draw> draws, const std::function<void()>& settle) {
  draws_ = std::move(draws);
  mirrored_.assign(draws_.size(), 0);
  const bool grows = !commands_.handle() || draws_.size() > room_;
  if (grows) {
    settle();
    room_ = std::max(1u, count());
    constexpr VkBufferUsageFlags kUsage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    commands_ = gpu::PerFrameBuffer(device, room_ * sizeof(shared::DrawCommand), kUsage);
    seen_ = gpu::Buffer(device, room_ * sizeof(shared::DrawCommand),
                        kUsage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, gpu::MemoryKind::device);
    places_ =
        gpu::PerFrameBuffer(device, room_ * sizeof(shared::DrawPlace), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  }
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
  std::map<DrawState, uint32_t> counts;
  for (size_t d = 0; d < draws_.size(); ++d) ++counts[stateOf(d)];
  std::vector<DrawBucket> buckets;
  std::map<DrawState, uint32_t> next;
  for (const auto& [state, count] : counts) {
    const uint32_t first = buckets.empty() ? 0 : buckets.back().first + buckets.back().count;
    buckets.push_back({state, first, count});
    next[state] = first;
  }
  const auto haveSameState = [](const DrawBucket& a, const DrawBucket& b) { return a.state == b.state; };
  if (!std::equal(buckets.begin(), buckets.end(), buckets_.begin(), buckets_.end(), haveSameState))
    ++statesVersion_;
  buckets_ = std::move(buckets);

  // Each to its place, in their order.
  commandOf_.resize(draws_.size());
  auto* const commands = commands_.as<shared::DrawCommand>();
  for (size_t d = 0; d < draws_.size(); ++d) {
    const Draw& draw = draws_[d];
    commandOf_[d] = next[stateOf(d)]++;
    commands[commandOf_[d]] = {draw.indexCount, 1, draw.firstIndex, draw.vertexOffset, draw.object};
  }
}

void DrawList::place(const std::vector<scene::Bounds>& bounds, const std::vector<uint8_t>& mirrored) {
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
    places[commandOf_[d]] = {box.empty ? glm::vec3(1.0f) : box.min, box.empty ? glm::vec3(-1.0f) : box.max,
                             0};
  }
  for (uint32_t b = 0; b < buckets_.size(); ++b)
    for (uint32_t i = 0; i < buckets_[b].count; ++i) places[buckets_[b].first + i].bucket = b;
}

void DrawList::addUploads(std::vector<gpu::PerFrameBuffer*>& uploads) {
  uploads.push_back(&commands_);
  uploads.push_back(&places_);
}

}  // namespace scumble::world
