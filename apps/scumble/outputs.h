// Where pictures go: the names of the files, and which layers go into which.
#pragma once

#include <optional>
#include <string>

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
                                 const std::string& layout);

  // The path of frame `number`: #### is replaced by the number, zero-padded.
  std::string framePath(std::optional<int> number) const;
  bool isSequence() const { return path.find('#') != std::string::npos; }

  // Writes the picture and its AOVs: layers of an EXR, or beside a PNG as NAME.AOV.exr.
  Status write(const Frame& frame, const std::string& framePath) const;
};

}  // namespace scumble::app
