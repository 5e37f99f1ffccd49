#include "outputs.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace scumble::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* kEyes[] = {"left", "right"};

// "dir/name.png" with "left" gives "dir/name.left.png".
std::string withPart(const std::string& path, const std::string& part, const std::string& extension) {
  fs::path p(path);
  return (p.parent_path() / (p.stem().string() + "." + part + extension)).string();
}

Image arrange(const std::vector<Image>& views, const std::string& layout) {
  if (views.size() < 2) return views[0];
  return layout == "over-under" ? overUnder(views[0], views[1]) : sideBySide(views[0], views[1]);
}

}  // namespace

Status checkWritable(const std::string& path, const std::vector<std::string>& inputs) {
  if (path.empty()) return Done{};
  const auto fail_ = [&](std::string problem, std::string advice) {
    return Error{ErrorKind::outputNotWritten, path, 0, "", std::move(problem), std::move(advice)};
  };
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return fail_("the folder does not exist", "make it first");
  if (access(folder.c_str(), W_OK) != 0)
    return fail_(std::string("the folder cannot be written: ") + std::strerror(errno), "choose another one");
  if (fs::is_directory(path, ignored)) return fail_("this is a folder", "give a file's name");
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
    return fail_("it is not an ordinary file", "give another name");
  for (const std::string& input : inputs)
    if (fs::equivalent(path, input, ignored)) return fail_("this is one of the inputs", "give another name");
  return Done{};
}

Result<OutputPlan> OutputPlan::make(const std::string& given, const std::string& sceneFile,
                                    const std::string& layout, bool hasFrames,
                                    const std::vector<std::string>& inputs) {
  OutputPlan plan;
  plan.layout = layout;
  plan.path = given.empty() ? fs::path(sceneFile).stem().string() + ".png" : given;
  plan.separateEyes = layout == "separate";
  const std::string extension = fs::path(plan.path).extension().string();
  plan.exr = extension == ".exr";
  if (!plan.exr && extension != ".png")
    return Error{ErrorKind::usage,
                 "",
                 0,
                 "",
                 "'" + plan.path + "' ends neither in .png nor in .exr",
                 "name the output like picture.png"};
  if (plan.isSequence() && !hasFrames)
    return Error{ErrorKind::usage,
                 "",
                 0,
                 "",
                 "'" + plan.path + "' names a sequence, but there is no range of frames",
                 "add --frames A..B, or name one picture"};
  if (const Status status = checkWritable(plan.path, inputs); !status) return status.error();
  return plan;
}

std::string OutputPlan::framePath(std::optional<int> number) const {
  const size_t first = path.find('#');
  if (!number || first == std::string::npos) return path;
  size_t last = first;
  while (last < path.size() && path[last] == '#') ++last;
  std::string digits = std::to_string(std::abs(*number));
  if (digits.size() < last - first) digits.insert(0, last - first - digits.size(), '0');
  return path.substr(0, first) + (*number < 0 ? "-" : "") + digits + path.substr(last);
}

bool OutputPlan::isThere(const std::string& target, size_t viewCount) const {
  std::error_code ignored;
  if (!separateEyes || viewCount < 2) return fs::exists(target, ignored);
  const std::string extension = fs::path(target).extension().string();
  return fs::exists(withPart(target, kEyes[0], extension), ignored) &&
         fs::exists(withPart(target, kEyes[1], extension), ignored);
}

Status OutputPlan::write(const Frame& frame, const std::string& target) const {
  const size_t viewCount = frame.layers[0].views.size();
  const size_t files = separateEyes ? viewCount : 1;
  for (size_t file = 0; file < files; ++file) {
    const std::string path_ = separateEyes && viewCount > 1
                                  ? withPart(target, kEyes[file], fs::path(target).extension().string())
                                  : target;
    // The picture of one layer as it stands in this file.
    const auto picture = [&](const Frame::Layer& layer) {
      if (layer.views.size() == 1) return layer.views[0];
      return separateEyes ? layer.views[file] : arrange(layer.views, layout);
    };
    if (!exr) {
      if (const Status status = writePng(path_, picture(frame.layers[0])); !status) return status.error();
      for (size_t i = 1; i < frame.layers.size(); ++i) {
        const Image image = picture(frame.layers[i]);
        const ImageLayer layer{"", "", &image};
        if (const Status status = writeExr(withPart(path_, frame.layers[i].name, ".exr"), {layer}); !status)
          return status.error();
      }
      continue;
    }
    // All layers of an EXR have one size; what has another goes into a file of its own. One EXR of two eyes
    // holds them as views (the standard's multiView), which is what compositors read; layouts are for players
    // of flat pictures.
    const bool asViews = viewCount > 1 && !separateEyes;
    std::vector<Image> images;
    std::vector<std::pair<std::string, std::string>> names;
    for (const Frame::Layer& layer : frame.layers) {
      const bool otherSize = layer.views.size() != viewCount ||
                             layer.views[0].width != frame.layers[0].views[0].width ||
                             layer.views[0].height != frame.layers[0].views[0].height;
      if (otherSize) {
        const ImageLayer alone{"", "", &layer.views[0]};
        if (const Status status = writeExr(withPart(path_, layer.name, ".exr"), {alone}); !status)
          return status.error();
        continue;
      }
      for (size_t view = 0; view < (asViews ? viewCount : 1); ++view) {
        images.push_back(asViews ? layer.views[view] : picture(layer));
        names.emplace_back(layer.name, asViews ? kEyes[view] : "");
      }
    }
    std::vector<ImageLayer> layers;
    for (size_t i = 0; i < images.size(); ++i)
      layers.push_back({names[i].first, names[i].second, &images[i]});
    if (const Status status = writeExr(path_, layers); !status) return status.error();
  }
  return Done{};
}

}  // namespace scumble::app
