#include "chart.h"

#include <cairo/cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "scumble/image.h"

namespace scumble::app {

namespace {

constexpr int kWidth = 1600, kHeight = 1050;
constexpr double kMargin = 48;

struct Color {
  double r, g, b;
};
constexpr Color hex(uint32_t rgb) {
  return {(rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0};
}
constexpr Color kPaper = hex(0xFBF9F5), kInk = hex(0x2B2B2B), kQuiet = hex(0x7A7670), kGrid = hex(0xE4DFD6),
                kBand = hex(0xDDE9EC);

struct ModeStyle {
  const char *mode, *name;
  Color color;
};
constexpr ModeStyle kStyles[] = {{"metatexture", "MetaTexture", hex(0x1D6478)},
                                 {"object", "ordinary mapping", hex(0xD0974A)},
                                 {"screen", "screen space (shower door)", hex(0xB4605A)},
                                 {"fractal", "summed octaves", hex(0x8E9B6B)}};
const ModeStyle& styleOf(const std::string& mode) {
  for (const ModeStyle& style : kStyles)
    if (mode == style.mode) return style;
  return kStyles[0];
}

enum class Align { left, center, right };

class Canvas {
 public:
  Canvas()
      : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, kWidth, kHeight)),
        cairo_(cairo_create(surface_)) {
    setColor(kPaper);
    cairo_paint(cairo_);
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  }
  ~Canvas() {
    cairo_destroy(cairo_);
    cairo_surface_destroy(surface_);
  }
  Canvas(const Canvas&) = delete;

  void text(double x, double y, const std::string& what, double size, Color color, Align align = Align::left,
            bool bold = false) {
    cairo_select_font_face(cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo_, size);
    const double width = textWidth(what);
    setColor(color);
    cairo_move_to(cairo_, x - (align == Align::right ? width : align == Align::center ? width / 2 : 0), y);
    cairo_show_text(cairo_, what.c_str());
  }
  // In the font of the last text.
  double textWidth(const std::string& what) {
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_, what.c_str(), &extents);
    return extents.x_advance;
  }
  void uprightText(double x, double y, const std::string& what, double size, Color color) {
    cairo_save(cairo_);
    cairo_translate(cairo_, x, y);
    cairo_rotate(cairo_, -std::acos(0.0));
    text(0, 0, what, size, color, Align::center);
    cairo_restore(cairo_);
  }
  void rectangle(double x, double y, double width, double height, Color color) {
    setColor(color);
    cairo_rectangle(cairo_, x, y, width, height);
    cairo_fill(cairo_);
  }
  void line(const std::vector<std::pair<double, double>>& points, double width, Color color,
            bool dashed = false) {
    const double dash[] = {7, 5};
    cairo_set_dash(cairo_, dash, dashed ? 2 : 0, 0);
    cairo_set_line_width(cairo_, width);
    setColor(color);
    for (size_t i = 0; i < points.size(); ++i)
      (i == 0 ? cairo_move_to : cairo_line_to)(cairo_, points[i].first, points[i].second);
    cairo_stroke(cairo_);
    cairo_set_dash(cairo_, nullptr, 0, 0);
  }
  void dot(double x, double y, double radius, Color color) {
    setColor(color);
    cairo_arc(cairo_, x, y, radius, 0, 4 * std::acos(0.0));
    cairo_fill(cairo_);
  }

  // What was drawn, linear.
  Image image() {
    cairo_surface_flush(surface_);
    Image picture{kWidth, kHeight, {"R", "G", "B"}, {}};
    const auto linear = [](uint32_t byte) {
      const float v = float(byte) / 255;
      return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
    };
    const unsigned char* bytes = cairo_image_surface_get_data(surface_);
    const size_t stride = size_t(cairo_image_surface_get_stride(surface_));
    for (size_t y = 0; y < kHeight; ++y) {
      const uint32_t* row = reinterpret_cast<const uint32_t*>(bytes + y * stride);
      for (size_t x = 0; x < kWidth; ++x)
        for (const int shift : {16, 8, 0}) picture.pixels.push_back(linear(row[x] >> shift & 255));
    }
    return picture;
  }

