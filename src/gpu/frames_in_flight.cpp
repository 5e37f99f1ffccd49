#include "gpu/frames_in_flight.h"

#include <cstring>

namespace scumble::gpu {

Submission::Submission(Device& device) : device_(device) {
  const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr,
                                         VK_COMMAND_POOL_CREATE_TRANSIENT_BIT, device.queueFamily()};
  SCUMBLE_VK(vkCreateCommandPool(device.handle(), &poolInfo, nullptr, &pool_));
  const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_,
                                         VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  SCUMBLE_VK(vkAllocateCommandBuffers(device.handle(), &info, &commands_));
  const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  SCUMBLE_VK(vkCreateFence(device.handle(), &fenceInfo, nullptr, &done_));
}

Submission::~Submission() {
  // A lost device has nothing under way.
  if (underWay_) {
    vkWaitForFences(device_.handle(), 1, &done_, VK_TRUE, UINT64_MAX);
    device_.submissionEnded(done_);
  }
  if (done_) vkDestroyFence(device_.handle(), done_, nullptr);
  if (pool_) vkDestroyCommandPool(device_.handle(), pool_, nullptr);
}

void Submission::submit(const std::function<void(VkCommandBuffer)>& record, const Device::Around& around) {
  wait();
  SCUMBLE_VK(vkResetCommandPool(device_.handle(), pool_, 0));
  device_.submit(commands_, record, done_, around);
  underWay_ = true;
  device_.submissionBegan(done_);
}

void Submission::wait() {
  if (!underWay_) return;
  // Whatever comes of it, there is nothing to wait for any more.
  underWay_ = false;
  device_.submissionEnded(done_);
  SCUMBLE_VK(vkWaitForFences(device_.handle(), 1, &done_, VK_TRUE, UINT64_MAX));
  SCUMBLE_VK(vkResetFences(device_.handle(), 1, &done_));
}

PerFrameBuffer::PerFrameBuffer(Device& device, uint64_t size, VkBufferUsageFlags usage, const DebugName& name)
    : device_(&device),
      onDevice_(device, size, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::device, name),
      contents_(size),
      name_(name) {}

void PerFrameBuffer::upload(VkCommandBuffer commands, uint32_t frame) {
  if (!isWritten_) return;
  isWritten_ = false;
  if (!staging_[frame].handle())
    staging_[frame] =
        Buffer(*device_, contents_.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload, name_);
  std::memcpy(staging_[frame].mapped(), contents_.data(), contents_.size());
  const VkBufferCopy copy{0, 0, contents_.size()};
  vkCmdCopyBuffer(commands, staging_[frame].handle(), onDevice_.handle(), 1, &copy);
}

void PerFrameBuffer::amend(uint32_t frame, uint64_t offset, uint64_t bytes) {
  std::memcpy(staging_[frame].mapped() + offset, contents_.data() + offset, bytes);
}

void recordUploads(VkCommandBuffer commands, std::span<PerFrameBuffer* const> buffers, uint32_t frame) {
  memoryBarrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE,
                VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
  for (PerFrameBuffer* buffer : buffers) buffer->upload(commands, frame);
  memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_UNIFORM_READ_BIT |
                    VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
}

}  // namespace scumble::gpu
