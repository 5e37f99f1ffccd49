// How the importer gives up. Inside this room, and only here, a file that cannot be used ends in an
// exception: the readers are many and small, and what is optional (a camera, a clip, a texture) is guarded
// as a whole by one catch. Scene::load turns it into a Result; nothing leaves the room.
#pragma once

#include <string>
#include <utility>

#include "scumble/result.h"

namespace scumble::scene {

struct ImportFailure {
  Error error;
};

[[noreturn]] inline void fail(std::string jsonPath, std::string problem, std::string advice = {}) {
  throw ImportFailure{
      Error{ErrorKind::unusableFile, {}, 0, std::move(jsonPath), std::move(problem), std::move(advice)}};
}

}  // namespace scumble::scene
