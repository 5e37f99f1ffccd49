#include "picture_maker.h"

#include <algorithm>

namespace scumble::viewer {

PictureMaker::PictureMaker(std::unique_ptr<Renderer> renderer, std::function<void()> whenDone)
    : renderer_(std::move(renderer)), device_(vulkanDeviceOf(*renderer_)), whenDone_(std::move(whenDone)) {
  thread_ = std::thread([this] { run(); });
}

PictureMaker::~PictureMaker() {
  {
    const std::lock_guard lock(mutex_);
    isEnding_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PictureMaker::wish(Wish wish) {
  const std::lock_guard lock(mutex_);
  next_ = std::move(wish);
  changed_.notify_all();
  ++number_;
}

std::shared_ptr<const Picture> PictureMaker::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

std::optional<Error> PictureMaker::takeFailure() {
  const std::lock_guard lock(mutex_);
  return std::exchange(failure_, std::nullopt);
}

void PictureMaker::run() {
  for (;;) {
    Wish wish;
    uint64_t number = 0;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return isEnding_ || next_; });
      if (isEnding_) return;
      wish = std::move(*next_);
      next_.reset();
      number = number_;
    }
    Result<std::shared_ptr<Picture>> drawn = draw(wish);
    {
      const std::lock_guard lock(mutex_);
      if (drawn) {
        drawn.value()->number = number;
        latest_ = drawn.value();
      } else {
        failure_ = drawn.error();
      }
    }
    whenDone_();
  }
}

// One that nobody looks at. Those of other sizes go, but for what is being looked at.
std::shared_ptr<Picture> PictureMaker::blank(const glm::uvec2& size) {
  const std::lock_guard lock(mutex_);
  std::erase_if(pictures_, [&](const std::shared_ptr<Picture>& picture) {
    const VkExtent2D extent = picture->image.extent();
    return picture.use_count() == 1 && (extent.width != size.x || extent.height != size.y);
  });
  for (const std::shared_ptr<Picture>& picture : pictures_)
    if (picture.use_count() == 1) return picture;
  auto made = std::make_shared<Picture>();
  made->image = Image(
      device_, Picture::kFormat, {size.x, size.y},
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  return pictures_.emplace_back(std::move(made));
}

Result<std::shared_ptr<Picture>> PictureMaker::draw(const Wish& wish) {
  const Result<std::vector<View>> views =
      makeViews(wish.scene, wish.viewpoint, float(wish.size.x) / float(wish.size.y), Stereo::mono, 0.063f,
                wish.look, wish.time);
  if (!views) return views.error();
  std::shared_ptr<Picture> picture;
  try {
    picture = blank(wish.size);
  } catch (const VulkanFailure& failure) {
    return Error{ErrorKind::noUsableGpu, "", 0, "", failure.what(), "make the window smaller"};
  }
  RenderOptions options;
  options.width = wish.size.x, options.height = wish.size.y;
  options.samples = wish.samples, options.seed = wish.seed;
  options.progress = [this](double) {
    const std::lock_guard lock(mutex_);
    return !isEnding_;
  };
  VulkanTargets targets;
  VulkanTarget& target = targets.images.emplace_back();
  target.image = picture->image.handle();
  target.format = Picture::kFormat;
  target.extent = picture->image.extent();
  if (const Status begun = begin(*renderer_, wish.scene, wish.look, wish.time, *views, options, targets);
      !begun)
    return begun.error();
  const Result<Frame> frame = renderer_->finish();
  if (!frame) return frame.error();
  picture->milliseconds = frame->stats.gpuMilliseconds + frame->stats.cpuMilliseconds;
  return picture;
}

}  // namespace scumble::viewer
