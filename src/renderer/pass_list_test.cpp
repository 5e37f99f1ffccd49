// What must hold for all blocks of knobs at once: the structs that passes read start with the values that
// `scumble params` shows, and the list of blocks is complete.
#include "renderer/pass_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>

#include "frame/metatexture.h"
#include "passes/blur/blur_knobs.h"
#include "passes/color/color_knobs.h"
#include "passes/colorize/colorize_knobs.h"
#include "passes/cull/cull_knobs.h"
#include "passes/final_color/final_color_knobs.h"
#include "passes/final_shadow/final_shadow_knobs.h"
#include "passes/limit/limit_knobs.h"
#include "passes/shadow_map/shadow_map_knobs.h"
#include "passes/surface/surface_knobs.h"
#include "passes/warp/warp_knobs.h"
#include "renderer/feature_list.h"
#include "scumble/renderer.h"
#include "stage/animation_params.h"
#include "stage/camera.h"
#include "stage/light.h"
#include "stage/palette.h"
#include "tests/support/asset_files.h"
#include "tests/support/row_defaults.h"

namespace scumble::renderer {
namespace {

using test::expectRowsDefaults;

TEST(PassList, structsStartWithTheirRowsDefaults) {
  std::set<const look::ParamBlock*> seen;
  expectRowsDefaults<LightParams>(seen);
  expectRowsDefaults<PaletteParams>(seen);
  expectRowsDefaults<LitParams>(seen);
  expectRowsDefaults<ShadowedParams>(seen);
  expectRowsDefaults<GroundParams>(seen);
  expectRowsDefaults<passes::ShadowMapParams>(seen);
  expectRowsDefaults<passes::SurfaceParams>(seen);
  expectRowsDefaults<passes::BlurParams>(seen);
  expectRowsDefaults<passes::FinalShadowParams>(seen);
  expectRowsDefaults<passes::WarpParams>(seen);
  expectRowsDefaults<passes::BackgroundParams>(seen);
  expectRowsDefaults<passes::FinalColorParams>(seen);
  expectRowsDefaults<passes::LimitParams>(seen);
  expectRowsDefaults<passes::LevelsParams>(seen);
  expectRowsDefaults<passes::TextureParams>(seen);
  expectRowsDefaults<passes::IndirectParams>(seen);
  expectRowsDefaults<passes::BreakupParams>(seen);
  expectRowsDefaults<WarpMetaTextureParams>(seen);
  expectRowsDefaults<BreakupMetaTextureParams>(seen);
  expectRowsDefaults<TextureMetaTextureParams>(seen);
  expectRowsDefaults<AnimationParams>(seen);
  expectRowsDefaults<PlayParams>(seen);
  expectRowsDefaults<CameraParams>(seen);
  expectRowsDefaults<passes::VolumeParams>(seen);
  expectRowsDefaults<passes::GradeParams>(seen);
  // Features test their own.
  for (const frame::FeatureParts& parts : features()) seen.insert(parts.blocks.begin(), parts.blocks.end());
  for (const look::ParamBlock* block : look::allBlocks())
    EXPECT_TRUE(seen.count(block)) << block->path << ": a new block of knobs; add its struct to this test";
  EXPECT_EQ(look::allBlocks().size(), seen.size())
      << "a block of knobs that the list leaves out, or one twice";
}

// Passes of features that come after one pass: by name, but above those that they name, however they are
// given.
TEST(PassList, featuresAtOnePlaceHaveAnOrder) {
  const std::vector<std::string> known{"ash", "birch", "cedar", "not-built"};
  using Above = std::vector<std::string_view>;
  const auto ordered = [&](const std::vector<std::pair<std::string, Above>>& passes) {
    std::vector<FeaturePass> list;
    for (const auto& [feature, above] : passes) list.push_back({feature, {"final-color", nullptr, above}});
    std::string names;
    for (const FeaturePass& pass : inOrder(list, known)) names += pass.feature + " ";
    return names;
  };
  EXPECT_EQ(ordered({{"cedar", {}}, {"ash", {}}, {"birch", {}}}), "ash birch cedar ");
  EXPECT_EQ(ordered({{"ash", {"cedar"}}, {"birch", {}}, {"cedar", {}}}), "birch cedar ash ");
  EXPECT_EQ(ordered({{"ash", {"birch", "cedar"}}, {"birch", {"cedar"}}, {"cedar", {}}}), "cedar birch ash ");
  EXPECT_EQ(ordered({{"ash", {"not-built"}}, {"birch", {}}}), "ash birch ");
  EXPECT_EQ(ordered({{"birch", {}}, {"ash", {}}, {"ash", {}}}), "ash ash birch ");
  EXPECT_THROW(ordered({{"ash", {"elm"}}, {"birch", {}}}), std::logic_error) << "there is no such feature";
  EXPECT_THROW(ordered({{"ash", {"birch"}}, {"birch", {"ash"}}}), std::logic_error) << "a circle";
}

// As docs/passes.md has them: what lies on the picture, from below.
TEST(PassList, featuresPassesStandAsThePagesSay) {
  std::vector<std::string> names;
  for (const auto& pass : standardPasses().makeAll()) names.emplace_back(pass->name());
  std::ifstream page(test::kSource / "docs/passes.md");
  std::vector<std::string> told;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `")) continue;
    // Every name of the first cell.
    const std::string cell = line.substr(0, line.find('|', 1));
    for (size_t at = cell.find('`'); at != cell.npos; at = cell.find('`', cell.find('`', at + 1) + 1))
      told.push_back(cell.substr(at + 1, cell.find('`', at + 1) - at - 1));
    if (told.back() == "plain") break;  // the tables behind have other things
  }
  const auto placeOf = [](const std::vector<std::string>& in, std::string name) {
    std::replace(name.begin(), name.end(), '_', '-');
    const auto found = std::find_if(in.begin(), in.end(), [&](std::string other) {
      std::replace(other.begin(), other.end(), '_', '-');
      return other == name;
    });
    return found == in.end() ? -1 : int(found - in.begin());
  };
  const auto follow = [&](const char* from, const char* to) {
    int last = -1;
    for (size_t i = size_t(placeOf(names, from)); i < size_t(placeOf(names, to)); ++i) {
      const int at = placeOf(told, names[i]);
      ASSERT_GE(at, 0) << names[i] << " is not on the page";
      EXPECT_GT(at, last) << names[i] << " stands on the page before a pass that it comes after";
      last = at;
    }
  };
  follow("order", "surface");
  follow("final-color", "facts");
  // What lies behind goes through some of them once more.
  for (const std::string& name : names) {
    if (!name.starts_with("behind-")) {
      EXPECT_GE(placeOf(told, name), 0) << name << " is not on the page";
    }
  }
}

// Shaders pad nothing, and neither does the program's face: names of AOVs are different words of small
// letters.
TEST(PassList, namesOfAovsAreThePromisedOnes) {
  const std::vector<std::string> names = Renderer::aovNames();
  const std::set<std::string> unique(names.begin(), names.end());
  EXPECT_EQ(unique.size(), names.size());
  for (const std::string& name : names)
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos);
  // docs: PROGRAM.md promises these to scripts.
  for (const char* name : {"warp", "shadow-map", "shadow", "blur", "final-shadow", "lit", "shadowed", "color",
                           "limit", "final-color", "depth", "position", "normal", "uv", "uv-gradient",
                           "metatexture", "motion", "id", "cryptomatte"})
    EXPECT_TRUE(unique.count(name)) << name;
}

