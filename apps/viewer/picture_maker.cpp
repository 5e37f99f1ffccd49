#include "picture_maker.h"

#include <algorithm>
#include <utility>

#include "visible.h"

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

uint64_t PictureMaker::wish(int purpose, Wish wish) {
  const std::lock_guard lock(mutex_);
  const uint64_t number = ++number_;
  waiting_[purpose] = {number, std::move(wish)};
  wanted_.insert(purpose);
  changed_.notify_all();
  return number;
}

void PictureMaker::forget(int purpose) {
  const std::lock_guard lock(mutex_);
  waiting_.erase(purpose);
  wanted_.erase(purpose);
  latest_.erase(purpose);
}

bool PictureMaker::takeNews() {
  const std::lock_guard lock(mutex_);
  return std::exchange(isNews_, false);
}

std::shared_ptr<const Picture> PictureMaker::latest(int purpose) const {
  const std::lock_guard lock(mutex_);
  const auto found = latest_.find(purpose);
  return found == latest_.end() ? nullptr : found->second;
}

std::optional<Error> PictureMaker::takeFailure() {
  const std::lock_guard lock(mutex_);
  return std::exchange(failure_, std::nullopt);
}

void PictureMaker::run() {
  for (int purpose = -1;;) {
    Waiting next;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return isEnding_ || !waiting_.empty(); });
      if (isEnding_) return;
      // What moves is always wanted anew: others get their turn between.
      auto chosen = waiting_.begin();
      if (chosen->first == purpose && waiting_.size() > 1) ++chosen;
      purpose = chosen->first;
      next = std::move(chosen->second);
      waiting_.erase(chosen);
    }
    Result<std::shared_ptr<Picture>> drawn = tryDraw(next.wish);
    {
      const std::lock_guard lock(mutex_);
      // Nobody wants it any more where its purpose was forgotten.
      isNews_ = true;
      if (wanted_.count(purpose)) {
        if (drawn) {
          drawn.value()->number = next.number;
          latest_[purpose] = drawn.value();
        } else {
          failure_ = drawn.error();
        }
      }
    }
    whenDone_();
  }
}

// One that nobody looks at. Those of other sizes go, but for what is being looked at.
std::shared_ptr<Picture> PictureMaker::blank(const glm::uvec2& size, Stereo stereo) {
  const std::lock_guard lock(mutex_);
  const auto fits = [&](const Picture& picture) {
    const VkExtent2D extent = picture.image.extent();
    const bool hasRight = picture.right.handle() != VK_NULL_HANDLE;
    return extent.width == size.x && extent.height == size.y && hasRight == (stereo == Stereo::stereo);
  };
  std::erase_if(pictures_, [&](const std::shared_ptr<Picture>& picture) {
    return picture.use_count() == 1 && !fits(*picture);
  });
  for (const std::shared_ptr<Picture>& picture : pictures_)
    if (picture.use_count() == 1) return picture;
  constexpr VkImageUsageFlags kUsage =
      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  auto made = std::make_shared<Picture>();
  made->image = DeviceImage(device_, Picture::kFormat, {size.x, size.y}, kUsage, "picture");
  if (stereo == Stereo::stereo)
    made->right = DeviceImage(device_, Picture::kFormat, {size.x, size.y}, kUsage, "picture, right eye");
  return pictures_.emplace_back(std::move(made));
}

// What nobody has foreseen, such as too little memory, is a problem like others.
Result<std::shared_ptr<Picture>> PictureMaker::tryDraw(const Wish& wish) {
  try {
    return draw(wish);
  } catch (const VulkanFailure& failure) {
    return Error{ErrorKind::noUsableGpu, "", 0, "", failure.what(), "make the window smaller"};
  } catch (const std::exception& failure) {
    return Error{ErrorKind::internal, "", 0, "", failure.what(), "make the window smaller"};
  }
}

Result<std::shared_ptr<Picture>> PictureMaker::draw(const Wish& wish) {
  const Result<std::vector<View>> views =
      makeViews(wish.scene, wish.viewpoint, float(wish.size.x) / float(wish.size.y), wish.stereo, wish.ipd,
                wish.look, wish.time);
  if (!views) return views.error();
  const std::shared_ptr<Picture> picture = blank(wish.size, wish.stereo);
  RenderOptions options;
  options.width = wish.size.x, options.height = wish.size.y;
  options.samples = wish.samples, options.seed = wish.seed;
  options.background = wish.background;
  options.aovs = wish.aovs;
  options.progress = [this](double) {
    const std::lock_guard lock(mutex_);
    return !isEnding_;
  };
  VulkanTargets targets;
  for (size_t view = 0; view < views->size(); ++view) {
    const DeviceImage& image = view == 0 ? picture->image : picture->right;
    VulkanTarget& target = targets.images.emplace_back();
    target.image = image.handle();
    target.format = Picture::kFormat;
    target.extent = image.extent();
    target.view = view;
  }
  if (const Status begun = begin(*renderer_, wish.scene, wish.look, wish.time, *views, options, targets);
      !begun)
    return begun.error();
  const Result<Frame> frame = renderer_->finish();
  if (!frame) return frame.error();
  picture->milliseconds = frame->stats.gpuMilliseconds + frame->stats.cpuMilliseconds;
  picture->steps = frame->stats.passes;
  picture->objects = frame->objects, picture->materials = frame->materials;
  picture->layers.clear();
  for (const std::string& aov : wish.aovs)
    for (const Frame::Layer& layer : frame->layers)
      if (layer.name == aov) {
        const Image& values = layer.views[std::min(wish.aovView, layer.views.size() - 1)];
        picture->layers.push_back({aov, values,
                                   uploaded(device_, {values.width, values.height},
                                            visibleBytes(values, aov).data(), "AOV " + aov)});
      }
  return picture;
}

}  // namespace scumble::viewer
