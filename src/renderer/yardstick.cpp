#include "scumble/yardstick.h"

#include "renderer/impl.h"

namespace scumble {

Result<Frame> renderYardstick(Renderer& renderer, const Scene& scene, const Look& look, double time,
                              const std::vector<View>& views, const RenderOptions& options) {
  renderer::Request request{scene, look.data(), time, views, options};
  request.isYardstick = true;
  return RendererAccess::render(renderer, request);
}

}  // namespace scumble