 private:
  void setColor(Color color) { cairo_set_source_rgb(cairo_, color.r, color.g, color.b); }
  cairo_surface_t* surface_;
  cairo_t* cairo_;
};

struct Box {
  double x, y, width, height;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

// Its title and what one looks for in it; returns the box of the plot itself.
Box panel(Canvas& canvas, const Box& box, const std::string& title, const std::string& note) {
  canvas.text(box.x, box.y + 16, title, 17, kInk, Align::left, true);
  canvas.text(box.x, box.y + 37, note, 13, kQuiet);
  return {box.x + 62, box.y + 54, box.width - 66, box.height - 54 - 46};
}

struct Axis {
  double low, high;
  bool logarithmic = false;
  // From 0 to 1 along the axis.
  double at(double value) const {
    return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  }
};

void verticalAxis(Canvas& canvas, const Box& plot, const Axis& axis,
                  const std::vector<std::pair<double, std::string>>& ticks, const std::string& unit) {
  for (const auto& [value, label] : ticks) {
    const double y = plot.bottom() - plot.height * axis.at(value);
    canvas.line({{plot.x, y}, {plot.right(), y}}, 1, kGrid);
    canvas.text(plot.x - 9, y + 4.5, label, 12.5, kQuiet, Align::right);
  }
  canvas.uprightText(plot.x - 49, plot.y + plot.height / 2, unit, 13, kInk);
}

// "1/8", "1", "8".
std::string fractionText(double value) {
  return value < 1 ? fmt::format("1/{:.0f}", 1 / value) : fmt::format("{:.0f}", value);
}

using NumberOf = std::function<double(const ZoomPoint&)>;

void zoomCurves(Canvas& canvas, const Box& plot, const Axis& vertical, const Measurements& measured,
                const NumberOf& numberOf) {
  const Axis zoom{1.0 / 8, 8, true};
  for (double tick = 1.0 / 8; tick <= 8; tick *= 2) {
    const double x = plot.x + plot.width * zoom.at(tick);
    canvas.line({{x, plot.bottom()}, {x, plot.bottom() + 5}}, 1, kQuiet);
    canvas.text(x, plot.bottom() + 21, fractionText(tick), 12.5, kQuiet, Align::center);
  }
  canvas.line({{plot.x, plot.bottom()}, {plot.right(), plot.bottom()}}, 1, kQuiet);
  canvas.text(plot.x + plot.width / 2, plot.bottom() + 41, "zoom (1: the framing)", 13, kInk, Align::center);
  // MetaTexture last, on top.
  for (size_t m = measured.modes.size(); m-- > 0;) {
    const ModeMeasurements& mode = measured.modes[m];
    const Color color = styleOf(mode.mode).color;
    std::vector<std::pair<double, double>> points;
    for (const ZoomPoint& point : mode.zoom) {
      const double value = std::clamp(numberOf(point), vertical.low, vertical.high);
      if (numberOf(point) > 0)
        points.emplace_back(plot.x + plot.width * zoom.at(point.zoom),
                            plot.bottom() - plot.height * vertical.at(value));
    }
    canvas.line(points, m == 0 ? 3.5 : 2.2, color);
    for (const auto& [x, y] : points) canvas.dot(x, y, m == 0 ? 4.5 : 3.2, color);
  }
}

void frequencyPanel(Canvas& canvas, const Box& box, const Measurements& measured) {
  const Box plot =
      panel(canvas, box, "Screen frequency over a 64x zoom",
            "level is good; the band is one octave around MetaTexture, dashed is the flat example");
  double low = 1.0 / 8, lowest = 1, highest = 0;
  if (measured.exampleFrequency.vectors > 0) low = std::min(low, measured.exampleFrequency.vectors);
  for (const ModeMeasurements& mode : measured.modes)
    for (const ZoomPoint& point : mode.zoom)
      if (point.frequency.vectors > 0) low = std::min(low, point.frequency.vectors);
  for (const ZoomPoint& point : measured.modes[0].zoom)
    if (point.frequency.vectors > 0) {
      lowest = std::min(lowest, point.frequency.vectors);
      highest = std::max(highest, point.frequency.vectors);
    }
  const Axis axis{std::exp2(std::floor(std::log2(std::max(low, 1.0 / 1024)))), 0.5, true};
  if (highest > 0) {
    const double middle = std::sqrt(lowest * highest), bottom = std::max(middle / std::sqrt(2.0), axis.low),
                 top = std::min(middle * std::sqrt(2.0), axis.high);
    canvas.rectangle(plot.x, plot.bottom() - plot.height * axis.at(top), plot.width,
                     plot.height * (axis.at(top) - axis.at(bottom)), kBand);
  }
  std::vector<std::pair<double, std::string>> ticks;
  for (double tick = axis.low; tick <= axis.high * 1.001; tick *= 2)
    ticks.emplace_back(tick, fractionText(tick));
  verticalAxis(canvas, plot, axis, ticks, "cycles a pixel");
  if (const double example = measured.exampleFrequency.vectors; example > axis.low && example < axis.high) {
    const double y = plot.bottom() - plot.height * axis.at(example);
    canvas.line({{plot.x, y}, {plot.right(), y}}, 1.4, kQuiet, true);
  }
  zoomCurves(canvas, plot, axis, measured, [](const ZoomPoint& point) { return point.frequency.vectors; });
}

void contrastPanel(Canvas& canvas, const Box& box, const Measurements& measured) {
  const Box plot = panel(canvas, box, "Contrast over a 64x zoom",
                         "level and at 1 is good; the band is 5 percent around the flat example");
  double highest = 1.2;
  for (const ModeMeasurements& mode : measured.modes)
    for (const ZoomPoint& point : mode.zoom) highest = std::max(highest, point.contrast.vectors);
  const Axis axis{0, std::ceil(highest * 5) / 5};
  canvas.rectangle(plot.x, plot.bottom() - plot.height * axis.at(1.05), plot.width,
                   plot.height * (axis.at(1.05) - axis.at(0.95)), kBand);
  std::vector<std::pair<double, std::string>> ticks;
  for (double tick = 0; tick <= axis.high + 1e-9; tick += 0.2)
    ticks.emplace_back(tick, fmt::format("{:.1f}", tick));
  verticalAxis(canvas, plot, axis, ticks, "standard deviation / example's");
  zoomCurves(canvas, plot, axis, measured, [](const ZoomPoint& point) { return point.contrast.vectors; });
}

struct BarGroup {
  std::string name;
  std::function<double(const ModeMeasurements&)> valueOf;
};

void barPanel(Canvas& canvas, const Box& box, const std::string& title, const std::string& note,
              const std::string& unit, const Measurements& measured, const std::vector<BarGroup>& groups) {
  const Box plot = panel(canvas, box, title, note);
  double highest = 0.2;
  for (const ModeMeasurements& mode : measured.modes)
    for (const BarGroup& group : groups) highest = std::max(highest, group.valueOf(mode));
  const Axis axis{0, std::ceil(highest * 1.08 * 5) / 5};
  const double step = axis.high > 0.61 ? 0.2 : 0.1;
  std::vector<std::pair<double, std::string>> ticks;
  for (double tick = 0; tick <= axis.high + 1e-9; tick += step)
    ticks.emplace_back(tick, fmt::format("{:.1f}", tick));
  verticalAxis(canvas, plot, axis, ticks, unit);
  const double groupWidth = plot.width / double(groups.size());
  const double barWidth = std::min(0.19 * groupWidth, 34.0), gap = 0.1 * barWidth;
  for (size_t g = 0; g < groups.size(); ++g) {
    const double middle = plot.x + (double(g) + 0.5) * groupWidth;
    const double whole = double(measured.modes.size()) * (barWidth + gap) - gap;
    for (size_t m = 0; m < measured.modes.size(); ++m) {
      const double value = groups[g].valueOf(measured.modes[m]), height = plot.height * axis.at(value);
      const double x = middle - whole / 2 + double(m) * (barWidth + gap);
      canvas.rectangle(x, plot.bottom() - height, barWidth, height, styleOf(measured.modes[m].mode).color);
      std::string label = fmt::format("{:.2f}", value);
      if (label[0] == '0') label.erase(0, 1);
      canvas.text(x + barWidth / 2, plot.bottom() - height - 5, label, 10.5, kQuiet, Align::center);
    }
    canvas.text(middle, plot.bottom() + 21, groups[g].name, 13, kInk, Align::center);
  }
  canvas.line({{plot.x, plot.bottom()}, {plot.right(), plot.bottom()}}, 1, kQuiet);
}

}  // namespace

