#include "world/scene_motion.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "scene/parallel.h"
#include "scene/seen.h"
#include "stage/playing.h"

namespace scumble::world {

namespace {

// Fewer objects than this are placed sooner than threads start.
constexpr size_t kManyObjects = 2000;

template <class T>
gpu::PerFrameBuffer bufferOf(gpu::Device& device, size_t count) {
  return gpu::PerFrameBuffer(device, std::max<size_t>(1, count) * sizeof(T),
                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

// Writes and says whether anything is new.
template <class T>
bool replace(T* target, const T* source, size_t count) {
  if (std::memcmp(target, source, count * sizeof(T)) == 0) return false;
  std::memcpy(target, source, count * sizeof(T));
  return true;
}

// Inverse transpose of the linear part, up to a positive factor.
glm::mat3 normalMatrix(const glm::mat3& linear, bool mirrored) {
  // The cofactor matrix is the inverse transpose times the determinant, and exists for flat matrices too.
  glm::mat3 normal(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                   glm::cross(linear[0], linear[1]));
  // Its entries are products of two lengths; divide by the largest, so that tiny and huge scales keep
  // precision.
  float most = 0;
  for (int i = 0; i < 9; ++i) most = std::max(most, std::abs(normal[i / 3][i % 3]));
  return normal * ((mirrored ? -1.0f : 1.0f) / (most > 0 && std::isfinite(most) ? most : 1.0f));
}

// Whether matrices of joints turn what they bend inside out: most of those that move any vertex do. A skinned
// mesh's own node has no say, since it does not place the vertices either.
bool areMirrored(const scene::PrimitiveExtent& extent, std::span<const glm::mat4> joints) {
  size_t mirrored = 0;
  for (const scene::PrimitiveExtent::Joint& joint : extent.joints)
    mirrored += glm::determinant(glm::mat3(joints[joint.joint])) < 0;
  return 2 * mirrored > extent.joints.size();
}

// As the scene has it, which may be another one than that the object was made for.
const glm::mat4& instanceOf(const scene::SceneData& scene, const MovingObject& object) {
  if (object.node == MovingObject::kNoNode || object.node >= scene.nodes.size()) return object.instance;
  const std::vector<glm::mat4>& instances = scene.nodes[object.node].instances;
  return object.instanceOfNode < instances.size() ? instances[object.instanceOfNode] : object.instance;
}

}  // namespace

SceneMotion::SceneMotion(gpu::Device& device, const scene::SceneData& scene,
                         const std::vector<MovingObject>& moving,
                         const std::vector<shared::ObjectData>& objects, const GeometryOnGpu& geometry)
    : moving_(moving),
      geometry_(geometry),
      chunkCount_(geometry.chunkCount()),
      bounds_(moving.size()),
      mirrored_(moving.size(), 0),
      scales_(moving.size(), 1.0f),
      touched_(moving.size(), 0),
      followed_(&scene) {
  std::vector<shared::ObjectData> placed = objects;
  layout_ = layOut(scene, placed);
  for (const shared::ObjectData& object : placed) influences_.push_back(object.influences);
  objects_ = bufferOf<shared::ObjectData>(device, placed.size());
  joints_ = bufferOf<glm::mat4>(device, layout_.joints);
  morphWeights_ = bufferOf<float>(device, layout_.weights);
  movedChunks_ = bufferOf<uint32_t>(device, chunkCount_);
  std::copy(placed.begin(), placed.end(), objects_.as<shared::ObjectData>());
  for (const MovingObject& object : moving_) writerOf_.push_back(writerOf(object));
}

SceneMotion::Layout SceneMotion::layOut(const scene::SceneData& scene,
                                        std::vector<shared::ObjectData>& objects) const {
  Layout layout;
  layout.isJoint.resize(scene.nodes.size());
  layout.skinUseOf.resize(moving_.size());
  for (const scene::Skin& skin : scene.skins)
    for (const int joint : skin.joints) layout.isJoint[size_t(joint)] = true;
  std::map<std::pair<int, uint32_t>, uint32_t> uses;
  for (size_t i = 0; i < moving_.size(); ++i) {
    const MovingObject& object = moving_[i];
    if (object.skin >= 0) {
      const auto [use, isNew] =
          uses.try_emplace({object.skin, object.material}, uint32_t(layout.skinUses.size()));
      if (isNew) {
        layout.skinUses.push_back({object.skin, object.material, uint32_t(layout.joints)});
        layout.joints += scene.skins[size_t(object.skin)].joints.size();
      }
      layout.skinUseOf[i] = use->second;
      objects[i].firstJoint = layout.skinUses[use->second].firstJoint;
    }
    if (object.morphs) {
      objects[i].firstMorphWeight = uint32_t(layout.weights);
      layout.weights += scene.meshes[size_t(object.mesh)]->morphWeights.size();
    }
  }
  return layout;
}

bool SceneMotion::follow(const scene::SceneData& scene, const std::vector<shared::ObjectData>& objects) {
  if (objects.size() != bounds_.size() || geometry_.chunkCount() != chunkCount_) return false;
  std::vector<shared::ObjectData> placed = objects;
  Layout layout = layOut(scene, placed);
  if (layout.joints != layout_.joints || layout.weights != layout_.weights) return false;
  layout_ = std::move(layout);
  auto* const now = objects_.as<shared::ObjectData>();
  for (size_t i = 0; i < placed.size(); ++i) {
    shared::ObjectData& object = placed[i];
    // Who reads joints or weights from elsewhere now, or is something else to its feature, moves.
    if (object.firstJoint != now[i].firstJoint || object.firstMorphWeight != now[i].firstMorphWeight ||
        object.influences != influences_[i] || object.kind != now[i].kind || object.detail != now[i].detail ||
        writerOf(moving_[i]) != writerOf_[i])
      touched_[i] = 1;
    writerOf_[i] = writerOf(moving_[i]);
    influences_[i] = object.influences;
    // As the last pose has left it.
    object.influences = now[i].influences;
    object.mirrored = now[i].mirrored;
    object.model = now[i].model;
    object.normal = now[i].normal;
    if (moving_[i].feature >= 0) object.patternShift = now[i].patternShift;
  }
  std::copy(placed.begin(), placed.end(), now);
  followed_ = &scene;
  isAtRest_ = false;
  return true;
}

bool SceneMotion::pose(const scene::SceneData& scene, const KnobTable& knobs, double time,
                       const FeatureMoments& features, bool hides) {
  writers_ = 1 + features.size();
  moved_.assign(geometry_.pages().size() * writers_, {});
  const std::vector<scene::PlayedClip> clips = playedClips(scene, knobs.look());
  const bool hasFeature =
      std::any_of(features.begin(), features.end(), [](const auto& feature) { return bool(feature); });
  const bool rests = clips.empty() && !hasFeature && &scene == followed_;
  if (rests && isAtRest_ && written_) return false;
  isAtRest_ = rests;

  // One pose for each length of time that poses stand: joints and morph weights are held for as long as the
  // material that they move says, whatever the look names as long as it says.
  const std::vector<int> named = namedHolds(scene, knobs.look());
  // An earlier scene may have another origin.
  const glm::dmat4 toOrigin = glm::translate(glm::dmat4(1.0), scene.origin - followed_->origin);
  const auto posed = [&](const scene::NodeTimes& times) {
    scene::Pose pose = scene::poseAt(scene, clips, times);
    if (toOrigin != glm::dmat4(1.0))
      for (glm::dmat4& world : pose.world) world = toOrigin * world;
    return pose;
  };
  const auto poseHeldFor = [&](int frames) {
    scene::NodeTimes times;
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
      const double held = heldTime(time, named[n] >= 0 ? named[n] : frames);
      times.transforms.push_back(named[n] >= 0 || layout_.isJoint[n] ? held : time);
      times.morphWeights.push_back(held);
    }
    return posed(times);
  };
  std::map<int, scene::Pose> poses;
  std::vector<const scene::Pose*> poseOf;
  for (size_t m = 0; m < knobs.materialCount(); ++m) {
    const int frames = knobs.of<AnimationParams>(m).hold;
    const auto [pose, isNew] = poses.try_emplace(frames);
    if (isNew) pose->second = poseHeldFor(frames);
    poseOf.push_back(&pose->second);
  }
  const int usual = knobs.scene<AnimationParams>().hold;
  const auto usualPose = poses.find(usual);
  scene::Pose asDrawn = usualPose != poses.end() ? usualPose->second : poseHeldFor(usual);
  worldAsDrawn_ = std::move(asDrawn.world), shownAsDrawn_ = std::move(asDrawn.shown);
  const std::vector<double> now(scene.nodes.size(), time);
  scene::Pose present = posed({now, now});
  world_ = std::move(present.world), shown_ = std::move(present.shown);

  // What features move is where they have it now, however long poses are held; and what hangs on it goes
  // along.
  movedBy_.assign(hasFeature ? scene.nodes.size() : 0, {});
  for (const auto& feature : features)
    if (feature) feature->moveNodes(scene, world_, movedBy_);
  if (std::any_of(movedBy_.begin(), movedBy_.end(), [](const auto& moved) { return bool(moved); })) {
    for (size_t n = 0; n < scene.nodes.size(); ++n)
      if (const int parent = scene.nodes[n].parent; parent >= 0 && movedBy_[size_t(parent)])
        movedBy_[n] = movedBy_[size_t(parent)];
    const auto move = [&](std::vector<glm::dmat4>& world) {
      for (size_t n = 0; n < world.size(); ++n)
        if (movedBy_[n]) world[n] = glm::dmat4(*movedBy_[n]) * world[n];
    };
    for (auto& [frames, pose] : poses) move(pose.world);
    move(world_);
    move(worldAsDrawn_);
  }

  // Joints.
  std::vector<uint8_t> bends(layout_.skinUses.size());
  for (size_t i = 0; i < layout_.skinUses.size(); ++i) {
    const SkinUse& use = layout_.skinUses[i];
    const std::vector<glm::mat4> matrices =
        scene::jointMatrices(scene.skins[size_t(use.skin)], poseOf[use.material]->world);
    bends[i] = replace(joints_.as<glm::mat4>() + use.firstJoint, matrices.data(), matrices.size());
  }

  // Objects. The buffers are asked for once: who asks marks them.
  std::vector<uint8_t> moves(moving_.size());
  auto* const objectData = objects_.as<shared::ObjectData>();
  auto* const morphWeights = morphWeights_.as<float>();
  const glm::mat4* const joints = joints_.as<glm::mat4>();
  scene::parallelFor(
      moving_.size(), moving_.size() < kManyObjects ? 1 : scene::threadCount(0), [&](size_t i) {
        const MovingObject& object = moving_[i];
        const scene::Pose& pose = *poseOf[object.material];
        shared::ObjectData& data = objectData[i];
        const glm::mat4& instance = instanceOf(scene, object);
        glm::mat4 model = object.node == MovingObject::kNoNode
                              ? instance
                              : scene::instanceToWorld(pose.world[object.node], instance);
        const FeatureMoment* const feature =
            object.feature >= 0 ? features[size_t(object.feature)].get() : nullptr;
        if (feature) {
          const FeatureMoment::Place place = feature->placeOf(object.kind);
          model[3] += glm::vec4(place.offset, 0.0f);
          data.patternShift = place.patternShift;
        }
        // What a feature writes, it moves by itself. Joints have moved already: their object takes it back.
        const bool isMovedTwice = object.isWrittenByFeature && object.node != MovingObject::kNoNode;
        if (isMovedTwice && object.skin >= 0)
          model = glm::inverse(movedBy(size_t(scene.skins[size_t(object.skin)].joints.front())));
        else if (isMovedTwice)
          model = glm::inverse(movedBy(object.node)) * model;
        std::span<const glm::mat4> ownJoints;
        if (object.skin >= 0)
          ownJoints = {joints + data.firstJoint, scene.skins[size_t(object.skin)].joints.size()};
        // What is not seen is a point, which nothing draws.
        const bool isShown = object.node == MovingObject::kNoNode || pose.shown[object.node];
        const bool isSeen =
            isShown && (object.skin >= 0 ? std::any_of(ownJoints.begin(), ownJoints.end(), scene::keepsArea)
                                         : scene::keepsArea(model));
        const bool isPoint = hides && !isSeen;
        if (isPoint) model = glm::mat4(0.0f);
        const uint32_t influences = isPoint ? 0 : influences_[i];
        bool changes = object.isWrittenByFeature || !written_ || touched_[i] ||
                       (object.skin >= 0 && bends[layout_.skinUseOf[i]]);
        changes |= replace(&data.influences, &influences, 1);
        if (replace(&data.model, &model, 1) || !written_) {
          const glm::mat3 linear(model);
          if (object.skin < 0) mirrored_[i] = glm::determinant(linear) < 0;
          scales_[i] = largestScale(linear);
          data.normal = normalMatrix(linear, object.skin < 0 && mirrored_[i]);
          changes |= object.skin < 0;
        }
        std::span<const float> weights;
        if (object.morphs) {
          weights = pose.morphWeights[object.node];
          changes |= replace(morphWeights + data.firstMorphWeight, weights.data(), weights.size());
        }
        moves[i] = changes;
        if (!changes && !feature) return;
        if (object.skin >= 0) {
          scales_[i] = 0;
          for (const glm::mat4& joint : ownJoints)
            scales_[i] = std::max(scales_[i], largestScale(glm::mat3(joint)));
          mirrored_[i] = areMirrored(*object.extent, ownJoints);
        }
        data.mirrored = mirrored_[i];
        bounds_[i] = isSeen ? scene::posedBounds(*object.extent, model, ownJoints, weights) : scene::Bounds();
        if (feature) bounds_[i] = feature->boundsOf(object.kind, object.detail, bounds_[i]);
      });
  written_ = true;
  std::fill(touched_.begin(), touched_.end(), uint8_t(0));

  version_ += std::any_of(moves.begin(), moves.end(), [](uint8_t does) { return does != 0; });
  for (size_t i = 0; i < moving_.size(); ++i)
    if (moves[i] && moving_[i].casts) {
      ++castersVersion_;
      break;
    }

  // What is to be written: by page and writer, where first all is counted that is of each.
  const auto forEachMoved = [&](auto&& visit) {
    for (size_t i = 0; i < moving_.size(); ++i) {
      const MovingObject& object = moving_[i];
      const size_t writer = size_t(writerOf(object) + 1);
      for (uint32_t c = 0; moves[i] && c < object.chunkCount; ++c) {
        const uint32_t chunk = object.firstChunk + c;
        visit(chunk, moved_[geometry_.pageOfChunk()[chunk] * writers_ + writer]);
      }
    }
  };
  forEachMoved([](uint32_t, Moved& part) { ++part.count; });
  uint32_t next = 0;
  for (Moved& part : moved_) {
    part.first = next;
    next += part.count;
    part.count = 0;
  }
  auto* const chunks = movedChunks_.as<uint32_t>();
  forEachMoved([&](uint32_t chunk, Moved& part) { chunks[part.first + part.count++] = chunk; });
  return true;
}

void SceneMotion::addUploads(std::vector<gpu::PerFrameBuffer*>& uploads) {
  for (gpu::PerFrameBuffer* buffer : {&objects_, &joints_, &morphWeights_, &movedChunks_})
    uploads.push_back(buffer);
}

}  // namespace scumble::world
