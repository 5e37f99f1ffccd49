// The picture of an EXR file: of one of its views, R, G, B and A.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiView.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include <algorithm>
#include <exception>

#include "film/picture_limits.h"
#include "scumble/image.h"

namespace scumble {

using film::kMostPixels;
using film::unusable;

namespace {

// Names of the picture's channels in a view; empty: the file has no such view. A file without views shows the
// same to both eyes.
std::vector<std::string> channelsOf(const Imf::Header& header, const std::string& view) {
  std::vector<std::string> names{"R", "G", "B", "A"};
  if (view.empty() || !Imf::hasMultiView(header)) return names;
  const Imf::StringVector& views = Imf::multiView(header);
  const auto found = std::find(views.begin(), views.end(), view);
  if (found == views.end()) return {};
  for (std::string& name : names) name = Imf::insertViewName(name, views, int(found - views.begin()));
  return names;
}

// Files hold colours multiplied by their alpha.
void divideByAlpha(Image& image) {
  for (size_t i = 0; i < image.pixels.size(); i += 4)
    if (const float alpha = image.pixels[i + 3]; alpha > 0)
      for (size_t c = 0; c < 3; ++c) image.pixels[i + c] /= alpha;
}

// What of an image that covers one window lies in another one; 0 where it has nothing.
Image cropped(const Image& image, const Imath::Box2i& from, const Imath::Box2i& to) {
  Image result{
      uint32_t(to.max.x - to.min.x + 1), uint32_t(to.max.y - to.min.y + 1), image.channels, {}, true};
  const size_t channels = image.channels.size();
  result.pixels.resize(size_t(result.width) * result.height * channels);
  const int first = std::max(from.min.x, to.min.x), last = std::min(from.max.x, to.max.x);
  for (int y = std::max(from.min.y, to.min.y); first <= last && y <= std::min(from.max.y, to.max.y); ++y) {
    const float* const in =
        &image.pixels[(size_t(y - from.min.y) * image.width + size_t(first - from.min.x)) * channels];
    std::copy(in, in + size_t(last - first + 1) * channels,
              &result.pixels[(size_t(y - to.min.y) * result.width + size_t(first - to.min.x)) * channels]);
  }
  return result;
}

bool isTooLarge(const Imath::Box2i& window) {
  const int64_t width = int64_t(window.max.x) - window.min.x + 1;
  const int64_t height = int64_t(window.max.y) - window.min.y + 1;
  return width < 1 || height < 1 || uint64_t(width) * uint64_t(height) > kMostPixels;
}

}  // namespace

Result<Image> readExr(const std::string& path, const std::string& view) {
  try {
    Imf::InputFile file(path.c_str());
    const std::vector<std::string> names = channelsOf(file.header(), view);
    if (names.empty())
      return unusable(path, "has no view '" + view + "'", "give a file with views left and right");
    const Imath::Box2i window = file.header().dataWindow();
    const Imath::Box2i shown = file.header().displayWindow();
    if (isTooLarge(window) || isTooLarge(shown))
      return unusable(path, "has more pixels than this program accepts", "use a smaller picture");
    const Imf::ChannelList& channels = file.header().channels();
    Image image;
    image.width = uint32_t(window.max.x - window.min.x + 1);
    image.height = uint32_t(window.max.y - window.min.y + 1);
    image.isColor = true;
    for (const std::string& name : names) {
      const Imf::Channel* channel = channels.findChannel(name);
      const bool isAlpha = &name == &names.back();
      if (!channel && isAlpha) continue;
      if (!channel || channel->xSampling != 1 || channel->ySampling != 1)
        return unusable(path, "has no channel " + name + " for every pixel",
                        "give a file with R, G and B, as `scumble render` writes them");
      image.channels.push_back(name.substr(name.rfind('.') + 1));
    }
    image.pixels.resize(size_t(image.width) * image.height * image.channels.size());
    Imf::FrameBuffer target;
    const size_t stride = image.channels.size() * sizeof(float);
    for (size_t c = 0; c < image.channels.size(); ++c)
      target.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, window, stride,
                                               stride * image.width));
    file.setFrameBuffer(target);
    file.readPixels(window.min.y, window.max.y);
    if (image.channels.size() == 4) divideByAlpha(image);
    return window == shown ? image : cropped(image, window, shown);
  } catch (const std::bad_alloc&) {
    return unusable(path, "is too large for this machine's memory", "use a smaller picture");
  } catch (const std::exception& error) {
    // The library's own words name the file again, and go over several lines.
    std::string said = error.what();
    std::replace(said.begin(), said.end(), '\n', ' ');
    return unusable(path, "is no usable EXR: " + said, "check the name, or write it again");
  }
}

}  // namespace scumble
