// Frames on a device, and in images, of the program's own.
#include "scumble/vulkan.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <future>
#include <glm/gtc/packing.hpp>
#include <mutex>
#include <numeric>

#include "scumble/scene_editor.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

void expectDone(VkResult result) {
  if (result != VK_SUCCESS) throw std::runtime_error("Vulkan: " + std::to_string(result));
}

// An instance with the validation layers, a device and a queue, as a program would make them.
class Program {
 public:
  Program() {
    const VkValidationFeatureEnableEXT enabled[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT validation{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    validation.enabledValidationFeatureCount = 1;
    validation.pEnabledValidationFeatures = enabled;
    const VkApplicationInfo application{
        VK_STRUCTURE_TYPE_APPLICATION_INFO, nullptr, "engine", 1, "engine", 1, VK_API_VERSION_1_3};
    const char* const layer = "VK_LAYER_KHRONOS_validation";
    const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, &validation};
    info.pApplicationInfo = &application;
    info.enabledLayerCount = 1, info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = 1, info.ppEnabledExtensionNames = &extension;
    expectDone(vkCreateInstance(&info, nullptr, &device.instance));
    VkDebugUtilsMessengerCreateInfoEXT messages{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messages.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messages.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messages.pfnUserCallback = [](VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                  const VkDebugUtilsMessengerCallbackDataEXT* data, void* text) -> VkBool32 {
      static_cast<std::string*>(text)->append(data->pMessage).append("\n");
      return VK_FALSE;
    };
    messages.pUserData = &messages_;
    reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
        device.instance, "vkCreateDebugUtilsMessengerEXT"))(device.instance, &messages, nullptr, &messenger_);

    // The device that the other tests draw on.
    const std::string name = vulkanDeviceName();
    uint32_t count = 0;
    vkEnumeratePhysicalDevices(device.instance, &count, nullptr);
    std::vector<VkPhysicalDevice> candidates(count);
    vkEnumeratePhysicalDevices(device.instance, &count, candidates.data());
    for (const VkPhysicalDevice candidate : candidates) {
      VkPhysicalDeviceProperties properties;
      vkGetPhysicalDeviceProperties(candidate, &properties);
      if (name == properties.deviceName) device.physical = candidate;
    }
    if (!device.physical || !whyUnusable(device.physical).empty())
      throw std::runtime_error("no device " + name);

    VulkanFeatures features;
    requireVulkanFeatures(features);
    features.timelineSemaphore.timelineSemaphore = VK_TRUE;  // the program's own wish
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue{
        VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, 0, 1, &priority};
    VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features.core};
    deviceInfo.queueCreateInfoCount = 1, deviceInfo.pQueueCreateInfos = &queue;
    expectDone(vkCreateDevice(device.physical, &deviceInfo, nullptr, &device.device));
    vkGetDeviceQueue(device.device, 0, 0, &device.queue);
    const VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    expectDone(vkCreateCommandPool(device.device, &pool, nullptr, &pool_));
  }
  ~Program() {
    vkDeviceWaitIdle(device.device);
    for (const OwnImage& image : images_) {
      vkDestroyImage(device.device, image.image, nullptr);
      vkFreeMemory(device.device, image.memory, nullptr);
    }
    for (const VkSemaphore semaphore : semaphores_) vkDestroySemaphore(device.device, semaphore, nullptr);
    vkDestroyCommandPool(device.device, pool_, nullptr);
    vkDestroyDevice(device.device, nullptr);
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
        device.instance, "vkDestroyDebugUtilsMessengerEXT"))(device.instance, messenger_, nullptr);
    vkDestroyInstance(device.instance, nullptr);
    EXPECT_EQ(messages_, "");
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  VkImage image(VkFormat format, VkExtent2D extent, uint32_t layers = 1) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = 1, info.arrayLayers = layers;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage =
        VkImageUsageFlags(format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                                         : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT) |
        VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    OwnImage made;
    expectDone(vkCreateImage(device.device, &info, nullptr, &made.image));
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device.device, made.image, &needs);
    made.memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    expectDone(vkBindImageMemory(device.device, made.image, made.memory, 0));
    images_.push_back(made);
    return made.image;
  }

  VkSemaphore timeline() {
    const VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO, nullptr,
                                         VK_SEMAPHORE_TYPE_TIMELINE, 0};
    const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type};
    VkSemaphore semaphore;
    expectDone(vkCreateSemaphore(device.device, &info, nullptr, &semaphore));
    semaphores_.push_back(semaphore);
    return semaphore;
  }
  void waitFor(VkSemaphore semaphore, uint64_t value) const {
    VkSemaphoreWaitInfo wait{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
    wait.semaphoreCount = 1, wait.pSemaphores = &semaphore, wait.pValues = &value;
    expectDone(vkWaitSemaphores(device.device, &wait, 60'000'000'000));
  }
  void signal(VkSemaphore semaphore, uint64_t value) const {
    const VkSemaphoreSignalInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO, nullptr, semaphore, value};
    expectDone(vkSignalSemaphore(device.device, &info));
  }

  // The bytes of a layer that is in TRANSFER_SRC_OPTIMAL, on the program's own way; the rows from top to
  // bottom.
  std::vector<uint8_t> bytesOf(VkImage image, VkExtent2D extent, uint32_t bytesAPixel, uint32_t layer = 0,
                               VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT) {
    const VkDeviceSize size = VkDeviceSize(extent.width) * extent.height * bytesAPixel;
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = size, info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer;
    expectDone(vkCreateBuffer(device.device, &info, nullptr, &buffer));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device.device, buffer, &needs);
    const VkDeviceMemory memory =
        allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    expectDone(vkBindBufferMemory(device.device, buffer, memory, 0));
    const VkCommandBufferAllocateInfo one{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_,
                                          VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    VkCommandBuffer commands;
    expectDone(vkAllocateCommandBuffers(device.device, &one, &commands));
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    expectDone(vkBeginCommandBuffer(commands, &begin));
    VkBufferImageCopy copy{};
    copy.imageSubresource = {aspect, 0, layer, 1};
    copy.imageExtent = {extent.width, extent.height, 1};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &copy);
    VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
    barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT, barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.memoryBarrierCount = 1, dependency.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
    expectDone(vkEndCommandBuffer(commands));
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1, submit.pCommandBuffers = &commands;
    expectDone(vkQueueSubmit(device.queue, 1, &submit, VK_NULL_HANDLE));
    expectDone(vkQueueWaitIdle(device.queue));
    std::vector<uint8_t> bytes(size);
    void* mapped;
    expectDone(vkMapMemory(device.device, memory, 0, size, 0, &mapped));
    std::memcpy(bytes.data(), mapped, size);
    vkFreeCommandBuffers(device.device, pool_, 1, &commands);
    vkDestroyBuffer(device.device, buffer, nullptr);
    vkFreeMemory(device.device, memory, nullptr);
    return bytes;
  }

  VulkanDevice device;

 private:
  struct OwnImage {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
  };

  static std::string vulkanDeviceName() {
    RendererOptions options;
    options.device = testDevice();
    const auto renderer = Renderer::create(options);
    if (!renderer) throw std::runtime_error(renderer.error().message());
    return (*renderer)->gpu().name;
  }

  VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) const {
    VkPhysicalDeviceMemoryProperties properties;
    vkGetPhysicalDeviceMemoryProperties(device.physical, &properties);
    for (uint32_t type = 0; type < properties.memoryTypeCount; ++type) {
      if (!(needs.memoryTypeBits >> type & 1)) continue;
      if ((properties.memoryTypes[type].propertyFlags & wanted) != wanted) continue;
      const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
      VkDeviceMemory memory;
      expectDone(vkAllocateMemory(device.device, &info, nullptr, &memory));
      return memory;
    }
    throw std::runtime_error("no such memory");
  }

  std::string messages_;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  std::vector<OwnImage> images_;
  std::vector<VkSemaphore> semaphores_;
};

