// embed SCENE.glb PICTURE.png: the library in twenty lines.
#include <scumble/renderer.h>

#include <cstdio>

int main(int argc, char** argv) {
  using namespace scumble;
  if (argc != 3) return std::puts("usage: embed SCENE.glb PICTURE.png"), 2;
  const auto report = [](const Error& error) {
    return std::fprintf(stderr, "%s\n", error.message().c_str()), 1;
  };

  const Result<Scene> scene = Scene::load(argv[1]);
  if (!scene) return report(scene.error());
  Look look;
  if (const Status set = look.set("shadow.threshold", "0.45"); !set) return report(set.error());
  const Result<std::vector<View>> views = makeViews(*scene, Viewpoint{}, 16.0f / 9.0f);
  if (!views) return report(views.error());
  const Result<std::unique_ptr<Renderer>> renderer = Renderer::create();
  if (!renderer) return report(renderer.error());
  const Result<Frame> frame = (*renderer)->render(*scene, look, 0.0, *views, RenderOptions{});
  if (!frame) return report(frame.error());
  const Status written = writePng(argv[2], frame->layers[0].views[0]);
  return written ? 0 : report(written.error());
}
