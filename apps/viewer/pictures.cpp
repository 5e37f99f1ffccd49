#include "pictures.h"

#include <algorithm>
#include <utility>

namespace scumble::viewer {

namespace {

constexpr uint32_t kThumbnailWidth = 224, kLookWidth = 320;  // pixels
// What is told of a pixel.
const std::vector<std::string> kFacts{"depth", "position", "normal", "uv", "id"};

}  // namespace

Pictures::Pictures(std::unique_ptr<Renderer> renderer, const PictureOptions& options,
                   std::function<void()> whenDone)
    : options_(options), isOnCpu_(renderer->gpu().isCpu), maker_(std::move(renderer), std::move(whenDone)) {}

std::optional<double> Pictures::untilDue(double now) const {
  if (!isCoarse_ || !shown_) return std::nullopt;
  return std::max(sharpness_.untilRest(now), 0.0);
}

void Pictures::begin(const Document& document, const Moment& moment, const glm::uvec2& full, double now) {
  document_ = &document, moment_ = moment, full_ = full;
  size_ = sharpness_.isMoving(now) ? sharpness_.sizeWhileMoving(full) : full;
  // Where pictures are slow, the first one comes soon.
  if (!shown_ && isOnCpu_) size_ = Sharpness::coarsest(full);
  isCoarse_ = size_ != full;
  isAsked_.clear();
  if (picking_) {
    Wish wish = wishOf(document.look());
    wish.size = glm::max(full / 2u, 1u);
    wish.stereo = moment.stereo;
    wish.aovs = {"id", "position"}, wish.aovView = pickView_;
    pickNumber_ = maker_.wish(kPick, std::move(wish));
    pickedAt_ = *std::exchange(picking_, std::nullopt);
  }
}

Wish Pictures::wishOf(const Look& look) const {
  Wish wish{document_->scene(), look, moment_.viewpoint, moment_.time};
  wish.samples = options_.samples, wish.seed = options_.seed;
  wish.background = document_->background();
  wish.ipd = options_.ipd;
  return wish;
}

// `what`: of its purpose, besides what is the same for all.
void Pictures::ask(int purpose, const glm::uvec2& size, const std::string& what, Wish wish) {
  isAsked_.insert(purpose);
  Asked asked{document_->version(), moment_.moves, moment_.time, size, wish.stereo, what};
  const auto before = asked_.find(purpose);
  if (before != asked_.end() && before->second == asked) return;
  asked_[purpose] = std::move(asked);
  wish.size = size;
  maker_.wish(purpose, std::move(wish));
}

void Pictures::askForShown(bool savedLook) {
  Wish wish = wishOf(savedLook ? document_->savedLook() : document_->look());
  wish.stereo = moment_.stereo;
  ask(kShown, size_, savedLook ? "saved" : "", std::move(wish));
}

void Pictures::askForOther(const std::string& name, const Look& look) {
  ask(kOther, size_, name, wishOf(look));
}

// As wide as that, at the window's aspect.
glm::uvec2 Pictures::smallSize(uint32_t width) const {
  return {width, std::max(1u, uint32_t(uint64_t(width) * full_.y / std::max(full_.x, 1u)))};
}

// What rests only: small ones are as dear as large ones where there are twenty of them.
void Pictures::askForThumbnails() {
  if (isCoarse_) {
    isAsked_.insert(kThumbnails);
    return;
  }
  Wish wish = wishOf(document_->look());
  wish.aovs = Renderer::aovNames();
  ask(kThumbnails, smallSize(kThumbnailWidth), "", std::move(wish));
}

void Pictures::askForPass(const std::string& aov) {
  Wish wish = wishOf(document_->look());
  wish.aovs = kFacts;
  if (!aov.empty() && std::find(kFacts.begin(), kFacts.end(), aov) == kFacts.end()) wish.aovs.push_back(aov);
  ask(kPass, size_, aov, std::move(wish));
}

void Pictures::askForLooks(const std::vector<std::pair<std::string, Look>>& looks) {
  for (size_t i = 0; i < looks.size(); ++i)
    if (isCoarse_)
      isAsked_.insert(kLooks + int(i));
    else
      ask(kLooks + int(i), smallSize(kLookWidth), looks[i].first, wishOf(looks[i].second));
}

void Pictures::end() {
  std::vector<int> forgotten;
  for (const auto& [purpose, asked] : asked_)
    if (!isAsked_.count(purpose)) forgotten.push_back(purpose);
  for (const int purpose : forgotten) {
    maker_.forget(purpose);
    asked_.erase(purpose);
  }
}

void Pictures::pick(const glm::vec2& place, size_t view) {
  picking_ = place;
  pickView_ = view;
}

std::optional<Picked> Pictures::takePicked() {
  return std::exchange(picked_, std::nullopt);
}

bool Pictures::poll() {
  if (std::shared_ptr<const Picture> picture = maker_.latest(kPick);
      picture && picture->number == pickNumber_ && picture->layers.size() == 2) {
    const Image& id = picture->layers[0].values;
    const auto x = std::min(uint32_t(pickedAt_.x * float(id.width)), id.width - 1),
               y = std::min(uint32_t(pickedAt_.y * float(id.height)), id.height - 1);
    const auto name = [&](const std::vector<std::string>& names, uint32_t channel) {
      const auto number = size_t(id.at(x, y, channel));
      return number > 0 && number <= names.size() ? names[number - 1] : "";
    };
    const Image& place = picture->layers[1].values;
    picked_ = Picked{name(picture->objects, 0),
                     name(picture->materials, 1),
                     {place.at(x, y, 0), place.at(x, y, 1), place.at(x, y, 2)}};
    maker_.forget(kPick);
  }
  if (std::shared_ptr<const Picture> latest = maker_.latest(kShown); latest && latest != shown_) {
    const VkExtent2D extent = latest->image.extent();
    sharpness_.drew({extent.width, extent.height}, latest->milliseconds);
    shown_ = std::move(latest);
  }
  return maker_.takeNews();
}

}  // namespace scumble::viewer