// A picture of halves as the library reads it back: these have no partial coverage.
std::vector<float> floatsOf(const std::vector<uint8_t>& halves) {
  std::vector<float> floats(halves.size() / 2);
  for (size_t i = 0; i < floats.size(); ++i) {
    uint16_t half;
    std::memcpy(&half, &halves[2 * i], 2);
    floats[i] = glm::unpackHalf1x16(half);
  }
  return floats;
}

class Vulkan : public RenderTest {
 protected:
  static constexpr uint32_t kWidth = 72, kHeight = 48;
  static constexpr VkExtent2D kExtent{kWidth, kHeight};
  static constexpr VkFormat kHalf = VK_FORMAT_R16G16B16A16_SFLOAT;
  const Scene scene = stillLife().load();
  const Stand stand{{2, 2.5f, 6}, {0, 0.8f, 0}};

  std::vector<View> views(Stereo stereo = Stereo::mono) const {
    return viewsFrom(scene, stand, kWidth, kHeight, stereo);
  }
  static VulkanTarget target(VkImage image, VkFormat format = kHalf) {
    VulkanTarget target;
    target.image = image, target.format = format, target.extent = kExtent;
    target.after = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    return target;
  }
  static std::unique_ptr<Renderer> on(const Program& program) {
    auto made = createRenderer(program.device);
    if (!made) throw std::runtime_error(made.error().message());
    return std::move(made).value();
  }
};

