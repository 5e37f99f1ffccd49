// EXR files: one part, channels of all layers side by side, because that is what the widest range of programs
// reads.
//
// Views follow OpenEXR's page "Storing Multi-View Images in OpenEXR Files" for single-part files. The first
// name in the multiView attribute is the default view, and its channels go without a view's name only where
// the name has no other period: `R`, but `final-shadow.left.R`. A bare `final-shadow.R` would belong to no
// view, and that is how layers made once for both eyes are written. A file with one view of several says
// which by `multiView` and `view`, and its channels keep their plain names.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiView.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "base/whole_file.h"
#include "film/checks.h"
#include "film/cryptomatte.h"
#include "scumble/image.h"

namespace scumble {
namespace {

constexpr float kLargestHalf = 65504;

class StreamToWholeFile : public Imf::OStream {
 public:
  StreamToWholeFile(WholeFile* file, const char* name) : OStream(name), file_(file) {}
  void write(const char bytes[], int size) override {
    file_->write(bytes, size_t(size));
    // Stops the encoder; the reason is kept in the file.
    if (!file_->ok()) throw std::runtime_error("cannot be written");
  }
  uint64_t tellp() override { return file_->position(); }
  void seekp(uint64_t position) override { file_->seek(position); }

 private:
  WholeFile* file_;
};

// The views in the order of their appearance, but `left` first where it is among them.
Imf::StringVector viewsOf(const std::vector<ImageLayer>& layers) {
  Imf::StringVector views;
  for (const ImageLayer& layer : layers)
    if (!layer.view.empty() && std::find(views.begin(), views.end(), layer.view) == views.end())
      views.push_back(layer.view);
  const auto left = std::find(views.begin(), views.end(), "left");
  if (left != views.end()) std::rotate(views.begin(), left, left + 1);
  return views;
}

std::string channelName(const ImageLayer& layer, const std::string& channel, const Imf::StringVector& views) {
  std::string name = layer.name.empty() ? channel : layer.name + "." + channel;
  if (layer.view.empty() || views.size() < 2) return name;
  const auto view = std::find(views.begin(), views.end(), layer.view);
  return Imf::insertViewName(name, views, int(view - views.begin()));
}

const Cryptomatte* cryptomatteOf(const ImageLayer& layer, const ExrOptions& options) {
  for (const Cryptomatte& cryptomatte : options.cryptomattes)
    if (cryptomatte.layer == layer.name) return &cryptomatte;
  return nullptr;
}

std::string problemWith(const std::vector<ImageLayer>& layers, const ExrOptions& options) {
  if (layers.empty()) return "there is no layer to write";
  for (const ImageLayer& layer : layers) {
    if (!layer.image) return "the layer '" + layer.name + "' has no picture";
    if (std::string problem = film::problemWith(*layer.image); !problem.empty()) return problem;
    if (layer.image->format != PixelFormat::float32) return "the layer '" + layer.name + "' is not of floats";
    if (layer.image->width != layers[0].image->width || layer.image->height != layers[0].image->height)
      return "the layer '" + layer.name + "' differs in size from the first one";
    if (layer.view.find_first_of(". ") != std::string::npos)
      return "the view '" + layer.view + "' has a period or a space in its name";
    for (const std::string& channel : layer.image->channels)
      if (channel.empty()) return "a channel of the layer '" + layer.name + "' has no name";
    if (const Cryptomatte* cryptomatte = cryptomatteOf(layer, options)) {
      const std::string problem = film::problemWithCryptomatte(*layer.image, cryptomatte->objects);
      if (!problem.empty()) return "the layer '" + layer.name + "' is no Cryptomatte: " + problem;
    }
  }
  for (const Cryptomatte& cryptomatte : options.cryptomattes) {
    if (cryptomatte.layer.empty()) return "a Cryptomatte has no name";
    if (std::none_of(layers.begin(), layers.end(),
                     [&](const ImageLayer& layer) { return layer.name == cryptomatte.layer; }))
      return "there is no layer '" + cryptomatte.layer + "' for the Cryptomatte of that name";
  }
  return "";
}

Error misfit(const std::string& path, const std::string& problem) {
  Error error;
  error.kind = ErrorKind::usage;
  error.file = path;
  error.problem = problem;
  return error;
}

// OpenEXR compresses with a pool of threads shared by the whole process. It is started only where nobody,
// such as a host application, has done so.
void startThreads() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (Imf::globalThreadCount() == 0) Imf::setGlobalThreadCount(int(std::thread::hardware_concurrency()));
  });
}