Status writeChart(const std::string& path, const Measurements& measured, const std::string& title,
                  const std::string& subtitle) {
  Canvas canvas;
  canvas.text(kMargin, 56, title, 26, kInk, Align::left, true);
  canvas.text(kMargin, 84, subtitle, 14, kQuiet);
  double x = kMargin;
  for (const ModeMeasurements& mode : measured.modes) {
    const ModeStyle& style = styleOf(mode.mode);
    canvas.rectangle(x, 105, 16, 16, style.color);
    canvas.text(x + 24, 118.5, style.name, 15, kInk);
    x += 24 + canvas.textWidth(style.name) + 36;
  }

  constexpr double kGap = 44, kTop = 156, kRow = 400, kHalf = (kWidth - 2 * kMargin - kGap) / 2;
  frequencyPanel(canvas, {kMargin, kTop, kHalf, kRow}, measured);
  contrastPanel(canvas, {kMargin + kHalf + kGap, kTop, kHalf, kRow}, measured);

  constexpr double kSecond = kTop + kRow + 36, kThird = 362, kNarrow = (kHalf - kGap) / 2 + 30;
  constexpr double kWide = kWidth - 2 * kMargin - 2 * (kNarrow + kGap);
  barPanel(canvas, {kMargin, kSecond, kWide, kThird}, "Warp error from frame to frame",
           "low is good: 0 sticks to the surface, 1 is unrelated to it", "warp vectors", measured,
           {{"dolly", [](const ModeMeasurements& m) { return m.temporal.dolly.vectors; }},
            {"orbit", [](const ModeMeasurements& m) { return m.temporal.orbit.vectors; }},
            {"roll", [](const ModeMeasurements& m) { return m.temporal.roll.vectors; }},
            {"moving object", [](const ModeMeasurements& m) { return m.temporal.object.vectors; }}});
  barPanel(canvas, {kMargin + kWide + kGap, kSecond, kNarrow, kThird}, "Left eye against right",
           "low is good: 0 lies on the surface", "difference", measured,
           {{"warp vectors", [](const ModeMeasurements& m) { return m.stereo.warp.vectors; }},
            {"breakup marks", [](const ModeMeasurements& m) { return m.stereo.warp.marks; }}});
  barPanel(canvas, {kMargin + kWide + kNarrow + 2 * kGap, kSecond, kNarrow, kThird}, "Flatness",
           "low is good: 0 looks like the flat example", "co-occurrence error", measured,
           {{"warp vectors", [](const ModeMeasurements& m) { return m.flatness.vectors; }},
            {"breakup marks", [](const ModeMeasurements& m) { return m.flatness.marks; }}});

  double footer = kMargin;
  for (const MeasureTarget& target : measured.targets) {
    const std::string text =
        fmt::format("{} {:.2f} (at most {:.2f})", target.name, target.value, target.limit);
    canvas.dot(footer + 6, kHeight - 41, 6,
               target.isKept() ? styleOf("metatexture").color : styleOf("screen").color);
    canvas.text(footer + 20, kHeight - 36, text, 13.5, kInk);
    footer += 20 + canvas.textWidth(text);
    const std::string verdict = target.isKept() ? " kept" : " missed";
    canvas.text(footer, kHeight - 36, verdict, 13.5, kInk, Align::left, true);
    footer += canvas.textWidth(verdict) + 34;
  }
  return writePng(path, canvas.image());
}

}  // namespace scumble::app
