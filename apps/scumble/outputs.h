// Where pictures go: the names of the files, and which layers go into which.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scumble/renderer.h"

namespace scumble::app {

struct OutputPlan {
  std::string path;  // as given, or made from the scene's name
  bool exr = false;  // else PNG
  bool separateEyes = false;
  std::string layout;  // "", "side-by-side", "over-under" or "separate"

  // Fails with usage for a name whose ending is not known, and with outputNotWritten where it cannot be
  // written at all.
  static Result<OutputPlan> make(const std::string& given, const std::string& sceneFile,
                                 const std::string& layout, bool hasFrames,
                                 const std::vector<std::string>& inputs);

  // The path of frame `number`: #### is replaced by the number, zero-padded.
  std::string framePath(std::optional<int> number) const;
  bool isSequence() const { return path.find('#') != std::string::npos; }

  // Whether every picture of this frame is there (AOVs beside it are written after it and not looked for).
  bool isThere(const std::string& framePath, size_t viewCount) const;

  // Writes the picture and its AOVs: layers of an EXR, or beside a PNG as NAME.AOV.exr.
  Status write(const Frame& frame, const std::string& framePath) const;
};

// Whether a file could be written (an empty path: none is wanted), before long work begins: no input (scene,
// look) and nothing but an ordinary file is ever replaced.
Status checkWritable(const std::string& path, const std::vector<std::string>& inputs);

}  // namespace scumble::app
