// Where the command line puts scenes.
#pragma once

#include <string>
#include <vector>

#include "scumble/scene.h"

namespace scumble::app {

// All scenes in one world; `files` are their names. Each of `places` puts one of them somewhere, like
// "dog:at=0,0.4,0;turn=90;on=Boat"; without any, scenes stay where their files have them. Fails with usage.
Result<Scene> placedScenes(const std::vector<Scene>& scenes, const std::vector<std::string>& files,
                           const std::vector<std::string>& places);

}  // namespace scumble::app
