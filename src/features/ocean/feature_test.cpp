// What must hold for the feature's knobs.
#include "features/ocean/ocean.h"
#include "features/ocean/paint/ocean_knobs.h"
#include "frame/feature_parts.h"
#include "tests/support/row_defaults.h"

namespace scumble::ocean {

frame::FeatureParts makeFeature();

namespace {

TEST(OceanFeature, structsStartWithTheirRowsDefaults) {
  std::set<const look::ParamBlock*> seen;
  test::expectRowsDefaults<OceanParams>(seen);
  test::expectRowsDefaults<DecorationParams>(seen);
  test::expectRowsDefaults<OceanPaintParams>(seen);
  test::expectRowsDefaults<OceanMetaTextureParams>(seen);
  test::expectRowsDefaults<FloatParams>(seen);
  test::expectRowsDefaults<DrapeParams>(seen);
  const frame::FeatureParts parts = makeFeature();
  EXPECT_EQ(std::set(parts.blocks.begin(), parts.blocks.end()), seen);
}

}  // namespace
}  // namespace scumble::ocean