TEST_F(Vulkan, threeFramesInFlightIntoOwnImages) {
  Program program;
  const std::unique_ptr<Renderer> renderer = on(program);
  EXPECT_EQ(vulkanDeviceOf(*renderer).device, program.device.device);
  const VkSemaphore start = program.timeline(), done = program.timeline();
  const RenderOptions options = sized(kWidth, kHeight, {}, 4);
  constexpr int kFrames = 3;
  std::vector<VkImage> images;
  for (int i = 0; i < kFrames; ++i) images.push_back(program.image(kHalf, kExtent));
  for (int i = 0; i < kFrames; ++i) {
    VulkanTargets targets;
    targets.images = {target(images[size_t(i)])};
    VkSemaphoreSubmitInfo wait{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO}, signal = wait;
    wait.semaphore = start, wait.value = 1, wait.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    signal.semaphore = done, signal.value = uint64_t(i + 1),
    signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    targets.waits = {wait}, targets.signals = {signal};
    const Status status = begin(*renderer, scene, Look(), 0.5 * i, views(), options, targets);
    ASSERT_TRUE(status.ok()) << status.error().message();
  }
  // All three are under way, and none has begun: nothing was waited for.
  uint64_t value = 7;
  expectDone(vkGetSemaphoreCounterValue(program.device.device, done, &value));
  EXPECT_EQ(value, 0u);
  VulkanTargets one;
  one.images = {target(images[0])};
  EXPECT_EQ(begin(*renderer, scene, Look(), 0, views(), options, one).error().kind, ErrorKind::usage);
  program.signal(start, 1);
  program.waitFor(done, kFrames);
  for (int i = 0; i < kFrames; ++i) {
    const std::vector<float> own = floatsOf(program.bytesOf(images[size_t(i)], kExtent, 8));
    const auto finished = renderer->finish();
    ASSERT_TRUE(finished.ok());
    EXPECT_TRUE(finished->layers.empty()) << "something was read back";
    const auto frame = Vulkan::renderer().render(scene, Look(), 0.5 * i, views(), options);
    ASSERT_TRUE(frame.ok());
    EXPECT_EQ(own, frame->layers[0].views[0].pixels) << "frame " << i;
  }
}

// While somebody else has the queue nothing is submitted to it; and somebody else has it in between, over and
// over.
TEST_F(Vulkan, theQueueIsShared) {
  Program program;
  std::mutex lock;
  program.device.queueLock = &lock;
  const std::unique_ptr<Renderer> renderer = on(program);
  EXPECT_EQ(vulkanDeviceOf(*renderer).queueLock, &lock);
  const RenderOptions options = sized(kWidth, kHeight, {}, 4);
  const auto expected = Vulkan::renderer().render(scene, Look(), 0, views(), options);
  ASSERT_TRUE(expected.ok());
  // From now on a frame takes far less than the time that is waited for below.
  ASSERT_TRUE(renderer->render(scene, Look(), 0, views(), options).ok());
  std::unique_lock held(lock);
  auto drawn =
      std::async(std::launch::async, [&] { return renderer->render(scene, Look(), 0, views(), options); });
  EXPECT_EQ(drawn.wait_for(std::chrono::milliseconds(1500)), std::future_status::timeout);
  held.unlock();
  while (drawn.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    const std::lock_guard own(lock);
    expectDone(vkQueueSubmit(program.device.queue, 0, nullptr, VK_NULL_HANDLE));
  }
  const auto frame = drawn.get();
  ASSERT_TRUE(frame.ok()) << frame.error().message();
  EXPECT_TRUE(sameBytes(frame->layers[0].views[0], expected->layers[0].views[0]));
}

