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
    : options_(options), maker_(std::move(renderer), std::move(whenDone)) {}

std::optional<double> Pictures::untilDue(double now) const {
  if (!isCoarse_) return std::nullopt;
  return std::max(sharpness_.untilRest(now), 0.0);
}

void Pictures::begin(const Document& document, const Moment& moment, const glm::uvec2& full, double now) {
  document_ = &document, moment_ = moment, full_ = full;
  size_ = sharpness_.isMoving(now) ? sharpness_.sizeWhileMoving(full) : full;
  isCoarse_ = size_ != full;
  isAsked_.clear();
  if (picking_) {
    const glm::uvec2 size = glm::max(full / 2u, 1u);
    Wish wish = wishOf(document.look(), size);
    wish.aovs = {"id"};
    pickNumber_ = maker_.wish(kPick, std::move(wish));
    pickedAt_ = *std::exchange(picking_, std::nullopt);
  }
}

Wish Pictures::wishOf(const Look& look, const glm::uvec2& size) const {
  return {
      document_->scene(),      look, moment_.viewpoint, moment_.time, size, options_.samples, options_.seed,
      document_->background(), {}};
}

void Pictures::ask(int purpose, const glm::uvec2& size, const std::string& what, const Look& look,
                   std::vector<std::string> aovs) {
  isAsked_.insert(purpose);
  Asked asked{document_->version(), moment_.moves, moment_.time, size, what};
  const auto before = asked_.find(purpose);
  if (before != asked_.end() && before->second == asked) return;
  asked_[purpose] = std::move(asked);
  Wish wish = wishOf(look, size);
  wish.aovs = std::move(aovs);
  maker_.wish(purpose, std::move(wish));
}

void Pictures::askForShown(bool savedLook) {
  ask(kShown, size_, savedLook ? "saved" : "", savedLook ? document_->savedLook() : document_->look());
}

void Pictures::askForOther(const std::string& name, const Look& look) {
  ask(kOther, size_, name, look);
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
  ask(kThumbnails, smallSize(kThumbnailWidth), "", document_->look(), Renderer::aovNames());
}

void Pictures::askForPass(const std::string& aov) {
  std::vector<std::string> aovs = kFacts;
  if (!aov.empty() && std::find(aovs.begin(), aovs.end(), aov) == aovs.end()) aovs.push_back(aov);
  ask(kPass, size_, aov, document_->look(), std::move(aovs));
}

void Pictures::askForLooks(const std::vector<std::pair<std::string, Look>>& looks) {
  for (size_t i = 0; i < looks.size(); ++i)
    if (isCoarse_)
      isAsked_.insert(kLooks + int(i));
    else
      ask(kLooks + int(i), smallSize(kLookWidth), looks[i].first, looks[i].second);
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

void Pictures::pick(const glm::vec2& place) {
  picking_ = place;
}

std::optional<Picked> Pictures::takePicked() {
  return std::exchange(picked_, std::nullopt);
}

bool Pictures::poll() {
  if (std::shared_ptr<const Picture> picture = maker_.latest(kPick);
      picture && picture->number == pickNumber_ && !picture->layers.empty()) {
    const Image& id = picture->layers[0].values;
    const auto x = std::min(uint32_t(pickedAt_.x * float(id.width)), id.width - 1),
               y = std::min(uint32_t(pickedAt_.y * float(id.height)), id.height - 1);
    const auto name = [&](const std::vector<std::string>& names, uint32_t channel) {
      const auto number = size_t(id.at(x, y, channel));
      return number > 0 && number <= names.size() ? names[number - 1] : "";
    };
    picked_ = Picked{name(picture->objects, 0), name(picture->materials, 1)};
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
