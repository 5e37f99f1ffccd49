#include "gltf/accessor.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace scumble::gltf {

size_t sizeOf(ComponentType type) {
  switch (type) {
    case ComponentType::i8:
    case ComponentType::u8:
      return 1;
    case ComponentType::i16:
    case ComponentType::u16:
      return 2;
    default:
      return 4;
  }
}

bool isUnsigned(ComponentType type) {
  return type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
}

namespace {

ComponentType componentTypeOf(const JsonView& json) {
  const uint64_t code = json.requiredCount("componentType");
  if (code < 5120 || code > 5126 || code == 5124)
    json.failAt("componentType", "is not a known component type");
  return static_cast<ComponentType>(code);
}

template <class T>
T load(const uint8_t* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

// The mapping of the specification for normalised integers.
template <class T>
float toFloat(T value, bool normalized) {
  if constexpr (std::is_same_v<T, float> || sizeof(T) == 4) {
    return static_cast<float>(value);
  } else {
    const float number = static_cast<float>(value);
    return normalized ? std::max(number / static_cast<float>(std::numeric_limits<T>::max()), -1.0f) : number;
  }
}

template <class T, class Out>
Out convert(T value, bool normalized) {
  if constexpr (std::is_same_v<Out, float>)
    return toFloat(value, normalized);
  else
    return static_cast<Out>(value);
}

template <class T, class Out>
void readElement(const Accessor& a, const uint8_t* element, int components, Out* out) {
  if (a.columns == 1) {
    const int n = std::min(components, a.rows);
    for (int i = 0; i < n; ++i) out[i] = convert<T, Out>(load<T>(element + sizeof(T) * i), a.normalized);
    return;
  }
  for (int column = 0, i = 0; column < a.columns; ++column)
    for (int row = 0; row < a.rows && i < components; ++row, ++i)
      out[i] = convert<T, Out>(load<T>(element + a.columnStride * column + sizeof(T) * row), a.normalized);
}

// The number of components as a constant lets the compiler unroll the loops that matter.
template <class T, class Out, int kComponents>
void readVectors(const Accessor& a, std::span<const uint32_t> gather, Out* out) {
  const size_t count = gather.empty() ? a.count : gather.size();
  for (size_t i = 0; i < count; ++i, out += kComponents) {
    const uint8_t* element = a.data + a.stride * (gather.empty() ? i : gather[i]);
    for (int c = 0; c < kComponents; ++c)
      out[c] = convert<T, Out>(load<T>(element + sizeof(T) * c), a.normalized);
  }
}

template <class T, class Out>
void readAll(const Accessor& a, std::span<const uint32_t> gather, int components, Out* out) {
  const size_t count = gather.empty() ? a.count : gather.size();
  if (count == 0) return;
  if (!a.data) {
    const int n = std::min(components, a.components());
    for (size_t i = 0; i < count; ++i, out += components) std::fill(out, out + n, Out(0));
    return;
  }
  if (std::is_same_v<T, Out> && gather.empty() && a.columns == 1 && components == a.rows &&
      a.stride == sizeof(T) * a.rows) {
    std::memcpy(out, a.data, count * a.stride);
    return;
  }
  if (a.columns == 1 && components == a.rows) {
    switch (components) {
      case 1:
        return readVectors<T, Out, 1>(a, gather, out);
      case 2:
        return readVectors<T, Out, 2>(a, gather, out);
      case 3:
        return readVectors<T, Out, 3>(a, gather, out);
      case 4:
        return readVectors<T, Out, 4>(a, gather, out);
    }
  }
  for (size_t i = 0; i < count; ++i, out += components)
    readElement<T, Out>(a, a.data + a.stride * (gather.empty() ? i : gather[i]), components, out);
}

size_t sparseIndexAt(const Accessor& a, size_t i) {
  switch (a.sparseIndexType) {
    case ComponentType::u8:
      return a.sparseIndices[i];
    case ComponentType::u16:
      return load<uint16_t>(a.sparseIndices + 2 * i);
    default:
      return load<uint32_t>(a.sparseIndices + 4 * i);
  }
}

template <class T, class Out>
void read(const Accessor& a, std::span<const uint32_t> gather, int components, Out* out) {
  if (a.sparseCount == 0) return readAll<T, Out>(a, gather, components, out);
  // Sparse values replace elements by number: they are put in place before any gathering.
  std::vector<Out> whole;
  Out* target = out;
  if (!gather.empty()) {
    whole.resize(a.count * static_cast<size_t>(components));
    target = whole.data();
  }
  readAll<T, Out>(a, {}, components, target);
  for (size_t i = 0; i < a.sparseCount; ++i)
    readElement<T, Out>(a, a.sparseValues + a.elementSize() * i, components,
                        target + sparseIndexAt(a, i) * components);
  for (size_t i = 0; i < gather.size(); ++i)
    std::copy_n(whole.data() + size_t(gather[i]) * components, components, out + i * components);
}

template <class Out>
void readAs(const Accessor& a, std::span<const uint32_t> gather, int components, Out* out) {
  switch (a.type) {
    case ComponentType::i8:
      return read<int8_t, Out>(a, gather, components, out);
    case ComponentType::u8:
      return read<uint8_t, Out>(a, gather, components, out);
    case ComponentType::i16:
      return read<int16_t, Out>(a, gather, components, out);
    case ComponentType::u16:
      return read<uint16_t, Out>(a, gather, components, out);
    case ComponentType::u32:
      return read<uint32_t, Out>(a, gather, components, out);
    case ComponentType::f32:
      if constexpr (std::is_same_v<Out, float>) read<float, Out>(a, gather, components, out);
      return;
  }
}

// Bytes of `count` elements of `size` at `offset` in a view; fails when it is shorter.
const uint8_t* bytesIn(Bytes view, uint64_t offset, uint64_t stride, uint64_t count, uint64_t size,
                       const std::string& path) {
  const uint64_t needed = count == 0 ? 0 : stride * (count - 1) + size;
  if (offset > view.size() || needed > view.size() - offset)
    fail(path,
         "reaches to byte " + std::to_string(offset + needed) + " of a buffer view of " +
             std::to_string(view.size()),
         "export the scene again");
  return view.data() + offset;
}

}  // namespace

Accessors::Accessors(const Document& document, Buffers& buffers, ImportBudget& budget)
    : list_(document.list("accessors")), buffers_(buffers), budget_(budget) {}

Accessor Accessors::describe(const JsonView& json) {
  Accessor a;
  a.path = json.path();
  a.type = componentTypeOf(json);
  a.normalized = json.flag("normalized", false);
  a.count = json.requiredCount("count");
  if (a.count > 0xffffffffull) json.failAt("count", "is absurdly large");
  const std::string type = json.text("type");
  constexpr std::pair<const char*, glm::ivec2> kShapes[] = {
      {"SCALAR", {1, 1}}, {"VEC2", {1, 2}}, {"VEC3", {1, 3}}, {"VEC4", {1, 4}},
      {"MAT2", {2, 2}},   {"MAT3", {3, 3}}, {"MAT4", {4, 4}}};
  const auto* shape =
      std::find_if(std::begin(kShapes), std::end(kShapes), [&](auto& s) { return type == s.first; });
  if (shape == std::end(kShapes)) json.failAt("type", "is not a known type");
  a.columns = shape->second.x;
  a.rows = shape->second.y;
  a.columnStride = sizeOf(a.type) * a.rows;
  if (a.columns > 1) a.columnStride = (a.columnStride + 3) / 4 * 4;
  a.stride = a.elementSize();
  return a;
}

Accessor Accessors::open(size_t i) const {
  const JsonView json = list_.at(i);
  Accessor a = describe(json);
  const int64_t view = json.index("bufferView", buffers_.viewCount(), "buffer view");
  const uint64_t offset = json.count("byteOffset", 0);
  if (view >= 0) {
    if (const size_t stride = buffers_.viewStride(view); stride != 0) {
      // A stride of less than an element lets elements overlap; every read still stays in the view.
      a.stride = stride;
    }
    a.data = bytesIn(buffers_.view(view), offset, a.stride, a.count, a.elementSize(), a.path);
  } else {
    budget_.takeZeroNumbers(a.count * static_cast<uint64_t>(a.components()), a.path);
  }
  if (const JsonView sparse = json.object("sparse")) openSparse(sparse, a);
  return a;
}

void Accessors::openSparse(const JsonView& sparse, Accessor& a) const {
  a.sparseCount = sparse.requiredCount("count");
  if (a.sparseCount > a.count) sparse.failAt("count", "is larger than the accessor's count");
  const JsonView indices = sparse.object("indices"), values = sparse.object("values");
  if (!indices) sparse.failAt("indices", "is missing");
  if (!values) sparse.failAt("values", "is missing");
  a.sparseIndexType = componentTypeOf(indices);
  if (!isUnsigned(a.sparseIndexType)) indices.failAt("componentType", "is not an unsigned integer");
  const auto bytesOf = [&](const JsonView& json, size_t size) {
    const int64_t view = json.requiredIndex("bufferView", buffers_.viewCount(), "buffer view");
    return bytesIn(buffers_.view(view), json.count("byteOffset", 0), size, a.sparseCount, size, json.path());
  };
  a.sparseIndices = bytesOf(indices, sizeOf(a.sparseIndexType));
  a.sparseValues = bytesOf(values, a.elementSize());
  for (size_t i = 0; i < a.sparseCount; ++i)
    if (sparseIndexAt(a, i) >= a.count)
      fail(indices.path(),
           "names element " + std::to_string(sparseIndexAt(a, i)) + " of " + std::to_string(a.count),
           "export the scene again");
}

void readFloats(const Accessor& accessor, std::span<const uint32_t> gather, int components, float* out) {
  readAs<float>(accessor, gather, components, out);
}

void readUnsigned(const Accessor& accessor, std::span<const uint32_t> gather, int components, uint32_t* out) {
  readAs<uint32_t>(accessor, gather, components, out);
}

}  // namespace scumble::gltf
