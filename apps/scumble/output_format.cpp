#include "output_format.h"

#include "options.h"
#include "report.h"

namespace scumble::app {

namespace {

Status writeAsPng(const std::string& path, const Image& image, std::optional<int>) {
  return writePng(path, image);
}
Status writeAsJpeg(const std::string& path, const Image& image, std::optional<int> quality) {
  return quality ? writeJpeg(path, image, *quality) : writeJpeg(path, image);
}
Status writeAsWebp(const std::string& path, const Image& image, std::optional<int> quality) {
  return quality ? writeWebp(path, image, *quality) : writeWebp(path, image);
}

constexpr OutputFormat kFormats[] = {{".png", OutputKind::picture, 0, -1, FilmFormat::mp4, writeAsPng},
                                     {".jpg", OutputKind::picture, 1, 100, FilmFormat::mp4, writeAsJpeg},
                                     {".jpeg", OutputKind::picture, 1, 100, FilmFormat::mp4, writeAsJpeg},
                                     {".webp", OutputKind::picture, 0, 100, FilmFormat::mp4, writeAsWebp},
                                     {".exr", OutputKind::exr},
                                     {".mp4", OutputKind::film, 0, 51, FilmFormat::mp4},
                                     {".webm", OutputKind::film, 0, 63, FilmFormat::webm},
                                     {".gif", OutputKind::film, 0, -1, FilmFormat::gif},
                                     {".svg", OutputKind::drawing}};

}  // namespace

Status OutputFormat::checkQuality(std::optional<int> quality) const {
  if (!quality || (*quality >= leastQuality && *quality <= mostQuality)) return Done{};
  const std::string given = "--quality " + std::to_string(*quality);
  if (mostQuality < leastQuality)
    return usage(given + ": a " + (ending + 1) + " has no quality to choose", "leave it out");
  return usage(given + " is out of range", std::string("of a ") + (ending + 1) + " it is from " +
                                               std::to_string(leastQuality) + " to " +
                                               std::to_string(mostQuality));
}

Result<const OutputFormat*> formatOf(const std::string& path) {
  const std::string ending = endingOf(path);
  for (const OutputFormat& format : kFormats)
    if (ending == format.ending) return &format;
  std::string all;
  for (const OutputFormat& format : kFormats)
    all += (all.empty()                         ? ""
            : &format == std::end(kFormats) - 1 ? " and "
                                                : ", ") +
           std::string(format.ending);
  return usage("'" + path + "' ends in none of " + all, "name the output like picture.png");
}

}  // namespace scumble::app
