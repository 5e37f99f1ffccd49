#include "measure/magnify.h"

#include <algorithm>
#include <cmath>

namespace scumble::measuring {

glm::vec2 zoomCentre(const Field& seen, int zoom) {
  const int w = seen.width, h = seen.height;
  const int windowW = std::max(1, w / zoom), windowH = std::max(1, h / zoom);
  std::vector<uint32_t> sums(size_t(w + 1) * size_t(h + 1));
  const auto sumAt = [&](int x, int y) -> uint32_t& { return sums[size_t(y) * size_t(w + 1) + size_t(x)]; };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      sumAt(x + 1, y + 1) =
          sumAt(x, y + 1) + sumAt(x + 1, y) - sumAt(x, y) + seen.valid[size_t(y) * size_t(w) + size_t(x)];
  uint32_t most = 0;
  float nearest = 0;
  glm::vec2 best(0.0f);
  for (int y = 0; y + windowH <= h; ++y)
    for (int x = 0; x + windowW <= w; ++x) {
      const uint32_t covered =
          sumAt(x + windowW, y + windowH) - sumAt(x, y + windowH) - sumAt(x + windowW, y) + sumAt(x, y);
      const glm::vec2 middle((2.0f * float(x) + float(windowW)) / float(w) - 1,
                             (2.0f * float(y) + float(windowH)) / float(h) - 1);
      const float distance = glm::length(middle);
      if (covered > most || (covered == most && distance < nearest))
        most = covered, nearest = distance, best = middle;
    }
  // Magnified around a fixed place n, the picture's middle shows what was at n (1 - 1 / zoom).
  return glm::clamp(best / (1 - 1 / float(zoom)), -1.0f, 1.0f);
}

View magnified(View view, float zoom, const glm::vec2& centre) {
  glm::mat4 magnify(1.0f);
  magnify[0][0] = magnify[1][1] = zoom;
  magnify[3][0] = centre.x * (1 - zoom), magnify[3][1] = centre.y * (1 - zoom);
  view.eyeToClip = magnify * view.eyeToClip;
  return view;
}

void keepMagnified(Field& field, double zoom, const glm::vec2& centre) {
  const auto shows = [&](int i, int count, float fixed) {
    const double place = 2 * (i + 0.5) / count - 1;
    return std::abs(fixed + (place - fixed) * zoom) < 1;
  };
  for (size_t pixel = 0; pixel < field.pixelCount(); ++pixel)
    if (!shows(int(pixel % size_t(field.width)), field.width, centre.x) ||
        !shows(int(pixel / size_t(field.width)), field.height, centre.y))
      field.valid[pixel] = 0;
}

}  // namespace scumble::measuring