// What frames under way use changes when they are done, whatever else the queue still holds.
TEST_F(Vulkan, whatTheQueueHoldsOfOthersIsNotWaitedFor) {
  Program program;
  const std::unique_ptr<Renderer> renderer = on(program);
  const VkSemaphore others = program.timeline();
  const RenderOptions options = sized(kWidth, kHeight);
  // Both textures are on the device already: an upload would wait for its own place in the queue.
  Look look, other;
  ASSERT_TRUE(other.set("warp.metatexture.example", std::string("strokes")));
  for (const Look& each : {other, look}) ASSERT_TRUE(renderer->render(scene, each, 0, views(), options).ok());
  ASSERT_TRUE(renderer->begin(scene, look, 0, views(), options).ok());
  VkSemaphoreSubmitInfo wait{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
  wait.semaphore = others, wait.value = 1, wait.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.waitSemaphoreInfoCount = 1, submit.pWaitSemaphoreInfos = &wait;
  expectDone(vkQueueSubmit2(program.device.queue, 1, &submit, VK_NULL_HANDLE));
  // Another texture: sets of descriptors are written.
  auto begun =
      std::async(std::launch::async, [&] { return renderer->begin(scene, other, 0, views(), options); });
  EXPECT_EQ(begun.wait_for(std::chrono::seconds(30)), std::future_status::ready);
  program.signal(others, 1);
  ASSERT_TRUE(begun.get().ok());
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(renderer->finish().ok());
}

// An AOV of one view needs what the other does without; and a scene that grows between the frames.
TEST_F(Vulkan, anAovOfTheSecondViewAlone) {
  Program program;
  const std::unique_ptr<Renderer> renderer = on(program);
  SceneEditor editor(scene);
  std::vector<View> two = views();
  View small = viewsFrom(scene, stand, 36, 24)[0];
  small.size = {36, 24};
  two.push_back(small);
  constexpr VkExtent2D kSmall{36, 24};
  for (int round = 0; round < 3; ++round) {
    VulkanTargets targets;
    targets.images = {target(program.image(kHalf, kExtent)), target(program.image(kHalf, kSmall)),
                      target(program.image(kHalf, kSmall))};
    for (const size_t i : {1, 2}) targets.images[i].view = 1, targets.images[i].extent = kSmall;
    targets.images[2].aov = "depth";
    const Scene now = editor.scene().value();
    const Status status = begin(*renderer, now, Look(), 0, two, sized(kWidth, kHeight), targets);
    ASSERT_TRUE(status.ok()) << status.error().message();
    ASSERT_TRUE(renderer->finish().ok());
    const Frame usual = draw(now, Look(), two, sized(kWidth, kHeight));
    EXPECT_EQ(floatsOf(program.bytesOf(targets.images[0].image, kExtent, 8)),
              usual.layers[0].views[0].pixels);
    EXPECT_EQ(floatsOf(program.bytesOf(targets.images[1].image, kSmall, 8)), usual.layers[0].views[1].pixels);
    ASSERT_TRUE(editor.addNode({.mesh = MeshId(0)}).ok());
  }
}

// Two eyes, and a spectator of another size who changes nothing for them.
TEST_F(Vulkan, threeViewsAtOnce) {
  std::vector<View> all = views(Stereo::stereo);
  Stand other = stand;
  other.eye = {-3, 1.5f, 4};
  View spectator = viewsFrom(scene, other, 40, 56)[0];
  spectator.size = {40, 56}, spectator.rig = 1;
  all.push_back(spectator);
  const RenderOptions options = sized(kWidth, kHeight, {"depth", "shadow-map"}, 4);
  const Frame three = draw(scene, Look(), all, options),
              two = draw(scene, Look(), views(Stereo::stereo), options);
  spectator.rig = 0;
  const Frame one = draw(scene, Look(), {spectator}, sized(8, 8, {"depth", "shadow-map"}, 4));
  ASSERT_EQ(three.layers.size(), 3u);
  for (size_t layer = 0; layer < 2; ++layer) {
    ASSERT_EQ(three.layers[layer].views.size(), 3u);
    for (size_t v = 0; v < 2; ++v)
      EXPECT_TRUE(sameBytes(three.layers[layer].views[v], two.layers[layer].views[v]))
          << layer << ", eye " << v;
    EXPECT_EQ(three.layers[layer].views[2].width, 40u);
    EXPECT_EQ(three.layers[layer].views[2].height, 56u);
    EXPECT_TRUE(sameBytes(three.layers[layer].views[2], one.layers[layer].views[0])) << layer;
  }
  EXPECT_EQ(three.layers[2].views.size(), 1u) << "one shadow map for all";
  // Times are those of all of them.
  double passes = 0;
  for (const PassTime& pass : three.stats.passes) passes += pass.milliseconds;
  EXPECT_NEAR(three.stats.gpuMilliseconds, passes, 1e-6 * passes);
}

// The same six faces, whether they come together or in another order; more are refused.
TEST_F(Vulkan, sixViews) {
  std::vector<View> six;
  for (int i = 0; i < Renderer::kMaxViews; ++i) {
    Stand turned = stand;
    turned.target = turned.eye + glm::vec3(std::sin(float(i)), -0.2f, std::cos(float(i)));
    six.push_back(viewsFrom(scene, turned, kWidth, kHeight)[0]);
    six.back().rig = i;
  }
  const RenderOptions options = sized(kWidth, kHeight);
  const Frame together = draw(scene, Look(), six, options);
  std::vector<View> reversed(six.rbegin(), six.rend());
  const Frame backwards = draw(scene, Look(), reversed, options);
  for (size_t i = 0; i < six.size(); ++i) {
    EXPECT_TRUE(sameBytes(together.layers[0].views[i], backwards.layers[0].views[six.size() - 1 - i])) << i;
    EXPECT_TRUE(
        sameBytes(together.layers[0].views[i], draw(scene, Look(), {six[i]}, options).layers[0].views[0]));
  }
  six.push_back(six[0]);
  EXPECT_EQ(renderer().render(scene, Look(), 0, six, options).error().kind, ErrorKind::usage);
}

// Both eyes in one image, each in its half, and their depth in the layers of another; once more into the same
// images, where what is beside a rectangle stays.
TEST_F(Vulkan, rectanglesAndLayers) {
  Program program;
  const std::unique_ptr<Renderer> renderer = on(program);
  const VkExtent2D wide{2 * kWidth + 10, kHeight + 6};
  const VkImage both = program.image(kHalf, wide);
  const VkImage depths = program.image(VK_FORMAT_R32G32B32A32_SFLOAT, kExtent, 2);
  const RenderOptions options = sized(kWidth, kHeight);
  for (const bool again : {false, true}) {
    VulkanTargets targets;
    for (size_t v = 0; v < 2; ++v) {
      VulkanTarget& color = targets.images.emplace_back(target(both));
      color.extent = wide, color.view = v;
      color.offset = {int32_t(v * (kWidth + 10)), 6};
      if (again) color.before = color.after;
      VulkanTarget& depth = targets.images.emplace_back(target(depths, VK_FORMAT_R32G32B32A32_SFLOAT));
      depth.aov = "depth", depth.view = v, depth.layer = uint32_t(v);
    }
    const Status status = begin(*renderer, scene, Look(), 0, views(Stereo::stereo), options, targets);
    ASSERT_TRUE(status.ok()) << status.error().message();
    ASSERT_TRUE(renderer->finish().ok());
  }
  const Frame usual = draw(scene, Look(), views(Stereo::stereo), sized(kWidth, kHeight, {"depth"}));
  const std::vector<float> pixels = floatsOf(program.bytesOf(both, wide, 8));
  for (size_t v = 0; v < 2; ++v) {
    const Image &picture = usual.layers[0].views[v], &depth = usual.layers[1].views[v];
    const std::vector<uint8_t> bytes = program.bytesOf(depths, kExtent, 16, uint32_t(v));
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x) {
        for (uint32_t c = 0; c < 4; ++c)
          ASSERT_EQ(pixels[((y + 6) * wide.width + v * (kWidth + 10) + x) * 4 + c], picture.at(x, y, c));
        float own;
        std::memcpy(&own, &bytes[(y * kWidth + x) * 16], 4);
        ASSERT_EQ(own, depth.at(x, y, 0));
      }
  }
}

