// A scene in device memory, and the list of draws. It follows a scene that changes, and what of the look goes
// into it, part by part: what did not change stays.
#pragma once

#include <array>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gpu/frames_in_flight.h"
#include "gpu/pipeline.h"
#include "stage/knob_table.h"
#include "stage/palette.h"
#include "stage/viewers.h"
#include "world/draw_list.h"
#include "world/geometry_on_gpu.h"
#include "world/scene_motion.h"
#include "world/surface_colors.h"
#include "world/textures_on_gpu.h"
#include "world/transparent_triangles.h"

namespace scumble::world {

using namespace stage;

// A set of colours, as a texture.
struct SetTexture {
  VkImageView view = VK_NULL_HANDLE;
  gpu::SamplerDesc sampler;
  bool operator==(const SetTexture&) const = default;
};

// Whole sets of colours that a material has: bits.
enum ColorSets : uint8_t { kLitSet = 1, kShadowedSet = 2 };

class SceneOnGpu {
 public:
  // Empty until the first update().
  SceneOnGpu(gpu::Device& device, gpu::Samplers& samplers)
      : device_(device), samplers_(samplers), textures_(device) {}

  // What has become another, of all that others keep.
  struct Changes {
    bool buffers = false;    // names that passes have bound
    bool materials = false;  // how many there are, and which are the ground's and features'
    // What was written to the device.
    uint32_t writtenPrimitives = 0, writtenTextures = 0, writtenMaterials = 0;
  };
  // Brings it up to date; `scene` stays until the next update is over. `drops`: nobody needs its vertices any
  // more when they are on the device, and there is no other update for this scene. Calls `settle`, maybe more
  // than once, before it changes anything that frames under way read. Throws gpu::VulkanError when it does
  // not fit, and is good for nothing then.
  Changes update(const scene::SceneData& scene, const GeometryOptions& options, bool drops,
                 const std::function<void()>& settle);
  // The same where it is up to date.
  void dropVertices() const;
  bool isOf(const scene::SceneData& scene, const GeometryOptions& options) const {
    return data_ == &scene && options_ == options;
  }

  const GeometryOptions& options() const { return options_; }

  const scene::SceneData& data() const { return *data_; }
  // What is shown.
  const DrawList& draws() const { return draws_; }
  // Materials by index: the scene's, then (with a ground) the ground's, then those of features, then those of
  // nodes for which the look sets something.
  size_t materialCount() const { return materialNames_.size(); }
  const std::vector<std::string>& materialNames() const { return materialNames_; }
  // From 1 on, of a name in materialNames(): one of the scene's is the same whichever node it is on.
  size_t materialNumber(size_t material) const {
    const int base = materialUses_[material].base;
    return (base >= 0 ? size_t(base) : material) + 1;
  }
  const std::string& materialName(size_t material) const { return materialNames_[material]; }
  // What the scene has for it; glTF's default material for the ground and for features.
  const scene::Material& material(size_t material) const;
  // What their knobs follow from, in the same order, under a look that these options come from at any time.
  std::vector<KnobTable::Material> knobSubjects() const;
  // Whether vertex colours or textures vary this material's colour anywhere.
  bool isVaried(size_t material) const { return isVaried_[material]; }
  // Which tone of the ground it paints (world/ground.h); -1: none.
  int groundTone(size_t material) const { return materialUses_[material].groundTone; }
  // What the ground itself is painted with; -1: there is none.
  int groundMaterial() const { return groundMaterials_.empty() ? -1 : groundMaterials_[0]; }
  // A feature that is there; null where it is not. `index`: its own among all that there are.
  struct FeatureHere {
    int index;
    uint32_t material;
    const FeaturePlan* plan;
    const FeatureMoment *moment, *previous;  // previous: null before keepPrevious()
  };
  std::optional<FeatureHere> feature(const std::string& name) const;
  // Of the feature that has some; any buffers where none does, which nobody reads then. One feature may.
  FeatureMoment::CutoutBuffers cutouts() const;
  // The plan of the feature whose material it is; null: it is no feature's.
  const FeaturePlan* planOf(size_t material) const;
  const SceneColors& colors() const { return colors_; }
  // Boxes of what casts shadows, world: what each reaches at any time, as far as is known before, so that
  // what depends on it stays from frame to frame; and in the frame's pose.
  const std::vector<scene::Bounds>& casters() const { return casters_; }
  // Is another number whenever what casts shadows is another thing, elsewhere, or has other holes.
  uint64_t castersVersion() const { return castersVersion_ + motion_->castersVersion(); }

  // Sets what moves to its place at a time (seconds). The look has its tracks; `now` are its knobs at that
  // time.
  void pose(const look::LookData& look, const KnobTable& now, double time);
  // Finds out which blended surfaces can be seen; after pose(). (The device finds the others.)
  void look(const Viewers& viewers);
  // The largest factor on a material's inflation that vertices of it have (attribute _WARP), at least 1.
  float warpScaleOf(size_t material) const { return warpScaleOf_[material]; }
  // Where it was a frame ago; after keepPrevious() only. `scene`: what it was then, of the same nodes.
  void posePrevious(const scene::SceneData& scene, const look::LookData& look, const KnobTable& then,
                    double time);
  // The last poses are not on their way to the device after all.
  void forgetPoses();
  // Makes room for the positions of a frame ago, unless there is.
  void keepPrevious();
  const SceneMotion& motion() const { return *motion_; }
  const SceneMotion* previousMotion() const { return previousMotion_ ? &*previousMotion_ : nullptr; }
  // What the CPU writes for each frame.
  void addUploads(std::vector<gpu::PerFrameBuffer*>& uploads);

