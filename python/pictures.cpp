// Pictures, drawings and films as files.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"
#include "scumble/drawing.h"
#include "scumble/film.h"
#include "scumble/image.h"

using namespace scumble;
using namespace pybind11::literals;

namespace scumble_python {
namespace {

// The letters after a name's last period, small; empty: none.
std::string endingOf(const std::string& path) {
  const size_t at = path.find_last_of("./");
  if (at == std::string::npos || path[at] == '/') return "";
  std::string ending = path.substr(at + 1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return ending;
}

py::array readAny(const Path& file, const std::string& view) {
  const std::string path = file.string();
  return toArray(
      valueOf(withoutGil([&] { return endingOf(path) == "exr" ? readExr(path, view) : readPicture(path); })));
}

void writeAny(const Path& file, const py::object& pixels, std::optional<int> quality) {
  const std::string path = file.string();
  const Image image = toImage(pixels, "the picture");
  const std::string ending = endingOf(path);
  if (quality && ending != "jpg" && ending != "jpeg" && ending != "webp")
    raise({ErrorKind::usage, path, 0, "", "such a file has no quality", "leave it out"});
  done(withoutGil([&]() -> Status {
    if (ending == "png") return writePng(path, image);
    if (ending == "jpg" || ending == "jpeg") return writeJpeg(path, image, quality.value_or(92));
    if (ending == "webp") return writeWebp(path, image, quality.value_or(90));
    if (ending == "exr") return writeExr(path, {{.view = "", .image = &image}});
    return Error{ErrorKind::usage,
                 path,
                 0,
                 "",
                 "what kind of picture that is to be is unknown",
                 "end the name in .png, .jpg, .webp or .exr"};
  }));
}

// Layers of (name, view, pixels, channels, whether it is a colour).
using Layer = std::tuple<std::string, std::string, py::array, std::vector<std::string>, bool>;

void writeLayers(const Path& path, const std::vector<Layer>& layers,
                 const std::map<std::string, std::vector<std::string>>& cryptomattes) {
  std::deque<Image> images;
  std::vector<ImageLayer> described;
  for (const auto& [name, view, pixels, channels, isColor] : layers) {
    const std::string what = name.empty() ? "the picture" : "the layer '" + name + "'";
    const bool isHalf = pixels.dtype().kind() == 'f' && pixels.itemsize() == 2;
    const auto floats = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(pixels);
    if (!floats || floats.ndim() != 3 || size_t(floats.shape(2)) != channels.size())
      raiseUsage(what + " is no picture of " + std::to_string(channels.size()) + " channels",
                 "give height by width by channels");
    if (pixels.dtype().kind() != 'f')
      raiseUsage(what + " holds " + std::string(py::str(pixels.dtype())),
                 "EXR files hold floats: ask for float32 or float16");
    images.push_back({uint32_t(floats.shape(1)), uint32_t(floats.shape(0)), channels,
                      std::vector<float>(floats.data(), floats.data() + floats.size()), isColor});
    described.push_back({name, view, &images.back(), isHalf});
  }
  ExrOptions options;
  for (const auto& [layer, objects] : cryptomattes) options.cryptomattes.push_back({layer, objects});
  done(withoutGil([&] { return writeExr(path.string(), described, options); }));
}

// A film that is being written. The library's writer learns the pictures' size from the first one.
class GrowingFilm {
 public:
  GrowingFilm(std::string path, double fps, std::optional<int> quality, FilmLayout layout,
              FilmProjection projection)
      : path_(std::move(path)) {
    const std::string ending = endingOf(path_);
    if (ending != "mp4" && ending != "webm" && ending != "gif")
      raise({ErrorKind::usage, path_, 0, "", "what kind of film that is to be is unknown",
             "end the name in .mp4, .webm or .gif"});
    options_ = {.format = ending == "mp4"    ? FilmFormat::mp4
                          : ending == "webm" ? FilmFormat::webm
                                             : FilmFormat::gif,
                .fps = fps,
                .quality = quality,
                .layout = layout,
                .projection = projection};
  }

  void add(const py::object& pixels) {
    const Image picture = toImage(pixels, "the picture");
    if (hasEnded_) raiseUsage("the film has ended", "make another one");
    done(withoutGil([&] { return added(picture); }));
  }

  void finish() {
    if (hasEnded_) return;
    hasEnded_ = true;
    if (!writer_) raise({ErrorKind::usage, path_, 0, "", "a film needs at least one picture", ""});
    done(withoutGil([&] {
      Status status = writer_->finish();
      writer_.reset();
      return status;
    }));
  }

  // Leaves nothing behind, but of a film that was finished.
  void abandon() {
    hasEnded_ = true;
    withoutGil([&] { writer_.reset(); });
  }

 private:
  Status added(const Image& picture) {
    if (!writer_) {
      options_.width = picture.width, options_.height = picture.height;
      Result<std::unique_ptr<FilmWriter>> writer = FilmWriter::create(path_, options_);
      if (!writer) return writer.error();
      writer_ = std::move(*writer);
    }
    return writer_->add(picture);
  }

  std::string path_;
  FilmOptions options_;
  std::unique_ptr<FilmWriter> writer_;
  bool hasEnded_ = false;
};

py::list strokesOf(const Drawing& drawing) {
  py::list strokes;
  for (const Drawing::Stroke& stroke : drawing.strokes) {
    static_assert(sizeof(Drawing::Point) == 3 * sizeof(float));
    const py::array_t<float> points({stroke.points.size(), size_t(3)},
                                    reinterpret_cast<const float*>(stroke.points.data()));
    py::dict one;
    one["layer"] = stroke.layer;
    one["color"] = py::make_tuple(stroke.color.r, stroke.color.g, stroke.color.b);
    one["hidden"] = stroke.isHidden, one["closed"] = stroke.isClosed, one["points"] = points;
    strokes.append(one);
  }
  return strokes;
}

}  // namespace

void addPictures(py::module_& module) {
  module.def("read_picture", &readAny, "path"_a, "view"_a = "",
             "Reads a PNG, JPEG, WebP or EXR as a float32 array, height by width by channels (RGB or RGBA), "
             "linear, with\n"
             "straight alpha. view: of an EXR with two eyes, 'left' or 'right'.");
  module.def(
      "write_picture", &writeAny, "path"_a, "pixels"_a, "quality"_a = py::none(),
      "Writes a .png, .jpg, .webp or .exr. pixels: height by width, or by width by 1 (grey), 3 (RGB) or 4 "
      "(RGBA,\n"
      "straight): uint8 is sRGB, floats are linear. quality: of .jpg 1 to 100 (92), of .webp 0 to 100 (90).");
  module.def("_write_exr", &writeLayers, "path"_a, "layers"_a, "cryptomattes"_a);

  using SingleFilm = Single<GrowingFilm>;
  py::class_<SingleFilm>(module, "_FilmWriter")
      .def(py::init([](const Path& path, double fps, std::optional<int> quality, const py::object& layout,
                       const py::object& projection) {
             const auto laid = FilmLayout(wordOf(layout, "layout", {"mono", "side-by-side", "over-under"}));
             const auto projected =
                 FilmProjection(wordOf(projection, "projection", {"flat", "sphere", "half-sphere"}));
             return std::make_unique<SingleFilm>(
                 std::make_unique<GrowingFilm>(path.string(), fps, quality, laid, projected));
           }),
           "path"_a, "fps"_a, "quality"_a, "layout"_a, "projection"_a)
      .def(
          "add", [](SingleFilm& film, const py::object& pixels) { film.turn()->add(pixels); }, "pixels"_a)
      .def("finish", [](SingleFilm& film) { film.turn()->finish(); })
      .def("abandon", [](SingleFilm& film) { film.turn()->abandon(); });

  using SingleReader = Single<FilmReader>;
  py::class_<SingleReader>(module, "FilmReader",
                           "The pictures of a film that ffmpeg reads, by time. Times that grow are fast.")
      .def(py::init([](const Path& path) {
             return std::make_unique<SingleReader>(valueOf(FilmReader::open(path.string())));
           }),
           "path"_a)
      .def(
          "at",
          [](SingleReader& single, double time) {
            if (std::isnan(time)) raiseUsage("the time is no number", "give seconds");
            const auto reader = single.turn();
            return toArray(Image(*valueOf(withoutGil([&] { return reader->at(time); }))));
          },
          "time"_a, "The picture that stands at a time in seconds: float32, height by width by RGB, linear.")
      .def_property_readonly(
          "last_time", [](SingleReader& reader) { return reader.turn()->lastTime(); },
          "Of the last picture, seconds.");

  py::class_<Drawing>(module, "Drawing", "The lines of a frame as strokes (render(..., drawing=True)).")
      .def_property_readonly(
          "size", [](const Drawing& drawing) { return py::make_tuple(drawing.width, drawing.height); },
          "Width and height, pixels.")
      .def_readonly("left_out", &Drawing::leftOut, "Lines that there was no room for.")
      .def_property_readonly("strokes", &strokesOf,
                             "Later ones lie above. Each is a dict: layer (its kind, as knobs call it), "
                             "color (linear), hidden,\n"
                             "closed, and points, n by 3, float32: x and y in pixels from the upper left "
                             "corner, and half the width.")
      .def(
          "svg",
          [](const Drawing& drawing, bool centerlines, bool hidden) {
            return svgOf(drawing, {centerlines, hidden});
          },
          "centerlines"_a = false, "hidden"_a = false,
          "An SVG document. centerlines: middle lines of one width, for plotters; hidden: those too, "
          "dashed.");
}

}  // namespace scumble_python
