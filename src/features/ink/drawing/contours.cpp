#include "features/ink/drawing/contours.h"

#include <unordered_map>

namespace scumble::ink {

namespace {

// Numbers of nodes in the order in which they are first met.
class Nodes {
 public:
  uint32_t at(uint64_t key) { return numbers_.emplace(key, uint32_t(numbers_.size())).first->second; }
  uint32_t count() const { return uint32_t(numbers_.size()); }

 private:
  std::unordered_map<uint64_t, uint32_t> numbers_;
};

}  // namespace

Contours levelContours(uint32_t width, uint32_t height,
                       const std::function<std::optional<float>(uint32_t, uint32_t)>& value, float level) {
  Contours contours;
  Nodes nodes;
  std::vector<std::optional<float>> values(size_t(width) * height);
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) values[size_t(y) * width + x] = value(x, y);
  for (uint32_t y = 0; y + 1 < height; ++y)
    for (uint32_t x = 0; x + 1 < width; ++x) {
      // Corners go around the square; side i leads from corner i to the next one.
      constexpr uint32_t kAcross[] = {0, 1, 1, 0}, kDown[] = {0, 0, 1, 1};
      float corners[4];
      bool isWhole = true;
      for (int i = 0; i < 4 && isWhole; ++i) {
        const std::optional<float>& corner = values[size_t(y + kDown[i]) * width + x + kAcross[i]];
        isWhole = corner.has_value();
        if (isWhole) corners[i] = *corner - level;
      }
      if (!isWhole) continue;
      int sides[4];
      int count = 0;
      glm::vec2 places[4];
      uint32_t numbers[4];
      for (int i = 0; i < 4; ++i) {
        const int j = (i + 1) % 4;
        if ((corners[i] > 0) == (corners[j] > 0)) continue;
        const float t = corners[i] / (corners[i] - corners[j]);
        const glm::vec2 from(x + kAcross[i], y + kDown[i]), to(x + kAcross[j], y + kDown[j]);
        places[i] = 0.5f + from + t * (to - from);
        // A side is known by its upper left pixel and its direction.
        const uint64_t pixel =
            uint64_t(y + std::min(kDown[i], kDown[j])) * width + x + std::min(kAcross[i], kAcross[j]);
        numbers[i] = nodes.at(2 * pixel + uint64_t(kDown[i] != kDown[j]));
        sides[count++] = i;
      }
      const auto add = [&](int a, int b) {
        contours.links.push_back({{numbers[a], numbers[b]}, 0, {places[a], places[b]}});
      };
      if (count == 2) add(sides[0], sides[1]);
      if (count == 4) {
        // A saddle: the middle tells which corners belong together.
        const bool isMiddleUp = corners[0] + corners[1] + corners[2] + corners[3] > 0;
        if (isMiddleUp == (corners[0] > 0))
          add(0, 1), add(2, 3);
        else
          add(3, 0), add(1, 2);
      }
    }
  contours.nodeCount = nodes.count();
  return contours;
}

Contours borderContours(uint32_t width, uint32_t height, const IsBorder& isBorder) {
  Contours contours;
  Nodes nodes;
  const auto corner = [&](uint32_t x, uint32_t y) { return nodes.at(uint64_t(y) * (width + 1) + x); };
  const auto add = [&](uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1) {
    const uint32_t from = corner(x0, y0), to = corner(x1, y1);
    contours.links.push_back({{from, to}, 0, {glm::vec2(x0, y0), glm::vec2(x1, y1)}});
  };
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      if (x + 1 < width && isBorder(x, y, x + 1, y)) add(x + 1, y, x + 1, y + 1);
      if (y + 1 < height && isBorder(x, y, x, y + 1)) add(x, y + 1, x + 1, y + 1);
    }
  contours.nodeCount = nodes.count();
  return contours;
}

}  // namespace scumble::ink
