// Several frames under way: while the device draws one, the CPU prepares the next. The device runs frames one
// after the other, so that only what the CPU writes or reads needs copies.
#pragma once

#include <array>

#include "gpu/resources.h"

namespace scumble::gpu {

constexpr uint32_t kFramesInFlight = 3;

// Commands that are recorded and sent without waiting for them.
class Submission {
 public:
  explicit Submission(Device& device);
  ~Submission();
  Submission(const Submission&) = delete;
  Submission& operator=(const Submission&) = delete;

  // Records anew and submits; waits for what was submitted before.
  void submit(const std::function<void(VkCommandBuffer)>& record, const Device::Around& around = {});
  // Ends when the device has done it; at once where nothing is under way.
  void wait();

 private:
  Device& device_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence done_ = VK_NULL_HANDLE;
  bool underWay_ = false;
};

// A buffer that the CPU may write for each frame while the device still reads an earlier one's contents. One
// thread at a time uses it.
class PerFrameBuffer {
 public:
  PerFrameBuffer() = default;
  PerFrameBuffer(Device& device, uint64_t size, VkBufferUsageFlags usage,
                 const DebugName& name = SCUMBLE_CALLER);
  VkBuffer handle() const { return onDevice_.handle(); }
  uint64_t size() const { return onDevice_.size(); }
  // The CPU's own copy, which stays as it is from frame to frame; null for a buffer that was not made. To ask
  // for it as something that can be written is to write it: the next upload copies it.
  std::byte* contents() {
    markWritten();
    return contents_.data();
  }
  template <class T>
  T* as() {
    return reinterpret_cast<T*>(contents());
  }
  template <class T>
  const T* as() const {
    return reinterpret_cast<const T*>(contents_.data());
  }
  // Was written by a pointer from before; or what was recorded of it was not sent.
  void markWritten() { isWritten_ = true; }
  // Records the copy of contents() as they are now, where they were written since the last one; `frame` is
  // below kFramesInFlight, and its last turn is over. Callers put recordUploads() around all of them.
  void upload(VkCommandBuffer commands, uint32_t frame);
  // Takes a part of contents() once more into an upload that was recorded, and not yet sent.
  void amend(uint32_t frame, uint64_t offset, uint64_t bytes);

 private:
  Device* device_ = nullptr;
  Buffer onDevice_;
  std::array<Buffer, kFramesInFlight> staging_;  // made when they are first needed
  std::vector<std::byte> contents_;
  bool isWritten_ = true;
  DebugName name_;
};

// Sends buffers with a frame's own commands: after all that an earlier frame does with them, before all that
// this one does.
void recordUploads(VkCommandBuffer commands, std::span<PerFrameBuffer* const> buffers, uint32_t frame);

}  // namespace scumble::gpu
