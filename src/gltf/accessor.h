// Accessors: typed views of bytes. All checks are done when one is opened; reading then cannot go wrong.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "gltf/buffers.h"

namespace scumble::gltf {

using namespace scene;

enum class ComponentType : uint16_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

size_t sizeOf(ComponentType type);

struct Accessor {
  size_t count = 0;
  ComponentType type = ComponentType::f32;
  int columns = 1, rows = 1;  // a vector is one column
  size_t columnStride = 0;    // bytes; the columns of small matrices are padded
  bool normalized = false;
  const uint8_t* data = nullptr;  // null: zeros
  size_t stride = 0;              // bytes from element to element
  size_t sparseCount = 0;
  ComponentType sparseIndexType = ComponentType::u16;
  const uint8_t* sparseIndices = nullptr;
  const uint8_t* sparseValues = nullptr;  // tightly packed elements
  std::string path;

  int components() const { return columns * rows; }
  size_t elementSize() const { return columnStride * static_cast<size_t>(columns); }
};

class Accessors {
 public:
  Accessors(const Document& document, Buffers& buffers, ImportBudget& budget);

  size_t count() const { return list_.size(); }
  JsonView json(size_t i) const { return list_.at(i); }

  // Fails when the accessor is not well-formed or reaches outside of its bytes.
  Accessor open(size_t i) const;

  // Everything but the bytes, for accessors that only describe data that an extension holds.
  static Accessor describe(const JsonView& json);

 private:
  void openSparse(const JsonView& sparse, Accessor& accessor) const;

  JsonView list_;
  Buffers& buffers_;
  ImportBudget& budget_;
};

// The elements as floats, `components` a piece (those that the accessor lacks stay as they are), normalised
// integers mapped to [0, 1] or [-1, 1]. With a `gather` list, only these elements and in that order; its
// entries must be below count.
void readFloats(const Accessor& accessor, std::span<const uint32_t> gather, int components, float* out);

// The same as unsigned integers; signed and float components are refused by the caller.
void readUnsigned(const Accessor& accessor, std::span<const uint32_t> gather, int components, uint32_t* out);

bool isUnsigned(ComponentType type);

}  // namespace scumble::gltf
