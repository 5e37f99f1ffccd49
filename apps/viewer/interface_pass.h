// Draws what Dear ImGui has laid out. (Its own Vulkan backend of version 1.86 knows no dynamic rendering, and
// no textures but its letters.) An ImTextureID is a VkImageView of an image in
// VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL.
#pragma once

#include <imgui.h>

#include <array>
#include <map>
#include <vector>

#include "screen.h"

namespace scumble::viewer {

class InterfacePass {
 public:
  // Callbacks of a list (ImDrawList::AddCallback), which say how what follows them goes on what is there.
  static const ImDrawCallback kAdd, kOver;

  // With the letters that are in ImGui's present context, which this gives their texture. Throws
  // VulkanFailure.
  InterfacePass(const VulkanDevice& device, VkFormat format);
  ~InterfacePass();
  InterfacePass(const InterfacePass&) = delete;
  InterfacePass& operator=(const InterfacePass&) = delete;

  // `frame`: as Screen::draw has it. Images that are drawn stay as long as the frame is under way. `extent`:
  // of what is drawn into, which may be another one than ImGui knows while a window changes its size.
  void record(VkCommandBuffer commands, uint32_t frame, const ImDrawData& drawn, VkExtent2D extent);

 private:
  // What a frame under way needs.
  struct Slot {
    MappedBuffer vertices, indices;
    std::vector<VkDescriptorPool> pools;
    size_t used = 0;  // descriptor sets
    std::map<VkImageView, VkDescriptorSet> sets;
  };
  void makeLayout();
  VkPipeline makePipeline(VkFormat format, VkBlendFactor source, VkBlendFactor destination) const;
  void uploadLetters();
  VkDescriptorSet setFor(VkImageView view, Slot& slot);

  VulkanDevice device_;
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline over_ = VK_NULL_HANDLE, add_ = VK_NULL_HANDLE;
  DeviceImage letters_;
  std::array<Slot, Screen::kFrames> slots_;
};

}  // namespace scumble::viewer
