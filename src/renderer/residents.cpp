// What a renderer keeps on the device: scenes, the picture behind everything, and what frames are drawn with.
#include <algorithm>

#include "renderer/impl.h"
#include "scene/drop_vertices.h"

namespace scumble {

using namespace frame;
using namespace renderer;

Resident* Renderer::Impl::useScene(const Scene& wanted, const GeometryOptions& options, bool drops,
                                   FrameStats& stats) {
  const auto found = std::find_if(residents.begin(), residents.end(), [&](const Resident& resident) {
    const scene::SceneData &is = resident.scene.data(), &becomes = wanted.data();
    return &is == &becomes || (is.family != 0 && is.family == becomes.family);
  });
  const bool isThere = found != residents.end() && found->onGpu.isOf(wanted.data(), options);
  if (!isThere && scene::hasDroppedVertices(wanted.data())) return nullptr;
  if (found != residents.end()) {
    residents.splice(residents.begin(), residents, found);
  } else {
    fetchAll();
    keepBudget(0);
    residents.emplace_front(*device, *samplers, wanted);
  }
  Resident& resident = residents.front();
  if (isThere) {
    if (drops) resident.onGpu.dropVertices();
    return &resident;
  }
  try {
    const SceneOnGpu::Changes changes =
        resident.onGpu.update(wanted.data(), options, drops, [&] { fetchAll(); });
    resident.scene = wanted;
    stats.writtenPrimitives = changes.writtenPrimitives;
    stats.writtenTextures = changes.writtenTextures;
    stats.writtenMaterials = changes.writtenMaterials;
    if (changes.materials)
      resident.setups.clear();
    else if (changes.buffers)
      for (const std::unique_ptr<Setup>& setup : resident.setups) setup->bindScene();
  } catch (...) {
    // What is half of one and half of the other goes, when nobody draws from it any more.
    for (auto& submission : submissions) submission.reset();
    residents.pop_front();
    abandon();
    throw;
  }
  return &resident;
}

void Renderer::Impl::keepBudget(size_t least) {
  auto last = residents.end();
  while (std::distance(residents.begin(), last) > ptrdiff_t(least) &&
         device->memory().bytesInUse() > sceneBudget) {
    --last;
    // Nobody else has vertices that were dropped.
    if (scene::hasDroppedVertices(last->scene.data()) && RendererAccess::isHeldElsewhere(last->scene))
      continue;
    fetchAll();
    last = residents.erase(last);
  }
}

void Renderer::Impl::useBackdrop(const glm::uvec2& texels) {
  if ((backdrop ? backdrop->size() : glm::uvec2(0)) == texels) return;
  fetchAll();
  for (Resident& resident : residents) resident.setups.clear();
  backdrop.reset();
  if (texels.x > 0) backdrop.emplace(*device, texels);
}

void Renderer::Impl::useSetups(Resident& resident, const std::vector<SetupKey>& keys, Begun& frame,
                               const std::function<void(double)>& progress) {
  std::vector<std::unique_ptr<Setup>>& had = resident.setups;
  std::vector<std::unique_ptr<Setup>> now(keys.size());
  // Those that fit as they are; then those that fit but for their size.
  for (const bool sizeToo : {true, false})
    for (size_t i = 0; i < keys.size(); ++i)
      for (std::unique_ptr<Setup>& setup : had)
        if (!now[i] && setup && setup->key() == keys[i] &&
            (!sizeToo || setup->size() == frame.parts[i].group.size))
          now[i] = std::move(setup);
  bool fits = std::none_of(had.begin(), had.end(), [](const auto& setup) { return bool(setup); });
  for (size_t i = 0; i < keys.size(); ++i) fits &= now[i] && now[i]->size() == frame.parts[i].group.size;
  if (!fits) {
    // Frames under way may use what changes or goes.
    for (std::unique_ptr<Setup>& setup : had)
      if (setup) now.push_back(std::move(setup));
    fetchAll();
    now.resize(keys.size());
    for (size_t i = 0; i < keys.size(); ++i)
      if (now[i]) now[i]->resize(frame.parts[i].group.size);
    const VkBuffer positions = resident.onGpu.previousPositions().handle();
    for (size_t i = 0; i < keys.size(); ++i)
      if (!now[i])
        now[i] =
            std::make_unique<Setup>(*device, *samplers, *examples, resident.onGpu,
                                    keys[i].plain ? plain : passes, keys[i], frame.parts[i].group.size,
                                    [&](double part) { progress((double(i) + part) / double(keys.size())); });
    // One that needs to know where everything was has made room for it: others name what was there before.
    if (resident.onGpu.previousPositions().handle() != positions)
      for (const std::unique_ptr<Setup>& setup : now) setup->bindScene();
  }
  had = std::move(now);
  for (size_t i = 0; i < keys.size(); ++i) frame.parts[i].setup = had[i].get();
}

}  // namespace scumble
