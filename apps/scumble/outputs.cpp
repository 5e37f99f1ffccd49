#include "outputs.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "options.h"
#include "report.h"

namespace scumble::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* kCryptomatte = "cryptomatte";  // the AOV

// "dir/name.png" with "left" gives "dir/name.left.png".
std::string withPart(const std::string& path, const std::string& part, const std::string& extension) {
  fs::path p(path);
  return (p.parent_path() / (p.stem().string() + "." + part + extension)).string();
}

// Whether a file is what writeSvg() writes of this size, to its end.
bool isWholeSvg(const std::string& path, uint32_t width, uint32_t height) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string size =
      "width=\"" + std::to_string(width) + "\" height=\"" + std::to_string(height) + "\"";
  return text.find(size) != std::string::npos && text.ends_with("</svg>\n");
}

}  // namespace

Result<OutputPlan> OutputPlan::make(const std::string& given, const std::string& sceneFile,
                                    const StereoLayout* layout, bool hasFrames,
                                    const RenderOptions& options) {
  OutputPlan plan;
  plan.layout = layout;
  plan.path = given.empty() ? fs::path(sceneFile).stem().string() + ".png" : given;
  plan.width = options.width, plan.height = options.height;
  plan.aovs = options.aovs;
  const Result<const OutputFormat*> format = formatOf(plan.path);
  if (!format) return format.error();
  plan.format = *format;
  if (plan.isSequence() && plan.kind() == OutputKind::film)
    return usage("'" + plan.path + "' names a sequence of films", "name one film, or name.####.png");
  if (plan.kind() == OutputKind::film && !options.aovs.empty())
    return usage("a film holds the picture only", "write AOVs to name.####.exr");
  if (layout && layout->isInTurns && plan.kind() != OutputKind::film && !plan.isSequence())
    return usage("two eyes take turns in a film, and '" + plan.path + "' is none", "name it like boat.gif");
  if (layout && !layout->arrangeDrawing && !layout->isSeparate && plan.kind() == OutputKind::drawing)
    return usage(std::string("a drawing cannot be ") + layout->name, "use side-by-side, or write a picture");
  if (plan.isSequence() && !hasFrames)
    return usage("'" + plan.path + "' names a sequence, but there is no range of frames",
                 "add --frames A..B, or name one picture");
  return plan;
}

std::pair<size_t, size_t> numberIn(const std::string& path) {
  const size_t name = path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1;
  const size_t first = std::min(path.find('#', name), path.size());
  return {first, std::min(path.find_first_not_of('#', first), path.size())};
}

bool isNumbered(const std::string& path) {
  return numberIn(path).first < path.size();
}

std::string numbered(const std::string& path, int number) {
  const auto [first, last] = numberIn(path);
  if (first == last) return path;
  std::string digits = std::to_string(std::abs(number));
  if (digits.size() < last - first) digits.insert(0, last - first - digits.size(), '0');
  return path.substr(0, first) + (number < 0 ? "-" : "") + digits + path.substr(last);
}

std::string OutputPlan::framePath(std::optional<int> number) const {
  return number ? numbered(path, *number) : path;
}

std::string rangesOf(const std::vector<int>& numbers) {
  std::string text;
  for (size_t first = 0, next = 0; first < numbers.size(); first = next) {
    for (next = first + 1; next < numbers.size() && numbers[next] == numbers[next - 1] + 1;) ++next;
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[first]);
    if (next - first > 1) text += ".." + std::to_string(numbers[next - 1]);
  }
  return text;
}

bool OutputPlan::isFileOfItsOwn(const std::string& aov) const {
  return kind() != OutputKind::exr || Renderer::hasSizeOfItsOwn(aov);
}

Status OutputPlan::writeLayers(const Frame& frame, const std::string& path_,
                               const std::vector<ImageLayer>& layers) const {
  ExrOptions options = exr;
  // Compositors know objects by their names.
  if (std::any_of(layers.begin(), layers.end(),
                  [](const ImageLayer& layer) { return layer.name == kCryptomatte; }))
    options.cryptomattes = {{kCryptomatte, frame.objects}};
  return writeExr(path_, layers, options);
}

std::vector<std::string> OutputPlan::picturePaths(const std::string& framePath_) const {
  if (!asFiles()) return {framePath_};
  const std::string extension = fs::path(framePath_).extension().string();
  return {withPart(framePath_, kEyes[0], extension), withPart(framePath_, kEyes[1], extension)};
}

std::vector<std::string> OutputPlan::files(const std::string& framePath_) const {
  std::vector<std::string> files = picturePaths(framePath_);
  const size_t pictures = files.size();
  for (size_t i = 0; i < pictures; ++i)
    for (const std::string& aov : aovs)
      if (isFileOfItsOwn(aov)) files.push_back(withPart(files[i], aov, ".exr"));
  return files;
}

bool OutputPlan::isThere(const std::string& framePath_) const {
  const bool isTogether = layout && kind() != OutputKind::exr;
  const uint32_t across = isTogether ? layout->across : 1, down = isTogether ? layout->down : 1;
  const std::vector<std::string> all = files(framePath_), pictures = picturePaths(framePath_);
  const auto isWhole = [&](const std::string& file) {
    return kind() == OutputKind::drawing ? isWholeSvg(file, width * across, height * down)
                                         : isWholePicture(file, width * across, height * down);
  };
  return std::all_of(pictures.begin(), pictures.end(), isWhole) &&
         std::all_of(all.begin() + std::ptrdiff_t(pictures.size()), all.end(),
                     [](const std::string& file) { return isWholePicture(file); });
}

