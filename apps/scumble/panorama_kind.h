// Pictures to stand inside of, by the names that `--panorama` takes.
#pragma once

#include <string>

#include "scumble/film.h"
#include "scumble/panorama.h"
#include "scumble/result.h"

namespace scumble::app {

struct PanoramaKindRow {
  const char* name;
  PanoramaKind kind;
  const char* stereo;         // how its eyes lie in a picture, where nothing else is said; "": one eye
  const char* size;           // of an eye's picture, likewise
  FilmProjection projection;  // what players are told
};

// Of this name; empty: null, no panorama. Fails with usage for others.
Result<const PanoramaKindRow*> panoramaKindOf(const std::string& name);

}  // namespace scumble::app
