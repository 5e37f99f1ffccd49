// Looks on the present scene, small and beside each other: one is taken by a click.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "picture_maker.h"

namespace scumble::viewer {

// `pictures`: of the look of each number, null where it is not there yet. Gives the number of the one that
// was taken.
std::optional<size_t> layOutLookSheet(
    const glm::vec2& window, const std::vector<std::string>& names,
    const std::function<std::shared_ptr<const Picture>(size_t number)>& pictures, float aspect);

}  // namespace scumble::viewer
