// Shaders that take the place of the library's own.
#include "renderer/shader_table.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "base/test_folder.h"
#include "tests/support/aov.h"
#include "tests/support/render_test.h"
#include "tests/support/test_device.h"

namespace scumble {
namespace {

using namespace test;

class ShaderFolder : public RenderTest {
 protected:
  static constexpr int kWidth = 64, kHeight = 48;
  const Scene scene_ = stillLife().load();
  const TestFolder folder_;

  void write(const std::string& name, const std::vector<uint32_t>& words) const {
    folder_.put(name + ".spv", {reinterpret_cast<const char*>(words.data()), 4 * words.size()});
  }
  Result<std::unique_ptr<Renderer>> made() const {
    RendererOptions options;
    options.device = testDevice();
    options.validation = true;
    options.shaderFolder = folder_.path();
    return Renderer::create(options);
  }
  std::vector<float> picture(Renderer& renderer) const {
    const Result<Frame> frame = renderer.render(scene_, Look(), 0, viewsFrom(scene_, {}, kWidth, kHeight),
                                                sized(kWidth, kHeight, {}, 1));
    EXPECT_TRUE(frame.ok()) << frame.error().message();
    EXPECT_EQ(renderer.validationMessages(), 0);
    return frame ? aov(*frame, "").pixels : std::vector<float>();
  }
};

std::vector<uint32_t> wordsOf(const renderer::NamedShader& shader) {
  return {shader.words.begin(), shader.words.end()};
}

TEST_F(ShaderFolder, theTableHasEachOnce) {
  std::set<std::string> names;
  for (const renderer::NamedShader& shader : renderer::shaderTable()) {
    EXPECT_TRUE(names.insert(shader.name).second) << shader.name;
    EXPECT_GT(shader.words.size(), 5u) << shader.name;
  }
  EXPECT_TRUE(names.count("final_color_image_frag") && names.count("fullscreen_vert"));
}

TEST_F(ShaderFolder, theSameShadersGiveTheSamePictureAndOthersAnother) {
  const std::vector<float> own = picture(renderer());
  for (const renderer::NamedShader& shader : renderer::shaderTable()) write(shader.name, wordsOf(shader));
  const auto same = made();
  ASSERT_TRUE(same.ok()) << same.error().message();
  EXPECT_EQ(picture(**same), own);
  // In those of one pass, each constant of 1 becomes a half.
  constexpr uint32_t kOpConstant = 43;
  int changed = 0;
  for (const renderer::NamedShader& shader : renderer::shaderTable()) {
    if (!std::string_view(shader.name).starts_with("final_color_")) continue;
    std::vector<uint32_t> words = wordsOf(shader);
    for (size_t i = 5; i < words.size(); i += std::max(words[i] >> 16, 1u))
      if ((words[i] & 0xFFFF) == kOpConstant && words[i] >> 16 == 4 &&
          words[i + 3] == std::bit_cast<uint32_t>(1.0f))
        words[i + 3] = std::bit_cast<uint32_t>(0.5f), ++changed;
    write(shader.name, words);
  }
  ASSERT_GT(changed, 0);
  const auto other = made();
  ASSERT_TRUE(other.ok()) << other.error().message();
  EXPECT_NE(picture(**other), own);
}

TEST_F(ShaderFolder, whatIsNoShaderIsRefused) {
  const auto problemOf = [&] {
    const auto made = this->made();
    EXPECT_FALSE(made.ok());
    if (made) return std::string();
    EXPECT_EQ(made.error().kind, ErrorKind::unusableFile);
    return made.error().message();
  };
  write("nobody", {1, 2, 3});
  EXPECT_TRUE(made().ok()) << "files of other names are not read";
  const std::vector<uint32_t> right = wordsOf(renderer::shaderTable().front());
  const std::string name = renderer::shaderTable().front().name;
  for (const std::vector<uint32_t>& wrong :
       {std::vector<uint32_t>(), {0x07230203}, std::vector<uint32_t>(right.begin() + 1, right.end())}) {
    write(name, wrong);
    EXPECT_NE(problemOf().find(name), std::string::npos);
  }
  write(name, right);
  folder_.put(name + ".spv", contentOf(folder_.file(name + ".spv")) + "x");
  EXPECT_NE(problemOf().find("no SPIR-V"), std::string::npos);
  RendererOptions options;
  options.device = testDevice();
  options.shaderFolder = folder_.file("nowhere");
  EXPECT_EQ(Renderer::create(options).error().kind, ErrorKind::unusableFile);
}

}  // namespace
}  // namespace scumble
