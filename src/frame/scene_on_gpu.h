// A scene in device memory: rest vertices, the final vertices that `deform` writes, indices, textures, and
// the list of draws. Built once per scene and GeometryOptions, the little of the look that goes into it.
#pragma once

#include <array>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "gpu/pipeline.h"
#include "gpu/resources.h"
#include "scene/scene_data.h"
#include "shading/frame.shared.h"

namespace scumble::frame {

constexpr uint32_t kShadowMapSize = 2048;

enum class AlphaMode : uint8_t { opaque, mask, blend };

struct Draw {
  uint32_t firstIndex = 0, indexCount = 0;
  int32_t vertexOffset = 0;
  uint32_t object = 0, material = 0;
  AlphaMode alpha = AlphaMode::opaque;
  bool cullsBack = true;  // single-sided
  bool mirrored = false;  // the object's matrix turns triangles inside out
  bool varied = false;    // vertex colours or textures vary the material's colour
  bool textured = false;
  bool wraps = false;    // its mapping closes on itself
  bool casts = true;     // shadows
  scene::Bounds bounds;  // world, rest pose
};

// What the automatic choices of colours need to know.
struct SceneColors {
  glm::vec3 meanRootRgb{0.5f};  // square root of linear RGB, averaged over the surface
};

// What of the look goes into a scene's geometry; when it changes, the scene is built anew.
struct GeometryOptions {
  bool ground = false;
  float shadowWarp = 0;     // strength of the shadow map's sigmoid, which long triangles cannot follow
  std::vector<bool> casts;  // by material: whether it casts shadows
  bool operator==(const GeometryOptions&) const = default;
};

struct Geometry;

class SceneOnGpu {
 public:
  // Throws gpu::VulkanError when it does not fit.
  SceneOnGpu(gpu::Device& device, gpu::Samplers& samplers, const scene::SceneData& scene,
             const GeometryOptions& options);

  const GeometryOptions& options() const { return options_; }

  const scene::SceneData& data() const { return *data_; }
  const std::vector<Draw>& draws() const { return draws_; }
  // Materials by index: the scene's, then (with a ground) the ground's.
  size_t materialCount() const { return materialNames_.size(); }
  const std::string& materialName(size_t material) const { return materialNames_[material]; }
  // Whether vertex colours or textures vary this material's colour anywhere.
  bool isVaried(size_t material) const;
  int groundMaterial() const { return groundMaterial_; }
  const SceneColors& colors() const { return colors_; }
  const scene::Bounds& bounds() const { return bounds_; }  // without the ground

  const gpu::Buffer& objects() const { return objects_; }
  const gpu::Buffer& chunks() const { return chunks_; }
  uint32_t chunkCount() const { return chunkCount_; }
  const gpu::Buffer& restCore() const { return restCore_; }
  const gpu::Buffer& restFrame() const { return restFrame_; }
  const gpu::Buffer& restSkin() const { return restSkin_; }
  const gpu::Buffer& joints() const { return joints_; }
  const gpu::Buffer& finalCore() const { return finalCore_; }
  const gpu::Buffer& finalFrame() const { return finalFrame_; }
  const gpu::Buffer& surface() const { return surface_; }
  const gpu::Buffer& indices() const { return indices_; }
  // Set 1 of geometry passes: a material's facts and its textures.
  const gpu::SetLayout& materialLayout() const { return materialLayout_; }
  VkDescriptorSet materialSet(uint32_t material) const { return materialSets_[material]; }
  // Called before each frame, since the colours follow the look.
  void setMaterial(size_t material, const shared::MaterialData& data);

  uint64_t triangleCount() const { return triangleCount_; }
  uint64_t uploadedBytes() const { return uploadedBytes_; }

 private:
  void buildGeometry(gpu::Device& device, gpu::Uploader& uploader, const Geometry& geometry);
  void buildMaterials(gpu::Device& device, gpu::Samplers& samplers, gpu::Uploader& uploader);
  void measureColors(const Geometry& geometry);

  const scene::SceneData* data_;
  GeometryOptions options_;
  std::vector<std::string> materialNames_;
  int groundMaterial_ = -1;
  std::vector<Draw> draws_;
  SceneColors colors_;
  scene::Bounds bounds_;
  gpu::Buffer objects_, chunks_, restCore_, restFrame_, restSkin_, joints_, finalCore_, finalFrame_, surface_,
      indices_;
  uint32_t chunkCount_ = 0;
  std::vector<gpu::Image> images_;
  gpu::Buffer materialData_;
  gpu::SetLayout materialLayout_;
  gpu::DescriptorSets materialSets_;
  uint64_t triangleCount_ = 0, uploadedBytes_ = 0;
};

}  // namespace scumble::frame
