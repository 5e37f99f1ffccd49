#include "film/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

namespace scumble::film {
namespace {

constexpr size_t kChannels = 4;  // of one layer: two ranks

// Constants of MurmurHash3_x86_32.
uint32_t scramble(uint32_t block) {
  return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

uint32_t littleEndian(std::string_view bytes) {
  uint32_t value = 0;
  for (size_t i = 0; i < bytes.size(); ++i) value |= uint32_t(uint8_t(bytes[i])) << (8 * i);
  return value;
}

}  // namespace

uint32_t murmurHash3(std::string_view bytes, uint32_t seed) {
  uint32_t hash = seed;
  std::string_view rest = bytes;
  for (; rest.size() >= 4; rest.remove_prefix(4))
    hash = std::rotl(hash ^ scramble(littleEndian(rest.substr(0, 4))), 13) * 5 + 0xe6546b64u;
  hash ^= scramble(littleEndian(rest));
  hash ^= uint32_t(bytes.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

uint32_t cryptomatteBits(std::string_view name) {
  const uint32_t hash = murmurHash3(name);
  const uint32_t exponent = std::clamp(hash >> 23 & 0xffu, 1u, 254u);
  return (hash & 0x807fffffu) | exponent << 23;
}

std::string cryptomatteManifest(const std::vector<std::string>& objects) {
  nlohmann::json manifest = nlohmann::json::object();
  for (const std::string& name : objects)
    if (!name.empty()) manifest[name] = fmt::format("{:08x}", cryptomatteBits(name));
  // Names that are no UTF-8 are hashed as they are and shown as well as JSON can.
  return manifest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<std::pair<std::string, std::string>> cryptomatteAttributes(
    const std::string& name, const std::vector<std::string>& objects) {
  const std::string key = "cryptomatte/" + fmt::format("{:08x}", murmurHash3(name)).substr(0, 7) + "/";
  return {{key + "name", name},
          {key + "hash", "MurmurHash3_32"},
          {key + "conversion", "uint32_to_float32"},
          {key + "manifest", cryptomatteManifest(objects)}};
}

std::string problemWithCryptomatte(const Image& image, const std::vector<std::string>& objects) {
  if (image.channels.size() % 2 != 0) return "its channels are no pairs of object and coverage";
  for (size_t i = 0; i < image.pixels.size(); i += 2) {
    const float number = image.pixels[i];
    // Written so that NaN is a problem too.
    if (!(number >= 0 && number <= float(objects.size()) && number == float(uint32_t(number))))
      return fmt::format("it has an object {}, but there are {} names", number, objects.size());
  }
  return "";
}

std::vector<Image> cryptomatteLayers(const Image& image, const std::vector<std::string>& objects) {
  std::vector<float> ids{0};
  for (const std::string& name : objects) ids.push_back(std::bit_cast<float>(cryptomatteBits(name)));

  const size_t given = image.channels.size(), pixelCount = size_t(image.width) * image.height;
  std::vector<Image> layers((given + kChannels - 1) / kChannels);
  for (size_t i = 0; i < layers.size(); ++i) {
    Image& layer = layers[i];
    layer.width = image.width;
    layer.height = image.height;
    layer.channels = {"R", "G", "B", "A"};
    layer.pixels.assign(pixelCount * kChannels, 0.0f);  // the second rank of the last layer may not be given
    const size_t first = i * kChannels, count = std::min(kChannels, given - first);
    for (size_t pixel = 0; pixel < pixelCount; ++pixel) {
      const float* in = image.pixels.data() + pixel * given + first;
      float* out = layer.pixels.data() + pixel * kChannels;
      for (size_t c = 0; c < count; c += 2) {
        out[c] = ids[size_t(in[c])];
        out[c + 1] = in[c] == 0 ? 0.0f : in[c + 1];
      }
    }
  }
  return layers;
}

}  // namespace scumble::film
