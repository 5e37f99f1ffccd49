// The table of knobs against the look asked knob by knob.
#include "stage/knob_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "scumble/look.h"
#include "stage/animation_params.h"
#include "stage/palette.h"

namespace scumble::stage {
namespace {

using Materials = std::vector<KnobTable::Material>;

template <class Params>
bool isSame(const Params& a, const Params& b) {
  return std::ranges::equal(std::as_bytes(std::span(&a, 1)), std::as_bytes(std::span(&b, 1)));
}

// File before hand, the whole scene before some names, the later one last.
Look lookOf() {
  Look look = *Look::fromJson(R"({"palette": {"saturation": 0.5},
      "materials": {"Wood*": {"palette": {"saturation": 0.7, "darkest": 0.1}, "animation": {"hold": 2}},
                    "Wood2": {"palette": {"saturation": 0.9}}},
      "nodes": {"Boat": {"palette": {"lightest": 0.8}}}})",
                              "test");
  EXPECT_TRUE(look.set("palette.darkest", "0.3"));
  EXPECT_TRUE(look.set("materials.*2.palette.lightest", "0.6"));
  return look;
}

TEST(KnobTable, areThoseOfTheLookForEachMaterial) {
  const Look look = lookOf();
  const look::LookData& data = look.data();
  std::vector<uint32_t> boat;
  for (uint32_t i = 0; i < data.assignments.size(); ++i)
    if (data.assignments[i].target == look::kNodes) boat.push_back(i);
  ASSERT_EQ(boat.size(), 1u);
  const Materials materials{{"Stone", {}},   {"Wood", {}},  {"Wood2", {}}, {"Stone", boat},
                            {"Wood2", boat}, {"Metal", {}}, {"Wood", {}},  {"Wood1", {}}};
  KnobTable knobs;
  knobs.evaluate(data);
  knobs.evaluate(materials);
  EXPECT_TRUE(isSame(knobs.scene<PaletteParams>(), data.get<PaletteParams>()));
  EXPECT_EQ(knobs.scene<PaletteParams>().saturation, 0.5f);
  EXPECT_EQ(knobs.scene<PaletteParams>().darkest, 0.3f);
  ASSERT_EQ(knobs.materialCount(), materials.size());
  for (size_t m = 0; m < materials.size(); ++m) {
    const std::string name(materials[m].name);
    EXPECT_TRUE(
        isSame(knobs.of<PaletteParams>(m), data.getForMaterial<PaletteParams>(name, materials[m].settings)))
        << m;
    EXPECT_TRUE(isSame(knobs.of<AnimationParams>(m), data.getForMaterial<AnimationParams>(name))) << m;
    EXPECT_TRUE(isSame(knobs.of<LitParams>(m), data.getForMaterial<LitParams>(name))) << m;
  }
  // Stone and Metal; Wood and Wood1; Wood2; two on the boat.
  EXPECT_EQ(knobs.rowCount(), 5u);
}

// What was found for names is asked again: with other values, other patterns, other names.
TEST(KnobTable, followTheLook) {
  Look look = lookOf();
  KnobTable knobs;
  const auto expectSame = [&](const Materials& materials) {
    const look::LookData& data = look.data();
    knobs.evaluate(data);
    knobs.evaluate(materials);
    for (size_t m = 0; m < materials.size(); ++m)
      EXPECT_TRUE(isSame(knobs.of<PaletteParams>(m),
                         data.getForMaterial<PaletteParams>(std::string(materials[m].name))))
          << materials[m].name;
  };
  const Materials materials{{"Wood", {}}, {"Wood2", {}}, {"Stone", {}}};
  expectSame(materials);
  ASSERT_TRUE(look.set("materials.*2.palette.lightest", "0.7"));
  expectSame(materials);
  ASSERT_TRUE(look.set("materials.St*.palette.lightest", "0.4"));
  expectSame(materials);
  expectSame({{"Stone2", {}}, {"Wood", {}}});
  look = Look();
  expectSame(materials);
}

}  // namespace
}  // namespace scumble::stage
