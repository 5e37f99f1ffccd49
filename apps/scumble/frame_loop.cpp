#include "frame_loop.h"

#include "report.h"

namespace scumble::app {

Result<std::unique_ptr<Renderer>> rendererFor(RenderPlan& plan) {
  // What is put over black is so in floats.
  if (plan.output.kind() != OutputKind::exr && !plan.options.transparent)
    plan.options.formats[""] = PixelFormat::srgb8;
  return Renderer::create(plan.args.picture.rendererOptions());
}

Status drawFrames(const RenderPlan& plan, Renderer& renderer, const std::vector<double>& times,
                  Progress& progress, const std::function<Status(size_t, Frame)>& take,
                  const std::function<bool()>& ends) {
  const bool moves = viewsMove(plan.scene, plan.args.picture.viewpoint().value(), plan.look);
  const PictureArguments camera = plan.args.camera();
  const auto viewsAt = [&](double time) {
    return moves ? camera.views(plan.scene, plan.look, time) : Result<std::vector<View>>(plan.views);
  };
  // With two frames under way the device always has work.
  constexpr size_t kUnderWay = 2;
  static_assert(kUnderWay <= size_t(Renderer::kMaxBegun));
  const size_t underWay = plan.args.kind ? 1 : kUnderWay;
  std::optional<Result<Frame>> panorama;
  size_t last = times.size();
  for (size_t next = 0, done = 0; done < last;) {
    // Frames under way are still finished.
    if (ends && ends()) last = next;
    if (done == last) break;
    if (next < last && next - done < underWay) {
      const Result<std::vector<View>> views = viewsAt(times[next]);
      if (!views) return views.error();
      RenderOptions options = plan.options;
      options.previousTime = times[next] - 1 / plan.args.fps;
      const Result<std::vector<View>> previous = viewsAt(*options.previousTime);
      if (!previous) return previous.error();
      options.previousViews = *previous;
      Result<std::shared_ptr<const Image>> behind = plan.background.at(times[next]);
      if (!behind) return behind.error();
      options.background = std::move(behind).value();
      if (plan.args.kind) {
        const Image* const around = options.background.get();
        if (around && around->width != 2 * around->height && done == 0 && !plan.args.quiet)
          warn({"the background goes all around, and is not twice as wide as high: it is stretched"});
        // Many frames in itself: it keeps the device at work alone.
        options.progress = [&](double part) {
          progress.part(part);
          return !(ends && ends());
        };
        panorama = renderPanorama(renderer, plan.scene, plan.look, times[next], views->front(),
                                  plan.args.wanted(), options);
        if (!*panorama) {
          const bool isWanted = panorama->error().kind == ErrorKind::cancelled && ends && ends();
          return isWanted ? Status(Done{}) : panorama->error();
        }
      } else if (const Status status = renderer.begin(plan.scene, plan.look, times[next], *views, options);
                 !status) {
        return status.error();
      }
      ++next;
      continue;
    }
    Result<Frame> frame = panorama ? std::move(*panorama) : renderer.finish();
    if (!frame) return frame.error();
    if (plan.args.picture.validate && renderer.validationMessages() > 0)
      return Error{ErrorKind::internal, "", 0, "", "the validation layers found mistakes",
                   "please report them"};
    if (const Status status = take(done++, std::move(frame).value()); !status) return status.error();
  }
  return Done{};
}

}  // namespace scumble::app
