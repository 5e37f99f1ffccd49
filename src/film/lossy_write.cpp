#include "film/lossy_write.h"

#include <exception>
#include <new>

#include "film/checks.h"

namespace scumble::film {

Status writeLossy(const std::string& path, const Image& image, int quality, const Lossy& format,
                  const std::function<bool(WholeFile&)>& encode) {
  const auto wrong = [&](ErrorKind kind, std::string problem, std::string advice) {
    return Error{kind, path, 0, "", std::move(problem), std::move(advice)};
  };
  try {
    if (std::string problem = problemWith(image); !problem.empty())
      return wrong(ErrorKind::usage, std::move(problem), "");
    if (quality < format.leastQuality || quality > 100)
      return wrong(ErrorKind::usage,
                   "the quality " + std::to_string(quality) + " is not from " +
                       std::to_string(format.leastQuality) + " to 100",
                   format.aboutQuality);
    if (image.width > format.largestSide || image.height > format.largestSide)
      return wrong(ErrorKind::outputNotWritten, "is larger than a " + format.name + " can be", "write a PNG");
    WholeFile file(path);
    if (!encode(file)) throw std::bad_alloc();
    return file.commit();
  } catch (const std::exception&) {
    return wrong(ErrorKind::outputNotWritten, "cannot be written: not enough memory",
                 "choose a smaller size");
  }
}

}  // namespace scumble::film