TEST(PassList, aovsSayWhatTheyHold) {
  const auto passes = standardPasses().makeAll();
  const std::vector<const Aov*> aovs = aovsOf(passes);
  ASSERT_GT(aovs.size(), 15u);
  for (const Aov* const aov : aovs) {
    ASSERT_NE(aov->name, nullptr);
    ASSERT_NE(aov->channels[0], nullptr) << aov->name;
    for (size_t c = 1; c < aov->channels.size(); ++c)
      EXPECT_TRUE(!aov->channels[c] || aov->channels[c - 1]) << aov->name << ": a gap between channels";
    if (aov->premultiplied > 0) {
      EXPECT_NE(aov->channels[3], nullptr) << aov->name << ": without coverage";
    }
  }
}

class Nothing : public Pass {
 public:
  explicit Nothing(const char* name) : name_(name) {}
  const char* name() const override { return name_; }
  void declare(FrameBuilder&, uint32_t) override {}
  void create(FrameBuilder&) override {}
  void bind(const gpu::GraphResources&) override {}

 private:
  const char* name_;
};

TEST(PassList, passesAreInsertedByTheNamesOfOthers) {
  PassList list;
  for (const char* const name : {"a", "b", "b", "c"})
    list.append([=] { return std::make_unique<Nothing>(name); });
  EXPECT_TRUE(list.insertBefore("b", [] { return std::make_unique<Nothing>("x"); }));
  EXPECT_TRUE(list.insertAfter("b", [] { return std::make_unique<Nothing>("y"); }));
  EXPECT_TRUE(list.insertAfter("c", [] { return std::make_unique<Nothing>("z"); }));
  EXPECT_FALSE(list.insertBefore("d", [] { return std::make_unique<Nothing>("w"); }));
  std::string names;
  for (const auto& pass : list.makeAll()) names += pass->name();
  EXPECT_EQ(names, "axbbycz");
}

}  // namespace
}  // namespace scumble::renderer