// How far away everything is, as depth buffers have it by the view's own projection: for who draws more over
// a frame, and for runtimes of headsets.
TEST_F(Vulkan, depthBuffers) {
  Program program;
  const std::unique_ptr<Renderer> renderer = on(program);
  for (const uint32_t samples : {1u, 4u}) {
    const VkImage both = program.image(VK_FORMAT_D32_SFLOAT, kExtent, 2);
    VulkanTargets targets;
    for (size_t v = 0; v < 2; ++v) {
      VulkanTarget& depth = targets.images.emplace_back(target(both, VK_FORMAT_D32_SFLOAT));
      depth.aov = "depth", depth.view = v, depth.layer = uint32_t(v);
    }
    const std::vector<View> eyes = views(Stereo::stereo);
    const Status status =
        begin(*renderer, scene, quietLook(), 0, eyes, sized(kWidth, kHeight, {}, samples), targets);
    ASSERT_TRUE(status.ok()) << status.error().message();
    const Result<Frame> frame = renderer->finish();
    ASSERT_TRUE(frame.ok());
    // Nothing is drawn for it that is not drawn anyway.
    for (const PassTime& pass : frame->stats.passes) EXPECT_NE(pass.name, "facts");
    const Frame usual = draw(scene, quietLook(), eyes, sized(kWidth, kHeight, {"depth"}));
    for (size_t v = 0; v < 2; ++v) {
      const std::vector<uint8_t> bytes =
          program.bytesOf(both, kExtent, 4, uint32_t(v), VK_IMAGE_ASPECT_DEPTH_BIT);
      // Of several samples it is one's.
      Difference metres(samples == 1 ? 0.02 : 0.5);
      size_t nothing = 0;
      for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x) {
          float own;
          std::memcpy(&own, &bytes[(y * kWidth + x) * 4], 4);
          const float far = usual.layers[1].views[v].at(x, y, 0);
          nothing += own == 0;
          if (far < 1e29f && own > 0) metres.add(eyes[v].eyeToClip[3][2] / own, far);
        }
      EXPECT_GT(nothing, 100u);
      EXPECT_LT(metres.beyondPart(), samples == 1 ? 0.001 : 0.05) << metres.text();
    }
  }
}

