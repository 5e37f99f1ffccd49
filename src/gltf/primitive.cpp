#include "gltf/primitive.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gltf/draco.h"
#include "scene/prepare_mesh.h"

namespace scumble::gltf {

namespace {

// Where attributes come from: accessors, or Draco data that replaces some of them.
class AttributeSource {
 public:
  AttributeSource(const Import& import, const JsonView& json)
      : import_(import), attributes_(json.object("attributes")) {
    const JsonView compression = json.extension("KHR_draco_mesh_compression");
    if (compression) draco_ = decodeDraco(json, compression, import.accessors, import.buffers, import.budget);
  }

  std::optional<Accessor> find(const char* semantic) const {
    if (draco_)
      if (const auto found = draco_->attributes.find(semantic); found != draco_->attributes.end())
        return found->second;
    if (!attributes_) return std::nullopt;
    const int64_t index = attributes_.index(semantic, import_.accessors.count(), "accessor");
    if (index < 0) return std::nullopt;
    Accessor accessor = import_.accessors.open(index);
    accessor.path = attributes_.pathOf(semantic);
    return accessor;
  }

  bool has(const char* semantic) const { return attributes_ && attributes_.has(semantic); }
  std::string pathOf(const char* semantic) const { return attributes_.pathOf(semantic); }
  DracoPrimitive* draco() { return draco_ ? &*draco_ : nullptr; }