Status OutputPlan::write(const Frame& frame, const std::string& framePath_, int number) const {
  const std::vector<std::string> paths = picturePaths(framePath_);
  for (size_t file = 0; file < paths.size(); ++file) {
    const Part part = partOf(frame, file, number);
    if (const Status status = kind() == OutputKind::picture   ? writePicture(part, paths[file])
                              : kind() == OutputKind::drawing ? writeDrawing(part, paths[file])
                                                              : writeLayeredExr(frame, file, paths[file]);
        !status)
      return status.error();
  }
  return Done{};
}

OutputPlan::Part OutputPlan::partOf(const Frame& frame, size_t file, int number) const {
  if (!layout) return {frame, 0};
  if (layout->isSeparate) return {frame, file};
  return {frame, layout->isInTurns ? std::optional(eyeInTurn(number, fps)) : std::nullopt};
}

const Image& OutputPlan::imageOf(const Frame::Layer& layer, const Part& part, Image& made) const {
  // Some, like the shadow map, are the same for both.
  if (part.view || layer.views.size() < 2) return layer.views[layer.views.size() < 2 ? 0 : *part.view];
  const bool isPicture = &layer == &part.frame.layers[0];
  return made = (isPicture ? layout->arrange : layout->arrangeFacts)(layer.views[0], layer.views[1]);
}

Status OutputPlan::writeAovsBeside(const Part& part, const std::string& path_) const {
  Image made;
  for (size_t i = 1; i < part.frame.layers.size(); ++i) {
    const std::string& name = part.frame.layers[i].name;
    const ImageLayer layer{name == kCryptomatte ? name : "", "", &imageOf(part.frame.layers[i], part, made),
                           isHalf(name)};
    if (const Status status = writeLayers(part.frame, withPart(path_, name, ".exr"), {layer}); !status)
      return status.error();
  }
  return Done{};
}

Status OutputPlan::writePicture(const Part& part, const std::string& path_) const {
  if (const Status status = writeAovsBeside(part, path_); !status) return status.error();
  Image made;
  return format->write(path_, imageOf(part.frame.layers[0], part, made), quality);
}

Status OutputPlan::writeDrawing(const Part& part, const std::string& path_) const {
  if (const Status status = writeAovsBeside(part, path_); !status) return status.error();
  const std::vector<Drawing>& views = part.frame.drawings;
  if (part.view) return writeSvg(path_, views[*part.view], svg);
  return writeSvg(path_, layout->arrangeDrawing(views[0], views[1]), svg);
}

Status OutputPlan::writeLayeredExr(const Frame& frame, size_t file, const std::string& path_) const {
  // All layers of an EXR have one size; what has another goes into a file of its own. One EXR of two eyes
  // holds them as views (the standard's multiView), which is what compositors read; layouts are for players
  // of flat pictures.
  std::vector<ImageLayer> layers;
  for (const Frame::Layer& layer : frame.layers) {
    if (isFileOfItsOwn(layer.name)) {
      const ImageLayer alone{"", "", &layer.views[0], isHalf(layer.name)};
      if (const Status status = writeLayers(frame, withPart(path_, layer.name, ".exr"), {alone}); !status)
        return status.error();
    } else if (asFiles() || !layout) {
      layers.push_back({layer.name, "", &layer.views[layout ? file : 0], isHalf(layer.name)});
    } else {
      for (size_t view = 0; view < viewCount(); ++view)
        layers.push_back({layer.name, kEyes[view], &layer.views[view], isHalf(layer.name)});
    }
  }
  return writeLayers(frame, path_, layers);
}

Result<FilmOutput> FilmOutput::create(const OutputPlan& plan, bool resume, size_t asked) {
  FilmOptions options;
  options.width = plan.width, options.height = plan.height;
  options.fps = plan.fps;
  options.quality = plan.quality;
  options.format = plan.format->film;
  options.projection = plan.projection;
  FilmOutput output;
  output.plan_ = plan;
  if (plan.layout) {
    options.width *= plan.layout->across, options.height *= plan.layout->down;
    options.layout = plan.layout->film;
  }
  for (const std::string& path : plan.picturePaths(plan.path)) {
    Result<std::unique_ptr<FilmWriter>> film =
        resume ? FilmWriter::resume(path, options) : FilmWriter::create(path, options);
    if (!film) return film.error();
    const size_t frames = (*film)->frames();
    if (frames > asked)
      return Error{ErrorKind::usage,
                   path,
                   0,
                   "",
                   "this film cannot be resumed: it has " + std::to_string(frames) + " frames, and " +
                       std::to_string(asked) + " are asked for",
                   "give the --frames that it was made with, or another name, or delete it"};
    output.frames_ = output.films_.empty() ? frames : std::min(output.frames_, frames);
    output.films_.push_back(std::move(film).value());
  }
  return output;
}

Status FilmOutput::add(const Frame& frame, int number) {
  Image made;
  for (size_t i = 0; i < films_.size(); ++i) {
    if (films_[i]->frames() > frames_) continue;
    if (const Status status =
            films_[i]->add(plan_.imageOf(frame.layers[0], plan_.partOf(frame, i, number), made));
        !status)
      return status.error();
  }
  ++frames_;
  return Done{};
}

Status FilmOutput::finish() {
  for (const auto& film : films_)
    if (const Status status = film->finish(); !status) return status.error();
  return Done{};
}

}  // namespace scumble::app