// What frame synthesis takes: where everything was a frame before, in normalised device coordinates.
TEST_F(Vulkan, motionThatIsNormalized) {
  Program program;
  const std::unique_ptr<Renderer> renderer = on(program);
  for (const Stereo stereo : {Stereo::mono, Stereo::stereo}) {
    const std::vector<View> eyes = views(stereo);
    RenderOptions options = sized(kWidth, kHeight, {}, 1);
    options.previousViews = eyes;
    for (View& view : options.previousViews) {
      glm::mat4 turned = glm::mat4_cast(glm::angleAxis(0.05f, glm::normalize(glm::vec3(0.3f, 1, 0.1f))));
      turned[3] = glm::vec4(0.03f, -0.02f, 0.2f, 1);
      view.worldToEye = turned * view.worldToEye;
    }
    const VkImage motions = program.image(VK_FORMAT_R32G32B32A32_SFLOAT, kExtent, 2),
                  depths = program.image(VK_FORMAT_D32_SFLOAT, kExtent, 2);
    VulkanTargets targets;
    for (size_t v = 0; v < eyes.size(); ++v) {
      VulkanTarget& motion = targets.images.emplace_back(target(motions, VK_FORMAT_R32G32B32A32_SFLOAT));
      motion.aov = "motion",
      motion.motion = stereo == Stereo::mono ? MotionUnit::ndc : MotionUnit::ndcUpwards, motion.view = v,
      motion.layer = uint32_t(v);
      VulkanTarget& depth = targets.images.emplace_back(target(depths, VK_FORMAT_D32_SFLOAT));
      depth.aov = "depth", depth.view = v, depth.layer = uint32_t(v);
    }
    const Status status = begin(*renderer, scene, quietLook(), 0, eyes, options, targets);
    ASSERT_TRUE(status.ok()) << status.error().message();
    const Result<Frame> frame = renderer->finish();
    ASSERT_TRUE(frame.ok());
    // Surfaces are drawn once for both.
    std::vector<std::string> drawn;
    for (const PassTime& pass : frame->stats.passes) drawn.push_back(pass.name);
    EXPECT_EQ(std::count(drawn.begin(), drawn.end(), "facts"), 1);
    EXPECT_EQ(std::count(drawn.begin(), drawn.end(), "color"), 0);

    options.aovs = {"position", "motion"};
    const Frame usual = draw(scene, quietLook(), eyes, options);
    for (size_t v = 0; v < eyes.size(); ++v) {
      const std::vector<uint8_t> bytes = program.bytesOf(motions, kExtent, 16, uint32_t(v));
      const std::vector<uint8_t> depthBytes =
          program.bytesOf(depths, kExtent, 4, uint32_t(v), VK_IMAGE_ASPECT_DEPTH_BIT);
      const View &now = eyes[v], &then = options.previousViews[v];
      Difference across(1e-4), deep(1e-5);
      size_t surfaces = 0, nothing = 0;
      for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x) {
          glm::vec4 moved;
          float depth;
          std::memcpy(&moved, &bytes[(y * kWidth + x) * 16], 16);
          if (stereo == Stereo::stereo) moved.y = -moved.y;
          std::memcpy(&depth, &depthBytes[(y * kWidth + x) * 4], 4);
          const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) / glm::vec2(kWidth, kHeight) * 2.0f - 1.0f;
          glm::dvec4 before;
          if (depth > 0) {
            ++surfaces;
            const glm::vec2 pixels(texel(aov(usual, "motion", v), x, y));
            across.add(moved.x, pixels.x * 2 / kWidth), across.add(moved.y, pixels.y * 2 / kHeight);
            const glm::dvec3 place(texel(aov(usual, "position", v), x, y));
            before = glm::dmat4(then.eyeToClip) * (glm::dmat4(then.worldToEye) * glm::dvec4(place, 1));
          } else {
            ++nothing;
            const glm::dmat4 toWorld = glm::inverse(glm::dmat4(now.eyeToClip) * glm::dmat4(now.worldToEye));
            // Two places of its ray.
            const auto at = [&](double d) {
              const glm::dvec4 place = toWorld * glm::dvec4(ndc, d, 1);
              return glm::dvec3(place) / place.w;
            };
            before =
                glm::dmat4(then.eyeToClip) * (glm::dmat4(then.worldToEye) * glm::dvec4(at(0.5) - at(0.9), 0));
          }
          across.add(moved.x, ndc.x - before.x / before.w), across.add(moved.y, ndc.y - before.y / before.w);
          deep.add(moved.z, depth - before.z / before.w);
        }
      EXPECT_GT(surfaces, 100u);
      EXPECT_GT(nothing, 100u);
      EXPECT_LT(across.beyondPart(), 0.001) << across.text();
      EXPECT_LT(deep.beyondPart(), 0.001) << deep.text();
    }
  }
}