 private:
  const Import& import_;
  JsonView attributes_;
  std::optional<DracoPrimitive> draco_;
};

enum Mode : uint64_t { kTriangles = 4, kStrip = 5, kFan = 6 };

std::vector<uint32_t> readIndices(const Import& import, const JsonView& json, size_t vertices) {
  const int64_t index = json.index("indices", import.accessors.count(), "accessor");
  std::vector<uint32_t> indices;
  if (index < 0) {
    import.budget.takeBytes(vertices * 4, json.path());
    indices.resize(vertices);
    for (size_t i = 0; i < vertices; ++i) indices[i] = static_cast<uint32_t>(i);
    return indices;
  }
  const Accessor accessor = import.accessors.open(index);
  if (accessor.components() != 1 || !isUnsigned(accessor.type))
    json.failAt("indices", "is not an accessor of unsigned scalars", "export the scene again");
  import.budget.takeBytes(accessor.count * 4, json.path());
  indices.resize(accessor.count);
  readUnsigned(accessor, {}, 1, indices.data());
  return indices;
}

void checkIndices(const std::vector<uint32_t>& indices, size_t vertices, const std::string& path) {
  uint32_t largest = 0;
  for (const uint32_t index : indices) largest = std::max(largest, index);
  if (!indices.empty() && largest >= vertices)
    fail(path, "names vertex " + std::to_string(largest) + ", but there are " + std::to_string(vertices),
         "export the scene again");
}

// Strips and fans as lists, in the specification's order of corners.
std::vector<uint32_t> toList(std::vector<uint32_t> indices, uint64_t mode) {
  if (mode == kTriangles) return indices;
  std::vector<uint32_t> list;
  if (indices.size() < 3) return list;
  list.reserve((indices.size() - 2) * 3);
  for (size_t i = 0; i + 2 < indices.size(); ++i) {
    if (mode == kStrip)
      list.insert(list.end(), {indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
    else
      list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
  }
  return list;
}

// Which vertices to read when the triangles use only some, renumbering the indices; empty: all of them.
// Exporters like to share one array of vertices between many primitives.
std::vector<uint32_t> selectVertices(std::vector<uint32_t>& indices, size_t vertices) {
  std::vector<uint32_t> source;
  if (vertices <= 4 * indices.size()) {
    std::vector<uint32_t> target(vertices, 0);
    for (const uint32_t index : indices) target[index] = 1;
    size_t used = 0;
    for (const uint32_t flag : target) used += flag;
    if (used == vertices) return source;
    source.reserve(used);
    for (size_t i = 0; i < vertices; ++i) {
      if (!target[i]) continue;
      target[i] = static_cast<uint32_t>(source.size());
      source.push_back(static_cast<uint32_t>(i));
    }
    for (uint32_t& index : indices) index = target[index];
    return source;
  }
  source = indices;
  std::sort(source.begin(), source.end());
  source.erase(std::unique(source.begin(), source.end()), source.end());
  for (uint32_t& index : indices)
    index = static_cast<uint32_t>(std::lower_bound(source.begin(), source.end(), index) - source.begin());
  return source;
}

// Reads the optional attributes of one primitive; what does not fit is left out with a warning.
class AttributeReader {
 public:
  AttributeReader(const Import& import, const AttributeSource& source, size_t fileVertices,
                  const std::vector<uint32_t>& selection, ImportWarnings& warnings)
      : import_(import),
        source_(source),
        fileVertices_(fileVertices),
        selection_(selection),
        warnings_(warnings) {}

  size_t count() const { return selection_.empty() ? fileVertices_ : selection_.size(); }

  bool fits(const Accessor& accessor, int minComponents, int maxComponents) {
    if (accessor.columns != 1 || accessor.rows < minComponents || accessor.rows > maxComponents) {
      warnings_.add(accessor.path, "a vertex attribute of the wrong type is ignored");
      return false;
    }
    if (accessor.count != fileVertices_) {
      warnings_.add(accessor.path, "a vertex attribute with another count than POSITION is ignored");
      return false;
    }
    return true;
  }

  template <class Vector>
  std::vector<Vector> vectors(const Accessor& accessor) {
    import_.budget.takeBytes(count() * sizeof(Vector), accessor.path);
    std::vector<Vector> values(count());
    readFloats(accessor, selection_, Vector::length(), &values.data()->x);
    return values;
  }

  template <class Vector>
  std::vector<Vector> optionalVectors(const char* semantic) {
    const std::optional<Accessor> accessor = source_.find(semantic);
    if (!accessor || !fits(*accessor, Vector::length(), Vector::length())) return {};
    return vectors<Vector>(*accessor);
  }

  void uvs(Primitive& p) {
    p.uv0 = optionalVectors<glm::vec2>("TEXCOORD_0");
    p.uv1 = optionalVectors<glm::vec2>("TEXCOORD_1");
    for (std::vector<glm::vec2>* uvs : {&p.uv0, &p.uv1}) {
      bool broken = false;
      for (glm::vec2& uv : *uvs)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = glm::vec2(0.0f), broken = true;
      if (broken)
        warnings_.add(source_.pathOf("TEXCOORD_0"), "texture coordinates that are not finite become zero");
    }
    if (source_.has("TEXCOORD_2"))
      warnings_.add(source_.pathOf("TEXCOORD_2"), "texture coordinates beyond TEXCOORD_1 are ignored");
  }

  void colors(Primitive& p) {
    const std::optional<Accessor> accessor = source_.find("COLOR_0");
    if (!accessor || !fits(*accessor, 3, 4)) return;
    import_.budget.takeBytes(count() * 4, accessor->path);
    std::vector<glm::vec4> values(count(), glm::vec4(1.0f));
    Accessor normalized = *accessor;
    normalized.normalized = true;  // integer colours make sense in no other way
    readFloats(normalized, selection_, 4, &values.data()->x);
    p.colors.resize(values.size());
    for (size_t i = 0; i < values.size(); ++i)
      for (int c = 0; c < 4; ++c) {
        const float value = values[i][c];
        p.colors[i][c] = value >= 1.0f  ? 255
                         : value > 0.0f ? static_cast<uint8_t>(std::lround(value * 255.0f))
                                        : 0;
      }
  }

  // Attributes of the file's own, as Blender exports those whose names begin with an underscore.
  void warpScales(Primitive& p) { own("_WARP", 64, p.warpScales); }
  void roundness(Primitive& p) { own("_ROUND", 1, p.roundness); }

  // A number a vertex, from 0 to `most`.
  void own(const char* name, float most, std::vector<float>& values) {
    const std::optional<Accessor> accessor = source_.find(name);
    if (!accessor || !fits(*accessor, 1, 1)) return;
    import_.budget.takeBytes(count() * sizeof(float), accessor->path);
    values.resize(count());
    Accessor normalized = *accessor;
    if (normalized.type != ComponentType::f32) normalized.normalized = true;
    readFloats(normalized, selection_, 1, values.data());
    for (float& value : values) value = value > 0.0f ? std::min(value, most) : 0.0f;
  }

  void skinning(Primitive& p) {
    int sets = 0;
    std::optional<Accessor> joints[2], weights[2];
    for (; sets < 2; ++sets) {
      joints[sets] = source_.find(sets == 0 ? "JOINTS_0" : "JOINTS_1");
      weights[sets] = source_.find(sets == 0 ? "WEIGHTS_0" : "WEIGHTS_1");
      if (!joints[sets] || !weights[sets]) break;
      if (!fits(*joints[sets], 4, 4) || !fits(*weights[sets], 4, 4)) break;
      if (joints[sets]->type != ComponentType::u8 && joints[sets]->type != ComponentType::u16) {
        warnings_.add(joints[sets]->path, "a vertex attribute of the wrong type is ignored");
        break;
      }
    }
    if (sets == 0) return;
    p.influences = 4 * sets;
    import_.budget.takeBytes(count() * p.influences * 6, joints[0]->path);
    p.joints.resize(count() * p.influences);
    p.weights.resize(count() * p.influences);
    std::vector<uint32_t> setJoints(count() * 4);
    std::vector<float> setWeights(count() * 4);
    for (int set = 0; set < sets; ++set) {
      readUnsigned(*joints[set], selection_, 4, setJoints.data());
      if (weights[set]->type != ComponentType::f32) weights[set]->normalized = true;
      readFloats(*weights[set], selection_, 4, setWeights.data());
      for (size_t i = 0; i < count(); ++i)
        for (int k = 0; k < 4; ++k) {
          p.joints[i * p.influences + set * 4 + k] = static_cast<uint16_t>(setJoints[4 * i + k]);
          p.weights[i * p.influences + set * 4 + k] = setWeights[4 * i + k];
        }
    }
    normalizeWeights(p, joints[0]->path);
    if (sets == 2 && source_.has("JOINTS_2"))
      warnings_.add(source_.pathOf("JOINTS_2"), "joints beyond eight a vertex are ignored");
  }

  void morphTargets(Primitive& p, const JsonView& json) {
    const JsonView targets = json.list("targets");
    if (targets.size() > kMaxMorphTargets)
      warnings_.add(targets.path(),
                    "morph targets beyond " + std::to_string(kMaxMorphTargets) + " are ignored");
    bool broken = false;
    for (size_t i = 0; i < std::min<size_t>(targets.size(), kMaxMorphTargets); ++i) {
      const JsonView target = targets.at(i);
      const auto displacements = [&](const char* semantic) -> std::vector<glm::vec3> {
        const int64_t index = target.index(semantic, import_.accessors.count(), "accessor");
        if (index < 0) return {};
        Accessor accessor = import_.accessors.open(index);
        accessor.path = target.pathOf(semantic);
        if (!fits(accessor, 3, 3)) return {};
        std::vector<glm::vec3> values = vectors<glm::vec3>(accessor);
        for (glm::vec3& v : values)
          for (int c = 0; c < 3; ++c)
            if (!(std::abs(v[c]) < kMaxCoordinate)) v[c] = 0.0f, broken = true;
        return values;
      };
      import_.budget.takeBytes(count() * 4 * sizeof(glm::vec3), target.path());  // what preparation adds
      p.morphTargets.push_back({displacements("POSITION"), displacements("NORMAL"), {}, {}, {}});
    }
    if (broken) warnings_.add(targets.path(), "displacements that are not finite become zero");
  }

 private:
  void normalizeWeights(Primitive& p, const std::string& path) {
    // Bytes round by up to half of one each.
    const float tolerance = 0.01f * float(p.influences);
    bool broken = false, uneven = false;
    for (size_t i = 0; i < count(); ++i) {
      float* weights = p.weights.data() + i * p.influences;
      uint16_t* joints = p.joints.data() + i * p.influences;
      float sum = 0.0f;
      for (int k = 0; k < p.influences; ++k) {
        if (!(weights[k] >= 0.0f && weights[k] < 1e6f)) weights[k] = 0.0f, broken = true;
        if (weights[k] == 0.0f) joints[k] = 0;  // need not be valid in the file then
        sum += weights[k];
      }
      if (sum < 1e-12f) {
        weights[0] = sum = 1.0f;
        broken = true;
      }
      uneven |= std::abs(sum - 1.0f) > tolerance;
      for (int k = 0; k < p.influences; ++k) weights[k] /= sum;
    }
    if (uneven) warnings_.add(path, "skin weights that do not sum to one are scaled");
    if (broken) warnings_.add(path, "skin weights that are negative, not finite or all zero are replaced");
  }

  const Import& import_;
  const AttributeSource& source_;
  size_t fileVertices_;
  const std::vector<uint32_t>& selection_;
  ImportWarnings& warnings_;
};

}  // namespace

Primitive readPrimitive(const Import& import, const JsonView& json, ImportWarnings& warnings) {
  Primitive p;
  const uint64_t mode = json.count("mode", kTriangles);
  if (mode > kFan) json.failAt("mode", "is not a known primitive mode");
  if (mode < kTriangles) {
    warnings.add(json.path(), "points and lines are not drawn");
    return p;
  }
  // Materials are numbered from one here: ours begin with the default one.
  p.material =
      static_cast<int>(json.index("material", import.document.list("materials").size(), "material") + 1);

  AttributeSource source(import, json);
  const std::optional<Accessor> position = source.find("POSITION");
  if (!position) {
    warnings.add(json.path(), "a primitive without POSITION is not drawn");
    return p;
  }
  if (position->columns != 1 || position->rows != 3)
    fail(position->path, "is not an accessor of VEC3", "export the scene again");

  std::vector<uint32_t> indices =
      source.draco() ? std::move(source.draco()->indices) : readIndices(import, json, position->count);
  checkIndices(indices, position->count, json.pathOf("indices"));
  p.indices = toList(std::move(indices), source.draco() ? uint64_t(kTriangles) : mode);
  if (p.indices.size() % 3 != 0) {
    warnings.add(json.path(), "the last corners, too few for a triangle, are ignored");
    p.indices.resize(p.indices.size() / 3 * 3);
  }
  if (p.indices.empty()) {
    warnings.add(json.path(), "a primitive without triangles is not drawn");
    return p;
  }

  const std::vector<uint32_t> selection = selectVertices(p.indices, position->count);
  AttributeReader reader(import, source, position->count, selection, warnings);
  // The arrays that preparation makes, flat-shaded corners included.
  import.budget.takeBytes(reader.count() * 48 + p.indices.size() * (source.has("NORMAL") ? 4 : 64),
                          json.path());
  p.positions = reader.vectors<glm::vec3>(*position);
  p.normals = reader.optionalVectors<glm::vec3>("NORMAL");
  reader.uvs(p);
  reader.colors(p);
  reader.warpScales(p);
  reader.roundness(p);
  reader.skinning(p);
  reader.morphTargets(p, json);
  return p;
}

}  // namespace scumble::gltf
