// Draws pictures beside the window, on a thread of its own, so that the window never waits for one.
#pragma once

#include <condition_variable>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "vulkan_parts.h"

namespace scumble::viewer {

struct Wish {
  Scene scene;
  Look look;
  Viewpoint viewpoint;
  double time = 0;  // seconds
  glm::uvec2 size{0};
  uint32_t samples = 4, seed = 0;
  std::shared_ptr<const Image> background;
  Stereo stereo = Stereo::mono;
  float ipd = 0.063f;             // metres
  std::vector<std::string> aovs;  // to be looked at, and read, beside the picture
  size_t aovView = 0;             // and of which view
};

struct Picture {
  static constexpr VkFormat kFormat = VK_FORMAT_R8G8B8A8_UNORM;  // in sRGB's curve

  struct Layer {
    std::string aov;
    Image values;
    DeviceImage shown;  // as visible.h has it
  };
  DeviceImage image;        // VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL; of the left eye where there are two
  DeviceImage right;        // likewise; none of a picture in mono
  uint64_t number = 0;      // of the wish: they grow
  double milliseconds = 0;  // without what only a first one takes: uploads and compiling
  std::vector<PassTime> steps;
  std::vector<Layer> layers;                    // in the wish's order
  std::vector<std::string> objects, materials;  // Frame's, where one of the layers names them
};

class PictureMaker {
 public:
  // `whenDone`: called by the thread after each picture and each failure.
  PictureMaker(std::unique_ptr<Renderer> renderer, std::function<void()> whenDone);
  ~PictureMaker();  // what is being drawn is given up
  PictureMaker(const PictureMaker&) = delete;
  PictureMaker& operator=(const PictureMaker&) = delete;

  // `purpose`: pictures of different ones do not replace each other. Of those that wait the one of the lowest
  // is drawn first, but none twice while others wait; what was wished before for the same one and has not
  // begun is not drawn at all. Gives the wish's number.
  uint64_t wish(int purpose, Wish wish);
  // Neither drawn any more nor kept.
  void forget(int purpose);
  // The last one that is done; null before the first. As long as somebody has it nothing is drawn into it.
  std::shared_ptr<const Picture> latest(int purpose) const;
  // Whether a picture was done, or one has failed, since the last call.
  bool takeNews();
  // What went wrong last, once.
  std::optional<Error> takeFailure();
  // While no picture is being made.
  const Renderer& renderer() const { return *renderer_; }

 private:
  void run();
  std::shared_ptr<Picture> blank(const glm::uvec2& size, Stereo stereo);
  Result<std::shared_ptr<Picture>> tryDraw(const Wish& wish);
  Result<std::shared_ptr<Picture>> draw(const Wish& wish);

  const std::unique_ptr<Renderer> renderer_;
  const VulkanDevice device_;
  const std::function<void()> whenDone_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  struct Waiting {
    uint64_t number = 0;
    Wish wish;
  };
  std::map<int, Waiting> waiting_;
  std::set<int> wanted_;  // purposes that were not forgotten
  uint64_t number_ = 0;
  bool isEnding_ = false, isNews_ = false;
  std::map<int, std::shared_ptr<const Picture>> latest_;
  std::optional<Error> failure_;
  std::vector<std::shared_ptr<Picture>> pictures_;  // the thread's own
  std::thread thread_;
};

}  // namespace scumble::viewer
