#include "interface_pass.h"

#include <imgui.h>

#include <algorithm>
#include <cstring>

#include "shaders/interface_frag.h"
#include "shaders/interface_vert.h"

namespace scumble::viewer {

namespace {

constexpr uint32_t kSetsOfPool = 64;
constexpr VkDeviceSize kLeastBytes = 1 << 16;

// Large enough, with room for what comes.
void ensure(const VulkanDevice& device, MappedBuffer& buffer, VkDeviceSize bytes, VkBufferUsageFlags usage) {
  if (buffer.size() < bytes)
    buffer = MappedBuffer(device, std::max(kLeastBytes, bytes + bytes / 2), usage, "interface");
}

// Never called: they are told apart by where they are.
void add(const ImDrawList*, const ImDrawCmd*) {}
void over(const ImDrawList*, const ImDrawCmd*) {}

}  // namespace

const ImDrawCallback InterfacePass::kAdd = add, InterfacePass::kOver = over;

InterfacePass::InterfacePass(const VulkanDevice& device, VkFormat format) : device_(device) {
  VkSamplerCreateInfo sampler{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
  sampler.addressModeU = sampler.addressModeV = sampler.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  must(vkCreateSampler(device.device, &sampler, nullptr, &sampler_), "vkCreateSampler");
  makeLayout();
  over_ = makePipeline(format, VK_BLEND_FACTOR_SRC_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA);
  add_ = makePipeline(format, VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_ONE);
  uploadLetters();
  ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
}

InterfacePass::~InterfacePass() {
  for (const Slot& slot : slots_)
    for (const VkDescriptorPool pool : slot.pools) vkDestroyDescriptorPool(device_.device, pool, nullptr);
  vkDestroyPipeline(device_.device, over_, nullptr);
  vkDestroyPipeline(device_.device, add_, nullptr);
  vkDestroyPipelineLayout(device_.device, layout_, nullptr);
  vkDestroyDescriptorSetLayout(device_.device, setLayout_, nullptr);
  vkDestroySampler(device_.device, sampler_, nullptr);
}

void InterfacePass::makeLayout() {
  const VkDescriptorSetLayoutBinding binding{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                             VK_SHADER_STAGE_FRAGMENT_BIT, &sampler_};
  VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set.bindingCount = 1, set.pBindings = &binding;
  must(vkCreateDescriptorSetLayout(device_.device, &set, nullptr, &setLayout_),
       "vkCreateDescriptorSetLayout");
  const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, 2 * sizeof(float)};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = layout.pushConstantRangeCount = 1;
  layout.pSetLayouts = &setLayout_, layout.pPushConstantRanges = &push;
  must(vkCreatePipelineLayout(device_.device, &layout, nullptr, &layout_), "vkCreatePipelineLayout");
}

VkPipeline InterfacePass::makePipeline(VkFormat format, VkBlendFactor source,
                                       VkBlendFactor destination) const {
  VkPipelineShaderStageCreateInfo stages[2]{};
  const auto stage = [&](VkPipelineShaderStageCreateInfo& at, VkShaderStageFlagBits which,
                         const auto& words) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = sizeof words, info.pCode = words;
    at = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    at.stage = which, at.pName = "main";
    must(vkCreateShaderModule(device_.device, &info, nullptr, &at.module), "vkCreateShaderModule");
  };
  stage(stages[0], VK_SHADER_STAGE_VERTEX_BIT, shaders::interface_vert);
  stage(stages[1], VK_SHADER_STAGE_FRAGMENT_BIT, shaders::interface_frag);
  const VkVertexInputBindingDescription vertex{0, sizeof(ImDrawVert), VK_VERTEX_INPUT_RATE_VERTEX};
  const VkVertexInputAttributeDescription attributes[] = {
      {0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, pos)},
      {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, uv)},
      {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(ImDrawVert, col)}};
  VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  input.vertexBindingDescriptionCount = 1, input.pVertexBindingDescriptions = &vertex;
  input.vertexAttributeDescriptionCount = 3, input.pVertexAttributeDescriptions = attributes;
  VkPipelineInputAssemblyStateCreateInfo assembly{
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineColorBlendAttachmentState over{};
  over.blendEnable = VK_TRUE;
  over.srcColorBlendFactor = source, over.dstColorBlendFactor = destination;
  over.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
  over.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  over.colorWriteMask = 0xF;
  VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blend.attachmentCount = 1, blend.pAttachments = &over;
  const VkDynamicState dynamic[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamicState{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamicState.dynamicStateCount = 2, dynamicState.pDynamicStates = dynamic;
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = 1, rendering.pColorAttachmentFormats = &format;
  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
  info.stageCount = 2, info.pStages = stages;
  info.pVertexInputState = &input, info.pInputAssemblyState = &assembly, info.pViewportState = &viewport;
  info.pRasterizationState = &raster, info.pMultisampleState = &samples, info.pColorBlendState = &blend;
  info.pDynamicState = &dynamicState, info.layout = layout_;
  VkPipeline pipeline = VK_NULL_HANDLE;
  const VkResult made =
      vkCreateGraphicsPipelines(device_.device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
  for (const VkPipelineShaderStageCreateInfo& each : stages)
    vkDestroyShaderModule(device_.device, each.module, nullptr);
  must(made, "vkCreateGraphicsPipelines");
  name(device_, VK_OBJECT_TYPE_PIPELINE, pipeline, "interface");
  return pipeline;
}

void InterfacePass::uploadLetters() {
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  letters_ = uploaded(device_, {uint32_t(width), uint32_t(height)}, pixels, "letters");
  ImGui::GetIO().Fonts->SetTexID(ImTextureID(letters_.view()));
}

VkDescriptorSet InterfacePass::setFor(VkImageView view, Slot& slot) {
  const auto [known, isNew] = slot.sets.try_emplace(view, VK_NULL_HANDLE);
  if (!isNew) return known->second;
  if (slot.used == slot.pools.size() * kSetsOfPool) {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kSetsOfPool};
    VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    info.maxSets = kSetsOfPool;
    info.poolSizeCount = 1, info.pPoolSizes = &size;
    must(vkCreateDescriptorPool(device_.device, &info, nullptr, &slot.pools.emplace_back()),
         "vkCreateDescriptorPool");
  }
  VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
  info.descriptorPool = slot.pools[slot.used++ / kSetsOfPool];
  info.descriptorSetCount = 1, info.pSetLayouts = &setLayout_;
  must(vkAllocateDescriptorSets(device_.device, &info, &known->second), "vkAllocateDescriptorSets");
  const VkDescriptorImageInfo image{sampler_, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  write.dstSet = known->second;
  write.descriptorCount = 1;
  write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  write.pImageInfo = &image;
  vkUpdateDescriptorSets(device_.device, 1, &write, 0, nullptr);
  return known->second;
}

void InterfacePass::record(VkCommandBuffer commands, uint32_t frame, const ImDrawData& drawn,
                           VkExtent2D extent) {
  Slot& slot = slots_[frame];
  for (const VkDescriptorPool pool : slot.pools) vkResetDescriptorPool(device_.device, pool, 0);
  slot.used = 0;
  slot.sets.clear();
  if (drawn.TotalVtxCount == 0) return;
  ensure(device_, slot.vertices, VkDeviceSize(drawn.TotalVtxCount) * sizeof(ImDrawVert),
         VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  ensure(device_, slot.indices, VkDeviceSize(drawn.TotalIdxCount) * sizeof(ImDrawIdx),
         VK_BUFFER_USAGE_INDEX_BUFFER_BIT);

  const VkViewport viewport{0, 0, drawn.DisplaySize.x, drawn.DisplaySize.y, 0, 1};
  const float size[] = {drawn.DisplaySize.x, drawn.DisplaySize.y};
  const VkDeviceSize start = 0;
  const VkBuffer vertices = slot.vertices.handle();
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, over_);
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof size, size);
  vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &start);
  vkCmdBindIndexBuffer(commands, slot.indices.handle(), 0,
                       sizeof(ImDrawIdx) == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
  uint32_t firstVertex = 0, firstIndex = 0;
  for (int l = 0; l < drawn.CmdListsCount; ++l) {
    const ImDrawList& list = *drawn.CmdLists[l];
    std::memcpy(slot.vertices.mapped() + firstVertex * sizeof(ImDrawVert), list.VtxBuffer.Data,
                size_t(list.VtxBuffer.Size) * sizeof(ImDrawVert));
    std::memcpy(slot.indices.mapped() + firstIndex * sizeof(ImDrawIdx), list.IdxBuffer.Data,
                size_t(list.IdxBuffer.Size) * sizeof(ImDrawIdx));
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const float left = std::clamp(command.ClipRect.x, 0.0f, float(extent.width)),
                  top = std::clamp(command.ClipRect.y, 0.0f, float(extent.height));
      const float right = std::clamp(command.ClipRect.z, left, float(extent.width)),
                  bottom = std::clamp(command.ClipRect.w, top, float(extent.height));
      const VkRect2D scissor{{int32_t(left), int32_t(top)}, {uint32_t(right - left), uint32_t(bottom - top)}};
      if (command.UserCallback == kAdd || command.UserCallback == kOver)
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                          command.UserCallback == kAdd ? add_ : over_);
      if (command.UserCallback || scissor.extent.width == 0 || scissor.extent.height == 0) continue;
      const VkDescriptorSet set = setFor(VkImageView(command.GetTexID()), slot);
      vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set, 0, nullptr);
      vkCmdSetScissor(commands, 0, 1, &scissor);
      vkCmdDrawIndexed(commands, command.ElemCount, 1, firstIndex + command.IdxOffset,
                       int32_t(firstVertex + command.VtxOffset), 0);
    }
    firstVertex += uint32_t(list.VtxBuffer.Size), firstIndex += uint32_t(list.IdxBuffer.Size);
  }
}

}  // namespace scumble::viewer
