#include "gpu/resources.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <exception>

namespace scumble::gpu {

namespace {
// More staged than this and the uploader flushes by itself, so that staging never doubles the memory of a
// large scene.
constexpr uint64_t kMaxStaged = 64ull << 20;

uint32_t levelSize(uint32_t size, uint32_t level) {
  return std::max(1u, size >> level);
}

void recordLayout(VkCommandBuffer commands, VkImage image, uint32_t levels, VkImageLayout from,
                  VkImageLayout to) {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  const bool isNew = from == VK_IMAGE_LAYOUT_UNDEFINED;
  barrier.srcStageMask = isNew ? VK_PIPELINE_STAGE_2_NONE : VK_PIPELINE_STAGE_2_COPY_BIT;
  barrier.srcAccessMask = isNew ? VK_ACCESS_2_NONE : VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = isNew ? VK_PIPELINE_STAGE_2_COPY_BIT : VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.dstAccessMask = isNew ? VK_ACCESS_2_TRANSFER_WRITE_BIT : VK_ACCESS_2_SHADER_READ_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, levels, 0, 1};
  VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &dependency);
}

void recordTextureUpload(VkCommandBuffer commands, VkBuffer source, VkImage image, const ImageDesc& desc) {
  constexpr auto kTarget = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  recordLayout(commands, image, desc.mipLevels, VK_IMAGE_LAYOUT_UNDEFINED, kTarget);
  std::vector<VkBufferImageCopy> copies(desc.mipLevels);
  uint64_t offset = 0;
  for (uint32_t level = 0; level < desc.mipLevels; ++level) {
    const uint32_t width = levelSize(desc.width, level), height = levelSize(desc.height, level);
    copies[level].bufferOffset = offset;
    copies[level].imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
    copies[level].imageExtent = {width, height, 1};
    offset += uint64_t(width) * height * bytesPerPixel(desc.format);
  }
  vkCmdCopyBufferToImage(commands, source, image, kTarget, desc.mipLevels, copies.data());
  recordLayout(commands, image, desc.mipLevels, kTarget, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}
}  // namespace

Buffer::Buffer(Device& device, uint64_t size, VkBufferUsageFlags usage, MemoryKind kind,
               const DebugName& name)
    : device_(&device), size_(size) {
  assert(size > 0);
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  if (usage & VK_BUFFER_USAGE_STORAGE_BUFFER_BIT) info.usage |= VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
  SCUMBLE_VK(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_));
  device.name(VK_OBJECT_TYPE_BUFFER, buffer_, name);
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device.handle(), buffer_, &needs);
  try {
    allocation_ = device.memory().allocate(needs, kind, true);
    SCUMBLE_VK(vkBindBufferMemory(device.handle(), buffer_, allocation_.memory, allocation_.offset));
  } catch (...) {
    vkDestroyBuffer(device.handle(), buffer_, nullptr);
    throw;
  }
}

glm::uvec2 Buffer::address() const {
  const VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, nullptr, buffer_};
  const VkDeviceAddress address = vkGetBufferDeviceAddress(device_->handle(), &info);
  return {uint32_t(address), uint32_t(address >> 32)};
}

Buffer::~Buffer() {
  if (!buffer_) return;
  vkDestroyBuffer(device_->handle(), buffer_, nullptr);
  device_->memory().release(allocation_);
}

void Buffer::swap(Buffer& other) {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(allocation_, other.allocation_);
  std::swap(size_, other.size_);
}

Image Image::unplaced(Device& device, const ImageDesc& desc, VkImageUsageFlags usage, const DebugName& name) {
  Image made;
  made.device_ = &device;
  made.desc_ = desc;
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = desc.format;
  info.extent = {desc.width, desc.height, 1};
  info.mipLevels = desc.mipLevels;
  info.arrayLayers = desc.layers;
  info.samples = VkSampleCountFlagBits(desc.samples);
  info.usage = usage;
  SCUMBLE_VK(vkCreateImage(device.handle(), &info, nullptr, &made.image_));
  device.name(VK_OBJECT_TYPE_IMAGE, made.image_, name);
  return made;
}

VkMemoryRequirements Image::needs() const {
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device_->handle(), image_, &needs);
  return needs;
}

void Image::place(VkDeviceMemory memory, uint64_t offset) {
  SCUMBLE_VK(vkBindImageMemory(device_->handle(), image_, memory, offset));
  view_ = makeView(0);
}

Image::Image(Device& device, const ImageDesc& desc, VkImageUsageFlags usage, const DebugName& name)
    : Image(unplaced(device, desc, usage, name)) {
  allocation_ = device.memory().allocate(needs(), MemoryKind::device, false);
  place(allocation_.memory, allocation_.offset);
}

Image Image::foreign(Device& device, VkImage image, const ImageDesc& desc) {
  Image made;
  made.device_ = &device;
  made.desc_ = desc;
  made.isForeign_ = true;
  made.image_ = image;
  made.view_ = made.makeView(0);
  return made;
}

