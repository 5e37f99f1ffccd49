// From what was found in a picture to knobs. docs/study.md has the same as a table.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/srgb.h"
#include "scumble/study.h"

namespace scumble {

namespace {

// Colours, hues and numbers as looks have them.
std::string quoted(const glm::vec3& linear) {
  const SrgbEncoder& code = SrgbEncoder::instance();
  return fmt::format("\"#{:02X}{:02X}{:02X}\"", code(linear.r), code(linear.g), code(linear.b));
}

std::string numberText(double value) {
  std::string text = fmt::format("{:.3f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string percent(double share) {
  return fmt::format("{:.0f} %", 100 * share);
}

// The look's file, section by section.
class Writer {
 public:
  // Descriptions may have names of files in them, which need not be UTF-8.
  explicit Writer(const std::string& description)
      : text_("{\n  \"description\": " +
              nlohmann::json(description).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {}

  // Begins a section; `why` stands above it, as comments.
  Writer& section(const std::string& name, const std::vector<std::string>& why) {
    close();
    text_ += ",\n\n";
    for (const std::string& line : why) text_ += "  // " + line + "\n";
    text_ += "  \"" + name + "\": {";
    isOpen_ = true, isFirst_ = true;
    return *this;
  }
  Writer& set(const std::string& knob, const std::string& value) {
    text_ += (isFirst_ ? "\n    \"" : ",\n    \"") + knob + "\": " + value;
    isFirst_ = false;
    return *this;
  }
  Writer& set(const std::string& knob, double value) { return set(knob, numberText(value)); }
  std::string text() {
    close();
    return text_ + "\n}\n";
  }

 private:
  void close() {
    if (isOpen_) text_ += "\n  }";
    isOpen_ = false;
  }

  std::string text_;
  bool isOpen_ = false, isFirst_ = false;
};

// How far a family's hues pull others towards them: not at all where they are of all sorts, or hardly there.
double pull(const ColorFamily& family) {
  return family.agreement * family.agreement * std::min(1.0, family.chroma / 0.06);
}

std::string told(const char* name, const ColorFamily& family) {
  const std::string hue = family.agreement > 0 ? fmt::format(", hue {:.0f} degrees, agreement {}", family.hue,
                                                             numberText(family.agreement))
                                               : "";
  return fmt::format("{}: {} of the picture, lightness {}, chroma {}{}.", name, percent(family.share),
                     numberText(family.lightness), numberText(family.chroma), hue);
}

void writePalette(Writer& look, const PictureStudy& study) {
  const ColorFamily &light = study.light, &dark = study.dark;
  look.section("palette", {fmt::format("Values from {} to {}, OKLab lightness; they part at {}.",
                                       numberText(study.darkest), numberText(study.lightest),
                                       numberText(study.division)),
                           told("The light", light), told("The dark", dark)});
  look.set("darkest", std::min(study.darkest, study.lightest)).set("lightest", std::min(1.0, study.lightest));
  // Colours in shadow are this palette's too, whatever the scene has for them.
  look.set("ownShadow", "0");
  look.set("saturation", std::min(2.0, study.chroma / 0.04));
  if (light.share > 0 && dark.share > 0) {
    look.set("shadowValue", std::clamp(dark.lightness / light.lightness, 0.4, 0.9));
    if (light.chroma > 0.01) look.set("shadowSaturation", std::clamp(dark.chroma / light.chroma, 0.4, 1.6));
  }
  if (pull(light) > 0) look.set("litTint", quoted(light.color)).set("litTintAmount", 0.6 * pull(light));
  if (pull(dark) > 0) look.set("shadowTint", quoted(dark.color)).set("shadowTintAmount", pull(dark));
}

void writeLimit(Writer& look, const PictureStudy& study, double softness) {
  // Washes on paper keep their wandering hues, where they have any.
  const double amount =
      study.isOnPaper ? std::clamp(1.6 - 40 * study.chroma, 0.4, 1.0) : std::clamp(study.fewness, 0.5, 1.0);
  std::string shares;
  for (const PaletteColor& color : study.palette)
    shares += (shares.empty() ? "" : ", ") + fmt::format("{:.3g}", 100 * color.share);
  look.section("limit", {"Its colours; of what is even in the picture, in percent:", shares + ".",
                         percent(study.fewness) + " of that is one of them."});
  look.set("palette", "\"look\"").set("amount", amount).set("softness", softness);
  look.set("colors", double(study.palette.size()));
  for (size_t k = 0; k < study.palette.size(); ++k)
    look.set(fmt::format("color{}", k + 1), quoted(study.palette[k].color));
}

void writeMarks(Writer& look, const PictureStudy& study) {
  constexpr double kLeastContrast = 0.006;
  const StudiedMarks& marks = study.marks;
  const std::string told = fmt::format(
      "Grain of {} and strokes of {} in lightness, {} px wide, direction {}.", numberText(marks.grain),
      numberText(marks.contrast), numberText(marks.width), numberText(marks.direction));
  if (study.isOnPaper) {
    look.section("watercolor", {told, "Its lightest colour is in the corners: bare paper."})
        .set("shown", "true")
        .set("white", quoted(study.paper));
    return;
  }
  if (study.height < kLeastLinesForMarks) return;
  // Of a limited palette broken up in bands, strokes have no grain in them.
  if (marks.contrast < kLeastContrast || marks.grain < 0.2 * marks.contrast) return;
  const bool isStroked = marks.direction > 0.4;
  // What the built-in pictures give in full, and the size at which their strokes have a width.
  const double full = isStroked ? 0.14 : 0.1;
  const double size = std::clamp(256 * std::pow(marks.width / 7.1, 1.5), 64.0, 1024.0);
  look.section("texture", {told}).set("amount", std::min(0.7, 0.7 * marks.contrast / full));
  look.set("metatexture",
           fmt::format("{{ \"example\": \"{}\", \"size\": {}{} }}", isStroked ? "strokes" : "paper",
                       numberText(size), isStroked ? ", \"orient\": \"contour\"" : ""));
}

}  // namespace

std::string lookTextOf(const PictureStudy& study, const std::string& name) {
  Writer look("After " + name + ".");
  look.section("background", {"The picture's outer parts, at half its height and above."})
      .set("mode", "\"look\"")
      .set("horizon", quoted(study.horizon))
      .set("zenith", quoted(study.above));
  look.section("ground", {"And below."}).set("tint", quoted(study.below));
  writePalette(look, study);

  // Where nothing could be followed, edges are as the default look has them.
  double softness = 1;
  // A few pieces of a border are no edges of a picture; with few lines, the raster is all that they show.
  constexpr double kLeastPieces = 4;
  const bool isFine = study.height >= kLeastLinesForMarks;
  if (isFine && study.borders.counted >= kLeastPieces) {
    // What remains of an edge without raggedness is the raster's.
    constexpr double kSharp = 3.9, kStraight = 0.35;
    softness = std::clamp(1 + study.borders.width - kSharp, 1.0, 8.0);
    const double ragged = study.borders.raggedness;
    const double amount =
        std::min(6.0, 3.7 * std::sqrt(std::max(0.0, ragged * ragged - kStraight * kStraight)));
    const std::string told = fmt::format(
        "{:.0f} pieces of edges: one area turns into the other within {} px, {} px off a smooth curve.",
        study.borders.counted, numberText(study.borders.width), numberText(ragged));
    look.section("shadow", {told}).set("softness", softness);
    look.section("warp", {"The same raggedness, as tearing."}).set("amount", amount).set("inflation", amount);
  }
  writeLimit(look, study, softness);
  if (study.lines.isDrawn) {
    look.section("ink",
                 {fmt::format("{} of the borders have a line, and lines on none are {} as much as those.",
                              percent(study.lines.onBorders), percent(study.lines.offBorders))})
        .set("shown", "true")
        .set("line", "{ \"color\": " + quoted(study.lines.color) + " }");
    if (isFine) look.set("least", study.lines.thin).set("greatest", study.lines.thick);
  }
  writeMarks(look, study);
  return look.text();
}

}  // namespace scumble
