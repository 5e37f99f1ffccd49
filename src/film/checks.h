// What every writer asks of the pictures it is given.
#pragma once

#include <string>

#include "scumble/image.h"

namespace scumble::film {

// Empty when the picture has pixels and as many of them as it says; otherwise what is wrong.
std::string problemWith(const Image& image);

}  // namespace scumble::film
