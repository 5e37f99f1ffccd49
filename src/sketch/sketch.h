// Paintings in space that other programs have made: Tilt Brush and Open Brush (.tilt, as a file or as a
// folder), and A-Painter (.apa, and its JSON).
#pragma once

#include <memory>
#include <string>

#include "base/file_bytes.h"
#include "scene/import_warnings.h"
#include "scene/painting.h"

namespace scumble::sketch {

// Whether bytes are one of these files, by how they begin; of JSON, by what is in it.
bool isSketch(Bytes bytes);
// Whether a folder is an unzipped .tilt.
bool isSketchFolder(const std::string& path);

// All of these fail with scene::ImportFailure where there is no painting to be had.
scene::Painting readSketch(Bytes bytes, scene::ImportWarnings& warnings);
scene::Painting readSketchFolder(const std::string& path, scene::ImportWarnings& warnings);

// The parts of a .tilt: metadata.json, and data.sketch.
scene::Painting readTilt(Bytes metadata, Bytes sketch, scene::ImportWarnings& warnings);
// A .tilt as a file: a zip, behind a header of its own or (unzipped and zipped again) without.
bool isTiltFile(Bytes file);
scene::Painting readTiltFile(Bytes file, scene::ImportWarnings& warnings);
// A-Painter's two forms.
scene::Painting readApainter(Bytes file, scene::ImportWarnings& warnings);
scene::Painting readApainterJson(Bytes file, scene::ImportWarnings& warnings);

}  // namespace scumble::sketch
