#include "gltf/draco.h"

#include <draco/compression/decode.h>

#include <cstring>
#include <exception>

namespace scumble::gltf {

namespace {

// A plane of a million triangles can compress to almost nothing, so a ratio alone would refuse honest files;
// what is more than this needs bytes of its own.
constexpr uint64_t kFreeElements = 1 << 20, kElementsPerByte = 1024;

// The varint of draco's bit streams; false at the end of the bytes.
bool readVarint(Bytes bytes, size_t& at, uint64_t& value) {
  value = 0;
  for (int shift = 0; shift < 64 && at < bytes.size(); shift += 7) {
    const uint8_t byte = bytes[at++];
    value |= uint64_t(byte & 127) << shift;
    if (!(byte & 128)) return true;
  }
  return false;
}

// Reads the counts that the stream declares, before the decoder allocates by them. Streams with metadata or
// of an older version are left to the decoder's own checks.
void checkDeclaredCounts(Bytes bytes, const std::string& path) {
  constexpr size_t kHeader = 11;  // "DRACO", version, type, method, flags
  if (bytes.size() < kHeader + 2 || std::memcmp(bytes.data(), "DRACO", 5) != 0)
    fail(path, "holds no Draco data", "export the scene again");
  const uint8_t major = bytes[5], minor = bytes[6], method = bytes[8];
  const uint16_t flags = static_cast<uint16_t>(bytes[9] | bytes[10] << 8);
  if (bytes[7] != 1) fail(path, "holds a Draco point cloud, not a mesh", "export the scene again");
  if (major != 2 || minor < 2 || (flags & 0x8000)) return;
  size_t at = kHeader + (method == 1 ? 1 : 0);  // edgebreaker: the traversal's type comes first
  uint64_t first = 0, second = 0;
  if (!readVarint(bytes, at, first) || !readVarint(bytes, at, second))
    fail(path, "ends within its Draco header");
  const uint64_t limit = kFreeElements + kElementsPerByte * bytes.size();
  if (first > limit || second > limit)
    fail(path, "declares more triangles or points than its bytes can hold", "export the scene again");
}

template <class T>
void copyValues(const draco::PointAttribute& attribute, size_t points, int components, uint8_t* out) {
  T value[16] = {};
  for (size_t i = 0; i < points; ++i) {
    const draco::AttributeValueIndex index =
        attribute.mapped_index(draco::PointIndex(static_cast<uint32_t>(i)));
    attribute.ConvertValue<T>(index, static_cast<int8_t>(components), value);
    std::memcpy(out + i * components * sizeof(T), value, components * sizeof(T));
  }
}

void copyAttribute(const draco::PointAttribute& attribute, size_t points, const Accessor& shape,
                   uint8_t* out) {
  const int n = shape.components();
  switch (shape.type) {
    case ComponentType::i8:
      return copyValues<int8_t>(attribute, points, n, out);
    case ComponentType::u8:
      return copyValues<uint8_t>(attribute, points, n, out);
    case ComponentType::i16:
      return copyValues<int16_t>(attribute, points, n, out);
    case ComponentType::u16:
      return copyValues<uint16_t>(attribute, points, n, out);
    case ComponentType::u32:
      return copyValues<uint32_t>(attribute, points, n, out);
    case ComponentType::f32:
      return copyValues<float>(attribute, points, n, out);
  }
}

std::unique_ptr<draco::Mesh> decodeMesh(Bytes bytes, const std::string& path) {
  try {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (decoded.ok() && decoded.value()) return std::move(decoded).value();
  } catch (const std::exception&) {
    // The decoder may run out of memory on a hostile header.
  }
  fail(path, "holds Draco data that is damaged", "export the scene again");
}

}  // namespace

DracoPrimitive decodeDraco(const JsonView& primitive, const JsonView& compression, const Accessors& accessors,
                           Buffers& buffers, ImportBudget& budget) {
  const Bytes bytes =
      buffers.view(compression.requiredIndex("bufferView", buffers.viewCount(), "buffer view"));
  checkDeclaredCounts(bytes, compression.path());
  const std::unique_ptr<draco::Mesh> mesh = decodeMesh(bytes, compression.path());
  const size_t points = mesh->num_points(), faces = mesh->num_faces();

  DracoPrimitive result;
  budget.takeBytes(faces * 12, compression.path());
  result.indices.resize(faces * 3);
  for (size_t i = 0; i < faces; ++i) {
    const draco::Mesh::Face& face = mesh->face(draco::FaceIndex(static_cast<uint32_t>(i)));
    for (int corner = 0; corner < 3; ++corner) {
      const uint32_t point = face[corner].value();
      if (point >= points)
        fail(compression.path(), "holds Draco data that is damaged", "export the scene again");
      result.indices[3 * i + corner] = point;
    }
  }

  const JsonView ids = compression.object("attributes"), described = primitive.object("attributes");
  if (!ids || !described) compression.failAt("attributes", "is missing");
  for (const auto& [semantic, number] : ids.json().items()) {
    if (!described.has(semantic.c_str())) continue;
    const size_t index = described.requiredIndex(semantic.c_str(), accessors.count(), "accessor");
    const uint64_t id = ids.requiredCount(semantic.c_str());
    const draco::PointAttribute* attribute =
        id <= 0xffffffffu ? mesh->GetAttributeByUniqueId(static_cast<uint32_t>(id)) : nullptr;
    if (!attribute) ids.failAt(semantic, "names an attribute that the Draco data does not hold");
    Accessor shape = Accessors::describe(accessors.json(index));
    if (shape.columns != 1) ids.failAt(semantic, "has an accessor of matrices");
    budget.takeBytes(points * shape.elementSize(), compression.path());
    // The mapping of points to values comes from the stream; ConvertValue does not check it.
    for (size_t i = 0; i < points; ++i)
      if (attribute->mapped_index(draco::PointIndex(static_cast<uint32_t>(i))).value() >= attribute->size())
        fail(compression.path(), "holds Draco data that is damaged", "export the scene again");
    std::vector<uint8_t>& data = result.storage.emplace_back(points * shape.elementSize());
    if (points > 0) copyAttribute(*attribute, points, shape, data.data());
    shape.count = points;
    shape.stride = shape.elementSize();
    shape.data = data.data();
    result.attributes.emplace(semantic, std::move(shape));
  }
  return result;
}

}  // namespace scumble::gltf