  const GeometryOnGpu& geometry() const { return geometry_; }
  // What indirectLight() has found, for each final vertex; the same nothing for all, where the stride is 0.
  const gpu::Buffer& indirect() const { return indirect_; }
  uint32_t indirectStride() const { return options_.indirectReach > 0 ? sizeof(glm::u8vec4) : 0; }
  // One vec3 a final vertex; of one vertex only before keepPrevious().
  const gpu::Buffer& previousPositions() const { return previousPositions_; }
  // The triangles of blended draws.
  const TransparentTriangles& transparent() const { return transparent_; }
  // What the scene takes up, whatever its clips do.
  const scene::Bounds& bounds() const { return bounds_; }         // without the ground
  float longestCasterEdge() const { return longestCasterEdge_; }  // metres; longer ones have been split
  // Set 1 of geometry passes: a material's facts and its textures.
  const gpu::SetLayout& materialLayout() const { return materialLayout_; }
  VkDescriptorSet materialSet(uint32_t material) const { return materialSets_[material]; }
  // Called before each frame, since the colours follow the look.
  void setMaterial(size_t material, const shared::MaterialData& data);
  // The sets of colours that a material is drawn with; null: none. A picture stays as long as this does.
  void setColorSets(size_t material, const SetTexture* lit, const SetTexture* shadowed);
  uint8_t colorSets(size_t material) const {
    const MaterialUse& use = materialUses_[material];
    return uint8_t((use.lit.view ? kLitSet : 0) | (use.shadowed.view ? kShadowedSet : 0));
  }
  // What setMaterial() was given last.
  const shared::MaterialData& materialData(size_t material) const;
  // Its textures: base colour, emission, sets of colours for light and shadow; without a view where it has
  // none.
  std::array<SetTexture, 4> textures(size_t material) const;
  // A set of colours that comes with the scene.
  SetTexture textureOf(const scene::TextureUse& use) const;

  // Whether a mapping closes on itself, of any that is drawn.
  bool wraps() const { return wraps_; }
  // Counts up whenever textures are other images: a new one's view may have an old one's name.
  uint32_t texturesVersion() const { return texturesVersion_; }

  uint64_t triangleCount() const { return triangleCount_; }
  uint64_t uploadedBytes() const {
    return geometry_.bytes() + textures_.bytes() + transparent_.bytes() + draws_.bytes();
  }

 private:
  void listMaterials();
  // Gives draws on nodes with settings materials of their own.
  void separateMaterials(Geometry& geometry);
  // True where buffers have other names.
  bool listDraws(const Geometry& geometry, const std::function<void()>& settle);
  void placeIndirect(gpu::Uploader& uploader, const std::vector<std::vector<glm::u8vec4>>& indirect,
                     const std::function<void()>& settle);
  // True where buffers have other names.
  bool followFeatures(const std::function<void()>& settle);
  // True where the buffers have other names.
  bool followMotion(bool otherPlaces, const std::function<void()>& settle);
  // How many were written.
  uint32_t writeMaterials(bool otherTextures, const std::function<void()>& settle);

  struct MaterialUse {
    int base;               // in the scene; -1 for the ground and features
    uint32_t settings = 0;  // in NodeSettings::lists
    int groundTone = -1;
    SetTexture lit{}, shadowed{};
  };

  // Of a material's textures: which image, and how it is read.
  using TextureBindings = std::array<std::pair<int, gpu::SamplerDesc>, 2>;

  gpu::Device& device_;
  gpu::Samplers& samplers_;
  const scene::SceneData* data_ = nullptr;
  GeometryOptions options_;
  MadePrimitives made_;
  std::vector<std::string> materialNames_;
  std::vector<MaterialUse> materialUses_;
  std::vector<int> groundMaterials_;   // by tone
  std::vector<int> featureMaterials_;  // by feature; -1: it is not there
  DrawList draws_;
  bool arePlaced_ = false;            // draws_ and casters_, in the last pose
  std::vector<scene::Bounds> reach_;  // by draw, world: at any time as far as is known before
  std::vector<scene::Bounds> casters_;
  uint32_t texturesVersion_ = 0;
  uint64_t castersVersion_ = 0;
  bool wraps_ = false;
  std::vector<float> warpScaleOf_;  // by material
  std::vector<bool> isVaried_;      // by material
  SurfaceColors surfaceColors_;
  SceneColors colors_;
  scene::Bounds bounds_;
  float longestCasterEdge_ = 0;
  GeometryOnGpu geometry_;
  TexturesOnGpu textures_;
  gpu::Buffer indirect_;
  gpu::Buffer previousPositions_;
  std::vector<shared::ObjectData> objects_;  // without what moves
  std::vector<MovingObject> moving_;
  TransparentTriangles transparent_;
  FeatureMoments features_, previousFeatures_;  // the latter empty before keepPrevious()
  std::optional<SceneMotion> motion_, previousMotion_;
  gpu::PerFrameBuffer materialData_;
  gpu::SetLayout materialLayout_;
  gpu::DescriptorSets materialSets_;
  std::vector<TextureBindings> materialTextures_;  // as they were written last
  uint64_t triangleCount_ = 0;
};

}  // namespace scumble::world
