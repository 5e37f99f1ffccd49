// What must hold for any block of knobs: its struct starts with the values that `scumble params` shows, laid
// out as GLSL sees it.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>

#include "look/look_data.h"

namespace scumble::test {

using look::ParamKind;

template <class T>
T read(const void* base, size_t offset) {
  T value;
  std::memcpy(&value, static_cast<const char*>(base) + offset, sizeof(T));
  return value;
}

template <class Params>
void expectRowsDefaults(std::set<const look::ParamBlock*>& seen) {
  const look::ParamBlock& block = Params::block();
  seen.insert(&block);
  EXPECT_EQ(block.structSize, sizeof(Params));
  const Params fresh, whole = look::LookData{}.get<Params>(),
                      single = look::LookData{}.getForMaterial<Params>("Sail");
  size_t expectedOffset = 0;
  for (const look::ParamRow& row : block.rows) {
    const std::string name = std::string(block.path) + "." + row.name;
    // Scalar layout without gaps, which is what GLSL sees.
    EXPECT_EQ(row.offset, expectedOffset) << name;
    expectedOffset += row.kind == ParamKind::color || row.kind == ParamKind::triple ? 12 : 4;
    for (const Params* params : {&fresh, &whole, &single}) switch (row.kind) {
        case ParamKind::number:
          EXPECT_EQ(read<float>(params, row.offset), float(row.defaultValue)) << name;
          break;
        case ParamKind::integer:
        case ParamKind::choice:
        case ParamKind::picture:
        case ParamKind::name:
          EXPECT_EQ(read<int32_t>(params, row.offset), int32_t(row.defaultValue)) << name;
          break;
        case ParamKind::toggle:
          EXPECT_EQ(read<uint32_t>(params, row.offset), uint32_t(row.defaultValue)) << name;
          break;
        case ParamKind::triple:
          EXPECT_EQ(read<glm::vec3>(params, row.offset), glm::vec3(float(row.defaultValue))) << name;
          break;
        case ParamKind::color:
          EXPECT_EQ(look::srgbFromLinear(read<glm::vec3>(params, row.offset)), uint32_t(row.defaultValue))
              << name;
      }
  }
  EXPECT_EQ(expectedOffset, sizeof(Params)) << block.path;
}

}  // namespace scumble::test
