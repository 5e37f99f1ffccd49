// Strokes as SVG 1.1.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "base/srgb.h"
#include "scumble/drawing.h"
#include "scumble/image.h"

namespace scumble {

namespace {

// Beyond this angle between two parts of a stroke their joint is round: cosine of 20 degrees.
constexpr float kCosJoint = 0.94f;

std::string number(double value) {
  std::string result = fmt::format("{:.2f}", value);
  while (result.back() == '0') result.pop_back();
  if (result.back() == '.') result.pop_back();
  return result == "-0" ? "0" : result;
}

std::string colorOf(const glm::vec3& linear) {
  const auto code = [](float value) {
    return unsigned(std::lround(255 * srgbFromLinear(std::clamp(double(value), 0.0, 1.0))));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", code(linear.r), code(linear.g), code(linear.b));
}

// Of the points of a stroke, without those that lie on one another.
struct Way {
  std::vector<glm::vec2> points, directions;  // from each point to the next one
  std::vector<float> radii;
  bool isClosed = false;
};

Way wayOf(const Drawing::Stroke& stroke) {
  Way way;
  way.isClosed = stroke.isClosed;
  for (const Drawing::Point& point : stroke.points) {
    const glm::vec2 place(point.x, point.y);
    if (!way.points.empty() && glm::distance(way.points.back(), place) < 0.01f) {
      way.radii.back() = std::max(way.radii.back(), point.radius);
      continue;
    }
    way.points.push_back(place);
    way.radii.push_back(point.radius);
  }
  if (way.isClosed && way.points.size() > 1 && glm::distance(way.points.front(), way.points.back()) < 0.01f)
    way.points.pop_back(), way.radii.pop_back();
  way.isClosed &= way.points.size() > 2;
  const size_t count = way.points.size();
  for (size_t i = 0; i + (way.isClosed ? 0 : 1) < count; ++i)
    way.directions.push_back(glm::normalize(way.points[(i + 1) % count] - way.points[i]));
  return way;
}

class Path {
 public:
  void to(glm::vec2 point) {
    text_ += text_.empty() || text_.back() == 'Z' ? 'M' : 'L';
    put(point);
  }
  // Around a centre on the circle of that radius, clockwise as it is seen.
  void arc(float radius, glm::vec2 point) {
    text_ += "A" + number(radius) + " " + number(radius) + " 0 0 1 ";
    put(point);
  }
  void close() { text_ += 'Z'; }
  const std::string& text() const { return text_; }

 private:
  void put(glm::vec2 point) { text_ += number(point.x) + " " + number(point.y); }
  std::string text_;
};

// To the left of a direction, as it is seen (y grows downwards).
glm::vec2 leftOf(glm::vec2 direction) {
  return {direction.y, -direction.x};
}

// One side of a stroke, the left one of `way`, from its first point to its last; where it is closed, once
// around.
void addSide(const Way& way, Path& path) {
  const size_t count = way.points.size();
  for (size_t i = 0; i < count; ++i) {
    const glm::vec2 point = way.points[i];
    const float radius = way.radii[i];
    const bool hasBefore = i > 0 || way.isClosed, hasAfter = i + 1 < count || way.isClosed;
    const glm::vec2 before = hasBefore
                                 ? way.directions[(i + way.directions.size() - 1) % way.directions.size()]
                                 : way.directions[i];
    const glm::vec2 after = hasAfter ? way.directions[i] : before;
    if (glm::dot(before, after) >= kCosJoint) {
      path.to(point + radius * leftOf(glm::normalize(before + after)));
      continue;
    }
    path.to(point + radius * leftOf(before));
    // Turning away from this side leaves a gap, which is round; towards it, the two sides lie over each
    // other.
    if (before.x * after.y - before.y * after.x > 0)
      path.arc(radius, point + radius * leftOf(after));
    else
      path.to(point), path.to(point + radius * leftOf(after));
  }
}

Way reversed(const Way& way) {
  Way back = way;
  std::reverse(back.points.begin(), back.points.end());
  std::reverse(back.radii.begin(), back.radii.end());
  const size_t count = back.points.size();
  for (size_t i = 0; i < back.directions.size(); ++i)
    back.directions[i] = glm::normalize(back.points[(i + 1) % count] - back.points[i]);
  return back;
}

std::string outlineOf(const Way& way) {
  Path path;
  const Way back = reversed(way);
  addSide(way, path);
  if (way.isClosed) {
    path.close();
    addSide(back, path);
  } else {
    // Round caps.
    path.arc(way.radii.back(), back.points.front() + back.radii.front() * leftOf(back.directions.front()));
    addSide(back, path);
    path.arc(way.radii.front(), way.points.front() + way.radii.front() * leftOf(way.directions.front()));
  }
  path.close();
  return path.text();
}

std::string centerlineOf(const Way& way) {
  Path path;
  for (const glm::vec2 point : way.points) path.to(point);
  if (way.isClosed) path.close();
  return path.text();
}

// Half of the width that the most of its length has.
float middleRadius(std::vector<float> radii) {
  std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(radii.size() / 2), radii.end());
  return radii[radii.size() / 2];
}

std::string elementOf(const Drawing::Stroke& stroke, const SvgOptions& options) {
  const Way way = wayOf(stroke);
  if (way.points.size() < 2) return "";
  const std::string color = colorOf(stroke.color);
  if (!options.centerlines && !stroke.isHidden)
    return "<path fill=\"" + color + "\" d=\"" + outlineOf(way) + "\"/>\n";
  const float width = 2 * middleRadius(way.radii);
  std::string element = "<path fill=\"none\" stroke=\"" + color + "\" stroke-width=\"" +
                        number(std::max(width, 0.1f)) +
                        "\" stroke-linecap=\"round\" stroke-linejoin=\"round\"";
  if (stroke.isHidden)
    element += " stroke-dasharray=\"" + number(2 * width) + " " + number(2.5 * width) + "\"";
  return element + " d=\"" + centerlineOf(way) + "\"/>\n";
}

Drawing beside(const Drawing& first, const Drawing& second, glm::uvec2 place) {
  Drawing both = first;
  both.width = std::max(first.width, place.x + second.width);
  both.height = std::max(first.height, place.y + second.height);
  both.leftOut += second.leftOut;
  for (Drawing::Stroke stroke : second.strokes) {
    for (Drawing::Point& point : stroke.points) point.x += float(place.x), point.y += float(place.y);
    both.strokes.push_back(std::move(stroke));
  }
  return both;
}

}  // namespace

std::string svgOf(const Drawing& drawing, const SvgOptions& options) {
  const std::string width = std::to_string(drawing.width), height = std::to_string(drawing.height);
  std::string svg =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" version=\"1.1\" width=\"" +
      width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height + "\">\n";
  // What is hidden lies below all that is seen.
  for (const bool isHidden : {true, false}) {
    if (isHidden && !options.hidden) continue;
    std::vector<std::string> layers;
    for (const Drawing::Stroke& stroke : drawing.strokes)
      if (stroke.isHidden == isHidden &&
          std::find(layers.begin(), layers.end(), stroke.layer) == layers.end())
        layers.push_back(stroke.layer);
    for (const std::string& layer : layers) {
      const std::string name = isHidden ? layer + "-hidden" : layer;
      svg += "<g id=\"" + name + "\" inkscape:groupmode=\"layer\" inkscape:label=\"" + name + "\">\n";
      for (const Drawing::Stroke& stroke : drawing.strokes)
        if (stroke.isHidden == isHidden && stroke.layer == layer) svg += elementOf(stroke, options);
      svg += "</g>\n";
    }
  }
  return svg + "</svg>\n";
}

Status writeSvg(const std::string& path, const Drawing& drawing, const SvgOptions& options) {
  return writeText(path, svgOf(drawing, options));
}

Drawing sideBySide(const Drawing& left, const Drawing& right) {
  return beside(left, right, {left.width, 0});
}

Drawing overUnder(const Drawing& left, const Drawing& right) {
  return beside(left, right, {0, left.height});
}

}  // namespace scumble
