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
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "film/checks.h"
#include "film/whole_file.h"
#include "scumble/image.h"

namespace scumble {
namespace {

class StreamToWholeFile : public Imf::OStream {
 public:
  StreamToWholeFile(film::WholeFile* file, const char* name) : OStream(name), file_(file) {}
  void write(const char bytes[], int size) override {
    file_->write(bytes, size_t(size));
    // Stops the encoder; the reason is kept in the file.
    if (!file_->ok()) throw std::runtime_error("cannot be written");
  }
  uint64_t tellp() override { return file_->position(); }
  void seekp(uint64_t position) override { file_->seek(position); }

 private:
  film::WholeFile* file_;
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

std::string problemWith(const std::vector<ImageLayer>& layers) {
  if (layers.empty()) return "there is no layer to write";
  for (const ImageLayer& layer : layers) {
    if (!layer.image) return "the layer '" + layer.name + "' has no picture";
    if (std::string problem = film::problemWith(*layer.image); !problem.empty()) return problem;
    if (layer.image->width != layers[0].image->width || layer.image->height != layers[0].image->height)
      return "the layer '" + layer.name + "' differs in size from the first one";
    if (layer.view.find_first_of(". ") != std::string::npos)
      return "the view '" + layer.view + "' has a period or a space in its name";
    for (const std::string& channel : layer.image->channels)
      if (channel.empty()) return "a channel of the layer '" + layer.name + "' has no name";
  }
  return "";
}

Error usage(const std::string& path, const std::string& problem) {
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

Status writeExrThrowing(const std::string& path, const std::vector<ImageLayer>& layers,
                        film::WholeFile& file) {
  const int width = int(layers[0].image->width), height = int(layers[0].image->height);
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  const Imf::StringVector views = viewsOf(layers);
  if (!views.empty()) Imf::addMultiView(header, views);
  if (views.size() == 1) header.setView(views[0]);

  Imf::FrameBuffer frame;
  for (const ImageLayer& layer : layers) {
    const Image& image = *layer.image;
    const size_t pixelBytes = image.channels.size() * sizeof(float);
    for (size_t c = 0; c < image.channels.size(); ++c) {
      const std::string name = channelName(layer, image.channels[c], views);
      if (header.channels().findChannel(name))
        return usage(path, "the channel '" + name + "' is there twice");
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      // OpenEXR reads through this pointer only; its type is shared with reading.
      char* base = reinterpret_cast<char*>(const_cast<float*>(image.pixels.data() + c));
      frame.insert(name, Imf::Slice(Imf::FLOAT, base, pixelBytes, pixelBytes * image.width));
    }
  }
  startThreads();
  StreamToWholeFile stream(&file, path.c_str());
  {
    Imf::OutputFile output(stream, header, Imf::globalThreadCount());
    output.setFrameBuffer(frame);
    output.writePixels(height);
  }  // the table of lines is written here
  return file.commit();
}

}  // namespace

Status writeExr(const std::string& path, const std::vector<ImageLayer>& layers) {
  std::string reason = "not enough memory";
  try {
    if (const std::string problem = problemWith(layers); !problem.empty()) return usage(path, problem);
    film::WholeFile file(path);
    if (!file.ok()) return file.commit();
    try {
      return writeExrThrowing(path, layers, file);
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
