#include "frame/example_textures.h"

#include <algorithm>
#include <cmath>

#include "base/tileable_noise.h"

namespace scumble::frame {

namespace {

// A quarter of a unit is one deviation: then noise seldom leaves [0, 1].
uint8_t noiseByte(float v) {
  return uint8_t(std::lround(std::clamp(0.5f + v / 4.0f, 0.0f, 1.0f) * 255));
}

// Longer than wide, with flat tops and sharp sides.
std::vector<uint8_t> knifeMarks() {
  const std::vector<float> noise = selfSimilarNoise(kBuiltInSize, 32, 3, 0.6f, 5, 4.0f);
  std::vector<uint8_t> marks(noise.size());
  std::transform(noise.begin(), noise.end(), marks.begin(),
                 [](float v) { return uint8_t(std::lround((0.5f + 0.5f * std::tanh(1.05f * v)) * 255)); });
  return marks;
}

Pixels grey(const std::vector<uint8_t>& values) {
  Pixels pixels{kBuiltInSize, kBuiltInSize, std::vector<uint8_t>(values.size() * 4, 255)};
  for (size_t i = 0; i < values.size(); ++i)
    for (size_t c = 0; c < 3; ++c) pixels.rgba[4 * i + c] = values[i];
  return pixels;
}

// Means of 2 x 2 bytes down to one texel: these are values, not light.
std::vector<std::vector<uint8_t>> halves(const Pixels& pixels) {
  std::vector<std::vector<uint8_t>> levels{pixels.rgba};
  uint32_t width = pixels.width, height = pixels.height;
  while (width > 1 || height > 1) {
    const uint32_t w = std::max(width / 2, 1u), h = std::max(height / 2, 1u);
    std::vector<uint8_t> level(size_t(w) * h * 4);
    const std::vector<uint8_t>& above = levels.back();
    for (uint32_t y = 0; y < h; ++y)
      for (uint32_t x = 0; x < w; ++x)
        for (uint32_t c = 0; c < 4; ++c) {
          const uint32_t x0 = std::min(2 * x, width - 1), x1 = std::min(2 * x + 1, width - 1);
          const uint32_t y0 = std::min(2 * y, height - 1), y1 = std::min(2 * y + 1, height - 1);
          const auto at = [&](uint32_t i, uint32_t j) {
            return uint32_t(above[(size_t(j) * width + i) * 4 + c]);
          };
          level[(size_t(y) * w + x) * 4 + c] =
              uint8_t((at(x0, y0) + at(x1, y0) + at(x0, y1) + at(x1, y1) + 2) / 4);
        }
    levels.push_back(std::move(level));
    width = w, height = h;
  }
  return levels;
}

gpu::Image upload(gpu::Uploader& uploader, const Pixels& pixels) {
  const auto levels = halves(pixels);
  std::vector<std::span<const std::byte>> spans;
  for (const auto& level : levels) spans.push_back(std::as_bytes(std::span(level)));
  gpu::Image image = uploader.texture(spans, VK_FORMAT_R8G8B8A8_UNORM, pixels.width, pixels.height);
  uploader.flush();
  return image;
}

}  // namespace

Pixels builtInExample(int index) {
  if (index == 1) {
    // Lying, as `orient` wants them.
    const std::vector<uint8_t> standing = knifeMarks();
    std::vector<uint8_t> lying(standing.size());
    for (uint32_t y = 0; y < kBuiltInSize; ++y)
      for (uint32_t x = 0; x < kBuiltInSize; ++x)
        lying[y * kBuiltInSize + x] = standing[x * kBuiltInSize + y];
    return grey(lying);
  }
  if (index == 2) {
    const std::vector<float> grain = selfSimilarNoise(kBuiltInSize, 24, 4, 0.7f, 31);
    std::vector<uint8_t> bytes(grain.size());
    std::transform(grain.begin(), grain.end(), bytes.begin(), noiseByte);
    return grey(bytes);
  }
  const std::vector<float> x = selfSimilarNoise(kBuiltInSize, 14, 3, 0.62f, 11);
  const std::vector<float> y = selfSimilarNoise(kBuiltInSize, 14, 3, 0.62f, 23);
  Pixels pixels = grey(knifeMarks());
  for (size_t i = 0; i < x.size(); ++i)
    pixels.rgba[4 * i] = noiseByte(x[i]), pixels.rgba[4 * i + 1] = noiseByte(y[i]);
  return pixels;
}

namespace {

Pixels pixelsOf(const look::LookData& look, look::Picture picture) {
  return picture.index >= 0 ? builtInExample(picture.index)
                            : look.pictures[size_t(-1 - picture.index)]->pixels;
}

}  // namespace

ExampleTexture& ExampleTextures::find(const look::LookData& look, look::Picture picture) {
  const int builtIn = std::max(picture.index, -1);
  const uint64_t contents = builtIn >= 0 ? 0 : look.pictures[size_t(-1 - picture.index)]->contents;
  for (const Known& known : known_)
    if (known.builtIn == builtIn && known.contents == contents) return *known.texture;

  const Pixels pixels = pixelsOf(look, picture);
  auto texture = std::make_unique<ExampleTexture>();
  texture->width = pixels.width, texture->height = pixels.height;
  texture->statistics = measure(pixels);
  gpu::Uploader uploader(device_);
  texture->image = upload(uploader, pixels);
  known_.push_back({builtIn, contents, std::move(texture)});
  return *known_.back().texture;
}

const ExampleTexture& ExampleTextures::getWithTwin(const look::LookData& look, look::Picture picture) {
  ExampleTexture& texture = find(look, picture);
  if (texture.gaussian.handle()) return texture;
  const GaussianTwin twin = gaussianTwin(pixelsOf(look, picture));
  texture.gaussianStatistics = measure(twin.pixels);
  gpu::Uploader uploader(device_);
  texture.gaussian = upload(uploader, twin.pixels);
  const std::span<const std::byte> row = std::as_bytes(std::span(twin.inverse));
  texture.inverse = uploader.texture({&row, 1}, VK_FORMAT_R8G8B8A8_UNORM, 256, 1);
  uploader.flush();
  return texture;
}

}  // namespace scumble::frame
