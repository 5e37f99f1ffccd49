#include "look/param.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>

namespace scumble::look {

glm::vec3 linearFromSrgb(uint32_t rrggbb) {
  const auto channel = [&](int shift) {
    const double s = (rrggbb >> shift & 0xFF) / 255.0;
    return float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  };
  return {channel(16), channel(8), channel(0)};
}

uint32_t srgbFromLinear(const glm::vec3& linear) {
  uint32_t packed = 0;
  for (int i = 0; i < 3; ++i) {
    const double l = std::clamp(double(linear[i]), 0.0, 1.0);
    const double s = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
    packed = packed << 8 | uint32_t(std::lround(s * 255));
  }
  return packed;
}

namespace {

std::vector<const ParamBlock*>& blocks() {
  static std::vector<const ParamBlock*> all = ownBlocks();
  return all;
}

}  // namespace

const std::vector<const ParamBlock*>& allBlocks() {
  return blocks();
}

AddedBlock::AddedBlock(const ParamBlock& block) : block_(&block) {
  assert(std::none_of(blocks().begin(), blocks().end(),
                      [&](const ParamBlock* other) {
                        return other == &block || std::string_view(other->path) == block.path;
                      }) &&
         "there is such a block");
  blocks().push_back(block_);
}

AddedBlock::~AddedBlock() {
  std::erase(blocks(), block_);
}

std::vector<std::string> choiceNames(const ParamRow& row) {
  std::vector<std::string> names(1);
  for (const char* c = row.unit; *c; ++c) {
    if (*c == '|')
      names.emplace_back();
    else
      names.back() += *c;
  }
  return names;
}

}  // namespace scumble::look