// Of one view alone: eyes go into images, and what somebody else sees of the same frame comes back.
TEST_F(Vulkan, whatComesBackOfOneView) {
  Program program;
  const std::unique_ptr<Renderer> renderer = on(program);
  std::vector<View> all = views(Stereo::stereo);
  Stand other = stand;
  other.eye = {-3, 1.5f, 4};
  View spectator = viewsFrom(scene, other, 40, 56)[0], cursor = spectator;
  spectator.size = {40, 56}, spectator.rig = 1;
  cursor.size = {1, 1}, cursor.rig = 2;
  all.insert(all.end(), {spectator, cursor});
  RenderOptions options = sized(kWidth, kHeight, {}, 4);
  options.formats[""] = PixelFormat::srgb8;
  const VkImage both = program.image(kHalf, kExtent, 2);
  VulkanTargets targets;
  for (size_t v = 0; v < 2; ++v) {
    targets.images.push_back(target(both));
    targets.images.back().view = v, targets.images.back().layer = uint32_t(v);
  }
  targets.readbacks = {{2, ""}, {3, "id"}, {3, "position"}};
  ASSERT_TRUE(begin(*renderer, scene, Look(), 0, all, options, targets).ok());
  const Result<Frame> frame = renderer->finish();
  ASSERT_TRUE(frame.ok());
  const Frame usual = draw(scene, Look(), all, sized(kWidth, kHeight, {"id", "position"}, 4)),
              coded = draw(scene, Look(), all, options);
  std::vector<std::string> names;
  for (const Frame::Layer& layer : frame->layers) {
    names.push_back(layer.name);
    ASSERT_EQ(layer.views.size(), all.size());
    const size_t own = layer.name.empty() ? 2 : 3;
    for (size_t v = 0; v < all.size(); ++v) EXPECT_EQ(layer.views[v].width > 0, v == own) << layer.name << v;
    EXPECT_TRUE(sameBytes(layer.views[own],
                          layer.name.empty() ? coded.layers[0].views[2] : aov(usual, layer.name, own)));
  }
  EXPECT_EQ(names, (std::vector<std::string>{"", "id", "position"}));
  EXPECT_EQ(frame->objects, usual.objects);
  EXPECT_EQ(frame->materials, usual.materials);
  const std::vector<float> eye = floatsOf(program.bytesOf(both, kExtent, 8, 1));
  EXPECT_GT(eye[4 * (kHeight / 2 * kWidth + kWidth / 2)], 0);
  for (const VulkanReadback& wrong : {VulkanReadback{4, ""}, {0, "no-such"}}) {
    targets.readbacks = {wrong};
    const Status status = begin(*renderer, scene, Look(), 0, all, options, targets);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().kind, ErrorKind::usage);
  }
}

TEST_F(Vulkan, eightBits) {
  Program program;
  const std::unique_ptr<Renderer> renderer = on(program);
  const Frame usual = draw(scene, Look(), views(), sized(kWidth, kHeight));
  for (const VkFormat format : {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_SRGB,
                                VK_FORMAT_B8G8R8A8_UNORM}) {
    const VkImage image = program.image(format, kExtent);
    VulkanTargets targets;
    targets.images = {target(image, format)};
    ASSERT_TRUE(begin(*renderer, scene, Look(), 0, views(), sized(kWidth, kHeight), targets).ok());
    ASSERT_TRUE(renderer->finish().ok());
    const std::vector<uint8_t> bytes = program.bytesOf(image, kExtent, 4);
    const bool isBgr = format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_B8G8R8A8_UNORM;
    size_t differ = 0;
    for (uint32_t y = 0; y < kHeight; ++y)
      for (uint32_t x = 0; x < kWidth; ++x)
        for (uint32_t c = 0; c < 3; ++c) {
          const int own = bytes[(y * kWidth + x) * 4 + (isBgr ? 2 - c : c)];
          const int expected = srgbCode(usual.layers[0].views[0].at(x, y, c));
          ASSERT_LE(std::abs(own - expected), 1) << format << " at " << x << ", " << y;
          differ += own != expected;
        }
    EXPECT_LT(differ, size_t(3 * kWidth * kHeight / 5)) << format;
  }
}

