#include "world/textures_on_gpu.h"

#include <map>
#include <span>

#include "base/mipmaps.h"
#include "scene/parallel.h"

namespace scumble::world {

bool TexturesOnGpu::update(gpu::Uploader& uploader, const std::vector<Shared<scene::TextureImage>>& images,
                           const std::function<void()>& settle) {
  if (!white_.handle()) {
    const std::byte white[4] = {std::byte(255), std::byte(255), std::byte(255), std::byte(255)};
    const std::span<const std::byte> whiteLevel(white);
    white_ = uploader.texture({&whiteLevel, 1}, VK_FORMAT_R8G8B8A8_SRGB, 1, 1);
  }

  // Which are new.
  std::map<const scene::TextureImage*, std::shared_ptr<const Texture>> had, now;
  for (const auto& texture : textures_) had.emplace(texture->of.get(), texture);
  std::vector<std::shared_ptr<const scene::TextureImage>> fresh;
  bool changes = images.size() < textures_.size();
  for (size_t i = 0; i < images.size(); ++i) {
    const scene::TextureImage& image = *images[i];
    changes |= i < textures_.size() && textures_[i]->of.get() != &image;
    const auto [entry, isNew] = now.try_emplace(&image);
    if (!isNew) continue;
    if (const auto known = had.find(&image); known != had.end()) {
      entry->second = known->second;
      continue;
    }
    if (image.width > device_.limits().maxImageDimension2D ||
        image.height > device_.limits().maxImageDimension2D)
      throw gpu::VulkanError{"a texture's size", VK_ERROR_OUT_OF_DEVICE_MEMORY};
    fresh.push_back(images[i].keep());
  }
  if (changes) settle();

  // The old ones go before there are new ones, but those that stay.
  had.clear();
  textures_.clear();
  uploaded_ = uint32_t(fresh.size());
  std::vector<std::vector<std::vector<uint8_t>>> mipmaps(fresh.size());
  scene::parallelFor(fresh.size(), scene::threadCount(0), [&](size_t i) {
    mipmaps[i] = makeMipmaps(fresh[i]->rgba, fresh[i]->width, fresh[i]->height);
  });
  for (size_t i = 0; i < fresh.size(); ++i) {
    const scene::TextureImage& image = *fresh[i];
    std::vector<std::span<const std::byte>> levels{std::as_bytes(std::span(image.rgba))};
    for (const auto& level : mipmaps[i]) levels.push_back(std::as_bytes(std::span(level)));
    auto texture = std::make_shared<Texture>();
    texture->of = fresh[i];
    texture->image = uploader.texture(levels, VK_FORMAT_R8G8B8A8_SRGB, image.width, image.height);
    texture->bytes = 0;
    for (const auto& level : levels) texture->bytes += level.size();
    now[fresh[i].get()] = std::move(texture);
    mipmaps[i].clear();
  }
  for (const Shared<scene::TextureImage>& image : images) textures_.push_back(now.at(&*image));
  return changes;
}

VkImageView TexturesOnGpu::view(int image) const {
  return (image < 0 ? white_ : textures_[size_t(image)]->image).view();
}

uint64_t TexturesOnGpu::bytes() const {
  uint64_t bytes = 0;
  for (const auto& texture : textures_) bytes += texture->bytes;
  return bytes;
}

}  // namespace scumble::world