VkImageView Image::makeView(uint32_t firstLayer) const {
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = image_;
  info.viewType = desc_.arrayView ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
  info.format = desc_.format;
  info.subresourceRange = {aspectOf(desc_.format), 0, desc_.mipLevels, firstLayer, desc_.layers - firstLayer};
  VkImageView view;
  SCUMBLE_VK(vkCreateImageView(device_->handle(), &info, nullptr, &view));
  return view;
}

VkImageView Image::viewFrom(uint32_t layer) const {
  if (layer == 0) return view_;
  while (viewsFrom_.size() < layer) viewsFrom_.push_back(makeView(uint32_t(viewsFrom_.size() + 1)));
  return viewsFrom_[layer - 1];
}

Image::~Image() {
  if (!image_) return;
  for (VkImageView view : viewsFrom_) vkDestroyImageView(device_->handle(), view, nullptr);
  vkDestroyImageView(device_->handle(), view_, nullptr);
  if (!isForeign_) vkDestroyImage(device_->handle(), image_, nullptr);
  if (allocation_.memory) device_->memory().release(allocation_);
}

void Image::swap(Image& other) {
  std::swap(device_, other.device_);
  std::swap(image_, other.image_);
  std::swap(view_, other.view_);
  std::swap(viewsFrom_, other.viewsFrom_);
  std::swap(isForeign_, other.isForeign_);
  std::swap(allocation_, other.allocation_);
  std::swap(desc_, other.desc_);
}

void memoryBarrier(VkCommandBuffer commands, VkPipelineStageFlags2 sourceStages, VkAccessFlags2 sourceAccess,
                   VkPipelineStageFlags2 targetStages, VkAccessFlags2 targetAccess) {
  VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  barrier.srcStageMask = sourceStages;
  barrier.srcAccessMask = sourceAccess;
  barrier.dstStageMask = targetStages;
  barrier.dstAccessMask = targetAccess;
  VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &dependency);
}

void computeBarrier(VkCommandBuffer commands) {
  memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

void indirectBarrier(VkCommandBuffer commands) {
  memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
}

VkImageAspectFlags aspectOf(VkFormat format) {
  return VkImageAspectFlags(isDepthFormat(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT);
}

bool isDepthFormat(VkFormat format) {
  return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM;
}

uint32_t bytesPerPixel(VkFormat format) {
  switch (format) {
    case VK_FORMAT_D16_UNORM:
      return 2;
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB:
    case VK_FORMAT_B8G8R8A8_UNORM:
    case VK_FORMAT_B8G8R8A8_SRGB:
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_R32_SFLOAT:
      return 4;
    case VK_FORMAT_R32G32_SFLOAT:
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return 8;
    case VK_FORMAT_R32G32B32A32_UINT:
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return 16;
    default:
      assert(!"a format without a size");
      return 0;
  }
}

Uploader::~Uploader() {
  assert(((buffers_.empty() && textures_.empty()) || std::uncaught_exceptions() > 0) &&
         "flush() was forgotten");
}

size_t Uploader::stage(uint64_t size) {
  staging_.push_back(Buffer(device_, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload));
  stagedBytes_ += size;
  return staging_.size() - 1;
}

Buffer Uploader::reserve(uint64_t size, VkBufferUsageFlags usage, std::byte** target, const DebugName& name) {
  Buffer buffer(device_, size, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::device, name);
  *target = rewrite(buffer, 0, size);
  return buffer;
}

std::byte* Uploader::rewrite(Buffer& buffer, uint64_t offset, uint64_t size) {
  if (buffer.mapped()) return buffer.mapped() + offset;
  const size_t staged = stage(size);
  buffers_.push_back({staged, buffer.handle(), offset, size});
  return staging_[staged].mapped();
}

Image Uploader::texture(std::span<const std::span<const std::byte>> levels, VkFormat format, uint32_t width,
                        uint32_t height, const DebugName& name) {
  ImageDesc desc{format, width, height};
  desc.arrayView = false;
  desc.mipLevels = uint32_t(levels.size());
  Image image(device_, desc, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, name);
  uint64_t size = 0;
  for (const auto& level : levels) size += level.size();
  const size_t staged = stage(size);
  std::byte* target = staging_[staged].mapped();
  for (uint32_t i = 0; i < levels.size(); ++i) {
    assert(levels[i].size() == size_t(levelSize(width, i)) * levelSize(height, i) * bytesPerPixel(format));
    std::memcpy(target, levels[i].data(), levels[i].size());
    target += levels[i].size();
  }
  textures_.push_back({staged, image.handle(), desc});
  if (stagedBytes_ > kMaxStaged) flush();
  return image;
}

void Uploader::flush() {
  if (buffers_.empty() && textures_.empty()) return;
  const auto buffers = std::exchange(buffers_, {});
  const auto textures = std::exchange(textures_, {});
  device_.runOnce([&](VkCommandBuffer commands) {
    for (const BufferCopy& copy : buffers) {
      const VkBufferCopy region{0, copy.offset, copy.size};
      vkCmdCopyBuffer(commands, staging_[copy.staging].handle(), copy.target, 1, &region);
    }
    for (const TextureCopy& copy : textures)
      recordTextureUpload(commands, staging_[copy.staging].handle(), copy.target, copy.desc);
  });
  staging_.clear();
  stagedBytes_ = 0;
}

}  // namespace scumble::gpu