TEST_F(Vulkan, targetsThatDoNotFitAreRefused) {
  Program program;
  const std::unique_ptr<Renderer> renderer = on(program);
  const VkImage image = program.image(kHalf, kExtent);
  const auto refusal = [&](const std::function<void(VulkanTarget&)>& change) {
    VulkanTargets targets;
    targets.images = {target(image)};
    change(targets.images[0]);
    const Status status = begin(*renderer, scene, Look(), 0, views(), sized(kWidth, kHeight), targets);
    return status.ok() ? "" : status.error().problem;
  };
  EXPECT_EQ(refusal([](VulkanTarget& t) { t.image = VK_NULL_HANDLE; }), "a target has no image");
  EXPECT_NE(refusal([](VulkanTarget& t) { t.view = 1; }).find("view"), std::string::npos);
  EXPECT_NE(refusal([](VulkanTarget& t) { t.format = VK_FORMAT_D32_SFLOAT; }).find("format"),
            std::string::npos);
  EXPECT_NE(refusal([](VulkanTarget& t) { t.offset.x = 1; }).find("rectangle"), std::string::npos);
  EXPECT_NE(refusal([](VulkanTarget& t) { t.aov = "shadow-map"; }).find("size of its own"),
            std::string::npos);
  EXPECT_NE(refusal([](VulkanTarget& t) { t.aov = "dept"; }).find("no AOV"), std::string::npos);
  EXPECT_NE(refusal([](VulkanTarget& t) { t.motion = MotionUnit::ndc; }).find("motion"), std::string::npos);
  EXPECT_EQ(createRenderer(VulkanDevice()).error().kind, ErrorKind::usage);
}

// A pose that changes after the frame was recorded: everything is seen from there.
TEST_F(Vulkan, lateLatch) {
  const std::vector<std::string> facts{"depth", "position", "id"};
  for (const Stereo stereo : {Stereo::mono, Stereo::stereo}) {
    std::vector<View> before = views(stereo), after = before;
    for (View& view : after) {
      glm::mat4 nod(1.0f);
      nod[3] = glm::vec4(0.03f, -0.02f, 0.01f, 1);
      view.worldToEye = nod * view.worldToEye;
    }
    RenderOptions options = sized(kWidth, kHeight, facts);
    const Frame there = draw(scene, Look(), after, options), here = draw(scene, Look(), before, options);
    options.latch = [&](std::vector<View>& views) {
      ASSERT_EQ(views.size(), before.size());
      for (size_t v = 0; v < views.size(); ++v) EXPECT_EQ(views[v].worldToEye, before[v].worldToEye);
      views = after;
    };
    const Frame latched = draw(scene, Look(), before, options);
    for (size_t v = 0; v < before.size(); ++v) {
      for (size_t layer = 1; layer <= facts.size(); ++layer)
        EXPECT_TRUE(sameBytes(latched.layers[layer].views[v], there.layers[layer].views[v]))
            << facts[layer - 1];
      EXPECT_FALSE(sameBytes(latched.layers[1].views[v], here.layers[1].views[v]));
    }
    // The same views, and views that nobody can see from, change nothing.
    options.latch = [](std::vector<View>&) {};
    EXPECT_TRUE(sameBytes(draw(scene, Look(), before, options).layers[0].views[0], here.layers[0].views[0]));
    options.latch = [](std::vector<View>& views) { views[0].eyeToClip = glm::mat4(1.0f); };
    EXPECT_TRUE(sameBytes(draw(scene, Look(), before, options).layers[0].views[0], here.layers[0].views[0]));
    options.latch = [](std::vector<View>& views) { views.clear(); };
    EXPECT_TRUE(sameBytes(draw(scene, Look(), before, options).layers[0].views[0], here.layers[0].views[0]));
  }
}

TEST_F(Vulkan, wishesOfADevice) {
  RendererOptions options;
  options.device = testDevice();
  VulkanWishes wishes;
  wishes.deviceExtensions = {VK_KHR_TIMELINE_SEMAPHORE_EXTENSION_NAME};
  wishes.features = [](VulkanFeatures& features) { features.timelineSemaphore.timelineSemaphore = VK_TRUE; };
  const auto made = createRenderer(wishes, options);
  ASSERT_TRUE(made.ok()) << made.error().message();
  // The device can do what was asked for.
  const VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO, nullptr,
                                       VK_SEMAPHORE_TYPE_TIMELINE, 5};
  const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type};
  const VkDevice device = vulkanDeviceOf(**made).device;
  VkSemaphore semaphore;
  ASSERT_EQ(vkCreateSemaphore(device, &info, nullptr, &semaphore), VK_SUCCESS);
  uint64_t value = 0;
  EXPECT_EQ(vkGetSemaphoreCounterValue(device, semaphore, &value), VK_SUCCESS);
  EXPECT_EQ(value, 5u);
  vkDestroySemaphore(device, semaphore, nullptr);
  EXPECT_TRUE((*made)->render(scene, Look(), 0, views(), sized(kWidth, kHeight)).ok());

  wishes.deviceExtensions = {"VK_SCUMBLE_no_such_extension"};
  EXPECT_EQ(createRenderer(wishes, options).error().kind, ErrorKind::noUsableGpu);
  wishes = {};
  wishes.instanceExtensions = {"VK_SCUMBLE_no_such_extension"};
  EXPECT_EQ(createRenderer(wishes, options).error().kind, ErrorKind::noUsableGpu);
}

}  // namespace
}  // namespace scumble