// Finite values beyond what half can hold become the largest one that it can: an infinity would spread over
// everything that is filtered with it.
std::vector<half> halves(const std::vector<float>& values) {
  std::vector<half> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(), [](float value) {
    return half(std::isfinite(value) ? std::clamp(value, -kLargestHalf, kLargestHalf) : value);
  });
  return result;
}

bool isStraight(const Image& image) {
  return image.isColor && image.channels.size() == 4;
}
Image premultiplied(Image image) {
  for (size_t i = 0; i < image.pixels.size(); i += 4)
    for (size_t c = 0; c < 3; ++c) image.pixels[i + c] *= image.pixels[i + 3];
  return image;
}

// What goes into the file: its channels, and the pixels that are not in the caller's pictures.
struct Content {
  Imf::FrameBuffer frame;
  std::deque<Image> made;  // a deque, as the frame buffer points into what is there
  std::deque<std::vector<half>> madeHalf;
};

Status addLayer(const std::string& path, const ImageLayer& layer, const Imf::StringVector& views,
                Imf::Header& header, Content& content) {
  if (isStraight(*layer.image)) content.made.push_back(premultiplied(*layer.image));
  const Image& image = isStraight(*layer.image) ? content.made.back() : *layer.image;
  const size_t channels = image.channels.size();
  // OpenEXR reads through this pointer only; its type is shared with reading.
  char* base = reinterpret_cast<char*>(const_cast<float*>(image.pixels.data()));
  if (layer.half) {
    content.madeHalf.push_back(halves(image.pixels));
    base = reinterpret_cast<char*>(content.madeHalf.back().data());
  }
  const Imf::PixelType type = layer.half ? Imf::HALF : Imf::FLOAT;
  const size_t size = layer.half ? sizeof(half) : sizeof(float);
  for (size_t c = 0; c < channels; ++c) {
    const std::string name = channelName(layer, image.channels[c], views);
    if (header.channels().findChannel(name)) return misfit(path, "the channel '" + name + "' is there twice");
    header.channels().insert(name, Imf::Channel(type));
    content.frame.insert(name,
                         Imf::Slice(type, base + c * size, channels * size, channels * size * image.width));
  }
  return Done{};
}

Status writeExrThrowing(const std::string& path, const std::vector<ImageLayer>& layers,
                        const ExrOptions& options, WholeFile& file) {
  const int width = int(layers[0].image->width), height = int(layers[0].image->height);
  Imf::Header header(width, height);
  header.compression() =
      options.compression == ExrCompression::piz ? Imf::PIZ_COMPRESSION : Imf::ZIP_COMPRESSION;
  const Imf::StringVector views = viewsOf(layers);
  if (!views.empty()) Imf::addMultiView(header, views);
  if (views.size() == 1) header.setView(views[0]);
  for (const Cryptomatte& cryptomatte : options.cryptomattes)
    for (const auto& [name, text] : film::cryptomatteAttributes(cryptomatte.layer, cryptomatte.objects))
      header.insert(name, Imf::StringAttribute(text));

  Content content;
  const auto add = [&](const ImageLayer& layer) { return addLayer(path, layer, views, header, content); };
  for (const ImageLayer& layer : layers) {
    const Cryptomatte* cryptomatte = cryptomatteOf(layer, options);
    if (!cryptomatte) {
      if (Status status = add(layer); !status) return status;
      continue;
    }
    int number = 0;
    for (Image& image : film::cryptomatteLayers(*layer.image, cryptomatte->objects)) {
      content.made.push_back(std::move(image));
      // Never half: a number must come back bit by bit.
      if (Status status =
              add({fmt::format("{}{:02}", layer.name, number++), layer.view, &content.made.back()});
          !status)
        return status;
    }
  }
  startThreads();
  StreamToWholeFile stream(&file, path.c_str());
  {
    Imf::OutputFile output(stream, header, Imf::globalThreadCount());
    output.setFrameBuffer(content.frame);
    output.writePixels(height);
  }  // the table of lines is written here
  return file.commit();
}

}  // namespace

Status writeExr(const std::string& path, const std::vector<ImageLayer>& layers, const ExrOptions& options) {
  std::string reason = "not enough memory";
  try {
    if (const std::string problem = problemWith(layers, options); !problem.empty())
      return misfit(path, problem);
    WholeFile file(path);
    if (!file.ok()) return file.commit();
    try {
      return writeExrThrowing(path, layers, options, file);
    } catch (const std::bad_alloc&) {
    } catch (const std::exception& exception) {
      if (!file.ok()) return file.commit();
      reason = exception.what();
    }
  } catch (const std::exception&) {
  }
  Error error;
  error.kind = ErrorKind::outputNotWritten;
  error.file = path;
  error.problem = "cannot be written: " + reason;
  error.advice = "choose a smaller size or fewer layers";
  return error;
}

}  // namespace scumble
