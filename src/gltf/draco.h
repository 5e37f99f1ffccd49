// KHR_draco_mesh_compression: one compressed primitive, decoded into plain arrays.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "gltf/accessor.h"

namespace scumble::gltf {

using namespace scene;

struct DracoPrimitive {
  std::vector<uint32_t> indices;
  std::map<std::string, Accessor> attributes;  // by semantic; they point into `storage`
  std::deque<std::vector<uint8_t>> storage;
};

// `compression` is the extension's object in `primitive`. Fails when the data is damaged.
DracoPrimitive decodeDraco(const JsonView& primitive, const JsonView& compression, const Accessors& accessors,
                           Buffers& buffers, ImportBudget& budget);

}  // namespace scumble::gltf
