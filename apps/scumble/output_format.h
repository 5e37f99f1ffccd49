// The formats that pictures and films are written in, by their names' endings.
#pragma once

#include <optional>
#include <string>

#include "scumble/film.h"
#include "scumble/image.h"

namespace scumble::app {

enum class OutputKind { picture, exr, film, drawing };

struct OutputFormat {
  const char* ending;  // in small letters
  OutputKind kind;
  int leastQuality = 0, mostQuality = -1;  // nothing to choose where the most is below the least
  FilmFormat film = FilmFormat::mp4;
  // Of pictures.
  Status (*write)(const std::string& path, const Image& image, std::optional<int> quality) = nullptr;

  // Fails with usage where the format has no such quality.
  Status checkQuality(std::optional<int> quality) const;
};

// Fails with usage for an ending that is not known.
Result<const OutputFormat*> formatOf(const std::string& path);

}  // namespace scumble::app
